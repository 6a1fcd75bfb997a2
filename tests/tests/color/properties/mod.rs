//! Properties of colours, lights and spectra that hold for any values.

mod colors;
mod inputs;
mod sums;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::Lab;

/// Tolerance: a few rounding errors of numbers of size 100, the range of XYZ and Lab.
const ROUNDING: f64 = 1600.0 * f64::EPSILON;

/// Random pairs of colours, each with its seed.
fn random_pairs() -> impl Iterator<Item = (u64, Lab, Lab)> {
    (0..2000).map(|seed| {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut lab = || Lab {
            lightness: rng.random_range(0.0..=100.0),
            a: rng.random_range(-100.0..=100.0),
            b: rng.random_range(-100.0..=100.0),
        };
        (seed, lab(), lab())
    })
}
