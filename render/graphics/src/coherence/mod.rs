//! Noise that stays on its object while it moves, and flat on the paper.
//!
//! Two ways (Bousseau, Kaplan, Thollot and Sillion 2006, temporal coherence):
//! textures of pigment that follow a few particles, and features of noise on the
//! surface itself. What is decided for each particle or feature is decided here,
//! with the processor, once for all backends; they do what is done for each pixel.

mod sight;

mod depths;

mod random;

mod hierarchy;

mod octaves;

mod splat;

mod features;

mod pigment;

mod particles;

mod anchored;

mod popping;

pub use anchored::ANCHOR_TEXTURES;
pub use anchored::Anchoring;
pub use depths::DEPTHS;
pub use depths::Depths;
pub use features::Features;
pub use hierarchy::Hierarchy;
pub use octaves::{FeatureNoise, SPREAD};
pub use particles::{Anchor, AnchoredNoise, Anchors, Particles};
pub use pigment::repeating_pigment;
pub use popping::{NoiseShot, Popping};
pub use sight::{Sight, depth_of};
pub use splat::GATHER_SPLATS;
pub use splat::{Splat, Splatting};
