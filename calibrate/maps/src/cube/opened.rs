//! A scan as its reader opens it: raw values, and how the file says that they become reflectance.

use std::path::PathBuf;

use super::window::Source;

/// How raw values become reflectance, as far as the file tells.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Values {
    /// The file does not tell. `are_whole`: its numbers are integers.
    Unknown { are_whole: bool },
    /// Reflectance is the value divided by this number.
    Divided(f64),
    /// Reflectance is the value times the first number plus the second, for each band.
    Gains(Vec<(f64, f64)>),
    /// Counts or radiance, which need a white reading.
    Counts,
}

/// A scan before its values are interpreted.
#[derive(Debug)]
pub(crate) struct Opened {
    pub(crate) path: PathBuf,
    pub(crate) lines: usize,
    pub(crate) samples: usize,
    /// Bands of the file.
    pub(crate) bands: usize,
    /// One wavelength a band; `None` if the file has none.
    pub(crate) wavelengths_nm: Option<Vec<f64>>,
    /// Full width at half maximum of each band, if known.
    pub(crate) fwhm_nm: Option<Vec<f64>>,
    /// Whether each band is good.
    pub(crate) good: Vec<bool>,
    /// Value that marks pixels without data.
    pub(crate) ignore: Option<f64>,
    pub(crate) values: Values,
    pub(crate) integration_time: Option<f64>,
    /// Sentences that a user should see.
    pub(crate) remarks: Vec<String>,
    pub(crate) source: Box<dyn Source>,
}
