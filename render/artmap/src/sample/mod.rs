//! Samples: passages of a painting with the brushwork of one tone each.

mod passage;

pub mod from_painting;

pub mod file;

pub use file::SampleFileError;
pub use from_painting::{FromPaintingError, WholePainting};
pub use passage::{PaintOfSamples, Sample, SampleSet, TexelPaint};
