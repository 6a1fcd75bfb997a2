//! Samples: passages of a painting with the brushwork of one tone each.

mod passage;

#[cfg(test)]
mod made_up;

pub use passage::{PaintOfSamples, Sample, SampleSet, TexelPaint};

#[cfg(test)]
pub(crate) use made_up::strokes;
