//! Noise that stays on a moving object and looks flat in the picture.
//!
//! Two methods (Bousseau, Kaplan, Thollot and Sillion 2006, section 5, temporal
//! coherence): textures that follow a few [`Particles`], and [`Features`] of noise that sit
//! on the surface itself. Particles and features are chosen on the processor, once for
//! both forms of [`crate::compute::Compute`]; [`draw_anchored`] and [`draw_splats`] then
//! work pixel by pixel.

mod projection;
mod depths;
mod depth_tiles;
mod random;
mod hierarchy;
mod octaves;
mod splat;
mod features;
mod selection;
mod feature_splats;
mod seen;
mod repeating_noise;
mod particles;
mod anchored;
mod popping;

pub use anchored::{ANCHOR_TEXTURES, draw_anchored};
pub use depths::{DEPTHS, depth_field, depths};
pub use features::{Feature, Features};
pub use hierarchy::Hierarchy;
pub use octaves::{FeatureNoise, SPREAD};
pub use particles::{Anchor, AnchoredNoise, Anchors, Particles};
pub use popping::{NoiseFrame, Popping};
pub use projection::Projection;
pub use repeating_noise::repeating_noise;
pub use seen::SeenFeature;
pub use selection::Density;
pub use splat::{GATHER_SPLATS, Splat, draw_splats};
