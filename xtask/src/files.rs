//! Lists and reads the files of the workspace.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Folders that we skip, because they hold build output or packages of others.
const PASSED_OVER: [&str; 5] = ["target", "out", "__pycache__", "node_modules", "shared"];

/// The root of the workspace.
#[must_use]
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(1).unwrap_or(Path::new(".")).to_owned()
}

/// Paths of all files below `folder` in order, seen from the root. This skips hidden files and
/// build output.
///
/// # Panics
/// If a folder cannot be read, or a name is not Unicode.
#[must_use]
pub fn files_below(folder: &str) -> Vec<String> {
    let root = root();
    let mut found = Vec::new();
    let mut folders = vec![root.join(folder)];
    while let Some(folder) = folders.pop() {
        let entries = std::fs::read_dir(&folder);
        for entry in entries.unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
            let path = entry.unwrap_or_else(|error| panic!("{}: {error}", folder.display())).path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if name.starts_with('.') || PASSED_OVER.contains(&&*name) {
                continue;
            }
            if path.is_dir() {
                folders.push(path);
            } else {
                let inside = path.strip_prefix(&root).unwrap_or(&path);
                found.push(inside.to_string_lossy().into_owned());
            }
        }
    }
    found.sort();
    found
}

/// Path and text of every file with one of the `endings`.
///
/// # Panics
/// If there is none, or a file cannot be read.
#[must_use]
pub fn texts(endings: &[&str]) -> BTreeMap<String, String> {
    let files = files_below("");
    let wanted = files.into_iter().filter(|path| endings.iter().any(|end| path.ends_with(end)));
    let found: BTreeMap<_, _> = wanted.map(|path| (path.clone(), text(&path))).collect();
    assert!(!found.is_empty(), "no file ends in {endings:?}");
    found
}

/// Text of the file at `path`, a path from the root.
#[must_use]
pub fn text(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Whether there is a file at `path`, a path from the root.
#[must_use]
pub fn exists(path: &str) -> bool {
    root().join(path).is_file()
}

/// The folder of a path, without a slash at its end. This is empty for a file in the root.
#[must_use]
pub fn folder_of(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(folder, _)| folder)
}
