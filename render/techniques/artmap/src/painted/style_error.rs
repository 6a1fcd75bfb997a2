//! Faults of styles.

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};

use super::shipped::NAMES;

/// A style cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StyleError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// No style that ships has this name.
    #[error("there is no style called `{name}`")]
    Unknown {
        /// Name that was looked up.
        name: String,
    },
    /// The text is no TOML, or has an unknown or missing key.
    #[error("{file}, line {line}: {reason}")]
    Line {
        /// Name of the file.
        file: String,
        /// Line, counted from 1.
        line: usize,
        /// Reason given by the parser.
        reason: String,
    },
    /// A number is out of its range.
    #[error("style {style}: {key} is {least} to {most}, found `{value}`")]
    Number {
        /// Name of the style.
        style: String,
        /// Group and key of the number.
        key: &'static str,
        /// Value of the number.
        value: f64,
        /// Least value allowed.
        least: f64,
        /// Greatest value allowed.
        most: f64,
    },
    /// A swatch would take too much memory or time.
    #[error("style {style}: a swatch has at most {most} {what}, found `{found:.0}`")]
    TooLarge {
        /// Name of the style.
        style: String,
        /// Items that are too many.
        what: &'static str,
        /// Number of the items.
        found: f64,
        /// Greatest number allowed.
        most: f64,
    },
}

impl Explain for StyleError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::File(error) => error.hint(),
            Self::Unknown { .. } => {
                Some(Hint::new(format!("choose [style] among {}", NAMES.join(", "))))
            }
            Self::Line { .. } => {
                Some(Hint::new("begin with the text of a style that ships: [show_style=oil-flat]"))
            }
            Self::Number { .. } => None,
            Self::TooLarge { .. } => {
                Some(Hint::new("take larger cells, wider spacing or shorter strokes"))
            }
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            _ => Fault::Setting,
        }
    }
}
