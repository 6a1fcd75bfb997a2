//! Errors of verbs: messages, hint and exit status.

use std::error::Error;
use std::fmt;
use std::io::{self, ErrorKind, Write};

use documents::hint::{Explain, Fault, Hint};
use documents::printable;
use documents::request::RequestError;
#[cfg(feature = "pictures")]
use pictures::{PictureError, SettingError};

/// Result of a verb or of one of its steps.
pub(crate) type Result<T, E = Failure> = std::result::Result<T, E>;

/// Exit status of a failure caused by the data.
const DATA: u8 = 1;
/// Exit status of a failure caused by an option, a file or the machine.
const USAGE: u8 = 2;

/// Error of a verb. Every library error that implements [`Explain`] converts into it with `?`.
#[derive(Debug)]
pub(crate) struct Failure {
    /// The message and its causes, outermost first.
    messages: Vec<String>,
    hint: Option<Hint>,
    /// Exit status: [`DATA`] or [`USAGE`].
    status: u8,
    /// Whether a write failed because the reader closed the pipe. That is reported as success.
    pipe_closed: bool,
}

impl Failure {
    /// Creates a failure caused by the user's data: exit status 1.
    pub(crate) fn data(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::with_hint(message, hint, DATA)
    }

    /// Creates a failure caused by the command itself, such as options that exclude each other:
    /// exit status 2.
    pub(crate) fn usage(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::with_hint(message, hint, USAGE)
    }

    /// The failure for a value that a request does not take: exit status 2. `option` finds the option of a
    /// key.
    pub(crate) fn of_request(error: &RequestError, option: impl Fn(&str) -> String) -> Self {
        let messages = vec![error.message(option)];
        Self { messages, hint: error.hint(), status: USAGE, pipe_closed: false }
    }

    /// Puts `message` first. The messages so far become its causes.
    pub(crate) fn within(mut self, message: impl Into<String>) -> Self {
        self.messages.insert(0, message.into());
        self
    }

    fn with_hint(message: impl Into<String>, hint: impl Into<String>, status: u8) -> Self {
        let hint = Some(Hint::verbatim(hint));
        Self { messages: vec![message.into()], hint, status, pipe_closed: false }
    }

    fn from_causes(error: &(dyn Error + 'static)) -> Self {
        let mut failure =
            Self { messages: Vec::new(), hint: None, status: USAGE, pipe_closed: false };
        let mut next = Some(error);
        while let Some(cause) = next {
            failure.messages.push(message_of(cause));
            let io = cause.downcast_ref::<io::Error>();
            failure.pipe_closed |= io.is_some_and(|io| io.kind() == ErrorKind::BrokenPipe);
            next = cause.source();
        }
        failure
    }

    /// Writes `error:`, the causes and `hint:`, each on a line that the terminal can show, and returns the exit
    /// status.
    pub(crate) fn report(&self, err: &mut dyn Write) -> u8 {
        if self.pipe_closed {
            return 0;
        }
        for (index, message) in self.messages.iter().enumerate() {
            let _ = match index {
                0 => writeln!(err, "error: {}", short_numbers(&printable(message))),
                _ => writeln!(err, "  because: {}", short_numbers(&printable(message))),
            };
        }
        if let Some(hint) = &self.hint {
            let _ = writeln!(err, "hint: {}", short_numbers(&printable(&with_options(hint))));
        }
        self.status
    }
}

impl fmt::Display for Failure {
    /// Writes the message and its causes, separated by colons.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.messages.join(": "))
    }
}

impl<E: Explain + 'static> From<E> for Failure {
    fn from(error: E) -> Self {
        let status = match error.fault() {
            Fault::Input => DATA,
            Fault::Setting | Fault::Environment => USAGE,
        };
        Self { hint: error.hint(), status, ..Self::from_causes(&error) }
    }
}

/// The message of an error. Settings of pictures are named as options, e.g. `--turntable`.
#[cfg(feature = "pictures")]
fn message_of(error: &(dyn Error + 'static)) -> String {
    match error.downcast_ref() {
        Some(PictureError::Setting(error)) => error.message(option_of),
        _ => match error.downcast_ref::<SettingError>() {
            Some(error) => error.message(option_of),
            None => error.to_string(),
        },
    }
}

#[cfg(not(feature = "pictures"))]
fn message_of(error: &(dyn Error + 'static)) -> String {
    error.to_string()
}

/// The option of a setting.
pub(crate) fn option_of(name: &str) -> String {
    match name {
        "brushes_mm" => "--brushes".to_owned(),
        name => format!("--{}", name.replace(['_', '.'], "-")),
    }
}

/// Adds a message to an error that says what was attempted.
pub(crate) trait Context<T> {
    /// Converts the error to a failure with `message()` first and the error as its cause.
    fn context<M: Into<String>>(self, message: impl FnOnce() -> M) -> Result<T>;
}

impl<T, E: Into<Failure>> Context<T> for std::result::Result<T, E> {
    fn context<M: Into<String>>(self, message: impl FnOnce() -> M) -> Result<T> {
        self.map_err(|error| error.into().within(message()))
    }
}

/// Writes a hint with its settings as options: `[full_scale=255]` becomes `--full-scale 255`.
pub(crate) fn with_options(hint: &Hint) -> String {
    hint.with_settings(|name, value| {
        let option = match (name, value) {
            // The library of a verb is one of its words.
            ("pigments" | "library", None) => return "LIBRARY".to_owned(),
            ("reference", _) => "--white".to_owned(),
            // No verb has an option for its temporary files.
            ("scratch", folder) => return format!("TMPDIR={}", folder.unwrap_or("FOLDER")),
            _ => option_of(name),
        };
        value.map_or_else(|| option.clone(), |value| format!("{option} {value}"))
    })
}

/// A number with at least this many digits in a row is written with an exponent.
const LONG: usize = 20;

/// Gives very long numbers of a message an exponent. For example, 1e300 written out has 301 digits.
fn short_numbers(message: &str) -> String {
    let mut short = String::new();
    let mut rest = message;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let (before, from) = rest.split_at(start);
        let end = from.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(from.len());
        let number = from[..end].trim_end_matches('.');
        short += before;
        // Names may hold digits too, such as those of a hash.
        let is_number = !before.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let is_number = is_number && !from[number.len()..].starts_with(char::is_alphabetic);
        match number.parse::<f64>() {
            Ok(value) if is_number && number.len() >= LONG => short += &format!("{value:e}"),
            _ => short += number,
        }
        rest = &from[number.len()..];
    }
    short + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_numbers_have_an_exponent() {
        let huge = format!("takes 0 to 10, found `{}`", 1e300);
        assert_eq!(short_numbers(&huge), "takes 0 to 10, found `1e300`");
        assert_eq!(short_numbers(&format!("found -{}.", 2.5e-40)), "found -2.5e-40.");
        for kept in ["400.5 nm, row 3.", "sha 12345678901234567890abc", "a1234567890123456789012"] {
            assert_eq!(short_numbers(kept), kept);
        }
    }
}
