//! One spectrum out of an instrument's file.

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

/// The name of a spectrum whose file does not name it: that of the file, without folder and
/// ending.
pub(super) fn stem(file: &str) -> String {
    let path = std::path::Path::new(file);
    path.file_stem().map_or_else(|| file.to_owned(), |stem| stem.to_string_lossy().into_owned())
}
