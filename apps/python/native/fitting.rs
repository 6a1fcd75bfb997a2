//! Fits and validations, films on two cards, and two sets of measurements compared.

use std::sync::Arc;

use calibrate::{
    CompareRequest, FilmRequest, FitRequest, FitValidation, PreparedFit, ValidationRequest,
    compare_sets,
};
use documents::request::request_from_json;
use pyo3::prelude::*;

use crate::failure::{Exception, Raised, RemarkTuple, remarks};
use crate::library::Library;
use crate::light::{Light, viewing};
use crate::readings::Readings;
use crate::residuals::Residuals;
use crate::running::run;

/// A fitted library, with what a user should know about the fit.
#[pyclass(frozen, module = "impasto._native")]
pub(crate) struct Fit {
    fit: calibrate::Fit,
}

#[pymethods]
impl Fit {
    /// The library, with the evidence of its fit.
    #[getter]
    fn library(&self) -> Library {
        Library(Arc::new(self.fit.library.clone()))
    }

    /// Remarks on the settings that the fit chose, and on findings about films and equations.
    #[getter]
    fn remarks(&self) -> Vec<RemarkTuple> {
        remarks(&self.fit.remarks)
    }

    /// Warnings about the data.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.fit.warnings().to_vec()
    }

    /// Errors of the fit as JSON, with the keys of `impasto fit --json`.
    fn errors(&self) -> String {
        serde_json::Value::Object(self.fit.errors_json()).to_string()
    }

    /// The report that `impasto fit` prints.
    fn text(&self) -> String {
        self.fit.report().to_string()
    }
}

/// Errors of mixtures that were predicted without their own measurement.
#[pyclass(frozen, module = "impasto._native")]
pub(crate) struct Validation(FitValidation);

#[pymethods]
impl Validation {
    /// The fit of all samples.
    #[getter]
    fn fit(&self) -> Fit {
        Fit { fit: self.0.fit.clone() }
    }

    /// Mixtures that could not be left out.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.0.warnings()
    }

    /// Measured and predicted reflectances of the mixtures.
    fn residuals(&self, py: Python<'_>) -> PyResult<Residuals> {
        let residuals = self.0.residuals().raised(py, Exception::Fit)?;
        Ok(Residuals(Arc::new(residuals)))
    }

    /// Errors as JSON: rms, delta_e, per_sample, needed, strength_free, strengths, by_pigment.
    fn errors(&self) -> PyResult<String> {
        serde_json::to_string(&self.0.errors)
            .map_err(|error| pyo3::exceptions::PyRuntimeError::new_err(error.to_string()))
    }

    /// The report that `impasto validate` prints.
    fn text(&self) -> String {
        self.0.report().to_string()
    }
}

/// Fits K and S of every pigment.
#[pyfunction]
pub(crate) fn fit(
    py: Python<'_>,
    readings: &Readings,
    request: &str,
    surface_of: Option<&Library>,
    light: &Light,
    observer: &str,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Fit> {
    let request: FitRequest = request_from_json(request).raised(py, Exception::Fit)?;
    let request = with_surface(request, surface_of);
    // The light may be a spectrum, which has no name that JSON could hold.
    let request = FitRequest { viewing: viewing(py, light, observer)?, ..request };
    let readings = readings.0.clone();
    let done = run(py, progress, move |task| {
        let prepared = PreparedFit::new(&readings, &request, task)?;
        let mut fit = prepared.fit(task)?;
        fit.remarks.splice(0..0, prepared.remarks);
        Ok::<_, calibrate::FittingError>(fit)
    })?;
    done.map(|fit| Fit { fit }).raised(py, Exception::Fit)
}

/// The request with the surface of a library, if there is one.
fn with_surface(request: FitRequest, library: Option<&Library>) -> FitRequest {
    match library {
        Some(library) => request.with_surface_of(&library.0),
        None => request,
    }
}

/// Predicts each mixture without its own measurement.
#[pyfunction]
pub(crate) fn validate(
    py: Python<'_>,
    readings: &Readings,
    request: &str,
    surface_of: Option<&Library>,
    light: &Light,
    observer: &str,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Validation> {
    let request: ValidationRequest = request_from_json(request).raised(py, Exception::Fit)?;
    let fit = with_surface(request.fit, surface_of);
    let fit = FitRequest { viewing: viewing(py, light, observer)?, ..fit };
    let request = ValidationRequest { fit, ..request };
    let readings = readings.0.clone();
    let done = run(py, progress, move |task| {
        PreparedFit::new(&readings, &request.fit, task)?.validate(&request, task)
    })?;
    done.map(Validation).raised(py, Exception::Fit)
}

/// K, S and hiding power of films on two cards. Returns JSON with the keys of `impasto film --json`, and
/// remarks.
#[pyfunction]
pub(crate) fn film(
    py: Python<'_>,
    readings: &Readings,
    request: &str,
    light: &Light,
    observer: &str,
) -> PyResult<(String, Vec<RemarkTuple>)> {
    let request: FilmRequest = request_from_json(request).raised(py, Exception::Fit)?;
    let request = FilmRequest { viewing: viewing(py, light, observer)?, ..request };
    let readings = readings.0.clone();
    let found = run(py, None, move |task| request.run(&readings, task))?;
    let found = found.raised(py, Exception::Fit)?;
    Ok((found.to_json().to_string(), remarks(&found.remarks)))
}

/// Compares two sets of measurements sample by sample. Returns JSON with the keys of `impasto color --against
/// --json` under one light, and remarks.
#[pyfunction]
pub(crate) fn compare(
    py: Python<'_>,
    readings: &Readings,
    against: &Readings,
    request: &str,
    light: &Light,
    observer: &str,
) -> PyResult<(String, Vec<RemarkTuple>)> {
    let request: CompareRequest = request_from_json(request).raised(py, Exception::Other)?;
    let request = CompareRequest { viewing: viewing(py, light, observer)?, ..request };
    let found = compare_sets(&readings.0.table, &against.0.table, &request);
    let found = found.raised(py, Exception::Reading)?;
    Ok((found.to_json().to_string(), remarks(&found.remarks)))
}
