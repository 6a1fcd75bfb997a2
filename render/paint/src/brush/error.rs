//! Why a head cannot be made.

use documents::hint::{Explain, Hint};

/// Why a head cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BrushError {
    /// The width of the head is out of range.
    #[error("a head is 0.2 to 100 mm wide: `{size_mm}` mm")]
    Size {
        /// Width of the head in mm.
        size_mm: f64,
    },
    /// The width of a cell is not above 0.
    #[error("cells have a width above 0 mm: `{cell_mm}` mm")]
    Cell {
        /// Width of a cell in mm.
        cell_mm: f64,
    },
    /// The head would have more cells than allowed.
    #[error("a head is at most 2048 cells wide: `{size_mm}` mm over cells of {cell_mm} mm")]
    TooFine {
        /// Width of the head in mm.
        size_mm: f64,
        /// Width of a cell in mm.
        cell_mm: f64,
    },
}

impl Explain for BrushError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Size { .. } => "give the width of the head in mm, such as 6",
            Self::Cell { .. } => "give the width of a cell in mm, such as 0.1",
            Self::TooFine { .. } => "take a smaller brush or larger cells",
        }))
    }
}
