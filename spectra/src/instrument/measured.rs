//! One spectrum out of an instrument's file.

use crate::grid::Grid;
use crate::irregular::{IrregularSpectrum, IrregularSpectrumError};
use crate::spectrum::{Reflectance, Spectrum, SpectrumError};
use documents::hint::{Explain, Hint};

/// The quantity that an instrument measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredQuantity {
    /// Reflectance factor, relative to a perfect diffuser.
    Reflectance,
    /// Transmittance factor, relative to the incident light.
    Transmittance,
    /// Absorbance: the negative decimal logarithm of a reflectance or transmittance.
    Absorbance,
    /// Power of a light: radiance, irradiance or relative power.
    Power,
    /// Counts of a detector, which give reflectance relative to a white and a dark reading.
    Counts,
    /// The file does not state the quantity.
    Unstated,
}

impl MeasuredQuantity {
    /// The quantity named in `words`, such as the heading of a column.
    pub(super) fn of_words(words: &str) -> Self {
        let lower = words.to_ascii_lowercase();
        let has = |stems: &[&str]| stems.iter().any(|stem| lower.contains(stem));
        if has(&["reflect"]) {
            Self::Reflectance
        } else if has(&["transmi"]) {
            Self::Transmittance
        } else if has(&["absorb", "absorpt"]) {
            Self::Absorbance
        } else if has(&["count", "scope", "raw"]) {
            Self::Counts
        } else if has(&["radian", "power", "emission", "w/m", "w/nm", "watt"]) {
            Self::Power
        } else {
            Self::Unstated
        }
    }
}

impl std::fmt::Display for MeasuredQuantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Reflectance => "reflectance",
            Self::Transmittance => "transmittance",
            Self::Absorbance => "absorbance",
            Self::Power => "the power of a light",
            Self::Counts => "a detector's counts",
            Self::Unstated => "an unstated quantity",
        })
    }
}

/// The unit of the values of a [`MeasuredSpectrum`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Percent: white is near 100.
    Percent,
    /// A fraction: white is near 1.
    Fraction,
    /// Another unit, or none stated.
    Unstated,
}

/// The role of a spectrum in its file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The spectrum for which the file was written.
    Main,
    /// Counts of the sample, from which the main spectrum was computed.
    Sample,
    /// Counts of the white reference.
    White,
    /// Counts without light.
    Dark,
}

/// One spectrum as its file contains it.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSpectrum {
    /// Name of the sample according to the file, otherwise a name made from its place in the
    /// file.
    pub name: String,
    /// The quantity that was measured.
    pub quantity: MeasuredQuantity,
    /// The role of the spectrum in the file.
    pub role: Role,
    /// Unit of `values`.
    pub unit: Unit,
    /// Wavelengths in nm, strictly rising; at least one.
    pub wavelengths_nm: Vec<f64>,
    /// One finite value for each wavelength, as written in the file.
    pub values: Vec<f64>,
    /// Number of the line on which the spectrum begins, from 1.
    pub line: usize,
    /// Other statements of the file on the spectrum (geometry, instrument, integration time
    /// ..), as pairs of keyword and text in their order.
    pub details: Vec<(String, String)>,
    /// Assumptions and corrections made in reading the spectrum, as messages for the user.
    pub remarks: Vec<String>,
}

impl MeasuredSpectrum {
    /// Whether the values are in percent: as the file states, otherwise if any exceeds 2.
    #[must_use]
    pub fn is_percent(&self) -> bool {
        match self.unit {
            Unit::Percent => true,
            Unit::Fraction => false,
            Unit::Unstated => self.values.iter().any(|&value| value > 2.0),
        }
    }

    /// Whether the values are relative to a white, as the file shows by their unit or by the white
    /// reading from which they were computed, though it may not name the quantity.
    #[must_use]
    pub fn is_relative_to_white(&self) -> bool {
        self.unit != Unit::Unstated
            || self.details.iter().any(|(key, value): &(String, String)| {
                key == "Reference Spectrum Present" && value.starts_with("Yes")
            })
    }

    /// The reflectance on a regular grid ([`Grid::suited_to`] the wavelengths, irregular
    /// ones interpolated by a spline), as a fraction.
    ///
    /// # Errors
    /// [`ReflectanceError`] if the spectrum is another quantity, or has a value outside
    /// 0 to 2.
    pub fn reflectance(&self) -> Result<Spectrum<Reflectance>, ReflectanceError> {
        use MeasuredQuantity::{Reflectance, Unstated};
        let name = || self.name.clone();
        if !matches!(self.quantity, Reflectance | Unstated) {
            return Err(ReflectanceError::Quantity { name: name(), found: self.quantity });
        }
        let scale = if self.is_percent() { 0.01 } else { 1.0 };
        let values = self.values.iter().map(|value| value * scale).collect();
        let irregular = IrregularSpectrum::new(self.wavelengths_nm.clone(), values)
            .map_err(|reason| ReflectanceError::Wavelengths { name: name(), reason })?;
        let grid = Grid::suited_to(&self.wavelengths_nm)
            .expect("an irregular spectrum has rising wavelengths");
        Spectrum::new(grid, irregular.on_grid(grid))
            .map_err(|reason| ReflectanceError::Values { name: name(), reason })
    }
}

/// A measured spectrum that is not a reflectance.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReflectanceError {
    /// The spectrum is another quantity.
    #[error("`{name}` must be a reflectance, found `{found}`")]
    Quantity {
        /// Name of the spectrum.
        name: String,
        /// The quantity that the file states.
        found: MeasuredQuantity,
    },
    /// A value is outside 0 to 2.
    #[error("`{name}` has a value that is not a reflectance")]
    Values {
        /// Name of the spectrum.
        name: String,
        /// The wavelength and its value.
        #[source]
        reason: SpectrumError,
    },
    /// The wavelengths do not rise, or their number is not that of the values.
    #[error("`{name}` is not a spectrum")]
    Wavelengths {
        /// Name of the spectrum.
        name: String,
        /// The fault of the wavelengths.
        #[source]
        reason: IrregularSpectrumError,
    },
}

impl Explain for ReflectanceError {
    fn hint(&self) -> Option<Hint> {
        let sentence = match self {
            Self::Quantity { found: MeasuredQuantity::Counts, .. } => {
                "reference counts to a white and a dark reading first"
            }
            Self::Quantity { found: MeasuredQuantity::Power, .. } => {
                "the light of a lamp is no reflectance; it can be the light under which colours are seen"
            }
            Self::Quantity { .. } => "export the spectrum as reflectance",
            Self::Values { .. } | Self::Wavelengths { .. } => return None,
        };
        Some(Hint::new(sentence))
    }
}

/// Name for a spectrum without one: the file name without folder and extension.
pub(super) fn stem(file: &str) -> String {
    let path = std::path::Path::new(file);
    path.file_stem().map_or_else(|| file.to_owned(), |stem| stem.to_string_lossy().into_owned())
}
