//! Pigments at points, from spectra that were measured there.

use std::sync::Arc;

use calibrate::measurement::{AveragedSpectra, AveragedSpectrum, Film};
use documents::request::request_from_json;
use maps::IdentifyRequest;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use crate::arrays::{GridNumbers, grid, rows};
use crate::failure::{Exception, Raised, RemarkTuple, remarks};
use crate::library::Library;
use crate::residuals::Residuals;
use crate::running::run;

/// Identifies the pigments of spectra as `request` (JSON) says. Returns JSON with the keys of
/// `impasto identify --json`, and remarks.
#[pyfunction]
pub(crate) fn identify(
    py: Python<'_>,
    library: &Library,
    names: Vec<String>,
    grid_numbers: GridNumbers,
    values: PyReadonlyArray2<'_, f64>,
    request: &str,
    residuals: Option<&Residuals>,
) -> PyResult<(String, Vec<RemarkTuple>)> {
    let request: IdentifyRequest = request_from_json(request).raised(py, Exception::Fit)?;
    let grid = grid(py, grid_numbers)?;
    let (values, [_, bands]) = rows(py, &values)?;
    let spectra = names.into_iter().zip(values.chunks_exact(bands.max(1)));
    let spectra = spectra.map(|(name, values)| AveragedSpectrum {
        sample: name.clone(),
        film: Film::Paint,
        name,
        reflectance: values.to_vec(),
    });
    let spots = AveragedSpectra { grid, spectra: spectra.collect() };
    let residuals = residuals.map(|residuals| calibrate::Residuals::clone(&residuals.0));
    let library = Arc::clone(&library.0);
    let found = run(py, None, move |_| request.run_with(&library, &spots, residuals))?;
    let found = found.raised(py, Exception::Fit)?;
    Ok((found.to_json().to_string(), remarks(&found.remarks)))
}
