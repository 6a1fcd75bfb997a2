//! Lists and reads the files of the workspace.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

/// Paths from the root of all files below `folder`, without hidden files and build output.
pub(crate) fn files_below(folder: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap();
            if name.starts_with('.')
                || ["target", "out", "__pycache__", "node_modules"].contains(&name)
            {
                continue;
            }
            if path.is_dir() {
                folders.push(path);
            } else {
                found.push(path.strip_prefix(root()).unwrap().to_str().unwrap().to_owned());
            }
        }
    }
    found.sort();
    found
}

/// Path and text of every file whose name ends in one of `endings`.
pub(crate) fn texts(endings: &[&str]) -> BTreeMap<String, String> {
    let files = files_below("");
    let wanted = files.into_iter().filter(|path| endings.iter().any(|end| path.ends_with(end)));
    let found: BTreeMap<_, _> = wanted.map(|path| (path.clone(), text(&path))).collect();
    assert!(!found.is_empty(), "no file ends in {endings:?}");
    found
}

pub(crate) fn text(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Whether there is a file at `path`, a path from the root.
pub(crate) fn exists(path: &str) -> bool {
    root().join(path).is_file()
}
