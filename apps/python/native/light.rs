//! Lights by name, temperature or file.

use numpy::PyArray1;
use pyo3::prelude::*;
use spectra::{Observer, Viewing, light_from_text};

use crate::failure::{Exception, Raised};

/// A light: its power from 360 to 830 nm at 1 nm.
#[pyclass(frozen, module = "impasto._native")]
pub(crate) struct Light(pub(crate) spectra::Illuminant);

#[pymethods]
impl Light {
    /// A CIE illuminant, a temperature such as `5600K` or `D5600K`, or a file of a lamp.
    #[new]
    fn new(py: Python<'_>, text: &str) -> PyResult<Self> {
        light_from_text(text).map(Self).raised(py, Exception::Reading)
    }

    #[getter]
    fn name(&self) -> &str {
        self.0.name()
    }

    /// How the file of a lamp was read.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.0.remarks().to_vec()
    }

    /// Wavelengths in nm.
    #[getter]
    fn wavelengths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let wavelengths = self.0.power().grid().wavelengths_nm().collect();
        PyArray1::from_vec(py, wavelengths)
    }

    /// Relative power at each wavelength.
    #[getter]
    fn power<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.0.power().values())
    }
}

/// A light and the observer of this name.
pub(crate) fn viewing(py: Python<'_>, light: &Light, observer: &str) -> PyResult<Viewing> {
    let observer = Observer::named(observer).raised(py, Exception::Other)?;
    Ok(Viewing { illuminant: light.0.clone(), observer })
}
