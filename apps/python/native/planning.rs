//! Plans of swatches.

use calibrate::PigmentLibrary;
use calibrate::plan::{MeasurementForm, PlanRequest};
use documents::request::request_from_json;
use pyo3::prelude::*;

use crate::arrays::{GridNumbers, grid};
use crate::failure::{Exception, Raised, RemarkTuple, remarks};
use crate::library::Library;
use crate::running::run;

/// Plans swatches. Returns JSON with the keys of `impasto plan --json`, the measurement form and the
/// recipes of its readings as bytes, and remarks.
#[pyfunction]
pub(crate) fn plan(
    py: Python<'_>,
    pigments: Vec<String>,
    white: String,
    request: &str,
    prior: Option<&Library>,
    form: (GridNumbers, usize),
) -> PyResult<(String, [Vec<u8>; 2], Vec<RemarkTuple>)> {
    let request: PlanRequest = request_from_json(request).raised(py, Exception::Fit)?;
    let prior = prior.map(|library| PigmentLibrary::clone(&library.0));
    let request = PlanRequest { prior, ..request };
    let form = MeasurementForm { grid: grid(py, form.0)?, replicates: form.1 };
    let planned = run(py, None, move |task| calibrate::plan(&pigments, &white, &request, task))?;
    let planned = planned.raised(py, Exception::Fit)?;
    let files = [planned.form(&form), planned.recipes(&form)];
    Ok((planned.to_json().to_string(), files, remarks(&planned.remarks)))
}
