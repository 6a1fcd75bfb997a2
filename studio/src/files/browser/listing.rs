//! What a folder holds, for the browser.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::files::job::{Progress, Stopped};
use session::FileFailure;

/// The most entries that are listed.
const MOST: usize = 20_000;

/// A file or a folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// Its name, without its folder.
    pub name: String,
    /// Whether it is a folder.
    pub folder: bool,
    /// A file's length.
    pub bytes: u64,
    /// When it was last changed, if the system tells.
    pub changed: Option<SystemTime>,
}

/// Which files are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Filter {
    /// What they are called.
    pub label: &'static str,
    /// How their names end, in small letters; none lets all pass.
    pub endings: &'static [&'static str],
}

impl Filter {
    /// All files.
    pub const ALL: Self = Self { label: "All files", endings: &[] };

    /// Whether a file of this name is shown.
    #[must_use]
    pub fn passes(&self, name: &str) -> bool {
        let name = name.to_lowercase();
        let ends = |ending: &&str| name.strip_suffix(ending).is_some_and(|n| n.ends_with('.'));
        self.endings.is_empty() || self.endings.iter().any(ends)
    }
}

/// The entries of `folder`, without hidden ones: folders first, each in the order
/// of names, in which numbers count as numbers.
///
/// # Errors
/// [`Stopped`] if it cannot be read.
pub(super) fn entries(folder: &Path, progress: &Progress) -> Result<Vec<Entry>, Stopped> {
    let unreadable = |error: std::io::Error| FileFailure::io(folder, "read", &error);
    let mut entries = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)?.take(MOST) {
        progress.tell(0.0)?;
        let Ok(entry) = entry else { continue };
        // A name that is no text cannot be typed either.
        let Ok(name) = entry.file_name().into_string() else { continue };
        if name.starts_with('.') {
            continue;
        }
        // Links are what they point to; one that points nowhere is left out.
        let Ok(found) = std::fs::metadata(entry.path()) else { continue };
        let (bytes, changed) = (found.len(), found.modified().ok());
        entries.push(Entry { name, folder: found.is_dir(), bytes, changed });
    }
    entries.sort_by_cached_key(|entry| (!entry.folder, order(&entry.name), entry.name.clone()));
    Ok(entries)
}

/// A piece of a name: letters, or a number.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Piece {
    Number(u64),
    Letters(String),
}

fn order(name: &str) -> Vec<Piece> {
    let name = name.to_lowercase();
    let mut pieces = Vec::new();
    let mut rest = name.as_str();
    while let Some(first) = rest.chars().next() {
        let digits = first.is_ascii_digit();
        let end = rest.find(|letter: char| letter.is_ascii_digit() != digits);
        let (piece, after) = rest.split_at(end.unwrap_or(rest.len()));
        pieces.push(match piece.parse() {
            Ok(number) if digits => Piece::Number(number),
            _ => Piece::Letters(piece.to_owned()),
        });
        rest = after;
    }
    pieces
}

/// The user's own folder, else the root.
#[must_use]
pub(super) fn home_folder() -> PathBuf {
    directories::UserDirs::new()
        .map_or_else(|| PathBuf::from("/"), |dirs| dirs.home_dir().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_come_first_and_numbers_count() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b10.exr", "b9.exr", "A.exr", ".hidden"] {
            std::fs::write(folder.path().join(name), "x").unwrap();
        }
        std::fs::create_dir(folder.path().join("zebra")).unwrap();
        let entries = entries(folder.path(), &Progress::default()).unwrap();
        let names: Vec<_> = entries.iter().map(|entry| entry.name.as_str()).collect();
        assert_eq!(names, ["zebra", "A.exr", "b9.exr", "b10.exr"]);
        assert_eq!((entries[0].folder, entries[1].bytes), (true, 1));
    }

    #[test]
    fn a_filter_looks_at_the_ending_alone() {
        let filter = Filter { label: "Paintings", endings: &["exr"] };
        for (name, passes) in [("a.exr", true), ("A.EXR", true), ("exr", false), ("a.png", false)] {
            assert_eq!(filter.passes(name), passes, "{name}");
            assert!(Filter::ALL.passes(name), "{name}");
        }
    }

    #[test]
    fn a_folder_that_is_gone_is_told() {
        let told = entries(Path::new("/no/such/folder"), &Progress::default());
        assert!(matches!(told, Err(Stopped::Failed(_))), "{told:?}");
    }
}
