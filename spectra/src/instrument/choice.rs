//! Selecting one spectrum of a file by name.

use std::path::Path;

use super::measured::{MeasuredSpectrum, Role};
use documents::file::disk::is_file;
use documents::hint::{Explain, Hint};

/// Maximum number of names listed in an error.
const LISTED: usize = 8;

/// Splits `FILE#NAME` into file and name; the name of a plain `FILE` is `None`. If the whole
/// text is the path of a file, it is not split.
#[must_use]
pub fn split_file_and_name(text: &str) -> (&str, Option<&str>) {
    match text.rsplit_once('#') {
        Some((file, name)) if !is_file(Path::new(text)) => (file, Some(name)),
        _ => (text, None),
    }
}

/// Selects the spectrum called `name` from `spectra`, the content of `file`. Without a name,
/// selects the only main spectrum ([`Role::Main`]), or the only spectrum if there is no main
/// one.
///
/// # Errors
/// [`ChoiceError`] if no spectrum or more than one qualifies.
pub fn choose_spectrum<'a>(
    file: &str,
    spectra: &'a [MeasuredSpectrum],
    name: Option<&str>,
) -> Result<&'a MeasuredSpectrum, ChoiceError> {
    let has_main = spectra.iter().any(|spectrum| spectrum.role == Role::Main);
    let qualifies = |spectrum: &&MeasuredSpectrum| match name {
        Some(name) => spectrum.name == name,
        None => spectrum.role == Role::Main || !has_main,
    };
    let found: Vec<&MeasuredSpectrum> = spectra.iter().filter(qualifies).collect();
    let file = file.to_owned();
    match (found.as_slice(), name) {
        ([one], _) => Ok(one),
        ([], Some(name)) => {
            Err(ChoiceError::Unknown { file, name: name.to_owned(), names: names(spectra.iter()) })
        }
        _ => {
            let names = names(found.iter().copied());
            Err(ChoiceError::Several { file, count: found.len(), names })
        }
    }
}

fn names<'a>(spectra: impl Iterator<Item = &'a MeasuredSpectrum>) -> Vec<String> {
    spectra.take(LISTED).map(|spectrum| spectrum.name.clone()).collect()
}

/// A selection that does not determine one spectrum.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ChoiceError {
    /// No spectrum has the name.
    #[error("{file}: no spectrum is called `{name}`")]
    Unknown {
        /// Path of the file.
        file: String,
        /// The name that was given.
        name: String,
        /// Names of the first few spectra of the file.
        names: Vec<String>,
    },
    /// Several spectra qualify and no name was given, or they share the name.
    #[error("{file}: expected one spectrum, found `{count}`")]
    Several {
        /// Path of the file.
        file: String,
        /// Number of spectra that qualify.
        count: usize,
        /// Names of the first few of them.
        names: Vec<String>,
    },
}

impl Explain for ChoiceError {
    fn hint(&self) -> Option<Hint> {
        // Names from a file may contain brackets.
        Some(Hint::verbatim(match self {
            Self::Unknown { names, .. } => format!("spectra: {}", names.join(", ")),
            Self::Several { file, names, .. } => {
                format!("name one: \"{file}#{}\"", names.join("\" or \"#"))
            }
        }))
    }
}
