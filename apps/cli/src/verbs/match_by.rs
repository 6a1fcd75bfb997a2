//! The choice of what recipes and corrections are matched by.

use calibrate::matching::{Metric, SpectrumWeights};
use clap::ValueEnum;

/// Measures by which recipes are matched.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum MatchBy {
    /// CIEDE2000 under the lights
    Color,
    /// Root mean square of the differences of reflectance, each wavelength equally
    Spectrum,
    /// Root mean square too, each wavelength as much as the observer sees of it under the lights
    WeightedSpectrum,
}

impl MatchBy {
    pub(super) fn metric(self) -> Metric {
        match self {
            Self::Color => Metric::Ciede2000,
            Self::Spectrum => Metric::Spectrum(SpectrumWeights::Even),
            Self::WeightedSpectrum => Metric::Spectrum(SpectrumWeights::Observer),
        }
    }
}
