//! Colour differences as a term of the cost of a fit, and as a scale for its residuals.

use spectra::TristimulusWeights;
use spectra::color::{Lab, Matrix3, Xyz, ciede2000_metric};

/// Measured colours that a fit should reproduce.
#[derive(Debug, Clone)]
pub(super) struct ColorTerm<'a> {
    weights: &'a TristimulusWeights,
    /// By sample: its measured colour, and the local metric of CIEDE2000 there.
    targets: Vec<(Lab, Matrix3)>,
}

/// Colour residual of one sample, with its slopes over reflectance.
pub(super) struct ColorResidual {
    /// Three components; their length is the colour difference.
    pub(super) residual: [f64; 3],
    /// By wavelength: derivatives of the components over reflectance.
    pub(super) slopes: Vec<[f64; 3]>,
}

impl<'a> ColorTerm<'a> {
    pub(super) fn new(weights: &'a TristimulusWeights, target: &[Vec<f64>]) -> Self {
        let targets = target
            .iter()
            .map(|reflectance| {
                let lab = Lab::from_xyz(weights.xyz(reflectance), weights.white());
                (lab, ciede2000_metric(lab))
            })
            .collect();
        Self { weights, targets }
    }

    /// Colour difference of sample `index` at `reflectance`.
    pub(super) fn difference(&self, index: usize, reflectance: &[f64]) -> f64 {
        let residual = self.components(index, self.weights.xyz(reflectance));
        residual.iter().map(|v| v * v).sum::<f64>().sqrt()
    }

    pub(super) fn linear(&self, index: usize, reflectance: &[f64]) -> ColorResidual {
        let xyz = self.weights.xyz(reflectance);
        let map = self.targets[index].1.after(&Lab::slopes_over_xyz(xyz, self.weights.white()));
        let slopes = self.weights.weights().iter().map(|w| map.apply(*w)).collect();
        ColorResidual { residual: self.components(index, xyz), slopes }
    }

    /// Movement of the colour, in CIEDE2000, per unit of reflectance at each wavelength, by sample.
    pub(super) fn sensitivity(&self, target: &[Vec<f64>]) -> Vec<Vec<f64>> {
        (0..self.targets.len())
            .map(|index| {
                self.linear(index, &target[index])
                    .slopes
                    .iter()
                    .map(|v: &[f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt())
                    .collect()
            })
            .collect()
    }

    fn components(&self, index: usize, xyz: Xyz) -> [f64; 3] {
        let (target, metric) = &self.targets[index];
        let lab = Lab::from_xyz(xyz, self.weights.white());
        metric.apply([lab.lightness - target.lightness, lab.a - target.a, lab.b - target.b])
    }
}
