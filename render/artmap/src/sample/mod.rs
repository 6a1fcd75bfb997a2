//! Samples: passages of a painting with the brushwork of one tone each.

mod passage;

#[cfg(test)]
mod made_up;

pub mod from_painting;

pub mod file;

pub use file::SampleFileError;
pub use from_painting::{FromPaintingError, WholePainting};
pub use passage::{PaintOfSamples, Sample, SampleSet, TexelPaint};

#[cfg(test)]
pub(crate) use made_up::strokes;
