//! Truth of a simulated scan: which paint really is at each pixel, and how near maps come to it.

mod paint_class;
mod seen;
mod error;
mod arrays;
mod stored;
mod written;
mod comparison;

pub use comparison::{CHI2_RISEN, Comparison, ComparisonRow, PigmentFigures, compare};
pub use error::TruthError;
pub use paint_class::PaintClass;
pub use seen::{TruthParts, TruthRows, truth_rows};
pub use stored::Truth;
pub use written::{TruthAbout, TruthWriter};
