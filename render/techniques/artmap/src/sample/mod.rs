//! Samples: passages of a painting with the brushwork of one tone each.

mod passage;

#[cfg(test)]
mod made_up;
mod joined;
mod guessed_relief;
pub mod from_painting;
pub mod file;

pub use crate::texel::{PaintOfSamples, TexelPaint};
pub use from_painting::{FromPaintingError, WholePainting};
pub use guessed_relief::GuessError;
pub use joined::JoinError;
pub use passage::{Sample, SampleSet};

#[cfg(test)]
pub(crate) use made_up::strokes;
