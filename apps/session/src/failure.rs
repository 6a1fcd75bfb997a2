//! Errors of autosave files.

use std::path::Path;

use documents::hint::{Explain, Fault, Hint};

/// A file or folder that cannot be used, with the causes in one sentence.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{what}")]
pub struct FileFailure {
    /// Path, and what is wrong with it.
    pub what: String,
    /// Advice on what to do, if there is any.
    pub hint: Option<Hint>,
}

impl FileFailure {
    /// A failure with the message, the causes and the hint of a library's error.
    pub fn explained(error: &dyn Explain) -> Self {
        Self { what: with_causes(error), hint: error.hint() }
    }

    /// A failure reported by the operating system: `path` cannot be read, written and so on;
    /// `participle` is that word.
    pub fn io(path: &Path, participle: &str, error: &std::io::Error) -> Self {
        let what = format!("{}: cannot be {participle}: {error}", path.display());
        Self { what, hint: error.hint() }
    }

    /// A failure of the operating system with something that the painter knows by another name
    /// than its file, such as an autosave.
    pub(crate) fn about(thing: &str, participle: &str, error: &std::io::Error) -> Self {
        Self { what: format!("{thing}: cannot be {participle}: {error}"), hint: error.hint() }
    }

    /// A failure without advice, with the causes of `error`.
    pub(crate) fn without_hint(error: &dyn std::error::Error) -> Self {
        Self { what: with_causes(error), hint: None }
    }
}

impl Explain for FileFailure {
    fn hint(&self) -> Option<Hint> {
        self.hint.clone()
    }

    fn fault(&self) -> Fault {
        Fault::Environment
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
