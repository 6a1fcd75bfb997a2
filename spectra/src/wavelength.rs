//! A wavelength in nanometres.

use serde::{Deserialize, Serialize};

use documents::hint::Explain;

/// A finite, positive wavelength in nanometres.
///
/// ```
/// use spectra::Wavelength;
/// assert_eq!(Wavelength::from_nm(550.0).unwrap().nm(), 550.0);
/// assert!(Wavelength::from_nm(-1.0).is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Wavelength(f64);

impl Wavelength {
    /// A wavelength of `nm` nanometres.
    ///
    /// # Errors
    /// [`WavelengthError`] unless `nm` is finite and above 0.
    pub fn from_nm(nm: f64) -> Result<Self, WavelengthError> {
        if nm.is_finite() && nm > 0.0 { Ok(Self(nm)) } else { Err(WavelengthError { nm }) }
    }

    /// The wavelength in nanometres.
    #[must_use]
    pub fn nm(self) -> f64 {
        self.0
    }
}

impl TryFrom<f64> for Wavelength {
    type Error = WavelengthError;

    fn try_from(nm: f64) -> Result<Self, WavelengthError> {
        Self::from_nm(nm)
    }
}

impl From<Wavelength> for f64 {
    fn from(wavelength: Wavelength) -> Self {
        wavelength.0
    }
}

impl std::fmt::Display for Wavelength {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} nm", self.0)
    }
}

/// A number that is not a wavelength.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("a wavelength is a finite number of nanometres above 0, found `{nm}`")]
pub struct WavelengthError {
    /// The number that was given, in nm.
    pub nm: f64,
}

impl Explain for WavelengthError {}
