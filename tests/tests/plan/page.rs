//! The commands of docs/guide/measuring.md, run in order.

use suite::program::{impasto, repository};

use crate::painted::{filled, oils};

/// Splits a command into words as a shell does, with double quotes.
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

/// Splits a filled measurement file into a file of spectra and a file of recipes.
fn parted(full: &str) -> (String, String) {
    let header: Vec<&str> = full.lines().next().unwrap().split(',').collect();
    let first_nm = header.iter().position(|name| *name == "400").unwrap();
    let (mut spectra, mut amounts) = (String::new(), String::new());
    let mut last = "";
    for line in full.lines() {
        let cells: Vec<&str> = line.split(',').collect();
        spectra += &format!("{},{}\n", cells[..3].join(","), cells[first_nm..].join(","));
        if cells[0] != last && cells[1] != "none" {
            amounts += &format!("{},{}\n", cells[0], cells[4..first_nm].join(","));
        }
        last = cells[0];
    }
    (spectra, amounts)
}

#[test]
fn every_command_of_the_page_on_measuring_runs() {
    let page = std::fs::read_to_string(repository("docs/guide/measuring.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let oils = oils();
    for (name, light) in [("white.txt", 20_000.0), ("dark.txt", 200.0), ("swatch.txt", 9_000.0)] {
        let count = |step: u32| format!("{} {}\n", 400 + 10 * step, light + f64::from(step));
        let text: String = (0..31).map(count).collect();
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let mut ran = 0;
    for block in page.split("```sh\n").skip(1) {
        let block = block.split("```").next().unwrap().replace("\\\n", " ");
        for line in block.lines().filter_map(|line| line.trim().strip_prefix("impasto ")) {
            let in_folder = |word: String| {
                let is_file = [".csv", ".json", ".txt"].iter().any(|end| word.ends_with(end));
                if is_file { folder.path().join(word).display().to_string() } else { word }
            };
            let words: Vec<String> = words(line).into_iter().map(in_folder).collect();
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            let run = impasto(&words);
            assert_eq!(run.status, 0, "impasto {line}\n{}", run.err);
            assert!(!run.err.contains("left out: card"), "the cards are lost\n{}", run.err);
            ran += 1;
            // The file of a plan is filled in before the next command reads it.
            if let Some(at) = words.iter().position(|word| *word == "--output")
                && words[0] == "plan"
            {
                let empty = std::fs::read_to_string(words[at + 1]).unwrap();
                let full = filled(&empty, &oils, 0.002, 3);
                std::fs::write(words[at + 1], &full).unwrap();
                let (spectra, amounts) = parted(&full);
                std::fs::write(folder.path().join("spectra.csv"), spectra).unwrap();
                std::fs::write(folder.path().join("amounts.csv"), amounts).unwrap();
            }
        }
    }
    assert!(ran >= 8, "{ran} commands");
}
