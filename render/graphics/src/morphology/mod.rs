//! Mathematical morphology of colour pictures: openings and closings with a round
//! structuring element, after Serra, "Image analysis and mathematical morphology" (1982).
//!
//! An opening removes what is lighter than its surroundings and too small for the element,
//! a closing what is darker. Channels are processed independently, coverage among them. So
//! bare paper must be white: specks of paint on paper then count as dark details, and gaps
//! in paint as light ones.
//!
//! The element is an octagon, the sum of a square and a diamond, each a sum of segments: a
//! pass needs a few comparisons per pixel at any radius. Minimum and maximum are exact, so
//! both forms of [`crate::compute::Compute`] agree bit for bit.

mod structuring_element;
mod extremum_on_cpu;
mod extremum;
mod operators;

pub use extremum::{EXTREMUM, extremum};
pub use operators::{closing, opening, opening_then_closing};
pub use structuring_element::{Extremum, StructuringElement};
