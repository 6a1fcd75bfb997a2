//! The smoothest reflectance that has a given colour.
//!
//! We use the method of least hyperbolic tangent slope squared (S. A. Burns, "Numerical methods for
//! smoothest reflectance reconstruction", Color Research and Application 45, 2020). R = (1 + tanh z) / 2
//! stays within 0..1. Of all z with the given colour, we find the one with the smallest sum of squared
//! steps over wavelength. R is the reflectance below the surface, so a paint under this surface can have
//! it. We solve Lagrange's conditions by Newton's method.

use documents::Task;
use nalgebra::{DMatrix, DVector};
use spectra::TristimulusWeights;
use spectra::color::{Lab, Xyz, ciede2000_metric, delta_e_ciede2000};
use spectra::optics::Surface;

use crate::least_squares::{NormalEquations, Stop, minimise};

/// The reflectance below the surface stays in this range, which is K/S from 1000 down to 5e-9, because a
/// paint is never perfectly black or white. We chose it by eye.
const INTERNAL: [f64; 2] = [0.0005, 0.9999];

/// A reflectance below the surface, with the difference between its colour and the requested one.
#[derive(Debug, Clone, PartialEq)]
pub struct Recovered {
    /// Internal reflectance by wavelength, between 0 and 1 exclusive.
    pub internal: Vec<f64>,
    /// XYZ of the film seen through its surface, Y = 100 for white.
    pub xyz: Xyz,
    /// CIEDE2000 from the requested colour. If a paint under this surface can have this colour, it is 0 to
    /// rounding. Otherwise you get the difference to a colour near the nearest possible one.
    pub delta_e: f64,
}

/// Returns the smoothest reflectance under `surface` with the colour `wanted`. If no reflectance has this
/// colour, you get one with a colour near it.
#[must_use]
pub fn smoothest_reflectance(
    weights: &TristimulusWeights,
    surface: Surface,
    wanted: Xyz,
) -> Recovered {
    let problem = Problem { weights, surface, wanted };
    let flat = DVector::zeros(weights.weights().len());
    let z = problem.exact(flat.clone()).unwrap_or_else(|| problem.nearest(flat));
    let internal: Vec<f64> = z.iter().map(|z| internal(*z)[0]).collect();
    let xyz = problem.xyz(&z);
    let [wanted, found] = [wanted, xyz].map(|xyz| Lab::from_xyz(xyz, weights.white()));
    Recovered { internal, xyz, delta_e: delta_e_ciede2000(wanted, found) }
}

/// Internal reflectance at z with its first and second derivative.
fn internal(z: f64) -> [f64; 3] {
    let [low, high] = INTERNAL;
    let half = 0.5 * (high - low);
    let t = z.tanh();
    let slope = half * (1.0 - t * t);
    [low + half * (1.0 + t), slope, -2.0 * t * slope]
}

struct Problem<'a> {
    weights: &'a TristimulusWeights,
    surface: Surface,
    wanted: Xyz,
}

