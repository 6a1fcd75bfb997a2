//! Lists, filters and sorts the entries of a folder.

use std::cmp::Reverse;
use std::path::Path;

use documents::Task;
use documents::file::disk;
use graphics::picture_formats::ENDINGS;
use web_time::SystemTime;

use crate::files::job::JobError;
use crate::files::preferences::BrowserOrder;
use crate::files::problem::Problem;
use crate::language::english;

/// Maximum number of entries that are listed.
const MAX_ENTRIES: usize = 20_000;

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Entry {
    /// Name without the folder.
    pub(crate) name: String,
    /// Whether this is a folder.
    pub(crate) folder: bool,
    pub(crate) bytes: u64,
    /// Time of the last change, if the system knows it.
    pub(crate) changed: Option<SystemTime>,
}

/// A rule for which files you see.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Filter {
    /// Label in the dialog.
    pub(crate) label: &'static str,
    /// Extensions of the names, in lower case. An empty list accepts all files.
    pub(crate) endings: &'static [&'static str],
}

impl Filter {
    /// Accepts all files.
    pub(crate) const ALL: Self = Self { label: english("All files"), endings: &[] };

    /// Whether you see a file of this name.
    #[must_use]
    pub(crate) fn passes(&self, name: &str) -> bool {
        let name = name.to_lowercase();
        self.endings.is_empty()
            || self
                .endings
                .iter()
                .any(|ending: &&str| name.strip_suffix(ending).is_some_and(|n| n.ends_with('.')))
    }
}

