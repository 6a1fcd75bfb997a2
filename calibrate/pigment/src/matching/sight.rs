//! What a recipe is judged by: lights, and the colour wanted under each.

use spectra::color::{Lab, ciede2000_residuals};
use spectra::{Reflectance, Spectrum};

use crate::evaluate::{Viewing, lab};

/// A light and an observer under which a recipe is judged.
#[derive(Debug, Clone, PartialEq)]
pub struct Sight {
    /// Light and observer.
    pub viewing: Viewing,
    /// How much the colour difference under this light counts, above 0; only the
    /// ratios of several matter.
    pub weight: f64,
}

/// How far two colours are apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Metric {
    /// CIEDE2000, made for differences up to about 5.
    #[default]
    Ciede2000,
    /// CIE 1976, which orders great differences better: CIEDE2000 may hold a grey
    /// to be nearer to a brilliant magenta than a dull magenta is.
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

/// The colour wanted under each sight.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// What the target is called.
    pub name: String,
    /// CIELAB under each sight, in their order.
    pub lab: Vec<Lab>,
}

impl Target {
    /// One colour without a spectrum: wanted to look the same under every sight.
    #[must_use]
    pub fn from_lab(name: &str, lab: Lab, sights: &[Sight]) -> Self {
        Self { name: name.to_owned(), lab: vec![lab; sights.len()] }
    }

    /// The colours of a measured reflectance.
    ///
    /// # Errors
    /// Never in practice: the method is chosen to fit the grid.
    pub fn from_reflectance(
        name: &str,
        reflectance: &Spectrum<Reflectance>,
        sights: &[Sight],
    ) -> Result<Self, spectra::InterpolateError> {
        let lab = sights.iter().map(|sight| {
            let weights = sight.viewing.weights(reflectance.grid())?;
            Ok(lab(&weights, reflectance.values()))
        });
        Ok(Self { name: name.to_owned(), lab: lab.collect::<Result<_, _>>()? })
    }
}
