//! What went wrong with a file, for the painter.

use std::path::Path;

use spectra::hint::Explain;

/// One sentence, and what to try.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{what}")]
pub struct FileFailure {
    /// The file, and what is wrong with it.
    pub what: String,
    /// The way out, where there is one.
    pub hint: Option<String>,
}

impl FileFailure {
    /// A failure with a way out.
    #[must_use]
    pub fn new(what: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { what: what.into(), hint: Some(hint.into()) }
    }

    /// What a library says of a file, with the hint that it has.
    pub fn told(error: &dyn std::error::Error, hint: Option<impl Into<String>>) -> Self {
        let mut what = error.to_string();
        let mut cause = error.source();
        while let Some(deeper) = cause {
            what = format!("{what}: {deeper}");
            cause = deeper.source();
        }
        Self { what, hint: hint.map(Into::into) }
    }

    /// A failure with the message, the causes and the hint of a library's error.
    pub fn explained(error: &dyn Explain) -> Self {
        Self::told(error, error.hint().map(|hint| hint.to_string()))
    }

    /// `path` cannot be `verb`ed: what the system says.
    pub fn io(path: &Path, verb: &str, error: &std::io::Error) -> Self {
        let hint = match error.kind() {
            std::io::ErrorKind::NotFound => Some("look whether the folder is still there"),
            std::io::ErrorKind::PermissionDenied => Some("choose a folder that is yours"),
            std::io::ErrorKind::StorageFull => Some("make room on the disk, or choose another"),
            _ => None,
        };
        let what = format!("{}: cannot be {verb}: {error}", path.display());
        Self { what, hint: hint.map(str::to_owned) }
    }
}
