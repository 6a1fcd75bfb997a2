//! The oldest Rust that builds the workspace, in every place that names it.

use crate::files::text;

/// Places of the version: a file, and the text before the version.
const PLACES: [(&str, &str); 8] = [
    ("Cargo.toml", "rust-version = \""),
    ("apps/python/Cargo.toml", "rust-version = \""),
    ("apps/web/Cargo.toml", "rust-version = \""),
    ("apps/web/bindgen/Cargo.toml", "rust-version = \""),
    ("clippy.toml", "msrv = \""),
    ("README.md", "needs Rust "),
    ("CONTRIBUTING.md", "Rust "),
    (".ci/run", "install Rust "),
];

/// The oldest Rust that each file names, or `None` if it does not name one.
#[must_use]
pub fn oldest_rust() -> Vec<(&'static str, Option<String>)> {
    PLACES.map(|(path, before)| (path, version_after(&text(path), before))).to_vec()
}

/// Reads the version after the first `before` in `text`.
fn version_after(text: &str, before: &str) -> Option<String> {
    text.match_indices(before).find_map(|(at, _)| {
        let rest = &text[at + before.len()..];
        let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
        let version = rest[..end].trim_end_matches('.');
        version.contains('.').then(|| version.to_owned())
    })
}

/// Checks that all files name one version.
///
/// # Errors
/// If they differ. The error lists each file with its version.
pub fn agree_on_rust() -> Result<(), String> {
    let found = oldest_rust();
    let first = &found[0].1;
    if first.is_some() && found.iter().all(|(_, version)| version == first) {
        return Ok(());
    }
    let places = found
        .iter()
        .map(|(path, version)| format!("  {path}: {}", version.as_deref().unwrap_or("none")));
    Err(format!(
        "the oldest Rust is not the same everywhere:\n{}",
        places.collect::<Vec<_>>().join("\n")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_names_the_same_rust() {
        assert_eq!(agree_on_rust(), Ok(()));
    }

    #[test]
    fn a_version_ends_before_the_full_stop() {
        let text = "Rust is fast. Install Rust 1.95. Or Rust 2.0";
        assert_eq!(version_after(text, "Rust "), Some("1.95".to_owned()));
        assert_eq!(version_after("Rust", "Rust "), None);
    }
}
