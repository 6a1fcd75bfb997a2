//! Surveys of scans, and their maps; pigments of spectra at points.

use std::path::PathBuf;
use std::sync::Arc;

use calibrate::PigmentLibrary;
use calibrate::measurement::{AveragedSpectra, AveragedSpectrum, Film};
use documents::request::request_from_json;
use maps::blocks::RunError;
use maps::{
    Book, Ground, GroundSource, IdentifyRequest, MapError, MapRequest, MapRequestError,
    MapSettings, ModelError, StoreMode, SurveyError, SurveyedScan,
};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use crate::arrays::{GridNumbers, grid, rows};
use crate::cube::Cube;
use crate::failure::{Exception, Raised, RemarkTuple, remarks};
use crate::library::Library;
use crate::residuals::Residuals;
use crate::running::{run, run_with};

/// Wavelengths of a ground in nm, and its reflectance at each.
type GroundCurve = (Vec<f64>, Vec<f64>);

/// Settings of a map. Residuals and a measured ground come beside the request, because JSON can hold
/// neither an object of Python nor a number such as NaN.
fn settings(
    mut request: MapRequest,
    residuals: Option<&Residuals>,
    ground: Option<GroundCurve>,
    (cube, library): (&maps::Cube, &PigmentLibrary),
) -> Result<MapSettings, MapRequestError> {
    // In Python the noise of the white reading has no lower limit.
    request.noise = request.noise.or_else(|| cube.noise_of_white());
    if let Some((nm, reflectance)) = ground {
        let ground = Ground::new(nm, reflectance).map_err(SurveyError::from)?;
        request.ground = Some(GroundSource::Measured(ground));
    }
    let settings = request.settings(cube, library)?;
    let residuals =
        residuals.map(|residuals| ModelError::Residuals(calibrate::Residuals::clone(&residuals.0)));
    Ok(MapSettings { model_error: residuals.or(settings.model_error), ..settings })
}

/// A scan that was surveyed with a library.
#[pyclass(frozen, module = "impasto._native")]
pub(crate) struct Survey(Arc<SurveyedScan>);

#[pymethods]
impl Survey {
    /// Surveys a scan as `request` (JSON) says, or takes over the `book` (JSON) of an earlier survey.
    #[new]
    #[pyo3(signature = (cube, library, request, residuals, ground, book, progress))]
    #[expect(clippy::too_many_arguments, reason = "the public face has them by name")]
    fn new(
        py: Python<'_>,
        cube: &Cube,
        library: &Library,
        request: &str,
        residuals: Option<&Residuals>,
        ground: Option<GroundCurve>,
        book: Option<String>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let request: MapRequest = request_from_json(request).raised(py, Exception::Fit)?;
        let cube = py.detach(|| cube.again()).raised(py, Exception::Reading)?;
        let region = request.region.clone();
        let settings = settings(request, residuals, ground, (&cube, &library.0));
        let settings = settings.raised(py, Exception::Fit)?;
        let book = book.map(|text| Book::from_json(&text)).transpose();
        let book = book.raised(py, Exception::Reading)?;
        let library = library.0.clone();
        let surveyed = run_with(
            py,
            progress,
            |_| "pixel".to_owned(),
            move |task| match book {
                Some(book) => SurveyedScan::with_book(cube, &library, &settings, region, book),
                None => SurveyedScan::survey(cube, &library, &settings, region, task),
            },
        )?;
        surveyed.map(|scan| Self(Arc::new(scan))).raised(py, Exception::Fit)
    }

    /// Pigments that take no part, and assumed errors of the library.
    #[getter]
    fn remarks(&self) -> Vec<RemarkTuple> {
        let mapper = self.0.mapper();
        // Python states the assumed error in `about`.
        remarks(mapper.remarks())
    }

    /// The book of the survey as JSON.
    fn book(&self, py: Python<'_>) -> PyResult<String> {
        self.0.book().to_json().raised(py, Exception::Other)
    }

    /// Palette, groups, hashes and settings as JSON, with the keys of `impasto map --json`.
    fn about(&self) -> String {
        self.0.to_json(None, &[]).to_string()
    }

    /// Begins or resumes the maps at `path`, and returns for each shard its name and how many of
    /// its pixels are still to be mapped.
    fn begin(&self, py: Python<'_>, path: PathBuf, resume: bool) -> PyResult<Vec<(String, usize)>> {
        let mode = if resume { StoreMode::Resume } else { StoreMode::New };
        let store = py.detach(|| self.0.store(path, mode)).raised(py, Exception::Other)?;
        let shards = store.shards().iter().map(|shard| {
            let finished = store.is_finished(shard);
            let left = if finished { 0 } else { shard.rows.len() * shard.columns.len() };
            (shard.to_string(), left)
        });
        Ok(shards.collect())
    }

    /// Maps all unfinished shards of the maps at `path`, on all cores.
    fn map(
        &self,
        py: Python<'_>,
        path: PathBuf,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let scan = Arc::clone(&self.0);
        let store = py.detach(|| scan.store(path, StoreMode::Resume));
        let store = store.raised(py, Exception::Other)?;
        let mapped = run_with(
            py,
            progress,
            |progress| format!("{} of {} pixels", progress.done, progress.of),
            move |task| scan.map(&store, task),
        )?;
        mapped.raised(py, Exception::Other).map(drop)
    }

    /// Maps the unfinished shards among the indices `places` of the maps at `path`, one after another.
    /// Returns the number of mapped pixels.
    fn map_shards(&self, py: Python<'_>, path: PathBuf, places: Vec<usize>) -> PyResult<u64> {
        let scan = Arc::clone(&self.0);
        let store = py.detach(|| scan.store(path, StoreMode::Resume));
        let store = store.raised(py, Exception::Other)?;
        let mapped = run(py, None, move |task| {
            places.into_iter().take_while(|_: &usize| !task.is_cancelled()).try_fold(
                0,
                |pixels, place| {
                    let counts = scan.map_shard(&store, place, task)?;
                    Ok::<_, RunError<MapError>>(pixels + counts.map_or(0, |counts| counts.all()))
                },
            )
        })?;
        mapped.raised(py, Exception::Other)
    }
}

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
