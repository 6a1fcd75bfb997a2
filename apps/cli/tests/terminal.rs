//! The built program in a terminal: the spinner and the progress bar of slow verbs.

#![cfg(target_os = "linux")]
#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use std::path::Path;
use std::process::Command;

/// A script of strokes that takes seconds.
fn slow(folder: &Path) -> String {
    let stroke =
        r#"{"stroke": {"brush": "flat", "samples": [[0, 3, 4, 0.4], [0.5, 56, 36, 0.6]]}}"#;
    let actions = vec![stroke; 16].join(", ");
    let text = format!(
        r#"{{"format": "strokes", "version": 1, "title": "Slow",
        "canvas": {{"width_mm": 60, "height_mm": 40, "cell_mm": 0.125}},
        "palette": {{"W": "Lead White"}}, "brushes": {{"flat": {{"shape": "flat", "size_mm": 9}}}},
        "actions": [{{"load": {{"brush": "flat", "recipe": {{"W": 1}}, "amount_mm": 0.3}}}}, {actions}]}}"#
    );
    let path = folder.join("slow.json");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Bytes that a terminal receives while a shell runs `line`, in which `impasto` is the built program.
/// `script` of util-linux makes the terminal.
fn seen(line: &str) -> String {
    let line = format!("impasto() {{ '{}' \"$@\"; }}; {line}", env!("CARGO_BIN_EXE_impasto"));
    let output = Command::new("script")
        .args(["--quiet", "--return", "--command", &line, "/dev/null"])
        .env("SHELL", "/bin/sh")
        .env("TERM", "xterm")
        .env_remove("NO_COLOR")
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{text}");
    text
}

/// The lines that stay on the screen after carriage returns and erased lines.
fn stays(seen: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut rest = seen;
    while let Some(letter) = rest.chars().next() {
        rest = &rest[letter.len_utf8()..];
        let line = lines.last_mut().unwrap();
        match letter {
            '\n' => lines.push(String::new()),
            '\r' if !rest.starts_with('\n') => line.clear(),
            '\r' => {}
            '\x1b' => {
                rest = rest
                    .trim_start_matches(|c: char| !c.is_ascii_alphabetic())
                    .get(1..)
                    .unwrap_or("");
            }
            other => line.push(other),
        }
    }
    lines.retain(|line| !line.is_empty());
    lines
}

#[test]
fn a_bar_is_drawn_in_a_terminal_and_cleared_again() {
    let folder = tempfile::tempdir().unwrap();
    let script = slow(folder.path());
    let out = folder.path().join("a.png");
    let paint = format!("impasto paint '{script}' --backend cpu -o '{}'", out.display());
    // Results go elsewhere, the bar stays in the terminal.
    let results = folder.path().join("results.txt");
    let drawn = seen(&format!("{paint} > '{}'", results.display()));
    assert!(drawn.contains("painting [") && drawn.contains("/17"), "{drawn}");
    let left = stays(&drawn);
    assert!(left.iter().all(|line| !line.contains("painting [")), "{left:?}");
    assert!(left.iter().any(|line| line.starts_with("Wrote ")), "{left:?}");
    let results = std::fs::read_to_string(&results).unwrap();
    assert!(results.contains("16 strokes") && !results.contains('\x1b'), "{results}");
    // No bar where remarks go to a file, or where none are wanted.
    let errors = folder.path().join("errors.txt");
    let elsewhere = seen(&format!("{paint} 2> '{}'", errors.display()));
    assert!(elsewhere.contains("16 strokes") && !elsewhere.contains("painting ["), "{elsewhere}");
    let errors = std::fs::read_to_string(&errors).unwrap();
    assert!(errors.contains("Wrote ") && !errors.contains("painting ["), "{errors}");
    let quiet = seen(&format!("{paint} -q"));
    assert!(quiet.contains("16 strokes") && !quiet.contains("painting ["), "{quiet}");
}

#[test]
fn a_spinner_is_drawn_in_a_terminal_and_cleared_again() {
    let folder = tempfile::tempdir().unwrap();
    let model = format!(
        "impasto watercolor shape:still-life --width 2400 --backend cpu -o '{}'",
        folder.path().join("a.png").display()
    );
    let drawn = seen(&model);
    assert!(drawn.contains(" painting (") || drawn.contains(" preparing the model ("), "{drawn}");
    let left = stays(&drawn);
    assert!(left.iter().all(|line| !line.contains(" (")), "{left:?}");
    assert!(left.iter().any(|line| line.starts_with("Wrote ")), "{left:?}");
    let quiet = seen(&format!("{model} -q"));
    assert!(!quiet.contains("painting (") && !quiet.contains("preparing"), "{quiet}");
    let library =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../measurements/van-gogh-oils.pigments.json");
    let mixing = seen(&format!("impasto quadrature '{library}' --nodes 18"));
    let label = mixing.contains("wavelengths (") || mixing.contains(" comparing mixtures (");
    assert!(label, "{mixing}");
}

#[test]
fn a_dumb_terminal_gets_no_escapes() {
    let library =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../measurements/van-gogh-oils.pigments.json");
    let mix = format!("impasto mix '{library}' Viridian=1");
    assert!(seen(&mix).contains('\x1b'), "a patch of colour");
    let plain = seen(&format!("export TERM=dumb; {mix}"));
    assert!(plain.contains("100.00 % Viridian") && !plain.contains('\x1b'), "{plain}");
}
