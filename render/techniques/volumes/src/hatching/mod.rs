//! Real-time hatching that conveys light: a texture of pencil strokes, and how much ink it puts on
//! a point of a surface.
//!
//! We follow Praun, Hoppe, Webb and Finkelstein, "Real-time hatching" (2001): strokes of a lighter
//! tone are in all darker ones, strokes of a coarser level in all finer ones. As in Webb, Praun,
//! Finkelstein and Hoppe, "Fine tone control in hardware hatching" (2002), a texture of thresholds
//! holds all tones at once.

mod strokes;
mod threshold;
mod coordinates;
mod ink;

pub use coordinates::{Coordinates, HatchingLook, has_useful_coordinates};
pub use ink::{DIRECTIONS_MEET, Hatching, crossed_tones};
pub use strokes::SIDE;
pub use threshold::{SLICES, ThresholdTexture};

pub(crate) use coordinates::Placing;
pub(crate) use ink::Inking;

#[cfg(test)]
pub(crate) use threshold::sample_texture;
