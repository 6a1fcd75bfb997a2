//! Colours and colour differences of reflectances, and their summary.

use serde::{Deserialize, Serialize};
use spectra::TristimulusWeights;
pub use spectra::Viewing;
use spectra::color::{Lab, delta_e_ciede2000};

/// CIELAB of a reflectance on the grid of `weights`.
#[must_use]
pub fn lab(weights: &TristimulusWeights, reflectance: &[f64]) -> Lab {
    Lab::from_xyz(weights.xyz(reflectance), weights.white())
}

/// CIEDE2000 difference of two reflectances on the grid of `weights`.
#[must_use]
pub fn delta_e(weights: &TristimulusWeights, first: &[f64], second: &[f64]) -> f64 {
    delta_e_ciede2000(lab(weights, first), lab(weights, second))
}

/// Four numbers that summarise a set of colour differences.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// Arithmetic mean of the differences.
    pub mean: f64,
    /// Median of the differences.
    pub median: f64,
    /// 90th percentile of the differences.
    pub p90: f64,
    /// Largest of the differences.
    pub max: f64,
}

impl Summary {
    /// Summarises `errors`; every number is 0 where there are none.
    #[must_use]
    pub fn of(errors: &[f64]) -> Self {
        Self {
            mean: errors.iter().sum::<f64>() / errors.len().max(1) as f64,
            median: percentile(errors, 50.0),
            p90: percentile(errors, 90.0),
            max: percentile(errors, 100.0),
        }
    }

    /// Copy rounded to six significant digits, for a file.
    #[must_use]
    pub fn rounded(&self) -> Self {
        let Self { mean, median, p90, max } = *self;
        let [mean, median, p90, max] = [mean, median, p90, max].map(crate::digits::rounded);
        Self { mean, median, p90, max }
    }
}

/// Value that `percent` of `values` do not exceed, interpolated linearly between order statistics
/// (Hyndman and Fan 1996, definition 7, as numpy does); 0 for no values.
#[must_use]
pub fn percentile(values: &[f64], percent: f64) -> f64 {
    let Some(last) = values.len().checked_sub(1) else { return 0.0 };
    let position = percent / 100.0 * last as f64;
    let below = position.floor() as usize;
    let fraction = position - below as f64;
    let mut partly_sorted = values.to_vec();
    let (_, &mut low, above) = partly_sorted.select_nth_unstable_by(below, f64::total_cmp);
    let high = above.iter().copied().min_by(f64::total_cmp).unwrap_or(low);
    low + fraction * (high - low)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_those_of_numpy() {
        let values = [4.0, 1.0, 3.0, 2.0];
        assert_eq!(percentile(&values, 50.0), 2.5);
        assert!((percentile(&values, 90.0) - 3.7).abs() < 1e-12);
        assert_eq!(percentile(&values, 100.0), 4.0);
        assert_eq!(percentile(&[], 50.0), 0.0);
    }
}
