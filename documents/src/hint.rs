//! Hints: advice on how to resolve an error, independent of the program that shows it.

use std::error::Error;
use std::fmt;

pub use documents_derive::Explain;

/// Advice on how to resolve an error, as one sentence.
///
/// Write a setting in square brackets, by its name in the library and, if you like, with a value:
/// `[reference]`, `[backend=cpu]`. A program replaces this with its own control
/// ([`Hint::with_settings`]), e.g. an option of a command line. Brackets that hold anything else
/// stay as they are, e.g. `[[pour]]`, a table of a file.
///
/// ```
/// use documents::hint::Hint;
///
/// let hint = Hint::new("name another white with [reference]");
/// assert_eq!(hint.to_string(), "name another white with `reference`");
/// let panel = hint.with_settings(|name, _| format!("the panel {name}"));
/// assert_eq!(panel, "name another white with the panel reference");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hint {
    sentence: String,
    has_settings: bool,
}

impl Hint {
    /// A hint. Write `[name]` or `[name=value]` for a setting.
    #[must_use]
    pub fn new(sentence: impl Into<String>) -> Self {
        Self { sentence: sentence.into(), has_settings: true }
    }

    /// A hint without settings, which leaves brackets as they are. Use this for sentences that
    /// quote names from a file.
    #[must_use]
    pub fn verbatim(sentence: impl Into<String>) -> Self {
        Self { sentence: sentence.into(), has_settings: false }
    }

    /// Returns the sentence with each setting replaced by `control(name, value)`. `value`
    /// is `None` for a setting without one.
    #[must_use]
    pub fn with_settings(&self, control: impl Fn(&str, Option<&str>) -> String) -> String {
        if !self.has_settings {
            return self.sentence.clone();
        }
        let mut sentence = String::new();
        let mut rest = self.sentence.as_str();
        while let Some(start) = rest.find('[') {
            let (before, from) = rest.split_at(start);
            sentence.push_str(before);
            match setting(from) {
                Some((name, value, length)) => {
                    sentence.push_str(&control(name, value));
                    rest = &from[length..];
                }
                None => {
                    let kept = if from.starts_with("[[") { 2 } else { 1 };
                    sentence.push_str(&from[..kept]);
                    rest = &from[kept..];
                }
            }
        }
        sentence.push_str(rest);
        sentence
    }
}

impl fmt::Display for Hint {
    /// Writes the sentence with its settings as code: `` `reference` ``, `` `backend = cpu` ``.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.with_settings(|name, value| match value {
            Some(value) => format!("`{name} = {value}`"),
            None => format!("`{name}`"),
        }))
    }
}

/// Parses a setting at the start of `text`: `[name]` or `[name=value]`. The name consists of
/// lower-case letters, digits and underscores. Returns its name, its value and its length in bytes,
/// brackets included.
fn setting(text: &str) -> Option<(&str, Option<&str>, usize)> {
    let end = text.find(']')?;
    let inside = &text[1..end];
    let (name, value) = match inside.split_once('=') {
        Some((name, value)) => (name, Some(value)),
        None => (inside, None),
    };
    let is_name = name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(|c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    is_name.then_some((name, value, end + 1))
}

/// Whether the data, a setting or the machine caused an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// The data are wrong. The call would succeed with other data.
    Input,
    /// A setting is wrong, e.g. out of its range. The call would succeed with the same data and
    /// another setting.
    Setting,
    /// The machine is the cause, e.g. a full disk or a lost graphics device.
    Environment,
}

