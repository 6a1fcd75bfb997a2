//! Faults of styles.

use documents::hint::{Explain, Fault};
use documents::text::TextError;

use super::shipped::NAMES;

/// A style cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum StyleError {
    /// The file cannot be read, is no TOML, or has an unknown or missing key.
    #[error(transparent)]
    #[hint(if matches!(_0, TextError::File(_)), inner)]
    #[hint("begin with the text of a style that ships: [show_style=oil-flat]")]
    #[fault(with = if matches!(_0, TextError::File(_)) { _0.fault() } else { Fault::Setting })]
    Text(#[from] TextError),
    /// No style that ships has this name.
    #[error("there is no style called `{name}`")]
    #[hint("choose [style] among {}", NAMES.join(", "))]
    Unknown {
        /// Name that was looked up.
        name: String,
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
    #[hint("take larger cells, wider spacing or shorter strokes")]
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
