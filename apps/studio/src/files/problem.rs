//! Problems with files, as messages with their causes, and ages and sizes of files as text.

use std::error::Error;
use std::path::Path;

use documents::file::FileError;
use documents::hint::{Explain, Hint};
use session::FileFailure;
use web_time::{Duration, SystemTime};

use crate::language::{tr, tr_format};

/// A message about a failure, and a suggestion if there is one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Names the file or the thing that failed, and the reason.
    pub text: String,
    /// Suggests how to solve it.
    pub hint: Option<String>,
}

impl Problem {
    /// A problem with a suggestion.
    #[must_use]
    pub fn new(text: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { text: text.into(), hint: Some(hint.into()) }
    }

    /// The message of a library's error with all its causes, and its hint. In this, settings have
    /// the names that you see in the window.
    pub fn from_error(error: &dyn Explain) -> Self {
        let hint = error.hint().as_ref().map(with_panel_names);
        Self { hint, ..Self::without_hint(error) }
    }

    /// The message of an error that has no hint, with all its causes.
    pub(crate) fn without_hint(error: &dyn Error) -> Self {
        let mut text = error.to_string();
        let mut cause = error.source();
        while let Some(deeper) = cause {
            text = format!("{text}: {deeper}");
            cause = deeper.source();
        }
        Self { text, hint: None }
    }

    /// Says that something with `path` failed. `participle` completes `cannot be ..`, for example
    /// `read`.
    pub(crate) fn io(path: &Path, participle: &str, error: &std::io::Error) -> Self {
        let text = format!("{}: cannot be {participle}: {error}", path.display());
        Self { text, hint: error.hint().as_ref().map(with_panel_names) }
    }
}

impl From<FileError> for Problem {
    fn from(error: FileError) -> Self {
        Self::from_error(&error)
    }
}

impl From<FileFailure> for Problem {
    fn from(failure: FileFailure) -> Self {
        Self { text: failure.what, hint: failure.hint.as_ref().map(with_panel_names) }
    }
}

/// Text of a hint. Each setting has the name that you see in the window.
pub(crate) fn with_panel_names(hint: &Hint) -> String {
    hint.with_settings(|name, value| match (name, value) {
        ("backend", Some("cpu")) => "Edit, Preferences, Computes: Processor".to_owned(),
        ("backend", _) => "Edit, Preferences, Computes".to_owned(),
        (name, None) => name.replace('_', " "),
        (name, Some(value)) => format!("{} {value}", name.replace('_', " ")),
    })
}

/// The age of `then` at the time `now`, for example `3 minutes ago`.
#[must_use]
pub fn ago(then: SystemTime, now: SystemTime) -> String {
    let seconds = now.duration_since(then).unwrap_or(Duration::ZERO).as_secs();
    let (count, [one, many]) = match seconds {
        0..60 => return tr("just now").to_owned(),
        60..3600 => (seconds / 60, [tr("minute"), tr("minutes")]),
        3600..86_400 => (seconds / 3600, [tr("hour"), tr("hours")]),
        86_400..5_184_000 => (seconds / 86_400, [tr("day"), tr("days")]),
        5_184_000..63_072_000 => (seconds / 2_592_000, [tr("month"), tr("months")]),
        _ => (seconds / 31_536_000, [tr("year"), tr("years")]),
    };
    let unit = if count == 1 { one } else { many };
    tr_format!("{count} {unit} ago", count, unit)
}

/// A file size in decimal units, for example `12.3 MB`.
#[must_use]
pub fn size(bytes: u64) -> String {
    match bytes {
        0..1000 => format!("{bytes} B"),
        1000..1_000_000 => format!("{:.0} kB", bytes as f64 / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", bytes as f64 / 1e6),
        _ => format!("{:.1} GB", bytes as f64 / 1e9),
    }
}

/// A problem of a page, which keeps its autosaves in the browser's storage.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PageProblem {
    /// The browser gives this page no storage.
    StorageDenied,
    /// The storage has no room for an autosave.
    StorageFull,
    /// The storage was emptied while the page was open. The page has written its files again.
    StorageCleared,
    /// A write failed for another reason, in the browser's words.
    StorageFailed(String),
    /// This file is larger than a page allows.
    TooLarge {
        /// Name of the file.
        name: String,
        /// Bytes of the file.
        bytes: u64,
        /// Most bytes that a page allows.
        most: u64,
    },
    /// The browser cannot read this file.
    Unreadable {
        /// Name of the file.
        name: String,
        /// The reason, in the browser's words.
        reason: String,
    },
}

