//! Fits and validations.

use std::sync::Arc;

use calibrate::fit::{Method, Smoothness};
use calibrate::library::AmountKind;
use calibrate::observation::BelowSurface;
use calibrate::{FitOptions, FitValidation, PreparedFit, ValidationOptions};
use documents::hint::Fault;
use pyo3::prelude::*;
use spectra::optics::{Specular, Surface};

use crate::failure::{Exception, Raised};
use crate::json::{RemarkTuple, remarks};
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

    /// Choices that were made, and what the films and equations show.
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

    /// Errors as JSON: rms, delta_e, per_sample, needed, strength_free, by_pigment.
    fn errors(&self) -> PyResult<String> {
        serde_json::to_string(&self.0.errors)
            .map_err(|error| pyo3::exceptions::PyRuntimeError::new_err(error.to_string()))
    }

    /// The report that `impasto validate` prints.
    fn text(&self) -> String {
        self.0.report().to_string()
    }
}

/// Options of a fit, as the public Python functions pass them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options<'py> {
    amounts: String,
    method: String,
    reference: Option<String>,
    surface: Option<(f64, f64)>,
    specular: bool,
    below_surface: Option<String>,
    smoothness: Option<f64>,
    unevenness: Option<f64>,
    exclude: Vec<String>,
    light: PyRef<'py, Light>,
    observer: String,
    title: Option<String>,
    licence: Option<String>,
    source: Option<String>,
}

impl Options<'_> {
    fn options(&self, py: Python<'_>) -> PyResult<FitOptions> {
        let specular = if self.specular { Specular::Included } else { Specular::Excluded };
        let surface = self.surface.map(|(k1, k2)| Surface::new(k1, k2, specular)).transpose();
        Ok(FitOptions {
            amounts: chosen(
                py,
                ("amounts", &self.amounts),
                &[("relative", AmountKind::Relative), ("absolute", AmountKind::Absolute)],
            )?,
            method: chosen(
                py,
                ("method", &self.method),
                &[("qp", Method::Qp), ("weighted", Method::Weighted), ("refined", Method::Refined)],
            )?,
            reference: self.reference.clone(),
            surface: surface.raised(py, Exception::Fit)?,
            specular,
            below_surface: match &self.below_surface {
                None => None,
                Some(text) => Some(chosen(
                    py,
                    ("below_surface", text),
                    &[("refuse", BelowSurface::Refuse), ("floor", BelowSurface::Floor)],
                )?),
            },
            smoothness: self.smoothness.map_or(Smoothness::default(), Smoothness::Fixed),
            unevenness: self.unevenness,
            exclude: self.exclude.clone(),
            viewing: viewing(py, &self.light, &self.observer)?,
            title: self.title.clone(),
            licence: self.licence.clone(),
            source: self.source.clone(),
        })
    }
}

fn chosen<T: Clone>(
    py: Python<'_>,
    (setting, name): (&str, &str),
    values: &[(&str, T)],
) -> PyResult<T> {
    let found = values.iter().find(|(known, _)| *known == name);
    found.map(|(_, value)| value.clone()).ok_or_else(|| {
        let known: Vec<&str> = values.iter().map(|(known, _)| *known).collect();
        let message = format!("unknown {setting} `{name}`");
        let hint = format!("{setting} is one of {}", known.join(", "));
        Exception::Fit.with(py, Fault::Setting, &message, Some(&hint))
    })
}

/// Fits K and S of every pigment.
#[pyfunction]
pub(crate) fn fit(
    py: Python<'_>,
    readings: &Readings,
    options: Options<'_>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Fit> {
    let options = options.options(py)?;
    let readings = readings.0.clone();
    let done = run(py, progress, move |task| {
        let prepared = PreparedFit::new(&readings, &options, task)?;
        let mut fit = prepared.fit(task)?;
        fit.remarks.splice(0..0, prepared.remarks);
        Ok::<_, calibrate::FittingError>(fit)
    })?;
    done.map(|fit| Fit { fit }).raised(py, Exception::Fit)
}

/// Predicts each mixture without its own measurement.
#[pyfunction]
pub(crate) fn validate(
    py: Python<'_>,
    readings: &Readings,
    options: Options<'_>,
    folds: Option<usize>,
    with: Vec<String>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Validation> {
    let options = ValidationOptions { fit: options.options(py)?, folds, with };
    let readings = readings.0.clone();
    let done = run(py, progress, move |task| {
        PreparedFit::new(&readings, &options.fit, task)?.validate(&options, task)
    })?;
    done.map(Validation).raised(py, Exception::Fit)
}
