//! One spectrum out of an instrument's file.

use crate::grid::Grid;
use crate::hint::{Explain, Hint};
use crate::irregular::{IrregularSpectrum, IrregularSpectrumError};
use crate::spectrum::{Reflectance, Spectrum, SpectrumError};

/// What an instrument says that it measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredQuantity {
    /// Reflectance factor.
    Reflectance,
    /// Transmittance.
    Transmittance,
    /// Absorbance: the negative decimal logarithm of a reflectance or transmittance.
    Absorbance,
    /// Power of a light: radiance, irradiance or relative power.
    Power,
    /// A detector's counts, to be set against a white and a dark reading.
    Counts,
    /// The file does not say.
    Unstated,
}

impl MeasuredQuantity {
    /// The quantity that `words` name, such as the heading of a column.
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

/// The unit of a [`MeasuredSpectrum`]'s values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// White near 100.
    Percent,
    /// White near 1.
    Fraction,
    /// Anything else, or nothing said.
    Unstated,
}

/// What a spectrum is to its file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// What the file was written for.
    Main,
    /// The sample's light, from which the processed spectrum beside it was made.
    Sample,
    /// The light of the white, kept beside.
    White,
    /// The dark, kept beside.
    Dark,
}

/// One spectrum, as the file has it.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSpectrum {
    /// The sample's name; the file's own word for it, else its place in the file.
    pub name: String,
    /// What was measured.
    pub quantity: MeasuredQuantity,
    /// What it is to the file.
    pub role: Role,
    /// The unit of `values`.
    pub unit: Unit,
    /// Wavelengths in nm, rising strictly; at least one.
    pub wavelengths_nm: Vec<f64>,
    /// One value for each wavelength, finite, otherwise as written.
    pub values: Vec<f64>,
    /// The line on which the record begins, counted from 1.
    pub line: usize,
    /// What else the file says of it (geometry, instrument, integration time ..), in its own
    /// words and order.
    pub details: Vec<(String, String)>,
    /// What had to be decided in reading it, in words for the user.
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

    /// The reflectance on a regular grid ([`Grid::suited_to`] the wavelengths, irregular
    /// ones interpolated linearly), as a fraction.
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
        /// Its quantity.
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
        /// What is wrong with the wavelengths.
        #[source]
        reason: IrregularSpectrumError,
    },
}

impl Explain for ReflectanceError {
    fn hint(&self) -> Option<Hint> {
        let sentence = match self {
            Self::Quantity {
                found: MeasuredQuantity::Counts | MeasuredQuantity::Power, ..
            } => "reference counts to a white and a dark reading first",
            Self::Quantity { .. } => "export the spectrum as reflectance",
            Self::Values { .. } | Self::Wavelengths { .. } => return None,
        };
        Some(Hint::new(sentence))
    }
}

/// The name of a spectrum whose file does not name it: that of the file, without folder and
/// ending.
pub(super) fn stem(file: &str) -> String {
    let path = std::path::Path::new(file);
    path.file_stem().map_or_else(|| file.to_owned(), |stem| stem.to_string_lossy().into_owned())
}
