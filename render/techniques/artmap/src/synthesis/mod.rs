//! Textures that tile, synthesised from samples: each texel is a place in its sample.

mod settings;
mod level;
mod grid;
mod cut;
mod descriptors;
mod canvas;
mod usage;
mod mending;
mod candidates;
mod first;
mod following;
mod nested;
mod prepared;
mod key_maps;
mod stages;

#[cfg(test)]
mod tests;

pub use key_maps::{KeyMaps, key_maps};
pub use settings::{Features, SynthesisError, SynthesisSettings};
pub use stages::{Stage, key_maps_with_stages};
