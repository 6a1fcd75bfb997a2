//! Notices of the crates that our programs contain: most licences ask that copies carry their text.
//!
//! We take them from the sources that cargo keeps, so that the list is right for every `Cargo.lock`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::runs::{Outcome, Run};

/// Beginnings of the names of files with a licence, in upper case.
const NAMES: [&str; 8] =
    ["LICENSE", "LICENCE", "COPYING", "COPYRIGHT", "NOTICE", "UNLICENSE", "OFL", "UFL"];
/// Line between two texts.
const LINE: &str =
    "--------------------------------------------------------------------------------";

/// A crate of others: name and version, e.g. `serde 1.0.228`, and its licence.
type Notice = (String, String);

/// The notices of all crates of others in both programs. Equal texts are printed once.
pub(crate) fn notices() -> Outcome<String> {
    let crates = crates()?;
    let sources = sources()?;
    let mut texts: BTreeMap<String, BTreeSet<&str>> = BTreeMap::new();
    let mut without: Vec<&Notice> = Vec::new();
    for notice in &crates {
        let folder = sources.iter().map(|folder| folder.join(notice.0.replace(' ', "-")));
        let Some(folder) = folder.into_iter().find(|folder| folder.is_dir()) else {
            return Err(format!("{}: its source is missing, call `cargo fetch`", notice.0));
        };
        let found = licences(&folder, 2)?;
        if found.is_empty() {
            without.push(notice);
        }
        for text in found {
            texts.entry(text).or_default().insert(&notice.0);
        }
    }
    let mut whole = String::from("impasto contains these crates, under their licences:\n\n");
    for (name, licence) in &crates {
        whole += &format!("{name}: {licence}\n");
    }
    whole += "\nThese have no file of their licence. The texts of MIT and Apache-2.0 are in LICENSE-MIT and \
        LICENSE-APACHE:\n\n";
    for (name, licence) in without {
        whole += &format!("{name}: {licence}\n");
    }
    for (text, names) in texts {
        let names: Vec<&str> = names.into_iter().collect();
        whole += &format!("\n{LINE}\n{}\n\n{text}\n", names.join(", "));
    }
    Ok(whole)
}

/// The crates of others that both programs contain on this system.
fn crates() -> Outcome<BTreeSet<Notice>> {
    let tree = Run::cargo("tree --locked -e normal --prefix none -p impasto -p impasto-studio");
    let tree = tree.args(["--format", "{p}|{l}"]).output()?;
    Ok(tree.lines().filter_map(notice).collect())
}

/// The crate of a line such as `serde v1.0.228 (*)|MIT OR Apache-2.0`. Our own crates have a path.
fn notice(line: &str) -> Option<Notice> {
    let (package, licence) = line.split_once('|')?;
    let mut words = package.split_whitespace();
    let name = words.next()?;
    let version = words.next()?.strip_prefix('v')?;
    let is_ours = words.any(|word| word.starts_with("(/") || word.contains(":\\"));
    (!is_ours).then(|| (format!("{name} {version}"), licence.trim_end_matches(" (*)").to_owned()))
}

/// Folders in which cargo keeps the sources of crates.
fn sources() -> Outcome<Vec<PathBuf>> {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(std::env::home_dir()?.join(".cargo")));
    let folder = home.ok_or("there is no home folder")?.join("registry/src");
    entries(&folder)
}

/// The paths in a folder, in order.
fn entries(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let fault = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(fault)? {
        found.push(entry.map_err(fault)?.path());
    }
    found.sort();
    Ok(found)
}

/// Texts of licences in a folder and, as fonts have them, `depth` - 1 levels below it.
fn licences(folder: &Path, depth: usize) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    for path in entries(folder)? {
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_uppercase();
        if path.is_dir() && depth > 1 {
            found.extend(licences(&path, depth - 1)?);
        } else if path.is_file() && NAMES.iter().any(|start| name.starts_with(start)) {
            let text = fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
            let text = String::from_utf8_lossy(&text).replace("\r\n", "\n");
            found.push(text.trim_matches('\n').to_owned());
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_a_tree_name_crates_of_others() {
        let of = |line: &str| notice(line).map(|(name, licence)| format!("{name}, {licence}"));
        assert_eq!(
            of("serde v1.0.2|MIT OR Apache-2.0").as_deref(),
            Some("serde 1.0.2, MIT OR Apache-2.0")
        );
        assert_eq!(of("paste v1.0.15 (proc-macro) (*)|MIT").as_deref(), Some("paste 1.0.15, MIT"));
        assert_eq!(of("impasto v0.2.0 (/a/apps/cli)|MIT"), None);
        assert_eq!(of("impasto v0.2.0 (C:\\a\\apps)|MIT"), None);
        assert_eq!(of(""), None);
    }

    #[test]
    fn every_crate_of_the_programs_has_a_notice() {
        let crates = crates().unwrap();
        assert!(crates.len() > 150, "{} crates", crates.len());
        let text = notices().unwrap();
        let (list, texts) = text.split_once("These have no file").unwrap();
        for (name, licence) in &crates {
            assert!(!licence.is_empty(), "{name} has no licence");
            assert!(list.contains(&format!("\n{name}: {licence}\n")), "{name}");
            // In a list of names above a text, or in the list of those without.
            assert!(texts.contains(name), "{name} has no text");
        }
        let has = |name: &str| crates.iter().any(|(known, _)| known.starts_with(name));
        assert!(
            has("serde ") && has("eframe ") && !has("proptest ") && !has("impasto"),
            "{crates:?}"
        );
        assert!(
            texts.contains("Permission is hereby granted")
                && texts.contains("SIL OPEN FONT LICENSE")
        );
    }
}
