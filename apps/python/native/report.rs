//! The report on a library.

use std::ops::RangeInclusive;
use std::sync::Arc;

use documents::request::request_from_json;
use pyo3::prelude::*;
use reports::{Report, ReportError, ReportRequest};

use crate::failure::{Exception, Raised};
use crate::library::Library;
use crate::light::{Light, viewing};
use crate::readings::Readings;
use crate::running::run;

/// How many wavelengths the quadratures in a report have.
const WAVELENGTHS: RangeInclusive<usize> = 3..=12;

/// Draws the page and its figures. Returns the path inside the report's folder and the bytes of
/// each file.
#[pyfunction]
pub(crate) fn report(
    py: Python<'_>,
    library: &Library,
    readings: Option<&Readings>,
    request: &str,
    light: &Light,
    observer: &str,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<(String, Vec<u8>)>> {
    let request: ReportRequest = request_from_json(request).raised(py, Exception::Recipe)?;
    // The light may be a spectrum, which has no name that JSON could hold.
    let viewing = viewing(py, light, observer)?;
    let request = ReportRequest { viewing, wavelengths: WAVELENGTHS, ..request };
    let library = library.0.clone();
    let readings = readings.map(|readings| Arc::clone(&readings.0));
    let drawn = run(py, progress, move |task| {
        let subject = request.run(&library, readings.as_deref(), "impasto.report", task)?;
        Ok::<_, ReportError>(Report::draw(&subject, task)?.files())
    })?;
    drawn.map_err(|error| {
        let exception = match &error {
            ReportError::Request(_) | ReportError::Pigment(_) => Exception::Recipe,
            _ => Exception::Fit,
        };
        exception.of(py, &error)
    })
}
