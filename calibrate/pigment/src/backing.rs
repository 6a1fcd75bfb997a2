//! The bare ground under a film: a paper, a card, a primer.

use std::str::FromStr;

use documents::hint::{Explain, Fault, Hint};
use spectra::{Extrapolation, Grid, InterpolateError, Interpolation, Reflectance, Spectrum};

use crate::remark::Remark;

/// Measured reflectance of the bare ground under a film, surface included.
///
/// ```
/// use pigment::Backing;
///
/// let paper: Backing = "0.85".parse()?;
/// assert_eq!(paper, Backing::even(0.85)?);
/// assert!("grey".parse::<Backing>().is_err());
/// # Ok::<(), pigment::BackingError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Backing {
    /// One reflectance at every wavelength, 0 to 1.
    Even(f64),
    /// A measured spectrum.
    Measured(Spectrum<Reflectance>),
}

impl Default for Backing {
    /// A perfect white.
    fn default() -> Self {
        Self::Even(1.0)
    }
}

impl Backing {
    /// Backing with one reflectance at every wavelength.
    ///
    /// # Errors
    /// [`BackingError::Reflectance`] unless it is 0 to 1.
    pub fn even(reflectance: f64) -> Result<Self, BackingError> {
        if (0.0..=1.0).contains(&reflectance) {
            return Ok(Self::Even(reflectance));
        }
        Err(BackingError::Reflectance { text: reflectance.to_string() })
    }

    /// Reflectance at each wavelength of `grid`. Where a measured spectrum is shorter, its end values
    /// are held, and a warning says so.
    ///
    /// # Errors
    /// [`BackingError::Band`] if the spectrum has no wavelength within the grid.
    pub fn on_grid(&self, grid: Grid) -> Result<(Vec<f64>, Option<Remark>), BackingError> {
        let spectrum = match self {
            Self::Even(value) => return Ok((vec![*value; grid.count()], None)),
            Self::Measured(spectrum) => spectrum,
        };
        let from = spectrum.grid();
        let start = from.start_nm();
        let end = from.end_nm();
        if start > grid.end_nm() || end < grid.start_nm() {
            return Err(BackingError::Band { start_nm: start, end_nm: end, wanted: grid });
        }
        let shorter = start > grid.start_nm() || end < grid.end_nm();
        let warning = shorter.then(|| {
            Remark::warning(format!(
                "the ground is measured from {start} to {end} nm; beyond, its end values are held"
            ))
        });
        let resampled =
            spectrum.resampled(grid, Interpolation::best_for(from), Extrapolation::Hold)?;
        Ok((resampled.into_values(), warning))
    }
}

impl FromStr for Backing {
    type Err = BackingError;

    /// Reads `white`, `black`, or a reflectance from 0 to 1.
    fn from_str(text: &str) -> Result<Self, BackingError> {
        match text {
            "white" => Ok(Self::Even(1.0)),
            "black" => Ok(Self::Even(0.0)),
            _ => text
                .parse()
                .ok()
                .and_then(|value| Self::even(value).ok())
                .ok_or_else(|| BackingError::Reflectance { text: text.to_owned() }),
        }
    }
}

/// A backing that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BackingError {
    /// The reflectance is not a number from 0 to 1.
    #[error("the ground's reflectance is 0 to 1, white or black, found `{text}`")]
    Reflectance {
        /// Text or number that was given.
        text: String,
    },
    /// The spectrum has no wavelength in common with the library.
    #[error("the ground is measured from {start_nm} to {end_nm} nm only")]
    Band {
        /// First wavelength of the spectrum in nm.
        start_nm: f64,
        /// Last wavelength of the spectrum in nm.
        end_nm: f64,
        /// Wavelengths of the library.
        wanted: Grid,
    },
    /// The spectrum cannot be interpolated.
    #[error(transparent)]
    Interpolate(#[from] InterpolateError),
}

impl Explain for BackingError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Reflectance { .. } => {
                Some(Hint::new("try [over=0.85] or [over=paper.csv#SAMPLE]"))
            }
            Self::Band { wanted, .. } => Some(Hint::new(format!("the library stands on {wanted}"))),
            Self::Interpolate(_) => None,
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Reflectance { .. } => Fault::Setting,
            Self::Band { .. } | Self::Interpolate(_) => Fault::Input,
        }
    }
}
