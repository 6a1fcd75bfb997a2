//! Painterly art maps after Yan, Chi, Lee and Lin (2008): samples of painted passages, and
//! textures synthesised from them, from dark to light, that carry their brushwork.
//!
//! ```text
//! painting or photograph + marks -> passages (jseg, joining) -> upright, evenly spaced -+
//! style -> swatches painted by the engine ----------------------------------------------+-> SampleSet
//!                                                                                       |
//!                                  ArtMap <- key maps <- coherence search space <-------+
//! ```
//!
//! A sample carries colour and, where it was painted with calibrated pigments, the amounts of
//! paint and the height of every texel. Maps are synthesised as places in the samples, so that
//! all channels follow.
//!
//! Modules are declared in order of dependence: each uses only those above it.

pub mod texel_file;
pub mod sample;
mod relief;
pub mod measures;
pub mod passages;
pub mod painted;
pub mod sheet;
pub mod synthesis;
pub mod map;
