//! Films on two cards, and two sets of measurements compared.

use calibrate::{CompareRequest, FilmRequest, compare_sets};
use documents::request::request_from_json;
use pyo3::prelude::*;

use crate::failure::{Exception, Raised, RemarkTuple, remarks};
use crate::light::{Light, viewing};
use crate::readings::Readings;
use crate::running::run;

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