impl Problem<'_> {
    /// Measured reflectance at z with its first and second derivative.
    fn measured(&self, z: f64) -> [f64; 3] {
        let [r, slope, curvature] = internal(z);
        let by_r = self.surface.measured_slope(r);
        let by_r_twice = 2.0 * self.surface.k2 / (1.0 - self.surface.k2 * r) * by_r;
        let value = self.surface.measured_from_internal(r);
        [value, by_r * slope, by_r_twice * slope * slope + by_r * curvature]
    }

    fn xyz(&self, z: &DVector<f64>) -> Xyz {
        let reflectance: Vec<f64> = z.iter().map(|z| self.measured(*z)[0]).collect();
        self.weights.xyz(&reflectance)
    }

    /// Newton's method on Lagrange's conditions. We shorten each step until the residual falls. You get
    /// `None` if it does not converge, e.g. for a colour that no reflectance has.
    fn exact(&self, mut z: DVector<f64>) -> Option<DVector<f64>> {
        let count = z.len();
        let mut multipliers = DVector::zeros(3);
        let (mut residual, mut matrix) = self.conditions(&z, &multipliers);
        for _ in 0..100 {
            let size = residual.norm();
            if size < 1e-11 {
                return Some(z);
            }
            let step = matrix.lu().solve(&-&residual)?;
            let mut share = 1.0;
            loop {
                let next_z = &z + share * step.rows(0, count);
                let next_multipliers = &multipliers + share * step.rows(count, 3);
                let (next, next_matrix) = self.conditions(&next_z, &next_multipliers);
                if next.norm() < (1.0 - 0.1 * share) * size {
                    (z, multipliers, residual, matrix) =
                        (next_z, next_multipliers, next, next_matrix);
                    break;
                }
                share *= 0.5;
                if share < 1e-4 {
                    return (size < 1e-8).then_some(z);
                }
            }
        }
        None
    }

    /// Residual of Lagrange's conditions with its derivatives: first the gradient of the
    /// roughness, then XYZ (scaled to white 1).
    fn conditions(
        &self,
        z: &DVector<f64>,
        multipliers: &DVector<f64>,
    ) -> (DVector<f64>, DMatrix<f64>) {
        let count = z.len();
        let mut residual = DVector::zeros(count + 3);
        let mut matrix = DMatrix::zeros(count + 3, count + 3);
        for i in 1..count {
            let step = 2.0 * (z[i] - z[i - 1]);
            residual[i] += step;
            residual[i - 1] -= step;
            for (a, b, sign) in
                [(i, i, 1.0), (i - 1, i - 1, 1.0), (i, i - 1, -1.0), (i - 1, i, -1.0)]
            {
                matrix[(a, b)] += 2.0 * sign;
            }
        }
        let mut sums = [0.0; 3];
        for (i, weights) in self.weights.weights().iter().enumerate() {
            let [value, slope, curvature] = self.measured(z[i]);
            for channel in 0..3 {
                let weight = weights[channel] / 100.0;
                sums[channel] += weight * value;
                residual[i] += slope * weight * multipliers[channel];
                matrix[(i, i)] += curvature * weight * multipliers[channel];
                matrix[(i, count + channel)] = slope * weight;
                matrix[(count + channel, i)] = slope * weight;
            }
        }
        for (channel, wanted) in self.wanted.to_array().into_iter().enumerate() {
            residual[count + channel] = sums[channel] - wanted / 100.0;
        }
        (residual, matrix)
    }

    /// Reflectance with a colour near the requested one, by least squares in the local metric of CIEDE2000
    /// at this colour. A small weight keeps it smooth.
    fn nearest(&self, start: DVector<f64>) -> DVector<f64> {
        /// Weight of the squared steps of z. We chose it by eye, small against one CIEDE2000.
        const SMOOTH: f64 = 1e-5;
        let white = self.weights.white();
        let wanted = Lab::from_xyz(self.wanted, white);
        let metric = ciede2000_metric(wanted);
        let difference = |z: &DVector<f64>| {
            let xyz = self.xyz(z);
            let found = Lab::from_xyz(xyz, white).to_array();
            let by_lab: [f64; 3] = std::array::from_fn(|i| found[i] - wanted.to_array()[i]);
            (xyz, metric.apply(by_lab))
        };
        let bound = DVector::from_element(start.len(), 6.0);
        let stop = Stop { iterations: 500, relative_decrease: 1e-9 };
        minimise(
            start,
            (&-&bound, &bound),
            stop,
            &Task::default(),
            |z: &DVector<f64>| {
                let mut equations = NormalEquations::zeros(z.len());
                let (xyz, color) = difference(z);
                let lab_over_xyz = Lab::slopes_over_xyz(xyz, white);
                let columns: Vec<[f64; 3]> = (self.weights.weights().iter().zip(z.iter()))
                    .map(|(w, z)| {
                        let slope = self.measured(*z)[1];
                        metric.apply(lab_over_xyz.apply(w.map(|w| w * slope)))
                    })
                    .collect();
                for channel in 0..3 {
                    let derivatives: Vec<f64> = columns.iter().map(|c| c[channel]).collect();
                    equations.add(color[channel], &derivatives, 1.0);
                }
                for i in 1..z.len() {
                    let mut derivatives = vec![0.0; z.len()];
                    (derivatives[i - 1], derivatives[i]) = (-1.0, 1.0);
                    equations.add(z[i] - z[i - 1], &derivatives, SMOOTH);
                }
                equations
            },
            |z: &DVector<f64>| {
                let color: f64 = difference(z).1.iter().map(|d| d * d).sum();
                let steps: f64 = (1..z.len()).map(|i| (z[i] - z[i - 1]).powi(2)).sum();
                0.5 * (color + SMOOTH * steps)
            },
        )
        .point
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use spectra::Grid;
    use spectra::color::{Adaptation, Rgb, RgbSpace};
    use spectra::optics::Specular;

    use super::*;
    use crate::evaluate::Viewing;

    fn recovered(surface: Surface, colors: impl Iterator<Item = Rgb>) -> Vec<(Rgb, Recovered)> {
        let grid = Grid::from_nm(400.0, 10.0, 31).unwrap();
        let weights = Viewing::default().weights(grid).unwrap();
        colors
            .map(|rgb| {
                let xyz =
                    RgbSpace::Srgb.xyz_from_encoded(rgb, weights.white(), Adaptation::Bradford);
                (rgb, smoothest_reflectance(&weights, surface, xyz))
            })
            .collect()
    }

    fn random() -> impl Iterator<Item = Rgb> {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        (0..1000).map(move |_| Rgb(std::array::from_fn(|_| random.random_range(0.0..1.0))))
    }

    #[test]
    fn without_a_surface_every_srgb_color_is_reproduced() {
        for (rgb, found) in recovered(Surface::NONE, random()) {
            assert!(found.delta_e < 1e-6, "{}: {}", rgb.to_hex(), found.delta_e);
            assert!(found.internal.iter().all(|r| *r > 0.0 && *r < 1.0), "{:?}", found.internal);
        }
    }

    #[test]
    fn under_a_surface_most_srgb_colors_are_reproduced() {
        let surface = Surface::new(0.03, 0.6, Specular::Included).unwrap();
        let found = recovered(surface, random());
        let (met, missed): (Vec<_>, Vec<_>) = found.iter().partition(|(_, f)| f.delta_e < 0.05);
        assert!(met.len() > 880 && missed.len() > 50, "{} met", met.len());
        // We miss only colours with a primary darker than the surface's reflection.
        for (rgb, found) in missed {
            let least = rgb.linear().0.into_iter().fold(1.0, f64::min);
            assert!(least < 0.03 && found.delta_e < 14.0, "{}: {}", rgb.to_hex(), found.delta_e);
        }
    }

    #[test]
    fn black_is_limited_by_the_surface_reflection() {
        let surface = Surface::new(0.03, 0.6, Specular::Included).unwrap();
        let (_, black) = recovered(surface, [Rgb([0.0; 3])].into_iter()).remove(0);
        // The darkest reading, Y = 3, has L* = 20.0, which is 12.5 in CIEDE2000 from black.
        assert!(black.delta_e > 12.0 && (black.xyz.y - 3.0).abs() < 0.1, "{black:?}");
        let (_, white) = recovered(surface, [Rgb([1.0; 3])].into_iter()).remove(0);
        assert!(white.delta_e < 0.01, "{white:?}");
    }

    #[test]
    fn no_other_reflectance_of_the_same_color_is_smoother() {
        let grid = Grid::from_nm(400.0, 10.0, 31).unwrap();
        let weights = Viewing::default().weights(grid).unwrap();
        let surface = Surface::new(0.03, 0.6, Specular::Included).unwrap();
        let wanted = Xyz { x: 20.0, y: 25.0, z: 30.0 };
        let problem = Problem { weights: &weights, surface, wanted };
        let best = problem.exact(DVector::zeros(31)).unwrap();
        let mut random = ChaCha8Rng::seed_from_u64(3);
        for _ in 0..20 {
            let nudge = DVector::from_fn(31, |_, _| random.random_range(-0.05..0.05));
            // Newton steps of least norm bring the nudged curve back to the wanted XYZ.
            let mut other = &best + nudge;
            for _ in 0..20 {
                let jacobian = DMatrix::from_fn(3, 31, |c, i| {
                    weights.weights()[i][c] * problem.measured(other[i])[1]
                });
                let found = problem.xyz(&other).to_array();
                let off = DVector::from_fn(3, |c, _| wanted.to_array()[c] - found[c]);
                let across = &jacobian * jacobian.transpose();
                other += jacobian.transpose() * across.lu().solve(&off).unwrap();
            }
            assert!((problem.xyz(&other).y - 25.0).abs() < 1e-9, "the same colour");
            assert!(
                roughness(&other) > roughness(&best),
                "{} {}",
                roughness(&other),
                roughness(&best)
            );
        }
    }

    fn roughness(z: &DVector<f64>) -> f64 {
        (1..31).map(|i| (z[i] - z[i - 1]).powi(2)).sum()
    }
}
