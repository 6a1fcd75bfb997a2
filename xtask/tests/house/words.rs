//! Wording: libraries do not name options of a command line.

use xtask::files::texts;

/// Whether `line` names a command-line option: two dashes and a lower-case letter at the start of a
/// word. Properties of a style sheet, `var(--ink)` or `{--ink:`, do not count as one.
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
