//! Which entries of a folder are shown, and in which order.

use std::cmp::Reverse;

use super::listing::{Entry, Filter};
use crate::files::browser_look::BrowserOrder;

/// The entries that `filter` accepts and whose names contain the words of `typed`, capitals or
/// not, in `order`. `entries` are sorted by name, folders first.
#[must_use]
pub(super) fn arranged<'a>(
    entries: &'a [Entry],
    filter: Filter,
    typed: &str,
    order: BrowserOrder,
) -> Vec<&'a Entry> {
    let typed = typed.to_lowercase();
    let words: Vec<&str> = typed.split_whitespace().collect();
    let named = |entry: &Entry| {
        let name = entry.name.to_lowercase();
        words.iter().all(|word| name.contains(word))
    };
    let fits = |entry: &&Entry| (entry.folder || filter.passes(&entry.name)) && named(entry);
    let mut shown: Vec<&Entry> = entries.iter().filter(fits).collect();
    if order == BrowserOrder::Date {
        // A stable order: names decide between equal times.
        shown.sort_by_key(|entry| (!entry.folder, Reverse(entry.changed)));
    }
    shown
}

#[cfg(test)]
mod tests {
    use web_time::{Duration, SystemTime};

    use super::*;

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
