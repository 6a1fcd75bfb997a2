//! Readings of swatches: files of any format, or a table.

use std::path::PathBuf;
use std::sync::Arc;

use calibrate::ReadingFormat;
use calibrate::measurement::{Film, Scale, ScaleChoice};
use documents::hint::Fault;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use spectra::WavelengthList;
use spectra::instrument::StatedValues;
use spectra::referencing::{DarkFiles, ReferenceFiles, TileSource};

use crate::arrays::GridNumbers;
use crate::failure::{Exception, Raised, RemarkTuple, remarks};

/// Readings of one or more files on one grid.
#[pyclass(frozen, module = "impasto._native")]
pub(crate) struct Readings(pub(crate) Arc<calibrate::Readings>);

/// Files of a white reading and of dark readings, and the reflectance of the white if it is known. They
/// convert counts to reflectance.
type References = (String, Vec<String>, Option<String>);

/// Wavelengths of values that stand without theirs: a file or a range, or numbers in nm.
#[derive(Debug, FromPyObject)]
enum Wavelengths {
    Named(String),
    List(Vec<f64>),
}

impl Wavelengths {
    fn nm(self, py: Python<'_>) -> PyResult<Vec<f64>> {
        match self {
            Self::Named(text) => {
                WavelengthList::named(&text).map(|list| list.nm).raised(py, Exception::Reading)
            }
            Self::List(values) => {
                WavelengthList::of(&values, Some("nm")).map(|list| list.nm).map_err(|problem| {
                    let message = format!("the list of wavelengths {problem}");
                    let hint = "wavelengths are in nm";
                    Exception::Reading.with(py, Fault::Setting, &message, Some(hint))
                })
            }
        }
    }
}

#[pymethods]
impl Readings {
    /// Reads files, and recipes where these stand in a file of their own.
    #[staticmethod]
    #[pyo3(signature = (paths, recipes, pigments, format, percent, transmittance, values, wavelengths, references, spectra_only))]
    #[expect(clippy::too_many_arguments, reason = "the public face has them by name")]
    fn open(
        py: Python<'_>,
        paths: Vec<PathBuf>,
        recipes: Option<PathBuf>,
        pigments: Option<Vec<String>>,
        format: Option<&str>,
        percent: Option<bool>,
        transmittance: bool,
        values: Option<&str>,
        wavelengths: Option<Wavelengths>,
        references: Option<References>,
        spectra_only: bool,
    ) -> PyResult<Self> {
        let options = calibrate::ReadingOptions {
            format: format.map(|name| known_format(py, name)).transpose()?,
            scale: scale(percent),
            pigments,
            transmittance_is_reflectance: transmittance,
            values: values.map(|name| known_quantity(py, name)).transpose()?,
            wavelengths_nm: wavelengths.map(|list| list.nm(py)).transpose()?,
            references: references.map(reference_files),
        };
        let read = py.detach(|| {
            let named = options.pigments.as_deref();
            let mut readings = if spectra_only {
                calibrate::Readings::open_spectra(&paths, &options)?
            } else {
                calibrate::Readings::open_all(&paths, &options)?
            };
            if let Some(recipes) = &recipes {
                readings = readings.with_recipes_of(recipes, named)?;
            }
            readings.check_has_pigments(named.unwrap_or_default())?;
            Ok::<_, calibrate::ReadingsError>(readings)
        });
        read.map(|readings| Self(Arc::new(readings))).raised(py, Exception::Reading)
    }

    /// Reads the measurement CSV in `bytes`. Errors call it `name`.
    #[staticmethod]
    #[pyo3(signature = (name, bytes, pigments, percent))]
    fn from_csv(
        py: Python<'_>,
        name: &str,
        bytes: &[u8],
        pigments: Option<Vec<String>>,
        percent: Option<bool>,
    ) -> PyResult<Self> {
        let options = calibrate::ReadingOptions {
            scale: scale(percent),
            pigments,
            ..calibrate::ReadingOptions::default()
        };
        let readings = calibrate::Readings::from_csv_with(name, bytes, &options);
        readings.map(|readings| Self(Arc::new(readings))).raised(py, Exception::Reading)
    }

    /// Names of the pigments.
    #[getter]
    fn pigments(&self) -> Vec<String> {
        self.0.table.pigments.clone()
    }

