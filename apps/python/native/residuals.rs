//! Errors of a library's predictions for mixtures that its fit had not seen.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

use crate::failure::{Exception, Raised};

/// Measured and predicted reflectances of mixtures that were left out.
#[pyclass(frozen, module = "impasto._native")]
pub(crate) struct Residuals(pub(crate) Arc<calibrate::Residuals>);

#[pymethods]
impl Residuals {
    /// Reads the JSON file at `path`.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let read = py.detach(|| calibrate::Residuals::open(path));
        read.map(|residuals| Self(Arc::new(residuals))).raised(py, Exception::Reading)
    }

    /// Reads JSON text.
    #[staticmethod]
    fn from_json(py: Python<'_>, text: &str) -> PyResult<Self> {
        let read = calibrate::Residuals::from_json("residuals", text);
        read.map(|residuals| Self(Arc::new(residuals))).raised(py, Exception::Reading)
    }

    /// The file that `impasto validate --residuals` writes.
    fn to_json(&self) -> String {
        self.0.to_json()
    }

    /// Writes the JSON file at `path`.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| self.0.save(path)).raised(py, Exception::Other)
    }

    /// SHA-256 of the file, in hexadecimal.
    fn sha256(&self) -> String {
        self.0.sha256()
    }

    /// Names of the mixtures.
    fn samples(&self) -> Vec<String> {
        self.0.mixtures.iter().map(|mixture| mixture.sample.clone()).collect()
    }

    /// Wavelengths in nm.
    fn wavelengths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.0.grid.wavelengths_nm().collect())
    }

    /// Measured reflectances, mixtures by wavelengths.
    fn measured<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.array(py, |mixture| &mixture.measured)
    }

    /// Predicted reflectances, mixtures by wavelengths.
    fn predicted<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.array(py, |mixture| &mixture.predicted)
    }
}

impl Residuals {
    fn array<'py>(
        &self,
        py: Python<'py>,
        list: fn(&calibrate::LeftOutMixture) -> &Vec<f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let values: Vec<f64> = self.0.mixtures.iter().flat_map(list).copied().collect();
        PyArray1::from_vec(py, values).reshape([self.0.mixtures.len(), self.0.grid.count()])
    }
}
