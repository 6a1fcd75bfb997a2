//! A few wavelengths instead of many.

use calibrate::quadrature::QuadratureRequest;
use documents::request::request_from_json;
use pyo3::prelude::*;

use crate::failure::{Exception, Raised};
use crate::library::Library;
use crate::light::{Light, viewing};
use crate::running::run;

/// Chooses wavelengths and weights. Returns JSON with the keys of `impasto quadrature --json`.
#[pyfunction]
pub(crate) fn quadrature(
    py: Python<'_>,
    library: Option<&Library>,
    request: &str,
    light: &Light,
    observer: &str,
) -> PyResult<String> {
    let request: QuadratureRequest = request_from_json(request).raised(py, Exception::Other)?;
    // The light may be a spectrum, which has no name that JSON could hold.
    let request = QuadratureRequest { viewing: viewing(py, light, observer)?, ..request };
    let library = library.map(|library| library.0.clone());
    let done = run(py, None, move |task| {
        let outcome = request.run(library.as_deref(), task)?;
        Ok::<_, calibrate::quadrature::QuadratureFailure>(outcome.to_json(library.as_deref()))
    })?;
    done.map(|told| told.to_string()).raised(py, Exception::Other)
}
