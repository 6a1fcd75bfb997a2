//! Spectral scans, read in blocks.

use std::path::PathBuf;

use maps::cube::{CubeOptions, CubeScale, DarkReading};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;

use crate::failure::{Exception, Raised};

/// Options for opening a scan, as the public Python functions pass them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    white_reading: Option<PathBuf>,
    dark_reading: Option<PathBuf>,
    tile: f64,
    percent: Option<bool>,
    full_scale: Option<f64>,
    wavelengths: Option<PathBuf>,
    variable: Option<String>,
}

impl Options {
    fn options(self) -> CubeOptions {
        CubeOptions {
            white_reading: self.white_reading,
            dark_reading: match self.dark_reading {
                None => DarkReading::Missing,
                Some(path) if path.as_os_str() == "0" => DarkReading::Subtracted,
                Some(path) => DarkReading::File(path),
            },
            tile: self.tile,
            scale: match self.percent {
                None => CubeScale::ByFile,
                Some(true) => CubeScale::Percent,
                Some(false) => CubeScale::Fraction,
            },
            full_scale: self.full_scale,
            wavelengths: self.wavelengths,
            variable: self.variable,
            scratch: None,
        }
    }
}

/// A spectral scan.
#[pyclass(frozen, module = "impasto._native")]
pub(crate) struct Cube {
    cube: maps::Cube,
    path: PathBuf,
    options: CubeOptions,
}

impl Cube {
    /// Opens the scan again, for a survey that owns it.
    pub(crate) fn again(&self) -> Result<maps::Cube, maps::cube::CubeError> {
        maps::Cube::open_with(&self.path, &self.options)
    }

    /// Noise of a band, from the white reading.
    pub(crate) fn white_sd(&self) -> Option<f64> {
        let sd = self.cube.white_sd().filter(|sd| !sd.is_empty())?;
        Some((sd.iter().map(|sd| sd * sd).sum::<f64>() / sd.len() as f64).sqrt())
    }
}

#[pymethods]
impl Cube {
    /// Opens a scan.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf, options: Options) -> PyResult<Self> {
        let options = options.options();
        let opened = py.detach(|| maps::Cube::open_with(&path, &options));
        let cube = opened.raised(py, Exception::Reading)?;
        Ok(Self { cube, path, options })
    }

    /// Rows, columns, bands.
    #[getter]
    fn shape(&self) -> (usize, usize, usize) {
        (self.cube.lines(), self.cube.samples(), self.cube.wavelengths_nm().len())
    }

    /// Wavelengths of the bands in nm, rising.
    #[getter]
    fn wavelengths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.cube.wavelengths_nm())
    }

    /// Sentences about how the file was understood.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.cube.remarks().to_vec()
    }

    /// Reflectance (rows, columns, bands) and mask (rows, columns) of a rectangle.
    fn read<'py>(
        &self,
        py: Python<'py>,
        rows: (usize, usize),
        columns: (usize, usize),
    ) -> PyResult<(Bound<'py, PyArray3<f32>>, Bound<'py, PyArray2<u8>>)> {
        let block = py.detach(|| self.cube.read(rows.0..rows.1, columns.0..columns.1));
        let block = block.raised(py, Exception::Reading)?;
        let shape = [block.rows.len(), block.columns.len()];
        let mask: Vec<u8> = block.mask.iter().map(|mask| mask.code()).collect();
        let values = PyArray1::from_vec(py, block.values);
        Ok((
            values.reshape([shape[0], shape[1], block.bands])?,
            PyArray1::from_vec(py, mask).reshape(shape)?,
        ))
    }
}
