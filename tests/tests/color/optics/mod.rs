//! Properties that Kubelka-Munk films and surfaces have with any paint.

mod layers;
mod readings;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::optics::Layer;

/// A random paint film over a backing. A failed assertion prints it with its seed, from which
/// [`Film::random`] makes it again.
#[derive(Debug, Clone, Copy)]
struct Film {
    #[expect(dead_code, reason = "read through Debug, when a law fails")]
    seed: u64,
    absorption: f64,
    scattering: f64,
    thickness: f64,
    backing: f64,
}

impl Film {
    /// A random film, from a glaze to a film that hides. K and S are each 0 in a tenth of the
    /// films, otherwise 0.001 to 100 on a logarithmic scale.
    fn random(seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut coefficient =
            || if rng.random_bool(0.1) { 0.0 } else { 10f64.powf(rng.random_range(-3.0..2.0)) };
        let absorption = coefficient();
        let scattering = coefficient();
        let thickness = 10f64.powf(rng.random_range(-2.0..1.0));
        Self { seed, absorption, scattering, thickness, backing: rng.random_range(0.0..=1.0) }
    }

    fn layer(&self) -> Layer {
        Layer::new(self.absorption, self.scattering, self.thickness)
    }

    /// Layer of the same paint with `share` times the thickness.
    fn share(&self, share: f64) -> Layer {
        Layer::new(self.absorption, self.scattering, self.thickness * share)
    }

    fn over_backing(&self) -> f64 {
        self.layer().over(self.backing)
    }
}

fn random_films() -> impl Iterator<Item = Film> {
    (0..2000).map(Film::random)
}

/// Tolerance: a few rounding errors of numbers of size 1.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
