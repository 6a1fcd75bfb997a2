//! Reasons why spectra cannot be mapped with a library.

use calibrate::ResidualsError;
use documents::Cancelled;
use documents::hint::{Explain, Fault, Hint};
use pigment::RecipeError;

/// A library, wavelengths or settings with which no map can be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MapError {
    /// The wavelengths of the scan do not rise.
    #[error("wavelengths must rise strictly, found `{after}` nm at band {band} after {before} nm")]
    Order {
        /// Number of the band, counted from 1.
        band: usize,
        /// Wavelength of the band before, in nm.
        before: f64,
        /// Wavelength of this band, in nm.
        after: f64,
    },
    /// Too few bands lie within the library's wavelengths.
    #[error(
        "{inside} of {bands} bands lie within {start_nm} to {end_nm} nm, where the library's K and S are known; {needed} are needed"
    )]
    Overlap {
        /// Number of bands of the scan.
        bands: usize,
        /// Number of them within the library's wavelengths.
        inside: usize,
        /// Least number that is needed.
        needed: usize,
        /// First wavelength of the library in nm.
        start_nm: f64,
        /// Last wavelength of the library in nm.
        end_nm: f64,
    },
    /// A name matches no pigment of the library, or several.
    #[error(transparent)]
    Name(#[from] RecipeError),
    /// Residuals do not suit the library.
    #[error(transparent)]
    Residuals(#[from] ResidualsError),
    /// Too few or too many pigments take part.
    #[error("1 to {most} pigments can take part in a map, found `{found}`")]
    Pigments {
        /// Number of pigments that would take part.
        found: usize,
        /// Greatest number that can.
        most: usize,
    },
    /// A pigment belongs to two groups.
    #[error("{pigment} is in the group `{first}` and in the group `{second}`")]
    TwoGroups {
        /// Name of the pigment.
        pigment: String,
        /// Name of the first group.
        first: String,
        /// Name of the second group.
        second: String,
    },
    /// The ground is no reflectance, or does not cover the bands of the scan.
    #[error("the spectrum of the ground {problem}")]
    Ground {
        /// The fault, as a sentence part.
        problem: String,
    },
    /// A setting is out of its range.
    #[error("{name} must be {range}, found `{value}`")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Range of the setting, in words.
        range: &'static str,
        /// Value that was given.
        value: f64,
    },
    /// The number of reflectances is not a whole number of pixels.
    #[error("{values} reflectances are no whole number of pixels of {bands} bands")]
    Length {
        /// Number of reflectances.
        values: usize,
        /// Bands of a pixel.
        bands: usize,
    },
    /// The number of masks is not the number of pixels.
    #[error("{masks} masks for {pixels} pixels")]
    Masks {
        /// Number of masks.
        masks: usize,
        /// Number of pixels.
        pixels: usize,
    },
    /// No pixel of the survey can be mapped.
    #[error("none of {pixels} surveyed pixels holds a reflectance that can be mapped")]
    NothingToSurvey {
        /// Number of pixels that were surveyed.
        pixels: usize,
    },
    /// A book was made with another library, other wavelengths or other settings.
    #[error("the book of the survey was made for `{found}`, not for `{expected}`")]
    OtherBook {
        /// Identity of the book.
        found: String,
        /// Identity of the mapper.
        expected: String,
    },
    /// A book was made with another error of the library's predictions.
    #[error("the survey was made with {found}, not with {expected}")]
    OtherModelError {
        /// Error of the book, in words.
        found: String,
        /// Error of the mapper, in words.
        expected: String,
    },
    /// A file of a book cannot be read.
    #[error("the book of a survey is not valid: {reason}")]
    Book {
        /// Reason, in words.
        reason: String,
    },
    /// The survey was ended before all its pixels were searched.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Explain for MapError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Order { .. } => {
                Some(Hint::new("sort the bands of the scan by wavelength, in nm"))
            }
            Self::Overlap { .. } => Some(Hint::new(
                "check that the wavelengths are in nm, or fit a library from readings that cover the scan",
            )),
            Self::Name(error) => error.hint(),
            Self::Residuals(error) => error.hint(),
            Self::Pigments { .. } => Some(Hint::new("name the pigments with [palette]")),
            Self::TwoGroups { .. } => Some(Hint::new("name each pigment in one [group]")),
            Self::Setting { .. } => None,
            Self::Book { .. } => Some(Hint::new(
                "survey the scan again: without this file, or with another one as the [survey]",
            )),
            Self::Ground { .. } => Some(Hint::new(
                "give reflectances from 0 to 1 at rising wavelengths that cover the scan, or a region of bare ground in the scan, as the [ground]",
            )),
            Self::Length { .. } => {
                Some(Hint::new("give the reflectances pixel after pixel, all bands of each"))
            }
            Self::Masks { .. } => Some(Hint::new("give one mask for each pixel, or none at all")),
            Self::NothingToSurvey { .. } => Some(Hint::new(
                "check that the scan holds reflectances from 0 to 1 rather than raw counts or percent",
            )),
            Self::Cancelled(error) => error.hint(),
            Self::OtherBook { .. } => Some(Hint::new("survey the scan again with these settings")),
            Self::OtherModelError { .. } => Some(Hint::new(
                "give the same [residuals] or [model_error] as for the survey, or survey the scan again",
            )),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Residuals(error) => error.fault(),
            Self::Name(_)
            | Self::Pigments { .. }
            | Self::TwoGroups { .. }
            | Self::Ground { .. }
            | Self::Setting { .. } => Fault::Setting,
            Self::Cancelled(error) => error.fault(),
            _ => Fault::Input,
        }
    }
}
