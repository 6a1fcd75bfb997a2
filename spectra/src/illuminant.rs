//! Illuminants and standard observers of the CIE, read from the tables in `data`.
//!
//! Every other light, e.g. a measured lamp, also becomes an [`Illuminant`].

use std::sync::OnceLock;

use documents::hint::Explain;

use crate::grid::Grid;
use crate::interpolate::{Extrapolation, Interpolation};
use crate::spectrum::{
    IrregularSpectrum, IrregularSpectrumError, Power, Response, Spectrum, SpectrumError,
};

/// A light: its name and its relative spectral power at 1 nm on [`Grid::cie`].
///
/// We interpolate tables of the CIE at coarser steps linearly, because the CIE defines D65 between its
/// 5 nm values so (CIE 15:2018, section 4), and measured lamps by their smoothness
/// ([`Illuminant::from_lamp`]). Beyond the ends of a table the end value counts.
#[derive(Debug, Clone, PartialEq)]
pub struct Illuminant {
    name: String,
    power: Spectrum<Power>,
    lamp: Option<MeasuredLamp>,
}

/// How a lamp was measured, and what was assumed in reading it.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredLamp {
    /// Usual distance of neighbouring wavelengths in nm.
    pub step_nm: f64,
    /// Whether the power over wavelength is smooth ([`IrregularSpectrum::is_smooth`]).
    pub is_smooth: bool,
    /// Assumptions and corrections, as messages for the user.
    pub remarks: Vec<String>,
}

/// Interpolation makes no difference below this step in nm: less than 0.01 in Ra and Rf.
const FINE_NM: f64 = 2.5;

