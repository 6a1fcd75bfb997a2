//! Recipes for target colours.

use std::path::PathBuf;
use std::sync::Arc;

use calibrate::Viewing;
use calibrate::library::PigmentLibrary;
use calibrate::matching::{ColorTarget, MatchRequest, TargetBook, ViewingCondition};
use documents::file::read;
use documents::hint::Fault;
use documents::request::request_from_json;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use spectra::Observer;

use crate::arrays::{GridNumbers, reflectance};
use crate::failure::{Exception, Raised, RemarkTuple, remarks};
use crate::library::{Ground, Library};
use crate::light::{Light, viewing};
use crate::running::run;

/// A colour of a book.
#[pyclass(frozen, module = "impasto._native")]
pub(crate) struct BookColor(ColorTarget);

#[pymethods]
impl BookColor {
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }
}

/// The named colours of a swatch file or of a table, with remarks. `None` for other files. If you pass a `name`, or a
/// place counted from 1, you get this colour alone.
#[pyfunction]
pub(crate) fn color_book(
    py: Python<'_>,
    path: PathBuf,
    name: Option<&str>,
    light: Option<PyRef<'_, Light>>,
    observer: &str,
) -> PyResult<Option<(Vec<BookColor>, Vec<RemarkTuple>)>> {
    let viewing = light.map(|light| viewing(py, &light, observer)).transpose()?;
    let bytes = read(&path).raised(py, Exception::Reading)?;
    let file = path.display().to_string();
    let book = TargetBook::read(&file, &bytes, name, viewing.as_ref());
    let book = book.raised(py, Exception::Reading)?;
    Ok(book.map(|book| {
        let told = remarks(&book.remarks);
        (book.targets.into_iter().map(BookColor).collect(), told)
    }))
}

/// A target: a code such as `#4a7d8c` or `52,-10.5,8`, a colour of a book, or a name, a grid and a spectrum.
#[derive(FromPyObject)]
pub(crate) enum Target<'py> {
    Code(String),
    OfBook(PyRef<'py, BookColor>),
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
            Self::OfBook(color) => Ok(color.0.clone()),
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