    /// First wavelength, step and count.
    #[getter]
    fn grid(&self) -> GridNumbers {
        let grid = self.0.table.grid;
        (grid.start_nm(), grid.step_nm(), grid.count())
    }

    /// Name of the sample of each reading.
    #[getter]
    fn samples(&self) -> Vec<String> {
        self.0.table.readings.iter().map(|reading| reading.sample.clone()).collect()
    }

    /// Backing of each reading.
    #[getter]
    fn backings(&self) -> Vec<String> {
        self.0.table.readings.iter().map(|reading| reading.backing.to_string()).collect()
    }

    /// Whether each reading is of a bare card.
    #[getter]
    fn bare(&self) -> Vec<bool> {
        self.0.table.readings.iter().map(|reading| reading.film != Film::Paint).collect()
    }

    /// Amount of each pigment in each reading. Bare cards have NaN.
    #[getter]
    fn amounts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let count = self.0.table.pigments.len();
        let values = self.0.table.readings.iter().flat_map(|reading| {
            (0..count).map(|index| reading.amounts.get(index).copied().unwrap_or(f64::NAN))
        });
        let values = values.collect();
        PyArray1::from_vec(py, values).reshape([self.0.table.readings.len(), count])
    }

    /// Reflectance of each reading, as fractions.
    #[getter]
    fn reflectance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let table = &self.0.table;
        let values = table.readings.iter().flat_map(|reading| reading.reflectance.iter().copied());
        let values = values.collect();
        PyArray1::from_vec(py, values).reshape([table.readings.len(), table.grid.count()])
    }

    /// Mean reflectance by name, of paint and of bare cards.
    fn averaged<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Vec<String>, Vec<bool>, Bound<'py, PyArray2<f64>>)> {
        let averaged = self.0.table.averaged();
        let names = averaged.spectra.iter().map(|spectrum| spectrum.name.clone()).collect();
        let bare = averaged.spectra.iter().map(|spectrum| spectrum.film != Film::Paint).collect();
        let values = averaged.spectra.iter().flat_map(|spectrum| spectrum.reflectance.clone());
        let shape = [averaged.spectra.len(), averaged.grid.count()];
        Ok((names, bare, PyArray1::from_vec(py, values.collect()).reshape(shape)?))
    }

    /// Path and SHA-256 of each file that was read.
    #[getter]
    fn inputs(&self) -> Vec<(String, String)> {
        self.0.inputs.iter().map(|input| (input.path.clone(), input.sha256.clone())).collect()
    }

    /// Remarks on the files.
    #[getter]
    fn remarks(&self) -> Vec<RemarkTuple> {
        remarks(&self.0.remarks)
    }
}

fn scale(percent: Option<bool>) -> ScaleChoice {
    match percent {
        None => ScaleChoice::ByFile,
        Some(true) => ScaleChoice::Known(Scale::Percent),
        Some(false) => ScaleChoice::Known(Scale::Fraction),
    }
}

fn known_format(py: Python<'_>, name: &str) -> PyResult<ReadingFormat> {
    ReadingFormat::named(name).ok_or_else(|| {
        let known: Vec<&str> = ReadingFormat::names().collect();
        let message = format!("unknown format `{name}`");
        let hint = known.join(", ");
        Exception::Reading.with(py, Fault::Setting, &message, Some(&format!("formats are {hint}")))
    })
}

fn known_quantity(py: Python<'_>, name: &str) -> PyResult<StatedValues> {
    StatedValues::named(name).ok_or_else(|| {
        let known = StatedValues::ALL.map(StatedValues::name).join(", ");
        let message = format!("unknown quantity `{name}`");
        let hint = format!("quantities are {known}");
        Exception::Reading.with(py, Fault::Setting, &message, Some(&hint))
    })
}

fn reference_files((white, darks, tile): References) -> ReferenceFiles {
    let mut files = ReferenceFiles::new(white);
    files.dark = match darks.as_slice() {
        [zero] if zero == "0" => DarkFiles::Subtracted,
        _ => DarkFiles::Files(darks),
    };
    if let Some(tile) = tile {
        let fraction = tile.parse().map(TileSource::Fraction);
        files.tile = fraction.unwrap_or(TileSource::File(tile));
    }
    files
}
