//! Errors in the files of instruments, with their place.

use documents::hint::{Explain, Hint};

/// An instrument's file that cannot be read. Every variant names the file, and the line where
/// possible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InstrumentError {
    /// The content matches none of the formats in `Format`.
    #[error("{file}: no known format of an instrument")]
    Unrecognised {
        /// Path of the file.
        file: String,
    },
    /// The file is of a format that is known and not read.
    #[error("{file}: this is {kind}, which is not read")]
    NotRead {
        /// Path of the file.
        file: String,
        /// The kind of file, with its article.
        kind: &'static str,
        /// The way to a file that is read.
        way: &'static str,
    },
    /// A binary file, or a part of it, does not follow its format.
    #[error("{file}: faulty {format} file: {fault}")]
    Faulty {
        /// Path of the file.
        file: String,
        /// Name of the format as which it was read.
        format: &'static str,
        /// The fault, and its place in the file.
        fault: String,
    },
    /// The file contains no spectrum.
    #[error("{file}: no spectrum in this {format} file")]
    Empty {
        /// Path of the file.
        file: String,
        /// Name of the format as which it was read.
        format: &'static str,
    },
    /// A workbook has no sheet of the wanted name.
    #[error("{file}: no sheet is called `{sheet}`; its sheets are {sheets}")]
    NoSheet {
        /// Path of the workbook.
        file: String,
        /// The wanted name.
        sheet: String,
        /// Names of the sheets that are not empty.
        sheets: String,
    },
    /// A line does not follow the format.
    #[error("{file}, line {line}: expected {expected}, found `{text}`")]
    Line {
        /// Path of the file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// Description of the expected content.
        expected: &'static str,
        /// The content of the line or cell, shortened to 60 characters.
        text: String,
    },
    /// A wavelength occurs twice in one spectrum.
    #[error("{file}, line {line}: the wavelength {nm} nm occurs twice, first in line {first}")]
    Duplicate {
        /// Path of the file.
        file: String,
        /// Line number of the second occurrence, from 1.
        line: usize,
        /// The wavelength in nm.
        nm: f64,
        /// Line number of the first occurrence.
        first: usize,
    },
    /// A wavelength occurs more than once, with values too different to be averaged.
    #[error(
        "{file}, line {line}: {nm} nm occurs more than once, with different values from {least} to `{most}`"
    )]
    Unlike {
        /// Path of the file.
        file: String,
        /// Line number of the last occurrence, from 1.
        line: usize,
        /// The wavelength in nm.
        nm: f64,
        /// Smallest value at the wavelength.
        least: f64,
        /// Largest value at the wavelength.
        most: f64,
    },
    /// The wavelengths neither rise nor fall throughout.
    #[error("{file}, line {line}: wavelengths must rise or fall throughout, found `{nm}` nm")]
    Order {
        /// Path of the file.
        file: String,
        /// Line number of the first wavelength against the direction, from 1.
        line: usize,
        /// That wavelength in nm.
        nm: f64,
    },
    /// The wavelengths of a spectrum are not given.
    #[error(
        "{file}, line {line}: {element} has no {missing}, and neither has the specification `{specification}`"
    )]
    Incomplete {
        /// Path of the file.
        file: String,
        /// Line number of the spectrum, from 1.
        line: usize,
        /// XML element of the spectrum.
        element: String,
        /// The missing attribute.
        missing: &'static str,
        /// The colour specification that the spectrum refers to.
        specification: String,
    },
    /// The number of values differs from the number stated in the file.
    #[error("{file}, line {line}: the file states {expected} {what}, found `{found}`")]
    Count {
        /// Path of the file.
        file: String,
        /// Line number of the last value, from 1.
        line: usize,
        /// The things that are counted, in the plural.
        what: &'static str,
        /// The stated number.
        expected: usize,
        /// The number found.
        found: usize,
    },
}

impl InstrumentError {
    /// An error for a line that does not follow the format. Its text is shortened and made
    /// printable.
    pub(super) fn line(file: &str, line: usize, expected: &'static str, text: &str) -> Self {
        const LONGEST: usize = 60;
        let text = text.trim();
        let mut short: String = text.chars().take(LONGEST).collect();
        if short.len() < text.len() {
            short.push_str(" ..");
        }
        let text = short.chars().map(|c: char| if c.is_control() { ' ' } else { c }).collect();
        Self::Line { file: file.to_owned(), line, expected, text }
    }

    /// An error for a binary file that does not follow its format.
    pub(super) fn faulty(file: &str, format: &'static str, fault: impl Into<String>) -> Self {
        Self::Faulty { file: file.to_owned(), format, fault: fault.into() }
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
            Self::NotRead { way, .. } => way,
            Self::Faulty { .. } => {
                "the file may be cut off: copy it again, or export text from the instrument's program"
            }
            Self::NoSheet { .. } => "name the sheet as the workbook does: FILE.xlsx#SHEET",
            Self::Duplicate { .. } => "remove one of the two",
            Self::Unlike { .. } => "remove the wrong one; nearly equal values would be averaged",
            Self::Incomplete { .. } => {
                "export the file with its colour specifications, or save as CSV: a column `sample`, then wavelengths"
            }
            Self::Count { .. } => "the file may be cut off; export it again",
            Self::Line { .. } | Self::Order { .. } => return None,
        }))
    }
}