impl Illuminant {
    /// The CIE illuminant called `name`, ignoring case: A, B, C, D50, D55, D60, D65, D75, E,
    /// FL1 to FL12, FL3.1 to FL3.15, HP1 to HP5, LED-B1 to LED-B5, LED-BH1, LED-RGB1, LED-V1,
    /// LED-V2, ID50, ID65.
    pub fn named(name: &str) -> Result<Self, IlluminantError> {
        let tables = tables();
        let (known, _) = tables
            .iter()
            .skip(1)
            .find(|(known, _)| known.eq_ignore_ascii_case(name))
            .ok_or_else(|| IlluminantError::Unknown(name.to_owned()))?;
        let (nm, values) = filled(tables, known).expect("the column was just found");
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

    /// A light from its spectral power, measured at any wavelengths. Outside them the nearest end
    /// value counts.
    ///
    /// # Errors
    /// [`IlluminantError`] if a power is negative, or all are 0.
    pub fn from_samples(name: &str, samples: &IrregularSpectrum) -> Result<Self, IlluminantError> {
        Self::from_function(name, |nm| samples.at_linear(nm, Extrapolation::Hold).unwrap_or(0.0))
    }

    /// A light from the measured power of a lamp. Between the values we interpolate by Sprague's
    /// polynomial (CIE 167:2005), or by a cubic spline if the wavelengths are irregular. If the lamp
    /// is not smooth, e.g. because it has lines, we interpolate linearly. [`MeasuredLamp`] tells which.
    ///
    /// # Errors
    /// [`IlluminantError`] if a power is negative, or all are 0.
    pub fn from_lamp(name: &str, samples: &IrregularSpectrum) -> Result<Self, IlluminantError> {
        let step_nm = samples.step_nm();
        let is_smooth = step_nm >= FINE_NM && within(samples, Grid::cie()).is_smooth();
        let hold = Extrapolation::Hold;
        let linear = |nm| samples.at_linear(nm, hold).unwrap_or(0.0);
        let regular = Grid::through(samples.wavelengths_nm());
        let (light, method) = match regular {
            Some(grid) if is_smooth => {
                let power = Spectrum::<Power>::new(grid, samples.values().to_vec())?;
                let sprague = |nm| power.at(nm, Interpolation::Sprague, hold).unwrap_or(0.0);
                let light = Self::from_function(name, |nm| sprague(nm).max(0.0))?;
                (light, "by Sprague's polynomial, because the lamp is smooth")
            }
            None if is_smooth => {
                let curve = samples.smooth_curve();
                let light = Self::from_function(name, |nm| {
                    curve.at(nm).unwrap_or_else(|| linear(nm)).max(0.0)
                })?;
                (light, "by a cubic spline, because the lamp is smooth")
            }
            _ => (Self::from_samples(name, samples)?, "linearly, because the lamp is not smooth"),
        };
        let mut remarks = Vec::new();
        if step_nm >= FINE_NM {
            remarks.push(format!("{name}: steps of {step_nm} nm are interpolated {method}"));
        }
        Ok(Self { lamp: Some(MeasuredLamp { step_nm, is_smooth, remarks }), ..light })
    }

    /// The light with further remarks on its measurement, before its own. CIE illuminants keep none.
    #[must_use]
    pub(crate) fn with_remarks(mut self, remarks: Vec<String>) -> Self {
        if let Some(lamp) = &mut self.lamp {
            lamp.remarks.splice(0..0, remarks);
        }
        self
    }

    /// How the lamp was measured. `None` for lights that are computed or come from a table of the CIE.
    #[must_use]
    pub fn lamp(&self) -> Option<&MeasuredLamp> {
        self.lamp.as_ref()
    }

    /// Remarks on the measurement of the lamp, as messages for the user.
    #[must_use]
    pub fn remarks(&self) -> &[String] {
        self.lamp.as_ref().map_or(&[], |lamp| &lamp.remarks)
    }

    /// A light from a function of its relative power over the wavelength in nm.
    pub(crate) fn from_function(
        name: &str,
        power: impl Fn(f64) -> f64,
    ) -> Result<Self, IlluminantError> {
        let grid = Grid::cie();
        let power = Spectrum::new(grid, grid.wavelengths_nm().map(power).collect())?;
        if power.values().iter().all(|&v| v == 0.0) {
            return Err(IlluminantError::Dark(name.to_owned()));
        }
        Ok(Self { name: name.to_owned(), power, lamp: None })
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

/// The values at wavelengths of `band`, or all if it holds none.
fn within(samples: &IrregularSpectrum, band: Grid) -> IrregularSpectrum {
    let all = samples.wavelengths_nm().iter().zip(samples.values());
    let (nm, values) = all.filter(|(nm, _)| band.covers(**nm)).unzip();
    IrregularSpectrum::new(nm, values).unwrap_or_else(|_| samples.clone())
}

fn tables() -> &'static [(String, Vec<Option<f64>>)] {
    static TABLES: OnceLock<Vec<(String, Vec<Option<f64>>)>> = OnceLock::new();
    TABLES.get_or_init(|| columns(include_str!("../data/illuminants.csv")))
}

/// A light that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum IlluminantError {
    /// The illuminant name is not in the table.
    #[error("no CIE illuminant is called `{0}`")]
    #[hint("use a name such as D65, A, FL11 or LED-B3")]
    Unknown(String),
    /// The temperature is outside the defined range.
    #[error("daylight is defined from 4000 to 25000 K, a black body here from 500 K, found `{0}`")]
    #[hint("daylight is defined from D4000K to D25000K, a black body from 500K")]
    Temperature(f64),
    /// The power is 0 at every wavelength from 360 to 830 nm.
    #[error("the light has no power at any wavelength from 360 to 830 nm: `{0}`")]
    Dark(String),
    /// The wavelengths do not form a spectrum.
    #[error(transparent)]
    IrregularSpectrum(#[from] IrregularSpectrumError),
    /// A power is negative or not finite.
    #[error(transparent)]
    Power(#[from] SpectrumError),
}

/// The columns of a CSV with their headings. Empty cells are `None`.
pub(crate) fn columns(text: &str) -> Vec<(String, Vec<Option<f64>>)> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let headers = reader.headers().expect("a shipped table has headers").clone();
    let mut columns: Vec<(String, Vec<Option<f64>>)> =
        headers.iter().map(|name| (name.to_owned(), Vec::new())).collect();
    for record in reader.records() {
        let record = record.expect("a shipped table has rows of one length");
        for (column, cell) in columns.iter_mut().zip(&record) {
            column.1.push(
                (!cell.is_empty()).then(|| cell.parse().expect("a shipped cell is a number")),
            );
        }
    }
    columns
}

/// The wavelengths and values of the filled cells in the column `name`. The first column holds the
/// wavelengths.
pub(crate) fn filled(
    columns: &[(String, Vec<Option<f64>>)],
    name: &str,
) -> Option<(Vec<f64>, Vec<f64>)> {
    let nm = &columns.first()?.1;
    let values = &columns.iter().skip(1).find(|(header, _)| header == name)?.1;
    Some(nm.iter().zip(values).filter_map(|(nm, value)| Some(((*nm)?, (*value)?))).unzip())
}

/// A set of colour-matching functions at 1 nm.
///
/// Outside the tabulated band the functions are 0. You find sources and licences in
/// `data/SOURCES.md`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Observer {
    /// CIE 1931, 2 degrees (ISO/CIE 11664-1).
    #[default]
    Cie1931Deg2,
    /// CIE 1964, 10 degrees (ISO/CIE 11664-1).
    Cie1964Deg10,
    /// CIE 2015, cone-fundamental-based, 2 degrees (CIE 170-2:2015).
    Cie2015Deg2,
    /// CIE 2015, cone-fundamental-based, 10 degrees (CIE 170-2:2015).
    Cie2015Deg10,
}

impl Observer {
    /// All observers, by year and field of view.
    pub const ALL: [Self; 4] =
        [Self::Cie1931Deg2, Self::Cie1964Deg10, Self::Cie2015Deg2, Self::Cie2015Deg10];

