//! How the readings' noise spreads, and so how much each residual weighs.
//!
//! Part of the noise is even to the eye (a paint that was mixed a little
//! otherwise), part is constant in reflectance (the instrument's).

use super::color_term::ColorTerm;
use super::expected::ExpectedNoise;
use pigment::evaluate::percentile;

/// How noise spreads over samples and wavelengths.
pub(super) struct Noise<'a> {
    target: &'a [Vec<f64>],
    /// By sample and wavelength: weight of a cube-root residual that makes it
    /// even to the eye.
    even: Vec<Vec<f64>>,
    /// The same for a residual in reflectance itself.
    slope: Vec<Vec<f64>>,
    median_slope: f64,
    /// The least standard deviation of a residual: what repeated readings show.
    /// Few samples may be fitted nearer than that, but not known nearer.
    least_sd: f64,
}

impl<'a> Noise<'a> {
    pub(super) fn new(term: &ColorTerm<'_>, target: &'a [Vec<f64>], reading_sd: f64) -> Self {
        let root_slope = |reflectance: f64| reflectance.cbrt().powi(-2) / 3.0;
        let mut even = term.sensitivity(target);
        for (row, reflectances) in even.iter_mut().zip(target) {
            for (value, &r) in row.iter_mut().zip(reflectances) {
                *value /= root_slope(r);
            }
        }
        // Only the differences among samples count: no wavelength outweighs
        // another here, or the dim ends of the band would not be fitted at all.
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
        let least_sd = (reading_sd * median_slope).max(1e-4);
        Self { target, even, slope, median_slope, least_sd }
    }

    /// One over the standard deviation of each residual, and the deviation at a
    /// typical sample, which is `least` or more.
    pub(super) fn weights(
        &self,
        ratio: f64,
        values: &[Vec<f64>],
        least: f64,
    ) -> (Vec<Vec<f64>>, f64) {
        let at_median = 1.0 + (ratio * self.median_slope).powi(2);
        let mut weights: Vec<Vec<f64>> = self
            .even
            .iter()
            .zip(&self.slope)
            .map(|(even, slope)| {
                let pairs = even.iter().zip(slope);
                pairs.map(|(e, g)| e * (at_median / (1.0 + (ratio * g).powi(2))).sqrt()).collect()
            })
            .collect();
        let mut sizes = Vec::new();
        for ((row, values), target) in weights.iter().zip(values).zip(self.target) {
            for ((w, v), t) in row.iter().zip(values).zip(target) {
                sizes.push((w * (v.cbrt() - t.cbrt())).abs());
            }
        }
        // The median of |r| is 0.6745 standard deviations of normal noise.
        let least = if least.is_finite() { least.max(self.least_sd) } else { self.least_sd };
        let sd = (1.4826 * percentile(&sizes, 50.0)).max(least);
        weights.iter_mut().flatten().for_each(|w| *w /= sd);
        (weights, sd)
    }

    /// One over the standard deviation of each reading, in measured
    /// reflectance, where both parts of the noise are known.
    pub(super) fn precision(&self, noise: ExpectedNoise) -> Vec<Vec<f64>> {
        let sd = |slope: &f64| noise.constant.hypot(noise.even * self.median_slope / slope);
        self.slope.iter().map(|row| row.iter().map(|slope| sd(slope).recip()).collect()).collect()
    }

    /// The ratio of the two kinds of noise under which the residuals of
    /// `values` are most likely.
    pub(super) fn likeliest_ratio(&self, values: &[Vec<f64>]) -> f64 {
        let score = |ratio: f64| {
            let (mut sum, mut logs, mut count) = (0.0, 0.0, 0.0);
            for (index, row) in values.iter().enumerate() {
                for (at, value) in row.iter().enumerate() {
                    let residual =
                        self.even[index][at] * (value.cbrt() - self.target[index][at].cbrt());
                    let sd = (1.0 + (ratio * self.slope[index][at]).powi(2)).sqrt();
                    sum += (residual / sd).abs();
                    logs += sd.ln();
                    count += 1.0;
                }
            }
            count * (sum / count).max(f64::MIN_POSITIVE).ln() + logs
        };
        // 0, then 25 steps of equal ratio from 0.02 to 200.
        let candidates = (0..25).map(|i| 0.02 * 10f64.powf(4.0 * f64::from(i) / 24.0));
        let mut best = (score(0.0), 0.0);
        for ratio in candidates {
            let score = score(ratio);
            if score < best.0 {
                best = (score, ratio);
            }
        }
        best.1
    }
}
