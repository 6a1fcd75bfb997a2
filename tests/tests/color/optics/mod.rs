//! What Kubelka-Munk films and surfaces obey, whatever the paint.

mod layers;
mod readings;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::optics::Layer;

/// A paint film over a backing. A failed law prints it with its seed, from
/// which [`Film::random`] makes it again.
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
    /// From glazes to films that hide; some paints have no K, some no S.
    fn random(seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut coefficient =
            || if rng.random_bool(0.1) { 0.0 } else { 10f64.powf(rng.random_range(-3.0..2.0)) };
        let (absorption, scattering) = (coefficient(), coefficient());
        let thickness = 10f64.powf(rng.random_range(-2.0..1.0));
        Self { seed, absorption, scattering, thickness, backing: rng.random_range(0.0..=1.0) }
    }

    fn layer(&self) -> Layer {
        Layer::new(self.absorption, self.scattering, self.thickness)
    }

    /// The film of the same paint that is `share` as thick.
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

/// A few roundings of numbers of size 1.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
