//! A few wavelengths instead of many.

use std::sync::Arc;

use calibrate::quadrature::{EffectiveQuadrature, FilmSet, MixtureSet, Quadrature};
use documents::hint::Fault;
use pyo3::prelude::*;
use serde_json::Value;

use crate::failure::Exception;
use crate::library::Library;
use crate::light::{Light, viewing};
use crate::running::run;

/// Chooses wavelengths and weights. Returns JSON with the keys of `impasto quadrature --json`.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the public face has them by name")]
pub(crate) fn quadrature(
    py: Python<'_>,
    library: Option<&Library>,
    method: &str,
    nodes: usize,
    light: &Light,
    observer: &str,
    mixtures: usize,
    seed: u64,
) -> PyResult<String> {
    let viewing = viewing(py, light, observer)?;
    let library = library.map(|library| library.0.clone());
    let method = method.to_owned();
    let known = ["gauss", "moments", "library", "effective"];
    let has_library = library.is_some();
    if !known.contains(&method.as_str())
        || (!has_library && ["library", "effective"].contains(&&*method))
    {
        let message = if known.contains(&method.as_str()) {
            format!("the method `{method}` needs a pigment library")
        } else {
            format!("unknown method `{method}`")
        };
        let hint = "methods are gauss, moments, library and effective; the last two take a library";
        return Err(Exception::Other.with(py, Fault::Setting, &message, Some(hint)));
    }
    let done = run(py, None, move |task| {
        let Some(library) = library else {
            let rule = match method.as_str() {
                "gauss" => Quadrature::gauss(&viewing, nodes)?,
                _ => Quadrature::moments(&viewing, nodes)?,
            };
            return Ok(rule.to_json(None));
        };
        let library = Arc::clone(&library);
        let weights = viewing.weights(library.grid)?;
        if method == "effective" {
            let found = EffectiveQuadrature::of(&viewing, &library, nodes, task)?;
            let error = |films: FilmSet| (mixtures > 0).then(|| found.error(&library, &films));
            let hiding = error(FilmSet::hiding(&library, &weights, mixtures, seed));
            let over = error(FilmSet::over_grounds(&library, &weights, mixtures, seed));
            return Ok(found.to_json(&library, [hiding, over]));
        }
        let rule = match method.as_str() {
            "gauss" => Quadrature::gauss(&viewing, nodes)?,
            "moments" => Quadrature::moments(&viewing, nodes)?,
            _ => Quadrature::library(&viewing, &library, nodes)?,
        };
        Ok(rule.to_json(
            (mixtures > 0)
                .then(|| rule.error(&MixtureSet::random(&library, &weights, mixtures, seed))),
        ))
    })?;
    let done: Result<Value, QuadratureOrGrid> = done;
    done.map(|value| value.to_string()).map_err(|error| match error {
        QuadratureOrGrid::Quadrature(error) => Exception::Other.of(py, &error),
        QuadratureOrGrid::Grid(error) => Exception::Other.of(py, &error),
    })
}

/// Errors of a quadrature.
enum QuadratureOrGrid {
    Quadrature(calibrate::quadrature::QuadratureFailure),
    Grid(spectra::InterpolateError),
}

impl From<calibrate::quadrature::QuadratureFailure> for QuadratureOrGrid {
    fn from(error: calibrate::quadrature::QuadratureFailure) -> Self {
        Self::Quadrature(error)
    }
}

impl From<spectra::InterpolateError> for QuadratureOrGrid {
    fn from(error: spectra::InterpolateError) -> Self {
        Self::Grid(error)
    }
}
