//! The commands of docs/measuring.md, run in order.

use suite::program::{impasto, repository};

use crate::painted::{filled, oils};

/// The words of a command, as a shell would part them.
fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (index, part) in line.split('"').enumerate() {
        if index % 2 == 1 {
            words.push(part.to_owned());
        } else {
            words.extend(part.split_whitespace().map(str::to_owned));
        }
    }
    words
}

#[test]
fn every_command_of_the_page_on_measuring_runs() {
    let page = std::fs::read_to_string(repository("docs/measuring.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let oils = oils();
    let mut ran = 0;
    for block in page.split("```sh\n").skip(1) {
        let block = block.split("```").next().unwrap().replace("\\\n", " ");
        for line in block.lines().filter_map(|line| line.trim().strip_prefix("impasto ")) {
            let in_folder = |word: String| {
                let is_file = word.ends_with(".csv") || word.ends_with(".json");
                if is_file { folder.path().join(word).display().to_string() } else { word }
            };
            let words: Vec<String> = words(line).into_iter().map(in_folder).collect();
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            let run = impasto(&words);
            assert_eq!(run.status, 0, "impasto {line}\n{}", run.err);
            ran += 1;
            // A plan's file is filled in before what follows reads it.
            if let Some(at) = words.iter().position(|word| *word == "--output")
                && words[0] == "plan"
            {
                let empty = std::fs::read_to_string(words[at + 1]).unwrap();
                std::fs::write(words[at + 1], filled(&empty, &oils, 0.002, 3)).unwrap();
            }
        }
    }
    assert!(ran >= 5, "{ran} commands");
}
