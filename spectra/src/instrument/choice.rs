//! One spectrum of a file, as a user names it.

use std::path::Path;

use super::measured::{MeasuredSpectrum, Role};
use crate::hint::{Explain, Hint};

/// How many names an error lists.
const LISTED: usize = 8;

/// File and spectrum of `FILE` or `FILE#NAME`. A whole text that is a file wins over the part
/// before a `#`.
#[must_use]
pub fn split_file_and_name(text: &str) -> (&str, Option<&str>) {
    match text.rsplit_once('#') {
        Some((file, name)) if !Path::new(text).is_file() => (file, Some(name)),
        _ => (text, None),
    }
}

/// The one of `records`, the spectra of `file`, that is called `name`; without a name the only one
/// that the file was written for.
///
/// # Errors
/// [`ChoiceError`] if there is none, or more than one.
pub fn choose_spectrum<'a>(
    file: &str,
    records: &'a [MeasuredSpectrum],
    name: Option<&str>,
) -> Result<&'a MeasuredSpectrum, ChoiceError> {
    let has_main = records.iter().any(|record| record.role == Role::Main);
    let wanted = |record: &&MeasuredSpectrum| match name {
        Some(name) => record.name == name,
        None => record.role == Role::Main || !has_main,
    };
    let found: Vec<&MeasuredSpectrum> = records.iter().filter(wanted).collect();
    let file = file.to_owned();
    match (found.as_slice(), name) {
        ([one], _) => Ok(one),
        ([], Some(name)) => {
            Err(ChoiceError::Unknown { file, name: name.to_owned(), names: names(records.iter()) })
        }
        _ => {
            let names = names(found.iter().copied());
            Err(ChoiceError::Several { file, count: found.len(), names })
        }
    }
}

fn names<'a>(records: impl Iterator<Item = &'a MeasuredSpectrum>) -> Vec<String> {
    records.take(LISTED).map(|record| record.name.clone()).collect()
}

/// Why no spectrum is the one that is meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ChoiceError {
    /// None is called so.
    #[error("{file}: no spectrum is called `{name}`")]
    Unknown {
        /// The file.
        file: String,
        /// The name that was given.
        name: String,
        /// What there is; the first few.
        names: Vec<String>,
    },
    /// One of several must be named.
    #[error("{file}: one spectrum is wanted, found `{count}`")]
    Several {
        /// The file.
        file: String,
        /// How many there are.
        count: usize,
        /// Their names; the first few.
        names: Vec<String>,
    },
}

impl Explain for ChoiceError {
    fn hint(&self) -> Option<Hint> {
        // Names from a file may hold brackets of their own.
        Some(Hint::verbatim(match self {
            Self::Unknown { names, .. } => format!("spectra: {}", names.join(", ")),
            Self::Several { file, names, .. } => {
                format!("name one: \"{file}#{}\"", names.join("\" or \"#"))
            }
        }))
    }
}
