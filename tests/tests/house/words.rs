//! Wording: doc comments that can be read alone, and libraries that name no command-line option.

use crate::files::texts;

/// Openers that make a doc comment hard to read, and the number from which the test fails.
const RIDDLES: [&str; 3] = ["What ", "The same", "As "];
const MOST_RIDDLES: usize = 40;

/// Number of doc comments of one or two words from which the test fails.
const MOST_SHORT: usize = 100;

/// Place and text, joined to one line, of every doc comment in the sources of crates.
fn doc_comments() -> Vec<(String, String)> {
    let mut found = Vec::new();
    for (path, source) in texts(&[".rs"]) {
        if !path.contains("src/") || path.starts_with("tests/") {
            continue;
        }
        let mut before = None;
        for (line, number) in source.lines().map(str::trim).zip(1..) {
            let kind = line.get(..3).filter(|kind| ["///", "//!"].contains(kind));
            let Some(kind) = kind.filter(|_| !line.starts_with("////")) else {
                before = None;
                continue;
            };
            let words = line[3..].trim();
            if before == Some(kind) {
                let (_, text): &mut (String, String) = found.last_mut().unwrap();
                *text = format!("{text} {words}").trim().to_owned();
            } else {
                found.push((format!("{path}:{number}"), words.to_owned()));
            }
            before = Some(kind);
        }
    }
    found
}

#[test]
fn doc_comments_say_what_a_thing_is() {
    let comments = doc_comments();
    assert!(comments.len() > 5000, "{} doc comments found", comments.len());
    let list = |chosen: &dyn Fn(&str) -> bool| -> Vec<String> {
        let chosen = comments.iter().filter(|(_, text)| chosen(text));
        chosen.map(|(place, text)| format!("{place}: {text}")).collect()
    };
    let riddles = list(&|text| RIDDLES.iter().any(|opener| text.starts_with(opener)));
    assert!(
        riddles.len() < MOST_RIDDLES,
        "{} begin with {RIDDLES:?}:\n{}",
        riddles.len(),
        riddles.join("\n")
    );
    let short = list(&|text| text.split_whitespace().count() <= 2);
    assert!(short.len() < MOST_SHORT, "{} of one or two words:\n{}", short.len(), short.join("\n"));
}

/// Whether `line` names a command-line option: two dashes and a lower-case letter at the start of a
/// word. Properties of a style sheet, `var(--ink)` or `{--ink:`, do not count.
fn names_an_option(line: &str) -> bool {
    let bytes = line.as_bytes();
    (0..bytes.len().saturating_sub(2)).any(|at| {
        let before = &bytes[..at];
        let begins = before.last().is_none_or(|last| b" `\"'(".contains(last));
        let dashes = &bytes[at..at + 2] == b"--" && bytes[at + 2].is_ascii_lowercase();
        begins && dashes && !before.ends_with(b"var(")
    })
}

#[test]
fn no_library_names_an_option_of_a_command_line() {
    let libraries = ["spectra/", "calibrate/", "render/", "reports/", "apps/session/"];
    let mut found = Vec::new();
    for (path, source) in texts(&[".rs"]) {
        let library = libraries.iter().any(|folder| path.starts_with(folder));
        if !library || !path.contains("/src/") || path.ends_with("/tests.rs") {
            continue;
        }
        let source = source.split("#[cfg(test)]\nmod tests {").next().unwrap();
        let lines = source.lines().zip(1..).filter(|(line, _)| names_an_option(line));
        found.extend(lines.map(|(line, number)| format!("{path}:{number}: {}", line.trim())));
    }
    assert!(found.is_empty(), "{}:\n{}", found.len(), found.join("\n"));
    assert!(names_an_option("paint with --backend cpu"), "an option");
    assert!(names_an_option("name it (--recipes FILE)"), "an option in parentheses");
    assert!(!names_an_option("a row ------ of dashes, and a--b"), "no option");
    assert!(!names_an_option(":root{--ink:{};} a{color:var(--ink)}"), "no option");
}
