//! Hints: the way out of an error, told without naming a program's controls.

use std::error::Error;
use std::fmt;

/// The way out of an error, as one sentence.
///
/// A setting stands in square brackets, by its name in the library or with a value:
/// `[reference]`, `[backend=cpu]`. A program replaces these with its own controls
/// ([`Hint::with_settings`]): a command line with options, a window with panels. A
/// pair of brackets that holds anything but a setting stays as it is.
///
/// ```
/// use spectra::hint::Hint;
///
/// let hint = Hint::new("name another white with [reference]");
/// assert_eq!(hint.to_string(), "name another white with `reference`");
/// let option = hint.with_settings(|name, _| format!("--{name}"));
/// assert_eq!(option, "name another white with --reference");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hint(String);

impl Hint {
    /// A hint whose settings stand in square brackets.
    #[must_use]
    pub fn new(sentence: impl Into<String>) -> Self {
        Self(sentence.into())
    }

    /// The sentence with each setting written by `control`, which is given the
    /// setting's name and its value if the hint names one.
    #[must_use]
    pub fn with_settings(&self, control: impl Fn(&str, Option<&str>) -> String) -> String {
        let mut sentence = String::new();
        let mut rest = self.0.as_str();
        while let Some(start) = rest.find('[') {
            let (before, from) = rest.split_at(start);
            sentence.push_str(before);
            match setting(from) {
                Some((name, value, length)) => {
                    sentence.push_str(&control(name, value));
                    rest = &from[length..];
                }
                None => {
                    sentence.push('[');
                    rest = &from[1..];
                }
            }
        }
        sentence.push_str(rest);
        sentence
    }
}

impl fmt::Display for Hint {
    /// Writes settings as code: `` `reference` ``, `` `backend = cpu` ``.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.with_settings(|name, value| match value {
            Some(value) => format!("`{name} = {value}`"),
            None => format!("`{name}`"),
        }))
    }
}

/// Name, value and length of the setting that `text` begins with: `[name]` or
/// `[name=value]`, the name of lower-case letters, digits and underscores.
fn setting(text: &str) -> Option<(&str, Option<&str>, usize)> {
    let end = text.find(']')?;
    let inside = &text[1..end];
    let (name, value) = match inside.split_once('=') {
        Some((name, value)) => (name, Some(value)),
        None => (inside, None),
    };
    let letter = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    let is_name = name.starts_with(|c: char| c.is_ascii_lowercase()) && name.chars().all(letter);
    is_name.then_some((name, value, end + 1))
}

/// Whether the caller's data or the machine stands in the way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// The data or the request cannot be met: another input would do.
    Input,
    /// The machine cannot: a file that cannot be written, a graphics device that was lost.
    Environment,
}

/// What every error of these libraries tells beside its message.
pub trait Explain: Error {
    /// The way out, where there is one to name.
    fn hint(&self) -> Option<Hint> {
        None
    }

    /// Whether the input or the machine is at fault.
    fn fault(&self) -> Fault {
        Fault::Input
    }
}

impl Explain for std::io::Error {
    fn hint(&self) -> Option<Hint> {
        let sentence = match self.kind() {
            std::io::ErrorKind::NotFound => "look whether the file and its folder are there",
            std::io::ErrorKind::PermissionDenied => "choose a file or folder that is yours",
            std::io::ErrorKind::StorageFull => "make room on the disk, or choose another",
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
    fn settings_become_the_controls_of_a_program() {
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
    fn other_brackets_stay() {
        for text in
            ["samples [[0, 4, 3, 0.5]]", "a [", "an open [bracket", "[Not] a [setting 1]", ""]
        {
            assert_eq!(option(text), text);
        }
    }

    #[test]
    fn a_hint_alone_names_settings_as_code() {
        assert_eq!(Hint::new("set [backend=cpu]").to_string(), "set `backend = cpu`");
    }
}
