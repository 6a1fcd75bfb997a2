//! Lights under which recipes are judged, and the measure of difference.

use crate::evaluate::Viewing;

/// A light and an observer under which a recipe is judged.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewingCondition {
    /// Light and observer.
    pub viewing: Viewing,
    /// Weight of the colour difference under this light, above 0 and below 1e9. Only the ratios of
    /// several weights matter.
    pub weight: f64,
}

impl Default for ViewingCondition {
    /// Illuminant D65 and the CIE 1931 observer, with weight 1.
    fn default() -> Self {
        Self { viewing: Viewing::default(), weight: 1.0 }
    }
}

/// Measure of the difference between a recipe and its target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Metric {
    /// CIEDE2000, which is valid for differences up to about 5.
    #[default]
    Ciede2000,
    /// CIE 1976, which orders large differences better: by CIEDE2000 a grey may be nearer to a brilliant
    /// magenta than a dull magenta is.
    Cie1976,
    /// Root mean square of the differences of reflectance in percent, over the wavelengths that target and
    /// library share. The lights only tell colours. The target must be a measured spectrum.
    Spectrum(SpectrumWeights),
}

/// How much each wavelength counts in a difference of spectra.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SpectrumWeights {
    /// All wavelengths equally.
    #[default]
    Even,
    /// By the sum of its weights for X, Y and Z under the lights.
    Observer,
}

impl Metric {
    /// Weights of the wavelengths, for a difference of spectra.
    #[must_use]
    pub fn spectrum_weights(self) -> Option<SpectrumWeights> {
        match self {
            Self::Spectrum(weights) => Some(weights),
            Self::Ciede2000 | Self::Cie1976 => None,
        }
    }

    /// Name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Ciede2000 => "color",
            Self::Cie1976 => "cie1976",
            Self::Spectrum(SpectrumWeights::Even) => "spectrum",
            Self::Spectrum(SpectrumWeights::Observer) => "weighted-spectrum",
        }
    }

    /// Unit in which differences are told.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Ciede2000 => "CIEDE2000",
            Self::Cie1976 => "CIE 1976",
            Self::Spectrum(_) => "% of reflectance",
        }
    }
}
