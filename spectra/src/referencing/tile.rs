//! The dark reading and the white tile of a reference measurement.

use std::ops::RangeInclusive;

use super::error::ReferencingError;
use crate::instrument::{MeasuredQuantity, MeasuredSpectrum};
use crate::irregular::{IrregularSpectrum, SmoothCurve};

/// Band in nm where every value must be sound. Outside it unsound values are left out.
pub(super) const VISIBLE_NM: RangeInclusive<f64> = 380.0..=730.0;

/// The detector's signal without light.
#[derive(Debug, Clone, PartialEq)]
pub enum Dark {
    /// Readings without light. If there are several, sample and white each use the one of
    /// their own integration time: a dark signal is an offset plus a current and does not
    /// scale with time.
    Readings(Vec<MeasuredSpectrum>),
    /// The dark is already subtracted from sample and white.
    Subtracted,
}

/// The reflectance of the white itself.
#[derive(Debug, Clone, PartialEq)]
pub enum Tile {
    /// One fraction (0 to 1) for all wavelengths.
    Even(f64),
    /// Measured reflectance as a fraction.
    Measured(IrregularSpectrum),
}

impl Tile {
    /// A tile that reflects the fraction `value` at every wavelength.
    ///
    /// # Errors
    /// [`ReferencingError::Tile`] unless above 0 and at most 1.2 (a reflectance factor may
    /// exceed 1).
    pub fn even(value: f64) -> Result<Self, ReferencingError> {
        if value > 0.0 && value <= 1.2 {
            Ok(Self::Even(value))
        } else {
            Err(ReferencingError::Tile { value })
        }
    }

    /// A tile of measured reflectance, in percent or as a fraction
    /// ([`MeasuredSpectrum::is_percent`]).
    ///
    /// # Errors
    /// [`ReferencingError`] if the spectrum is not a reflectance, or is not above 0 and at
    /// most 1.2 from 380 to 730 nm.
    pub fn measured(spectrum: &MeasuredSpectrum) -> Result<Self, ReferencingError> {
        use MeasuredQuantity::{Reflectance, Unstated};
        if !matches!(spectrum.quantity, Reflectance | Unstated) {
            let name = spectrum.name.clone();
            let found = spectrum.quantity;
            return Err(ReferencingError::TileQuantity { name, found });
        }
        let scale = if spectrum.is_percent() { 0.01 } else { 1.0 };
        let values: Vec<f64> = spectrum.values.iter().map(|value| value * scale).collect();
        for (&value, nm) in values.iter().zip(&spectrum.wavelengths_nm) {
            if VISIBLE_NM.contains(nm) {
                Self::even(value)?;
            }
        }
        Ok(Self::Measured(irregular(spectrum.wavelengths_nm.clone(), values)))
    }

    /// The tile as a curve over wavelength.
    pub(super) fn curve(&self) -> TileCurve<'_> {
        match self {
            Self::Even(value) => TileCurve::Even(*value),
            Self::Measured(spectrum) => TileCurve::Measured(spectrum.smooth_curve()),
        }
    }
}

/// The reflectance of a white over wavelength.
pub(super) enum TileCurve<'a> {
    Even(f64),
    Measured(SmoothCurve<'a>),
}

impl TileCurve<'_> {
    /// Reflectance at `nm` as a fraction; `None` outside the measured band.
    pub(super) fn at(&self, nm: f64) -> Option<f64> {
        match self {
            Self::Even(value) => Some(*value),
            Self::Measured(curve) => curve.at(nm),
        }
    }
}

/// A measured spectrum's values for interpolation.
pub(super) fn irregular(wavelengths_nm: Vec<f64>, values: Vec<f64>) -> IrregularSpectrum {
    IrregularSpectrum::new(wavelengths_nm, values)
        .expect("a measured spectrum has rising wavelengths with one value each")
}
