//! Illuminants: the tables of the CIE, and the common form of all lights.

use std::sync::OnceLock;

use crate::grid::Grid;
use crate::interpolate::Extrapolation;
use crate::irregular::{IrregularSpectrum, IrregularSpectrumError};
use crate::spectrum::{Power, Spectrum, SpectrumError};
use crate::table;
use documents::hint::{Explain, Hint};

/// A light: its name and its relative spectral power at 1 nm on [`Grid::cie`].
///
/// Tables at coarser steps are interpolated linearly, as the CIE defines D65 between its 5 nm
/// values (CIE 15:2018, section 4). Beyond the ends of a table the end value is held.
#[derive(Debug, Clone, PartialEq)]
pub struct Illuminant {
    name: String,
    power: Spectrum<Power>,
}

impl Illuminant {
    /// The CIE illuminant called `name`, ignoring case: A, B, C, D50, D55, D60, D65, D75, E,
    /// FL1 to FL12, FL3.1 to FL3.15, HP1 to HP5, LED-B1 to LED-B5, LED-BH1, LED-RGB1, LED-V1,
    /// LED-V2, ID50, ID65.
    ///
    /// # Errors
    /// [`IlluminantError::Unknown`] for any other name.
    pub fn named(name: &str) -> Result<Self, IlluminantError> {
        let tables = tables();
        let (known, _) = tables
            .iter()
            .skip(1)
            .find(|(known, _)| known.eq_ignore_ascii_case(name))
            .ok_or_else(|| IlluminantError::Unknown { name: name.to_owned() })?;
        let (nm, values) = table::filled(tables, known).expect("the column was just found");
        Self::from_samples(known, &IrregularSpectrum::new(nm, values)?)
    }

    /// CIE standard illuminant D65, the default light of this crate.
    #[must_use]
    pub fn d65() -> Self {
        Self::named("D65").expect("D65 is shipped")
    }

    /// All names that [`Illuminant::named`] knows, in the order of the table.
    pub fn names() -> impl Iterator<Item = &'static str> {
        tables().iter().skip(1).map(|(name, _)| name.as_str())
    }

    /// A light from its spectral power, measured at any wavelengths. End values are held.
    ///
    /// # Errors
    /// [`IlluminantError`] if a power is negative, or all are 0.
    pub fn from_samples(name: &str, samples: &IrregularSpectrum) -> Result<Self, IlluminantError> {
        Self::from_function(name, |nm| samples.at_linear(nm, Extrapolation::Hold).unwrap_or(0.0))
    }

    /// A light from a function of its relative power over the wavelength in nm.
    pub(crate) fn from_function(
        name: &str,
        power: impl Fn(f64) -> f64,
    ) -> Result<Self, IlluminantError> {
        let grid = Grid::cie();
        let power = Spectrum::new(grid, grid.wavelengths_nm().map(power).collect())?;
        if power.values().iter().all(|&v| v == 0.0) {
            return Err(IlluminantError::Dark { name: name.to_owned() });
        }
        Ok(Self { name: name.to_owned(), power })
    }

    /// The name of the light.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Relative power at 1 nm, 360 to 830 nm.
    #[must_use]
    pub fn power(&self) -> &Spectrum<Power> {
        &self.power
    }
}

fn tables() -> &'static [(String, Vec<Option<f64>>)] {
    static TABLES: OnceLock<Vec<(String, Vec<Option<f64>>)>> = OnceLock::new();
    TABLES.get_or_init(|| table::columns(include_str!("../data/illuminants.csv")))
}

/// A light that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum IlluminantError {
    /// The illuminant name is not in the table.
    #[error("no CIE illuminant is called `{name}`")]
    Unknown {
        /// The name that was given.
        name: String,
    },
    /// The temperature is outside the defined range.
    #[error(
        "daylight is defined from 4000 to 25000 K, a black body here from 500 K, found `{kelvin}`"
    )]
    Temperature {
        /// The temperature in K.
        kelvin: f64,
    },
    /// The power is 0 at every wavelength from 360 to 830 nm.
    #[error("the light has no power at any wavelength from 360 to 830 nm: `{name}`")]
    Dark {
        /// Name of the light.
        name: String,
    },
    /// The wavelengths do not form a spectrum.
    #[error(transparent)]
    IrregularSpectrum(#[from] IrregularSpectrumError),
    /// A power is negative or not finite.
    #[error(transparent)]
    Power(#[from] SpectrumError),
}

impl Explain for IlluminantError {
    fn hint(&self) -> Option<Hint> {
        let sentence = match self {
            Self::Temperature { .. } => {
                "daylight is defined from D4000K to D25000K, a black body from 500K"
            }
            Self::Unknown { .. } => "use a name such as D65, A, FL11 or LED-B3",
            Self::IrregularSpectrum(error) => return error.hint(),
            Self::Power(error) => return error.hint(),
            Self::Dark { .. } => return None,
        };
        Some(Hint::new(sentence))
    }
}
