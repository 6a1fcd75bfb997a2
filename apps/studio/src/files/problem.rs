//! Problems as the painter sees them.

use std::error::Error;
use std::path::Path;

use documents::file::FileError;
use documents::hint::{Explain, Hint};
use session::FileFailure;

/// A message about something that failed, and a suggestion what to do, if there is one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Names the file or the thing that failed, and the reason.
    pub text: String,
    /// Suggests what to do.
    pub hint: Option<String>,
}

impl Problem {
    /// A problem with a suggestion what to do.
    #[must_use]
    pub fn new(text: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { text: text.into(), hint: Some(hint.into()) }
    }

    /// The message of a library's error with all its causes, and its hint, in which
    /// settings have the names that the window shows.
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

    /// The problem that `path` cannot be read, written and so on; `participle` is that
    /// word.
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

/// Text of a hint in which each setting has the name that the window shows.
pub(crate) fn with_panel_names(hint: &Hint) -> String {
    hint.with_settings(|name, value| match (name, value) {
        ("backend", Some("cpu")) => "Edit, Preferences, Computes: Processor".to_owned(),
        ("backend", _) => "Edit, Preferences, Computes".to_owned(),
        (name, None) => name.replace('_', " "),
        (name, Some(value)) => format!("{} {value}", name.replace('_', " ")),
    })
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
}