/// Returns `others` and the extensions of all pictures that we can read. `ALL` is their number.
pub(crate) const fn pictures_and<const ALL: usize>(others: &[&'static str]) -> [&'static str; ALL] {
    let mut endings = [""; ALL];
    assert!(ALL == ENDINGS.len() + others.len(), "the number of all endings");
    let mut at = 0;
    while at < ALL {
        endings[at] = if at < others.len() { others[at] } else { ENDINGS[at - others.len()] };
        at += 1;
    }
    endings
}

/// Lists `folder` without hidden entries: folders first, each group sorted by name with
/// numbers in numerical order.
///
/// # Errors
/// [`JobError`] if the folder cannot be read.
pub(super) fn entries(folder: &Path, task: &Task) -> Result<Vec<Entry>, JobError> {
    let mut entries = Vec::new();
    for entry in disk::read_dir(folder)
        .map_err(|error: std::io::Error| Problem::io(folder, "read", &error))?
        .take(MAX_ENTRIES)
    {
        task.reach(0.0)?;
        let Ok(entry) = entry else { continue };
        // You could not type or see a name that is not valid Unicode.
        let Ok(name) = entry.file_name().into_string() else { continue };
        if name.starts_with('.') {
            continue;
        }
        // We follow links and leave broken ones out.
        let Ok(found) = disk::metadata(entry.path()) else { continue };
        let bytes = found.len();
        let changed = found.modified().ok();
        entries.push(Entry { name, folder: found.is_dir(), bytes, changed });
    }
    entries.sort_by_cached_key(|entry| (!entry.folder, sort_key(&entry.name), entry.name.clone()));
    Ok(entries)
}

/// Part of a name: letters or a number, for sorting.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
enum NamePart {
    Number(u64),
    Letters(String),
}

fn sort_key(name: &str) -> Vec<NamePart> {
    let name = name.to_lowercase();
    let mut pieces = Vec::new();
    let mut rest = name.as_str();
    while let Some(first) = rest.chars().next() {
        let digits = first.is_ascii_digit();
        let end = rest.find(|letter: char| letter.is_ascii_digit() != digits);
        let (piece, after) = rest.split_at(end.unwrap_or(rest.len()));
        pieces.push(match piece.parse() {
            Ok(number) if digits => NamePart::Number(number),
            _ => NamePart::Letters(piece.to_owned()),
        });
        rest = after;
    }
    pieces
}

/// The entries that `filter` accepts and that contain the words of `typed` in their names, in
/// `order`. Case does not matter. `entries` are sorted by name, folders first.
#[must_use]
pub(super) fn arranged<'a>(
    entries: &'a [Entry],
    filter: Filter,
    typed: &str,
    order: BrowserOrder,
) -> Vec<&'a Entry> {
    let typed = typed.to_lowercase();
    let words: Vec<&str> = typed.split_whitespace().collect();
    let mut shown: Vec<&Entry> = entries.iter().collect();
    shown.retain(|entry| {
        let name = entry.name.to_lowercase();
        (entry.folder || filter.passes(&entry.name)) && words.iter().all(|word| name.contains(word))
    });
    if order == BrowserOrder::Date {
        // A stable order keeps the names sorted at equal times.
        shown.sort_by_key(|entry| (!entry.folder, Reverse(entry.changed)));
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;
    use web_time::{Duration, SystemTime};

    #[test]
    fn folders_come_first_and_numbers_sort_by_value() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b10.exr", "b9.exr", "A.exr", ".hidden"] {
            std::fs::write(folder.path().join(name), "x").unwrap();
        }
        std::fs::create_dir(folder.path().join("zebra")).unwrap();
        let entries = entries(folder.path(), &Task::default()).unwrap();
        let names: Vec<_> = entries.iter().map(|entry| entry.name.as_str()).collect();
        assert_eq!(names, ["zebra", "A.exr", "b9.exr", "b10.exr"]);
        assert_eq!((entries[0].folder, entries[1].bytes), (true, 1));
    }

    #[test]
    fn a_filter_of_pictures_shows_all_that_can_be_read() {
        const ENDINGS: [&str; 7] = pictures_and(&["exr"]);
        let filter = Filter { label: english("Pictures and paintings"), endings: &ENDINGS };
        for name in ["a.exr", "a.png", "a.JPEG", "scan.tif", "scan.tiff", "web.webp"] {
            assert!(filter.passes(name), "{name}");
        }
        assert!(!filter.passes("oils.json"), "no picture");
    }

    #[test]
    fn a_filter_tests_only_the_extension() {
        let filter = Filter { label: english("Paintings"), endings: &["exr"] };
        for (name, passes) in [("a.exr", true), ("A.EXR", true), ("exr", false), ("a.png", false)] {
            assert_eq!(filter.passes(name), passes, "{name}");
            assert!(Filter::ALL.passes(name), "{name}");
        }
    }

    #[test]
    fn a_missing_folder_is_reported() {
        let listed = entries(Path::new("/no/such/folder"), &Task::default());
        assert!(matches!(listed, Err(JobError::Failed(_))), "{listed:?}");
    }

    fn entry(name: &str, folder: bool, seconds: u64) -> Entry {
        let changed = Some(SystemTime::UNIX_EPOCH + Duration::from_secs(seconds));
        Entry { name: name.to_owned(), folder, bytes: 1, changed }
    }

    fn names(entries: &[Entry], typed: &str, order: BrowserOrder) -> Vec<String> {
        let filter = Filter { label: "Paintings", endings: &["exr"] };
        let shown = arranged(entries, filter, typed, order);
        shown.into_iter().map(|entry| entry.name.clone()).collect()
    }

    #[test]
    fn typed_words_filter_names_and_dates_order_them() {
        let entries = [
            entry("album", true, 5),
            entry("old", true, 9),
            entry("Field study.exr", false, 20),
            entry("notes.txt", false, 90),
            entry("study 2.exr", false, 40),
        ];
        let by_name = ["album", "old", "Field study.exr", "study 2.exr"];
        assert_eq!(names(&entries, "", BrowserOrder::Name), by_name);
        let by_date = ["old", "album", "study 2.exr", "Field study.exr"];
        assert_eq!(names(&entries, "", BrowserOrder::Date), by_date);
        assert_eq!(names(&entries, "STUDY", BrowserOrder::Date), by_date[2..]);
        assert_eq!(names(&entries, "study fie", BrowserOrder::Name), ["Field study.exr"]);
        assert!(names(&entries, "notes", BrowserOrder::Name).is_empty(), "of another kind");
    }
}
