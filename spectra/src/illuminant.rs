//! Lights: the CIE's tabulated illuminants, and the form all lights share.

use std::sync::OnceLock;

use crate::grid::Grid;
use crate::hint::{Explain, Hint};
use crate::interpolate::Extrapolation;
use crate::irregular::{IrregularSpectrum, IrregularSpectrumError};
use crate::spectrum::{Power, Spectrum, SpectrumError};
use crate::table;

/// A named relative spectral power distribution at 1 nm on [`Grid::cie`].
///
/// Tables at coarser steps are brought to 1 nm by straight lines, as the CIE
/// defines D65 between its 5 nm values (CIE 15:2018, section 4); beyond a
/// table's ends the end value is held.
#[derive(Debug, Clone, PartialEq)]
pub struct Illuminant {
    name: String,
    power: Spectrum<Power>,
}

impl Illuminant {
    /// The CIE illuminant called `name`: A, B, C, D50, D55, D60, D65, D75, E,
    /// FL1 to FL12, FL3.1 to FL3.15, HP1 to HP5, LED-B1 to LED-B5, LED-BH1,
    /// LED-RGB1, LED-V1, LED-V2, ID50, ID65. Case does not matter.
    ///
    /// # Errors
    /// [`IlluminantError::Unknown`].
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

    /// D65, the light this crate uses where none is named.
    #[must_use]
    pub fn d65() -> Self {
        Self::named("D65").expect("D65 is shipped")
    }

    /// The names that [`Illuminant::named`] knows, in table order.
    pub fn names() -> impl Iterator<Item = &'static str> {
        tables().iter().skip(1).map(|(name, _)| name.as_str())
    }

    /// A light measured at any wavelengths.
    ///
    /// # Errors
    /// [`IlluminantError`] if a power is negative or there is no light at all.
    pub fn from_samples(name: &str, samples: &IrregularSpectrum) -> Result<Self, IlluminantError> {
        Self::from_function(name, |nm| samples.at_linear(nm, Extrapolation::Hold).unwrap_or(0.0))
    }

    /// A light given by its relative power at a wavelength in nm.
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

    /// What the light is called.
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

/// Why there is no such light.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum IlluminantError {
    /// No CIE illuminant has this name.
    #[error("no CIE illuminant is called `{name}`")]
    Unknown {
        /// The name that was given.
        name: String,
    },
    /// No such daylight or black body.
    #[error(
        "daylight is defined from 4000 to 25000 K, a black body here from 500 K, found `{kelvin}`"
    )]
    Temperature {
        /// The temperature in kelvin.
        kelvin: f64,
    },
    /// The power is 0 at every wavelength.
    #[error("the light has no power at any wavelength from 360 to 830 nm: `{name}`")]
    Dark {
        /// Which light.
        name: String,
    },
    /// The wavelengths cannot be used.
    #[error(transparent)]
    IrregularSpectrum(#[from] IrregularSpectrumError),
    /// A power cannot be used.
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
