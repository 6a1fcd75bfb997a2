//! Errors in the files of instruments, with their place.

use crate::hint::{Explain, Hint};

/// Why an instrument's file cannot be used. Every variant names the file, and
/// the line where there is one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InstrumentError {
    /// No format of [`super::Format`].
    #[error("{file}: no known format of an instrument")]
    Unrecognised {
        /// The file.
        file: String,
    },
    /// The file holds no spectrum.
    #[error("{file}: no spectrum in this {format} file")]
    Empty {
        /// The file.
        file: String,
        /// What it was read as.
        format: &'static str,
    },
    /// A line is not what the format wants there.
    #[error("{file}, line {line}: {wanted} is wanted, found `{text}`")]
    Line {
        /// The file.
        file: String,
        /// Counted from 1.
        line: usize,
        /// What should stand there.
        wanted: &'static str,
        /// What stands there, cut short.
        text: String,
    },
    /// A wavelength stands twice in one spectrum.
    #[error("{file}, line {line}: the wavelength {nm} nm stands twice, first in line {first}")]
    Duplicate {
        /// The file.
        file: String,
        /// Counted from 1.
        line: usize,
        /// The wavelength.
        nm: f64,
        /// The line where it stands first.
        first: usize,
    },
    /// A wavelength stands more than once, with values too far apart for a mean.
    #[error(
        "{file}, line {line}: {nm} nm stands more than once, with unlike values from {least} to `{most}`"
    )]
    Unlike {
        /// The file.
        file: String,
        /// Where it stands last, counted from 1.
        line: usize,
        /// The wavelength.
        nm: f64,
        /// The smallest value there.
        least: f64,
        /// The largest value there.
        most: f64,
    },
    /// Wavelengths go up and down.
    #[error("{file}, line {line}: wavelengths must rise or fall throughout, found `{nm}` nm")]
    Order {
        /// The file.
        file: String,
        /// Counted from 1.
        line: usize,
        /// The wavelength.
        nm: f64,
    },
    /// A spectrum without what gives its wavelengths.
    #[error(
        "{file}, line {line}: {element} has no {missing}, nor has the specification `{specification}`"
    )]
    Incomplete {
        /// The file.
        file: String,
        /// Counted from 1.
        line: usize,
        /// The spectrum's element.
        element: String,
        /// The attribute.
        missing: &'static str,
        /// The specification that it names.
        specification: String,
    },
    /// More or fewer values than the file announces.
    #[error("{file}, line {line}: the file announces {wanted} {what}, found `{found}`")]
    Count {
        /// The file.
        file: String,
        /// Where the last one stands, counted from 1.
        line: usize,
        /// What is counted.
        what: &'static str,
        /// How many there should be.
        wanted: usize,
        /// How many there are.
        found: usize,
    },
}

impl InstrumentError {
    /// A line that is not what is wanted; its text is cut short and made printable.
    pub(super) fn line(file: &str, line: usize, wanted: &'static str, text: &str) -> Self {
        const LONGEST: usize = 60;
        let text = text.trim();
        let mut short: String = text.chars().take(LONGEST).collect();
        if short.len() < text.len() {
            short.push_str(" ..");
        }
        let printable = |c: char| if c.is_control() { ' ' } else { c };
        let text = short.chars().map(printable).collect();
        Self::Line { file: file.to_owned(), line, wanted, text }
    }
}

impl Explain for InstrumentError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Unrecognised { .. } => {
                "name the format with [format], or save as CSV: a column `sample`, then wavelengths"
            }
            Self::Empty { .. } => {
                "check that the export holds spectra, or name the format with [format]"
            }
            Self::Duplicate { .. } => "remove one of the two",
            Self::Unlike { .. } => "remove the wrong one; values nearly alike would be averaged",
            Self::Incomplete { .. } => {
                "export the file with its colour specifications, or save as CSV: a column `sample`, then wavelengths"
            }
            Self::Count { .. } => "the file may be cut off; export it again",
            Self::Line { .. } | Self::Order { .. } => return None,
        }))
    }
}