impl From<PageProblem> for Problem {
    fn from(problem: PageProblem) -> Self {
        match problem {
            PageProblem::StorageDenied => {
                let text = tr("no autosaves: this browser denies its storage to the page");
                Self::new(text, tr("save the painting often: it is downloaded"))
            }
            PageProblem::StorageFull => {
                let text = tr("no autosaves: the browser's storage is full");
                let hint = tr(
                    "save the painting: it is downloaded; autosaves go on once there is room on the \
                     disk or other pages' data is removed",
                );
                Self::new(text, hint)
            }
            PageProblem::StorageCleared => {
                let text = tr("the browser's storage was emptied: the autosave is written anew");
                Self::new(text, tr("save the painting often: it is downloaded"))
            }
            PageProblem::StorageFailed(reason) => {
                let text = tr_format!(
                    "no autosaves: the browser's storage cannot be written: {reason}",
                    reason
                );
                Self::new(text, tr("save the painting often: it is downloaded"))
            }
            PageProblem::TooLarge { name, bytes, most } => {
                let bytes = size(bytes);
                let most = size(most);
                let text = tr_format!(
                    "{name}: has {bytes}; a page takes at most {most}",
                    name,
                    bytes,
                    most
                );
                Self::new(text, tr("open it in the program impasto-studio"))
            }
            PageProblem::Unreadable { name, reason } => {
                let text = tr_format!("{name}: the browser cannot read it: {reason}", name, reason);
                Self::new(text, tr("choose the file again; a folder cannot be opened"))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_library_error_is_shown_with_its_causes_and_panel_names() {
        let reason = std::io::Error::from(std::io::ErrorKind::PermissionDenied);
        let error = documents::file::read(Path::new("/no/such/folder/a.exr")).unwrap_err();
        let problem = Problem::from_error(&error);
        assert!(problem.text.contains("a.exr") && problem.hint.is_some(), "{problem:?}");
        let error =
            documents::file::write_whole(Path::new("/no/such/folder/a.exr"), b"").unwrap_err();
        let Problem { text, .. } = Problem::from_error(&error);
        assert!(
            text.contains("a.exr: cannot be written: ") && !text.contains(".impasto-"),
            "{text}"
        );
        assert!(Problem::io(Path::new("b"), "deleted", &reason).hint.is_some(), "{reason}");
        let hint = Hint::new("paint on the processor: [backend=cpu]");
        let shown = "paint on the processor: Edit, Preferences, Computes: Processor";
        assert_eq!(with_panel_names(&hint), shown);
    }

    #[test]
    fn ages_and_sizes_in_words() {
        let now = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000_000);
        for (seconds, words) in [
            (5, "just now"),
            (60, "1 minute ago"),
            (7300, "2 hours ago"),
            (90_000, "1 day ago"),
            (70_000_000, "2 years ago"),
        ] {
            assert_eq!(ago(now - Duration::from_secs(seconds), now), words);
        }
        assert_eq!(ago(now + Duration::from_secs(60), now), "just now", "a clock set back");
        for (bytes, words) in [(999, "999 B"), (12_400, "12 kB"), (12_340_000, "12.3 MB")] {
            assert_eq!(size(bytes), words);
        }
    }

    #[test]
    fn each_problem_names_the_way_out() {
        let name = "big.exr".to_owned();
        let reason = "gone".to_owned();
        let large = PageProblem::TooLarge { name: name.clone(), bytes: 600 << 20, most: 512 << 20 };
        let problem = Problem::from(large);
        assert_eq!(problem.text, "big.exr: has 629.1 MB; a page takes at most 536.9 MB");
        let unreadable = PageProblem::Unreadable { name, reason: reason.clone() };
        assert!(Problem::from(unreadable).text.starts_with("big.exr: "));
        for problem in [
            PageProblem::StorageDenied,
            PageProblem::StorageFull,
            PageProblem::StorageCleared,
            PageProblem::StorageFailed(reason),
        ] {
            let shown = Problem::from(problem.clone());
            assert!(shown.text.contains("storage"), "{shown:?}");
            let hint = shown.hint.unwrap_or_default();
            assert!(hint.contains("save the painting"), "{problem:?}: {hint}");
        }
    }
}
