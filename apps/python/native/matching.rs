//! Recipes for target colours.

use std::sync::Arc;

use calibrate::Viewing;
use calibrate::library::PigmentLibrary;
use calibrate::matching::{ColorTarget, MatchRequest, ViewingCondition};
use documents::hint::Fault;
use documents::request::request_from_json;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use spectra::Observer;

use crate::arrays::{GridNumbers, reflectance};
use crate::failure::{Exception, Raised, RemarkTuple, remarks};
use crate::library::{Ground, Library};
use crate::light::Light;
use crate::running::run;

/// A target: a code such as `#4a7d8c` or `52,-10.5,8`, or a name, a grid and a spectrum.
#[derive(FromPyObject)]
pub(crate) enum Target<'py> {
    Code(String),
    Measured(String, GridNumbers, PyReadonlyArray1<'py, f64>),
}

impl Target<'_> {
    fn target(&self, py: Python<'_>) -> PyResult<ColorTarget> {
        match self {
            Self::Code(text) => text.parse().map_err(|_| {
                let message = format!("a target is #rrggbb, L,a,b or a spectrum, found `{text}`");
                let hint = "try \"#4a7d8c\", (52, -10.5, 8) or readings[\"NAME\"]";
                Exception::Recipe.with(py, Fault::Setting, &message, Some(hint))
            }),
            Self::Measured(name, grid, values) => {
                Ok(ColorTarget::measured(name.clone(), reflectance(py, *grid, values)?))
            }
        }
    }
}

/// Searches recipes for each target. Returns one JSON object a target, with the keys of
/// `impasto match --json`, and remarks.
#[pyfunction]
#[expect(
    clippy::too_many_arguments,
    reason = "a light or a ground may be a spectrum, which JSON does not name"
)]
pub(crate) fn recipes_for(
    py: Python<'_>,
    library: &Library,
    targets: Vec<Target<'_>>,
    request: &str,
    lights: Vec<(PyRef<'_, Light>, f64)>,
    observer: &str,
    over: Option<Ground<'_>>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<(String, Vec<RemarkTuple>)>> {
    let options: MatchRequest = request_from_json(request).raised(py, Exception::Recipe)?;
    // Lights and ground may be spectra, which have no names that JSON could hold.
    let observer = Observer::named(observer).raised(py, Exception::Other)?;
    let conditions = lights.iter().map(|(light, weight)| ViewingCondition {
        viewing: Viewing { illuminant: light.0.clone(), observer },
        weight: *weight,
    });
    let options = MatchRequest {
        conditions: conditions.collect(),
        over: over.as_ref().map(|ground| ground.backing(py)).transpose()?,
        ..options
    };
    let targets: Vec<ColorTarget> =
        targets.iter().map(|target| target.target(py)).collect::<PyResult<_>>()?;
    let library: Arc<PigmentLibrary> = library.0.clone();
    let found = run(py, progress, move |task| {
        let search = library.recipe_search(&options)?;
        let mut found = Vec::new();
        for target in &targets {
            let matched = search.recipes_for(target, &task.quiet())?;
            task.stage(&matched.target.name);
            found.push((search.to_json(&matched, None).to_string(), remarks(&matched.remarks)));
        }
        Ok::<_, calibrate::matching::MatchError>(found)
    })?;
    found.raised(py, Exception::Recipe)
}