/// Advice and cause of an error, beside its message. Every public error of these libraries
/// implements it.
///
/// Derive this with the macro of the same name. You write both as attributes beside the message:
///
/// ```
/// use documents::did_you_mean;
/// use documents::hint::{Explain, Fault};
///
/// #[derive(Debug, thiserror::Error, Explain)]
/// #[fault(Setting)]
/// enum PaletteError {
///     #[error("there are {count} pigments, more than `8`")]
///     #[hint("leave out {} of them, or set [palette=auto]", count - 8)]
///     TooMany { count: usize },
///     #[error("there is no pigment `{0}`")]
///     #[hint(if did_you_mean(_0, ["zinc"]).is_none(), "pigments are zinc and umber")]
///     #[hint(verbatim, "{}", did_you_mean(_0, ["zinc"]).unwrap_or_default())]
///     Unknown(String),
///     #[error(transparent)]
///     Io(#[from] std::io::Error),
///     #[error("the palette is empty")]
///     #[fault(Input)]
///     Empty,
/// }
///
/// let error = PaletteError::TooMany { count: 10 };
/// let hint = error.hint().map(|hint| hint.to_string());
/// assert_eq!(hint.as_deref(), Some("leave out 2 of them, or set `palette = auto`"));
/// assert_eq!(error.fault(), Fault::Setting);
/// let error = PaletteError::Unknown("zinq".to_owned());
/// assert_eq!(error.hint().map(|hint| hint.to_string()).as_deref(), Some("did you mean zinc?"));
/// assert_eq!((PaletteError::Empty.hint(), PaletteError::Empty.fault()), (None, Fault::Input));
/// ```
///
/// | attribute of a variant or a struct | hint |
/// | --- | --- |
/// | `#[hint("text with [setting] and {field}")]` | the text as [`Hint::new`], with braces as in `format!`: all fields by name, fields of tuples as `{0}` or `_0` |
/// | `#[hint("{} and {}", expression, expression)]` | the same with arguments, in which fields are references and `self` is the error |
/// | `#[hint(verbatim, "text")]` | the text as [`Hint::verbatim`] |
/// | `#[hint(with = expression)]` | the expression, an `Option<Hint>`. We call a path to a function with `self` |
/// | `#[hint(inner)]`, `#[hint(inner = field)]` | the hint of the wrapped error: the field with `#[from]` or `#[source]`, else `source` or `error`, else the only one. It also gives the fault |
/// | `#[hint(none)]` | none, also where the enum has one for all |
/// | `#[hint(if condition, ..)]` | any of these if the condition holds, otherwise the next `#[hint(..)]` of the variant |
/// | nothing | the one of the enum, else the wrapped error's where the message is `#[error(transparent)]`, else none |
///
/// | attribute of a variant, a struct or an enum | fault |
/// | --- | --- |
/// | `#[fault(Setting)]` | that variant of [`Fault`] |
/// | `#[fault(with = expression)]`, `#[fault(inner)]` | as for hints |
/// | nothing | the wrapped error's under `#[hint(inner)]` or `#[error(transparent)]`, else the one of the enum, else [`Fault::Input`] |
pub trait Explain: Error {
    /// Advice on how to resolve the error, or `None` if the message already says it.
    fn hint(&self) -> Option<Hint> {
        None
    }

    /// Whether the data, a setting or the machine caused the error.
    fn fault(&self) -> Fault {
        Fault::Input
    }
}

impl Explain for std::convert::Infallible {}

impl Explain for std::io::Error {
    fn hint(&self) -> Option<Hint> {
        let sentence = match self.kind() {
            std::io::ErrorKind::NotFound => "check that the file and its folder exist",
            std::io::ErrorKind::PermissionDenied => {
                "choose a file or folder that you may read and write"
            }
            std::io::ErrorKind::StorageFull => "free space on the disk, or choose another",
            _ => return None,
        };
        Some(Hint::new(sentence))
    }

    fn fault(&self) -> Fault {
        Fault::Environment
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn option(hint: &str) -> String {
        Hint::new(hint).with_settings(|name, value| match value {
            Some(value) => format!("--{name} {value}"),
            None => format!("--{name}"),
        })
    }

    #[test]
    fn settings_are_replaced_by_the_controls_of_a_program() {
        assert_eq!(
            option("paint on the processor: [backend=cpu]"),
            "paint on the processor: --backend cpu"
        );
        assert_eq!(option("[white] and [dark] are files"), "--white and --dark are files");
        assert_eq!(
            option("[below_surface=floor] reads it as black"),
            "--below_surface floor reads it as black"
        );
    }

    #[test]
    fn brackets_that_hold_no_setting_are_kept() {
        for text in [
            "samples [[0, 4, 3, 0.5]]",
            "a [",
            "an open [bracket",
            "[Not] a [setting 1]",
            "[[pour]]",
        ] {
            assert_eq!(option(text), text);
        }
        let quoted = Hint::verbatim("spectra: [white], [dark]");
        assert_eq!(quoted.with_settings(|_, _| String::new()), "spectra: [white], [dark]");
    }

    #[test]
    fn display_writes_settings_as_code() {
        assert_eq!(Hint::new("set [backend=cpu]").to_string(), "set `backend = cpu`");
    }
}
