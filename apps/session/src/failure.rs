//! Errors with files and folders of the session.

use std::path::Path;

use documents::hint::{Explain, Hint};

/// A file or folder that cannot be used. The message is one sentence with the causes.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
#[hint(with = hint.clone())]
#[fault(Environment)]
#[error("{what}")]
pub struct FileFailure {
    /// The path, and what is wrong with it.
    pub what: String,
    /// Advice on what to do, if there is any.
    pub hint: Option<Hint>,
}

impl FileFailure {
    /// A failure with the message, the causes and the hint of a library's error.
    pub fn explained(error: &dyn Explain) -> Self {
        Self { what: with_causes(error), hint: error.hint() }
    }

    /// A failure that the operating system reports: `path` cannot be `participle`, e.g. "read" or
    /// "written".
    pub fn io(path: &Path, participle: &str, error: &std::io::Error) -> Self {
        let what = format!("{}: cannot be {participle}: {error}", path.display());
        Self { what, hint: error.hint() }
    }

    /// A failure that the operating system reports about a thing that the painter does not know by
    /// its file, e.g. an autosave.
    pub(crate) fn about(thing: &str, participle: &str, error: &std::io::Error) -> Self {
        Self { what: format!("{thing}: cannot be {participle}: {error}"), hint: error.hint() }
    }

    /// A failure without advice, with the causes of `error`.
    pub(crate) fn without_hint(error: &dyn std::error::Error) -> Self {
        Self { what: with_causes(error), hint: None }
    }
}

/// Messages of an error and of all its causes.
fn with_causes(error: &(impl std::error::Error + ?Sized)) -> String {
    let mut what = error.to_string();
    let mut cause = error.source();
    while let Some(deeper) = cause {
        what = format!("{what}: {deeper}");
        cause = deeper.source();
    }
    what
}
