//! A film whose thickness varies within the instrument's aperture.

use serde::{Deserialize, Serialize};

use super::layer::Layer;
use super::surface::Surface;

/// A film over a backing and under a surface. Its thickness is lognormal with mean 1, and
/// `unevenness` is the standard deviation of its logarithm.
///
/// A wash is never even: pigment collects in the hollows of the paper and at edges, and an
/// instrument reads the mean. The mean is computed from three thicknesses (Gauss-Hermite
/// quadrature, exact for polynomials of degree 5 in the logarithm).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct UnevenFilm {
    /// The surface of the film and of the bare backing.
    pub surface: Surface,
    /// Standard deviation of the logarithm of thickness: 0 for an even film, about 0.5 for a
    /// granulating wash.
    pub unevenness: f64,
}

impl UnevenFilm {
    /// Measured reflectance of a film with K d = `absorption` and S d = `scattering` at its
    /// mean thickness, over a backing with the internal reflectance `backing`.
    #[must_use]
    pub fn reflectance(&self, absorption: f64, scattering: f64, backing: f64) -> f64 {
        let at = |factor: f64| {
            let internal = Layer::new(factor * absorption, factor * scattering, 1.0).over(backing);
            self.surface.measured_from_internal(internal)
        };
        if self.unevenness == 0.0 {
            return at(1.0);
        }
        self.thicknesses().iter().map(|(factor, weight)| weight * at(*factor)).sum()
    }

    /// The value of [`UnevenFilm::reflectance`], followed by its derivatives with respect to
    /// `absorption` and `scattering`.
    #[must_use]
    pub fn reflectance_with_slopes(
        &self,
        absorption: f64,
        scattering: f64,
        backing: f64,
    ) -> [f64; 3] {
        let at = |factor: f64| {
            let [internal, over_k, over_s] =
                Layer::over_with_slopes(factor * absorption, factor * scattering, backing);
            let slope = factor * self.surface.measured_slope(internal);
            [self.surface.measured_from_internal(internal), slope * over_k, slope * over_s]
        };
        if self.unevenness == 0.0 {
            return at(1.0);
        }
        let mut sum = [0.0; 3];
        for (factor, weight) in self.thicknesses() {
            for (total, value) in sum.iter_mut().zip(at(factor)) {
                *total += weight * value;
            }
        }
        sum
    }

    /// Thicknesses relative to the mean, with their quadrature weights.
    fn thicknesses(&self) -> [(f64, f64); 3] {
        let sd = self.unevenness;
        let at = |z: f64| (sd * z - 0.5 * sd * sd).exp();
        let z = 3f64.sqrt();
        [(at(-z), 1.0 / 6.0), (at(0.0), 2.0 / 3.0), (at(z), 1.0 / 6.0)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::Specular;

    #[test]
    fn slopes_agree_with_difference_quotients() {
        let surface = Surface::new(0.03, 0.5, Specular::Included).unwrap();
        for unevenness in [0.0, 0.4] {
            let film = UnevenFilm { surface, unevenness };
            for k in [1e-4, 0.02, 0.7, 5.0] {
                for s in [1e-4, 0.03, 0.9, 6.0] {
                    for g in [0.0, 0.1, 0.9] {
                        let [value, over_k, over_s] = film.reflectance_with_slopes(k, s, g);
                        assert!((value - film.reflectance(k, s, g)).abs() < 1e-12, "{k} {s} {g}");
                        let h = 1e-6;
                        let quotient = |low: f64, high: f64| (high - low) / (2.0 * h);
                        let by_k = quotient(
                            film.reflectance(k * (1.0 - h), s, g),
                            film.reflectance(k * (1.0 + h), s, g),
                        );
                        let by_s = quotient(
                            film.reflectance(k, s * (1.0 - h), g),
                            film.reflectance(k, s * (1.0 + h), g),
                        );
                        assert!((by_k - k * over_k).abs() < 1e-8, "{k} {s} {g}: {by_k}");
                        assert!((by_s - s * over_s).abs() < 1e-8, "{k} {s} {g}: {by_s}");
                    }
                }
            }
        }
    }
}
