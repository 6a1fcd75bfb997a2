//! Samples: passages of a painting with the brushwork of one tone each.

mod passage;

pub use passage::{PaintOfSamples, Sample, SampleSet, TexelPaint};
