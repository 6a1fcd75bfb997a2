//! The folder of a painter's sets of brushes, one JSON file for each.

use std::path::{Path, PathBuf};

use documents::file::{disk, read, write_whole};

use super::reading::BrushFileError;
use super::set::BrushSet;
use crate::failure::FileFailure;

/// A set with its file.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredSet {
    /// File of the set.
    pub path: PathBuf,
    /// The brushes in it.
    pub set: BrushSet,
}

/// All sets of a folder, sorted by file name, and the errors of files that could not be used. These
/// files stay as they are. A folder that does not exist has no sets.
#[must_use]
pub fn read_sets(folder: &Path) -> (Vec<StoredSet>, Vec<FileFailure>) {
    let entries = match disk::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Default::default(),
        Err(error) => return (Vec::new(), vec![FileFailure::io(folder, "listed", &error)]),
    };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut paths: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "json")).collect();
    paths.sort();
    let mut sets = Vec::new();
    let mut failures = Vec::new();
    for path in paths {
        match read_set(&path) {
            Ok(set) => sets.push(StoredSet { path, set }),
            Err(failure) => failures.push(failure),
        }
    }
    (sets, failures)
}

/// Reads a set of brushes from its file.
///
/// # Errors
/// [`FileFailure`] if the file cannot be read, or if a key is wrong, which the message then names.
pub fn read_set(path: &Path) -> Result<BrushSet, FileFailure> {
    let text = read_text(path)?;
    BrushSet::of_json(&text, &path.display().to_string())
        .map_err(|error| FileFailure::explained(&error))
}

/// Writes a set to its file. Creates the folder if it is missing.
///
/// # Errors
/// [`FileFailure`] if folder or file cannot be written.
pub fn write_set(stored: &StoredSet) -> Result<(), FileFailure> {
    if let Some(folder) = stored.path.parent() {
        disk::create_dir_all(folder).map_err(|error| FileFailure::io(folder, "created", &error))?;
    }
    write_whole(&stored.path, stored.set.to_json().as_bytes())
        .map_err(|error| FileFailure::explained(&error))
}

/// Path for a new set in a folder: its name in lower case, with a number if one of `taken` has it.
#[must_use]
pub fn free_path(folder: &Path, name: &str, taken: &[StoredSet]) -> PathBuf {
    let stem: String = name
        .chars()
        .take(40)
        .map(
            |letter: char| {
                if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '-' }
            },
        )
        .collect();
    let stem = stem.trim_matches('-').to_owned();
    let stem = if stem.is_empty() { "brushes".to_owned() } else { stem };
    let mut path = folder.join(format!("{stem}.json"));
    let mut number = 2;
    while disk::exists(&path) || taken.iter().any(|stored| stored.path == path) {
        path = folder.join(format!("{stem}-{number}.json"));
        number += 1;
    }
    path
}

/// Text of a file.
///
/// # Errors
/// [`FileFailure`] if the file cannot be read or is not text.
pub fn read_text(path: &Path) -> Result<String, FileFailure> {
    let bytes = read(path).map_err(|error| FileFailure::explained(&error))?;
    String::from_utf8(bytes).map_err(|_| {
        FileFailure::explained(&BrushFileError {
            file: path.display().to_string(),
            key: String::new(),
            what: "is not text".to_owned(),
            hint: None,
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_survive_their_folder_and_a_broken_file_stays_as_it_is() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("brushes");
        assert_eq!(read_sets(&folder), (Vec::new(), Vec::new()));
        let mut sets: Vec<StoredSet> = Vec::new();
        for name in ["Portraits!", "portraits", "\u{fc}"] {
            let path = free_path(&folder, name, &sets);
            sets.push(StoredSet { path, set: BrushSet::new(name) });
        }
        let files: Vec<_> = sets.iter().filter_map(|stored| stored.path.file_name()).collect();
        assert_eq!(files, ["portraits.json", "portraits-2.json", "brushes.json"]);
        sets.iter().for_each(|stored| write_set(stored).unwrap());
        let broken = folder.join("a.json");
        std::fs::write(&broken, "{}").unwrap();
        let (read, failures) = read_sets(&folder);
        let order: Vec<_> = read.iter().map(|stored| stored.set.name()).collect();
        assert_eq!(order, ["\u{fc}", "portraits", "Portraits!"], "the order of the files");
        let [failure] = &failures[..] else { panic!("{failures:?}") };
        assert!(failure.what.contains("a.json") && failure.what.contains("`format`"), "{failure}");
        assert_eq!(std::fs::read_to_string(&broken).unwrap(), "{}");
        assert!(free_path(&folder, "A", &[]).ends_with("a-2.json"), "the broken one is there");
    }
}
