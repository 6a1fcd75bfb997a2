//! Noise that stays on a moving object and looks flat in the picture.
//!
//! You can choose from two methods (Bousseau, Kaplan, Thollot and Sillion 2006, section 5,
//! temporal coherence): textures that follow a few [`Particles`], and [`Features`] of noise that
//! sit on the surface itself. The processor chooses particles and features once, for both forms of
//! [`crate::compute::Compute`]. [`draw_anchored`] and [`draw_splats`] then work pixel by pixel.

mod projection;
mod depths;
mod hierarchy;
mod octaves;
mod splat;
mod features;
mod feature_splats;
mod anchored;

pub use anchored::{ANCHOR_TEXTURES, Anchor, AnchoredNoise, Anchors, Particles, draw_anchored};
pub use depths::{DEPTHS, depth_field, depths};
pub use feature_splats::SeenFeature;
pub use features::{Density, Feature, Features};
pub use hierarchy::Hierarchy;
pub use octaves::{FeatureNoise, SPREAD, repeating_noise};
pub use projection::{NoiseFrame, Popping, Projection};
pub use splat::{GATHER_SPLATS, Splat, draw_splats};
