//! Plans of swatches.

use calibrate::PigmentLibrary;
use calibrate::fit::ExpectedNoise;
use calibrate::plan::{MeasurementForm, PlanOptions};
use pyo3::prelude::*;

use crate::arrays::{GridNumbers, grid};
use crate::failure::{Exception, Raised};
use crate::json::{RemarkTuple, remarks};
use crate::library::Library;
use crate::running::run;

/// Options of a plan, as the public Python functions pass them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options<'py> {
    black: Option<String>,
    prior: Option<PyRef<'py, Library>>,
    swatches: Option<usize>,
    grams: f64,
    balance: f64,
    noise: Option<(f64, f64)>,
    grid: GridNumbers,
    replicates: usize,
}

/// Plans swatches. Returns JSON with the keys of `impasto plan --json`, the measurement form as
/// bytes, and remarks.
#[pyfunction]
pub(crate) fn plan(
    py: Python<'_>,
    pigments: Vec<String>,
    white: String,
    options: Options<'_>,
) -> PyResult<(String, Vec<u8>, Vec<RemarkTuple>)> {
    let form = MeasurementForm { grid: grid(py, options.grid)?, replicates: options.replicates };
    let noise = options.noise.map(|(constant, even)| ExpectedNoise { constant, even });
    let prior = options.prior.as_ref().map(|library| PigmentLibrary::clone(&library.0));
    let chosen = PlanOptions {
        black: options.black.clone(),
        prior,
        swatches: options.swatches,
        grams: options.grams,
        balance: options.balance,
        noise,
    };
    let planned = run(py, None, move |task| calibrate::plan(&pigments, &white, &chosen, task))?;
    let planned = planned.raised(py, Exception::Fit)?;
    Ok((planned.to_json().to_string(), planned.form(&form), remarks(&planned.remarks)))
}
