//! Lights under which recipes are judged, and the measure of colour difference.

use spectra::color::{Lab, ciede2000_residuals};

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

/// Measure of the difference of two colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Metric {
    /// CIEDE2000, which is valid for differences up to about 5.
    #[default]
    Ciede2000,
    /// CIE 1976, which orders large differences better: by CIEDE2000 a grey may be nearer to a brilliant
    /// magenta than a dull magenta is.
    Cie1976,
}

impl Metric {
    /// Three numbers whose squares sum to the square of the difference.
    pub(super) fn residuals(self, wanted: Lab, found: Lab) -> [f64; 3] {
        match self {
            Self::Ciede2000 => ciede2000_residuals(wanted, found),
            Self::Cie1976 => {
                [found.lightness - wanted.lightness, found.a - wanted.a, found.b - wanted.b]
            }
        }
    }
}
