//! Runs the commands of the README and of the guides as they are printed.
//!
//! They run in a folder with small copies of the files that ship, and with the files that a page
//! asks its reader for. We change only the size of a command: `SMALL` adds options to commands that
//! would paint large pictures. The page on measuring has its own test in `plan`, which fills in
//! readings.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod files;

use std::path::Path;

use suite::program::{Command, commands, impasto, repository};

/// Pages, in the order of reading.
const PAGES: [&str; 12] = [
    "README.md",
    "docs/guide/command-line.md",
    "docs/guide/fitting.md",
    "docs/guide/matching.md",
    "docs/guide/maps.md",
    "docs/guide/painting.md",
    "docs/guide/watercolor.md",
    "docs/guide/painterly.md",
    "docs/guide/volumes.md",
    "docs/guide/browser.md",
    "docs/guide/browser-studio.md",
    "docs/guide/figures.md",
];

/// We do not run the commands of these programs. Rust has its own tests, the studio needs a
/// display, the Python package and the pages in `web` are tested with their commands, and folders
/// belong to the reader.
const OTHERS: [&str; 8] = [
    "cargo",
    "IMPASTO_TURNTABLE=1",
    "impasto-studio",
    "mkdir",
    "pip",
    "rustup",
    "apps/web/build",
    "apps/web/serve",
];

/// Verb, words that the command must contain, and options that make its work small.
const SMALL: [(&str, &[&str], &[&str]); 8] = [
    ("paint", &["--from"], &["--width-mm", "24"]),
    ("paint", &["--from"], &["--palette", "Lead White,Ultramarine,Chrome Yellow,Vermilion"]),
    ("watercolor", &["shape:"], &["--width", "96"]),
    ("painterly", &["shape:"], &["--width", "96"]),
    ("stencil", &["shape:"], &["--width", "96"]),
    ("stencil", &["--animation"], &["--rate", "2"]),
    ("validate", &[], &["--folds", "4"]),
    ("report", &["-o"], &["--no-validation"]),
];

/// Makes a command small: with the options of [`SMALL`], few frames, and a small style and map
/// instead of those that ship.
fn small(words: &[String]) -> Vec<String> {
    let mut words = words.to_vec();
    fn has(words: &[String], part: &str) -> bool {
        words.iter().any(|word| word.contains(part))
    }
    for (verb, parts, more) in SMALL {
        let meant = words[1] == verb && parts.iter().all(|part| has(&words, part));
        if meant && !has(&words, more[0]) {
            words.extend(more.iter().map(|&word| word.to_owned()));
        }
    }
    let own_style = words.iter().any(|word| word == "mine.toml");
    fn replaced(words: &mut Vec<String>, option: &str, by: [&str; 2]) {
        match words.iter().position(|word| word == option) {
            Some(at) => words[at..at + 2].clone_from_slice(&by.map(str::to_owned)),
            None => words.extend(by.map(str::to_owned)),
        }
    }
    match (words[1].as_str(), words.get(2).map(String::as_str)) {
        ("artmap", Some("paint")) if !own_style && !has(&words, "--show-style") => {
            replaced(&mut words, "--style", ["--style", files::STYLE]);
        }
        ("artmap", Some("build")) => replaced(&mut words, "--size", ["--size", "64"]),
        // The map for a material does not replace the map for everything else.
        ("painterly", _) if has(&words, "--style") || !has(&words, "--map") => {
            replaced(&mut words, "--style", ["--map", files::MAP]);
        }
        _ => {}
    }
    for index in 1..words.len() {
        if ["--turntable", "--loop"].contains(&words[index - 1].as_str()) {
            words[index] = "2".to_owned();
        }
    }
    words
}

fn run(page: &str, command: &Command) {
    let words = small(&command.words);
    let words: Vec<&str> = words.iter().skip(1).map(String::as_str).collect();
    let run = impasto(&words);
    assert_eq!(run.status, 0, "{page}: {}\n{}", command.line, run.err);
    if let Some(output) = &command.output {
        let path = Path::new(output);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).unwrap();
        }
        std::fs::write(path, files::small_style(&run.out)).unwrap();
    }
    for pair in command.words.windows(2) {
        let file = Path::new(&pair[1]);
        if pair[0] == "-o" && pair[1] != "-" {
            assert!(file.exists(), "{page}: {} wrote no {}", command.line, file.display());
        }
    }
}

/// This is one test, since the working folder belongs to the whole process.
#[test]
fn every_command_of_the_guides_runs_as_it_is_printed() {
    let mut ran = 0;
    for page in PAGES {
        let text = std::fs::read_to_string(repository(page)).unwrap();
        let folder = tempfile::tempdir().unwrap();
        std::env::set_current_dir(folder.path()).unwrap();
        files::prepare(folder.path(), &text);
        for command in commands(&text) {
            match command.words[0].as_str() {
                "impasto" => {
                    run(page, &command);
                    ran += 1;
                }
                other => assert!(OTHERS.contains(&other), "{page}: {}", command.line),
            }
        }
        std::env::set_current_dir(repository("")).unwrap();
    }
    assert!(ran >= 70, "{ran} commands");
}

#[test]
fn every_page_with_commands_is_run() {
    let elsewhere = ["measuring.md", "strokes.md"];
    for entry in std::fs::read_dir(repository("docs/guide")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let text = std::fs::read_to_string(&path).unwrap();
        let known = PAGES.contains(&format!("docs/guide/{name}").as_str());
        assert!(
            known || elsewhere.contains(&name.as_str()) || commands(&text).is_empty(),
            "{name} has commands that no test runs"
        );
    }
}
