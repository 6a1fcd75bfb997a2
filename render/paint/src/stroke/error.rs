//! Errors of strokes.

use documents::hint::{Explain, Hint};

use super::limits::MOST_SUBSTEPS;

/// Why samples cannot be painted. Samples are counted from 0, the first of the stroke.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StrokeError {
    /// The stroke has no sample.
    #[error("a stroke without samples")]
    Empty,
    /// The width of a cell is not above 0.
    #[error("cells have a width above 0 mm: `{cell_mm}` mm")]
    Cell {
        /// Width of a cell in mm.
        cell_mm: f64,
    },
    /// A number is infinite or NaN.
    #[error("sample {sample}: {field} is no number: `{found}`")]
    NoNumber {
        /// Index of the sample.
        sample: usize,
        /// Name of the field.
        field: &'static str,
        /// Value of the field.
        found: f64,
    },
    /// A number is out of range.
    #[error("sample {sample}: {field} is from {lowest} to {highest}: `{found}`")]
    Range {
        /// Index of the sample.
        sample: usize,
        /// Name of the field.
        field: &'static str,
        /// Value of the field.
        found: f64,
        /// Lowest value allowed.
        lowest: f64,
        /// Highest value allowed.
        highest: f64,
    },
    /// A sample is earlier than the one before it.
    #[error("sample {sample}: seconds fall, from {before} to `{found}`")]
    Backwards {
        /// Index of the sample.
        sample: usize,
        /// Value of the field.
        found: f64,
        /// Seconds of the sample before it.
        before: f64,
    },
    /// The stroke needs more than [`MOST_SUBSTEPS`] sub-steps.
    #[error("the stroke takes up to {substeps:.0} sub-steps, at most {MOST_SUBSTEPS} are allowed")]
    TooLong {
        /// Upper bound of the sub-steps that the stroke would take.
        substeps: f64,
    },
    /// A sample came after the brush was lifted.
    #[error("the brush was lifted, so the stroke takes no more samples")]
    Lifted,
}

impl Explain for StrokeError {
    fn hint(&self) -> Option<Hint> {
        let hint = match self {
            Self::Empty => "give at least one sample",
            Self::Cell { .. } => "give the width of a cell in mm, such as 0.1",
            Self::NoNumber { .. } => "leave the sample out",
            Self::Range { field: "pressure", .. } => "divide by the pen's highest pressure",
            Self::Range { field: "x_mm" | "y_mm", .. } => {
                "places are in mm from the canvas's corner"
            }
            Self::Range { .. } => "tilts are degrees from upright",
            Self::Backwards { .. } => "sort the samples by time",
            Self::TooLong { .. } => "places are in mm; cut the stroke in pieces",
            Self::Lifted => "begin another stroke",
        };
        Some(Hint::new(hint))
    }
}
