//! Set-up shared by the reliefs that are generated from a seed.

use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::error::{GroundError, check_range};
use graphics::field::Field;
use graphics::noise::random;

/// Range of the relief of linen, paper, panels and wood, in mm.
const RELIEF_MM: [f64; 2] = [0.0, 2.0];

/// Random stream of each kind of ground, so that grounds of one seed differ.
#[derive(Debug, Clone, Copy)]
pub(super) enum Stream {
    Linen = 0,
    Paper = 1,
    Panel = 2,
    Wood = 3,
}

/// Checks a relief and starts the random numbers of its ground. Returns the relief in mm
/// and the generator.
pub(super) fn set_up(
    relief_mm: f64,
    seed: u64,
    stream: Stream,
) -> Result<(f32, ChaCha8Rng), GroundError> {
    let relief = check_range("relief_mm", " mm", relief_mm, RELIEF_MM)?;
    Ok((relief as f32, random(seed, stream as u64)))
}

/// Evaluates `height_mm(x, y)` for every cell, negative heights counting as 0.
pub(super) fn heights_mm(
    width: usize,
    height: usize,
    height_mm: impl Fn(usize, usize) -> f32 + Sync,
) -> Field<f32> {
    let mut heights = Field::filled(width, height, 0.0_f32);
    heights.values_mut().par_iter_mut().enumerate().for_each(|(index, out)| {
        *out = height_mm(index % width, index / width).max(0.0);
    });
    heights
}