    /// Name of the observer in files and settings.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Cie1931Deg2 => "1931-2",
            Self::Cie1964Deg10 => "1964-10",
            Self::Cie2015Deg2 => "2015-2",
            Self::Cie2015Deg10 => "2015-10",
        }
    }

    /// The observer with the given name. You may also write `2` or `10` for the observers of 1931
    /// and 1964.
    ///
    /// # Errors
    /// [`ObserverError`] if you pass another name. Its message lists the names.
    pub fn named(name: &str) -> Result<Self, ObserverError> {
        match name {
            "2" => Ok(Self::Cie1931Deg2),
            "10" => Ok(Self::Cie1964Deg10),
            _ => Self::ALL
                .into_iter()
                .find(|observer| observer.name() == name)
                .ok_or_else(|| ObserverError { name: name.to_owned() }),
        }
    }

    /// The colour-matching functions x, y and z (with a bar) on [`Grid::cie`].
    #[must_use]
    pub fn functions(self) -> &'static [Spectrum<Response>; 3] {
        static TABLES: [OnceLock<[Spectrum<Response>; 3]>; 4] = [const { OnceLock::new() }; 4];
        TABLES[self as usize].get_or_init(|| self.read_table())
    }

    fn read_table(self) -> [Spectrum<Response>; 3] {
        let columns = columns(match self {
            Self::Cie1931Deg2 => include_str!("../data/observers/cie-1931-2.csv"),
            Self::Cie1964Deg10 => include_str!("../data/observers/cie-1964-10.csv"),
            Self::Cie2015Deg2 => include_str!("../data/observers/cie-2015-2.csv"),
            Self::Cie2015Deg10 => include_str!("../data/observers/cie-2015-10.csv"),
        });
        ["x", "y", "z"].map(|name| {
            let (nm, tabulated) =
                filled(&columns, name).expect("a shipped observer has x, y and z");
            let grid = Grid::cie();
            let mut values = vec![0.0; grid.count()];
            for (nm, value) in nm.iter().zip(tabulated) {
                // The tables are given at whole nanometres inside this band.
                values[(nm - grid.start_nm()) as usize] = value;
            }
            Spectrum::new(grid, values).expect("a shipped observer is finite")
        })
    }
}

impl std::fmt::Display for Observer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// An unknown name of an observer.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
#[fault(Setting)]
#[error("observers are 1931-2 (or 2), 1964-10 (or 10), 2015-2 and 2015-10, found `{name}`")]
pub struct ObserverError {
    /// The name that was given.
    pub name: String,
}
