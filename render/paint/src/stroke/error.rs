//! Why samples are no stroke.

use super::MOST_SUBSTEPS;

/// Why samples are no stroke. Samples are counted from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StrokeError {
    /// No sample.
    #[error("a stroke without samples")]
    Empty,
    /// Cells without width.
    #[error("cells have a width above 0 mm: `{cell_mm}` mm")]
    Cell {
        /// As it was given.
        cell_mm: f64,
    },
    /// Infinite, or not a number.
    #[error("sample {sample}: {field} is no number: `{found}`")]
    NoNumber {
        /// Which sample.
        sample: usize,
        /// Which of its fields.
        field: &'static str,
        /// What it says.
        found: f64,
    },
    /// Beyond what the field can be.
    #[error("sample {sample}: {field} is from {lowest} to {highest}: `{found}`")]
    Range {
        /// Which sample.
        sample: usize,
        /// Which of its fields.
        field: &'static str,
        /// What it says.
        found: f64,
        /// The least it can be.
        lowest: f64,
        /// The most it can be.
        highest: f64,
    },
    /// A sample earlier than the one before it.
    #[error("sample {sample}: seconds fall, from {before} to `{found}`")]
    Backwards {
        /// Which sample.
        sample: usize,
        /// What it says.
        found: f64,
        /// What the sample before it says.
        before: f64,
    },
    /// More sub-steps than a stroke may take.
    #[error("the stroke takes up to {substeps:.0} sub-steps, at most {MOST_SUBSTEPS} are allowed")]
    TooLong {
        /// What it would take at most.
        substeps: f64,
    },
}

impl StrokeError {
    /// The way out.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
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
        }
    }
}
