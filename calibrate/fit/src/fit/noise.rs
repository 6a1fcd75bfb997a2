//! Noise model of the readings, which sets the weight of each residual.
//!
//! One part of the noise is perceptually uniform (errors of mixing and weighing), the other is constant
//! in reflectance (errors of the instrument).

use rayon::prelude::*;

use super::color_term::ColorTerm;
use pigment::evaluate::percentile;
/// Least standard deviation of a residual, as a cube root of reflectance; chosen by eye.
const LEAST_SD: f64 = 1e-4;
/// Standard deviation over median absolute value for normal noise.
const SD_OVER_MEDIAN: f64 = 1.4826;
/// Ratios of the two kinds of noise that are tried besides 0, evenly spaced in their logarithm.
const RATIOS: i32 = 25;
/// Least of these ratios; chosen by eye.
const LEAST_RATIO: f64 = 0.02;
/// Decades that these ratios span; chosen by eye.
const RATIO_DECADES: f64 = 4.0;

/// Expected errors of a swatch's reflectance, as standard deviations in measured reflectance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpectedNoise {
    /// Error that is equal at every reflectance, of the instrument; 0 to below 1.
    pub constant: f64,
    /// Error that is perceptually uniform, and so smaller in the dark: of weighing, mixing and the film;
    /// 0 to below 1, for a swatch of typical reflectance.
    pub even: f64,
}

impl ExpectedNoise {
    /// Whether both errors are 0 to below 1, and their sum is 1e-6 or more.
    #[must_use]
    pub fn is_possible(&self) -> bool {
        let range = 0.0..1.0;
        range.contains(&self.constant)
            && range.contains(&self.even)
            && self.constant + self.even >= 1e-6
    }
}

/// Distribution of the noise over samples and wavelengths.
pub(super) struct Noise {
    /// Cube roots of the measured reflectance.
    roots: Vec<Vec<f64>>,
    /// By sample and wavelength: weight of a cube-root residual that makes it perceptually uniform.
    even: Vec<Vec<f64>>,
    /// By sample and wavelength: that weight for a residual in reflectance itself.
    slope: Vec<Vec<f64>>,
    median_slope: f64,
    /// Least standard deviation of a residual, derived from repeated readings. With few samples a fit may
    /// come nearer to the readings than this, which would make them look too precise.
    least_sd: f64,
}

impl Noise {
    pub(super) fn new(term: &ColorTerm<'_>, target: &[Vec<f64>], reading_sd: f64) -> Self {
        let root_slope = |reflectance: f64| reflectance.cbrt().powi(-2) / 3.0;
        let mut even = term.sensitivity(target);
        for (row, reflectances) in even.iter_mut().zip(target) {
            for (value, &r) in row.iter_mut().zip(reflectances) {
                *value /= root_slope(r);
            }
        }
        // Weights are divided by their mean at each wavelength, so that they differ only among samples.
        // Otherwise the ends of the band, where the eye is least sensitive, would hardly be fitted.
        for at in 0..even[0].len() {
            let mean = even.iter().map(|row| row[at]).sum::<f64>() / even.len() as f64;
            for row in &mut even {
                row[at] = if mean > 0.0 { row[at] / mean } else { 1.0 };
            }
        }
        let slope: Vec<Vec<f64>> = even
            .iter()
            .zip(target)
            .map(|(row, rs)| row.iter().zip(rs).map(|(e, &r)| e * root_slope(r)).collect())
            .collect();
        let all: Vec<f64> = slope.iter().flatten().copied().collect();
        let median_slope = percentile(&all, 50.0);
        let least_sd = (reading_sd * median_slope).max(LEAST_SD);
        let roots = target.iter().map(|row| row.iter().map(|r| r.cbrt()).collect()).collect();
        Self { roots, even, slope, median_slope, least_sd }
    }

    /// One over the standard deviation of each residual, and the deviation at a typical sample, which
    /// is `least` or more.
    pub(super) fn weights(
        &self,
        ratio: f64,
        values: &[Vec<f64>],
        least: f64,
    ) -> (Vec<Vec<f64>>, f64) {
        let at_median = 1.0 + (ratio * self.median_slope).powi(2);
        let rows = self.even.par_iter().zip(&self.slope).zip(values.par_iter().zip(&self.roots));
        let (mut weights, sizes): (Vec<Vec<f64>>, Vec<Vec<f64>>) = rows
            .map(|((even, slope), (values, roots))| {
                let pairs = even.iter().zip(slope);
                let weights: Vec<f64> = pairs
                    .map(|(e, g)| e * (at_median / (1.0 + (ratio * g).powi(2))).sqrt())
                    .collect();
                let residuals = weights.iter().zip(values.iter().zip(roots));
                let sizes = residuals.map(|(w, (v, root))| (w * (v.cbrt() - root)).abs()).collect();
                (weights, sizes)
            })
            .unzip();
        let sizes: Vec<f64> = sizes.into_iter().flatten().collect();
        let least = if least.is_finite() { least.max(self.least_sd) } else { self.least_sd };
        let sd = (SD_OVER_MEDIAN * percentile(&sizes, 50.0)).max(least);
        weights.par_iter_mut().flatten().for_each(|w| *w /= sd);
        (weights, sd)
    }

    /// One over the standard deviation of each reading in measured reflectance, where both parts of the
    /// noise are known.
    pub(super) fn precision(&self, noise: ExpectedNoise) -> Vec<Vec<f64>> {
        let sd = |slope: &f64| noise.constant.hypot(noise.even * self.median_slope / slope);
        self.slope.iter().map(|row| row.iter().map(|slope| sd(slope).recip()).collect()).collect()
    }

    /// Ratio of the two kinds of noise (constant over uniform) under which the residuals of `values` are
    /// most likely by Laplace's law.
    pub(super) fn likeliest_ratio(&self, values: &[Vec<f64>]) -> f64 {
        let rows = values.par_iter().zip(&self.roots).zip(&self.even);
        let residuals: Vec<Vec<f64>> = rows
            .map(|((row, roots), even)| {
                let pairs = row.iter().zip(roots).zip(even);
                pairs.map(|((v, root), even)| even * (v.cbrt() - root)).collect()
            })
            .collect();
        let score = |ratio: f64| {
            let mut sum = 0.0;
            let mut logs = 0.0;
            let mut count = 0.0;
            for (residual, slope) in residuals.iter().flatten().zip(self.slope.iter().flatten()) {
                let sd = (1.0 + (ratio * slope).powi(2)).sqrt();
                sum += (residual / sd).abs();
                logs += sd.ln();
                count += 1.0;
            }
            count * (sum / count).max(f64::MIN_POSITIVE).ln() + logs
        };
        let candidate = |i: i32| match i {
            0 => 0.0,
            _ => LEAST_RATIO * 10f64.powf(RATIO_DECADES * f64::from(i - 1) / f64::from(RATIOS - 1)),
        };
        let scores = (0..=RATIOS).into_par_iter().map(|i| (score(candidate(i)), candidate(i)));
        let scores: Vec<(f64, f64)> = scores.collect();
        let best =
            scores.into_iter().reduce(|best, next| if next.0 < best.0 { next } else { best });
        best.map_or(0.0, |(_, ratio)| ratio)
    }
}
