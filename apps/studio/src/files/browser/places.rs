//! Folders that a painter goes to: their own, those of recent files, and drives.

use std::path::{Path, PathBuf};

#[cfg(not(target_arch = "wasm32"))]
use directories::UserDirs;

use crate::language::english;
use documents::file::disk;

/// Most folders of recent files.
const MOST_FOLDERS: usize = 6;

/// Kinds of places, each with a heading of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PlaceKind {
    /// The painter's own folders.
    Own,
    /// Folders in which files were chosen lately.
    Lately,
    /// Drives and cards.
    Drive,
}

/// A folder that one click opens.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PlaceFolder {
    pub(super) kind: PlaceKind,
    pub(super) name: String,
    pub(super) path: PathBuf,
}

/// The user's home folder, or the root folder if it is not known.
#[must_use]
#[cfg(not(target_arch = "wasm32"))]
pub(super) fn home_folder() -> PathBuf {
    UserDirs::new().map_or_else(|| PathBuf::from("/"), |dirs| dirs.home_dir().to_owned())
}

/// The folder of files that the painter opened or saved in this page.
#[must_use]
#[cfg(target_arch = "wasm32")]
pub(super) fn home_folder() -> PathBuf {
    PathBuf::from("/files")
}

/// The painter's folders for desktop, documents, pictures and downloads.
fn own_folders() -> [Option<PathBuf>; 4] {
    #[cfg(not(target_arch = "wasm32"))]
    if let Some(dirs) = UserDirs::new() {
        return [dirs.desktop_dir(), dirs.document_dir(), dirs.picture_dir(), dirs.download_dir()]
            .map(|path| path.map(Path::to_owned));
    }
    [const { None }; 4]
}

/// The places that exist now. `lately` lists folders of the last file and of recent ones, the
/// latest first. Looks at the disk.
#[must_use]
pub(super) fn places(lately: &[PathBuf]) -> Vec<PlaceFolder> {
    let mut found = Vec::new();
    let home = home_folder();
    add(&mut found, PlaceKind::Own, english("Home"), &home);
    for (name, path) in
        [english("Desktop"), english("Documents"), english("Pictures"), english("Downloads")]
            .into_iter()
            .zip(own_folders())
    {
        if let Some(path) = path {
            add(&mut found, PlaceKind::Own, name, &path);
        }
    }
    let mut left = MOST_FOLDERS;
    for path in lately {
        let name = path.file_name().map_or_else(|| path.to_string_lossy(), |n| n.to_string_lossy());
        if left > 0 && add(&mut found, PlaceKind::Lately, &name, path) {
            left -= 1;
        }
    }
    for path in drives(&home) {
        let name = path.file_name().map_or_else(|| path.to_string_lossy(), |n| n.to_string_lossy());
        add(&mut found, PlaceKind::Drive, &name, &path);
    }
    found
}

/// Adds a folder that exists and is not listed yet; returns whether it was added.
fn add(found: &mut Vec<PlaceFolder>, kind: PlaceKind, name: &str, path: &Path) -> bool {
    if !disk::is_dir(path) || found.iter().any(|place| place.path == path) {
        return false;
    }
    found.push(PlaceFolder { kind, name: name.to_owned(), path: path.to_owned() });
    true
}

/// Drives where the system shows them: letters, or folders that they are mounted in.
fn drives(home: &Path) -> Vec<PathBuf> {
    if cfg!(target_arch = "wasm32") {
        return Vec::new();
    }
    if cfg!(windows) {
        return ('A'..='Z').map(|letter| PathBuf::from(format!("{letter}:\\"))).collect();
    }
    let user = home.file_name().unwrap_or_default();
    let bases = [
        PathBuf::from("/Volumes"),
        Path::new("/media").join(user),
        Path::new("/run/media").join(user),
    ];
    let mut drives = vec![PathBuf::from("/")];
    for base in bases {
        let Ok(entries) = disk::read_dir(base) else { continue };
        let mut mounted: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
        mounted.sort();
        drives.extend(mounted);
    }
    drives
}

/// The folders of `last` and of the recent files, each once, the latest first.
#[must_use]
pub(super) fn folders_of(last: Option<&Path>, recent: &[PathBuf]) -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> = Vec::new();
    for folder in last.into_iter().chain(recent.iter().filter_map(|path| path.parent())) {
        if !folders.iter().any(|other| other == folder) {
            folders.push(folder.to_owned());
        }
    }
    folders
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_that_exist_are_listed_once_in_their_order() {
        let folder = tempfile::tempdir().unwrap();
        let studies = folder.path().join("studies");
        std::fs::create_dir(&studies).unwrap();
        let lately = folders_of(
            Some(&studies),
            &[folder.path().join("a.exr"), studies.join("b.exr"), PathBuf::from("/gone/c.exr")],
        );
        assert_eq!(lately[..2], [studies.clone(), folder.path().to_owned()]);
        let found = places(&lately);
        assert_eq!((found[0].name.as_str(), &found[0].path), ("Home", &home_folder()));
        let late: Vec<_> = found.iter().filter(|p| p.kind == PlaceKind::Lately).collect();
        assert_eq!(late.len(), 2, "the folder that is gone is left out: {late:?}");
        assert_eq!((late[0].name.as_str(), &late[0].path), ("studies", &studies));
        let root = found.iter().any(|p| p.kind == PlaceKind::Drive && p.path == Path::new("/"));
        assert!(root || cfg!(windows) || home_folder() == Path::new("/"), "{found:?}");
    }
}
