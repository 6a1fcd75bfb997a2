//! Reflection at the surface that varies from place to place, as varnish and gloss do.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use spectra::optics::Surface;

/// Distance in pixels over which the reflection changes.
const PATCH_PX: usize = 16;
/// Beginning of the streams of random numbers of the surface; the noise of a line has its own stream.
const STREAMS: u64 = 1 << 63;
/// Greatest k1 of a varied surface.
const MOST_K1: f64 = 0.9;

/// A surface whose k1 varies smoothly over a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceVariation {
    /// Surface under which the spectra of the scene were computed.
    pub surface: Surface,
    /// Standard deviation of k1, relative to that of the surface.
    pub relative: f64,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl SurfaceVariation {
    /// The factors on k1 of a line: mean 1, standard deviation `relative` at every place, and alike within
    /// some 16 pixels.
    #[must_use]
    pub fn factors(&self, line: usize, samples: usize) -> Vec<f64> {
        let corners = samples / PATCH_PX + 2;
        let row = |at: usize| -> Vec<f64> {
            let mut random = ChaCha8Rng::seed_from_u64(self.seed);
            random.set_stream(STREAMS + at as u64);
            StandardNormal.sample_iter(&mut random).take(corners).collect()
        };
        let above = line / PATCH_PX;
        let down = smooth(line % PATCH_PX);
        let rows = [row(above), row(above + 1)];
        let factor = |sample: usize| {
            let left = sample / PATCH_PX;
            let across = smooth(sample % PATCH_PX);
            let mut sum = 0.0;
            let mut squares = 0.0;
            for (row, down) in rows.iter().zip([1.0 - down, down]) {
                for (at, across) in [(left, 1.0 - across), (left + 1, across)] {
                    sum += down * across * row[at];
                    squares += (down * across).powi(2);
                }
            }
            // The weights' squares make the deviation equal between corners and at them.
            1.0 + self.relative * sum / squares.sqrt()
        };
        (0..samples).map(factor).collect()
    }

    /// Exchanges the surface of a spectrum for one with k1 times `factor`.
    pub fn exchange(&self, spectrum: &mut [f64], factor: f64) {
        let k1 = (self.surface.k1 * factor).clamp(0.0, MOST_K1);
        let other = Surface { k1, ..self.surface };
        for value in spectrum {
            let internal = self.surface.internal_from_measured(*value).unwrap_or(0.0);
            *value = other.measured_from_internal(internal);
        }
    }
}

/// Smooth step from 0 to 1 over a patch.
fn smooth(at: usize) -> f64 {
    let x = at as f64 / PATCH_PX as f64;
    x * x * (3.0 - 2.0 * x)
}

#[cfg(test)]
mod tests {
    use spectra::optics::Specular;

    use super::*;

    fn varied(relative: f64) -> SurfaceVariation {
        let surface = Surface::of_most_paints(Specular::Included);
        SurfaceVariation { surface, relative, seed: 5 }
    }

    #[test]
    fn the_factors_have_the_mean_and_the_deviation_that_were_asked_for() {
        let all: Vec<f64> = (0..1600).flat_map(|line| varied(0.2).factors(line, 1600)).collect();
        let count = all.len() as f64;
        let mean = all.iter().sum::<f64>() / count;
        let sd = (all.iter().map(|f| (f - mean).powi(2)).sum::<f64>() / count).sqrt();
        // 10,000 corners are independent.
        assert!((mean - 1.0).abs() < 0.008 && (sd - 0.2).abs() < 0.008, "{mean} {sd}");
        let line = varied(0.2).factors(7, 400);
        let steps = line.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        assert!(steps.fold(0.0, f64::max) < 0.2, "neighbours are alike");
    }

    #[test]
    fn another_surface_keeps_the_film_below_it() {
        let varied = varied(0.2);
        let mut spectrum = [0.03, 0.2, 0.9];
        varied.exchange(&mut spectrum, 1.0);
        for (found, expected) in spectrum.iter().zip([0.03, 0.2, 0.9]) {
            assert!((found - expected).abs() < 1e-12, "{found}");
        }
        varied.exchange(&mut spectrum, 1.5);
        assert!((spectrum[0] - 0.045).abs() < 1e-12, "black shows the surface alone");
        let dull = Surface { k1: 0.045, ..varied.surface };
        let internal = varied.surface.internal_from_measured(0.2).unwrap();
        assert!((dull.internal_from_measured(spectrum[1]).unwrap() - internal).abs() < 1e-12);
    }
}
