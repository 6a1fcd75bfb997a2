//! Spectral scans, read in blocks.

use std::path::PathBuf;

use documents::request::request_from_json;
use maps::cube::CubeOptions;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;

use crate::failure::{Exception, Raised, RemarkTuple, remarks};

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
}

#[pymethods]
impl Cube {
    /// Opens a scan with options (JSON).
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf, options: &str) -> PyResult<Self> {
        let options: CubeOptions = request_from_json(options).raised(py, Exception::Reading)?;
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

    /// How the file was understood.
    #[getter]
    fn remarks(&self) -> Vec<RemarkTuple> {
        remarks(self.cube.remarks())
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
