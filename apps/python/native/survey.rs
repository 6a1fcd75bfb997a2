//! Surveys of scans, and their maps.

use std::path::PathBuf;
use std::sync::Arc;

use documents::Progress;
use maps::blocks::RunError;
use maps::store::Shard;
use maps::{
    Book, Ground, MapError, MapSettings, ModelError, PigmentGroup, Region, StoreMode, SurveyError,
    SurveyedScan,
};
use pyo3::prelude::*;

use crate::cube::Cube;
use crate::failure::{Exception, Raised};
use crate::library::Library;
use crate::residuals::Residuals;
use crate::running::{run, run_with};

/// Settings of a map, as the public Python functions pass them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Settings {
    at_most: usize,
    palette: Vec<String>,
    groups: Vec<(String, Vec<String>)>,
    group_alike: bool,
    noise: Option<f64>,
    model_error: Option<f64>,
    residuals: Option<Py<Residuals>>,
    penalty: f64,
    ground: Option<(Vec<f64>, Vec<f64>)>,
    ground_region: Option<((usize, usize), (usize, usize))>,
    region: Option<((usize, usize), (usize, usize))>,
}

impl Settings {
    fn settings(
        self,
        cube: &maps::Cube,
        white_sd: Option<f64>,
    ) -> Result<(MapSettings, Option<Region>), SurveyError> {
        let of_ends = |(rows, columns): ((usize, usize), (usize, usize))| Region {
            rows: rows.0..rows.1,
            columns: columns.0..columns.1,
        };
        let ground = match (self.ground, self.ground_region) {
            (Some((nm, reflectance)), _) => Some(Ground::new(nm, reflectance)?),
            (None, Some(ends)) => Some(of_ends(ends).ground(cube)?),
            (None, None) => None,
        };
        let usual = MapSettings::default();
        let residuals = self.residuals.map(|residuals| {
            ModelError::Residuals(calibrate::Residuals::clone(&residuals.get().0))
        });
        let settings = MapSettings {
            at_most: self.at_most,
            palette: self.palette,
            groups: self
                .groups
                .into_iter()
                .map(|(name, pigments)| PigmentGroup { name, pigments })
                .collect(),
            group_alike: self.group_alike,
            sensor_noise: self.noise.or(white_sd).unwrap_or(usual.sensor_noise),
            model_error: residuals.or(self.model_error.map(ModelError::Stated)),
            penalty: self.penalty,
            ground,
        };
        Ok((settings, self.region.map(of_ends)))
    }
}

/// A scan that was surveyed with a library.
#[pyclass(frozen, module = "impasto._native")]
pub(crate) struct Survey(Arc<SurveyedScan>);

#[pymethods]
impl Survey {
    /// Surveys a scan, or takes the `book` of an earlier survey (JSON).
    #[new]
    #[pyo3(signature = (cube, library, settings, book, progress))]
    fn new(
        py: Python<'_>,
        cube: &Cube,
        library: &Library,
        settings: Settings,
        book: Option<String>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let white_sd = cube.white_sd();
        let cube = py.detach(|| cube.again()).raised(py, Exception::Reading)?;
        let (settings, region) = settings.settings(&cube, white_sd).raised(py, Exception::Fit)?;
        let book = book.map(|text| Book::from_json(&text)).transpose();
        let book = book.raised(py, Exception::Reading)?;
        let library = library.0.clone();
        let text = |_: &Progress| "pixel".to_owned();
        let surveyed = run_with(py, progress, text, move |task| match book {
            Some(book) => SurveyedScan::with_book(cube, &library, &settings, region, book),
            None => SurveyedScan::survey(cube, &library, &settings, region, task),
        })?;
        surveyed.map(|scan| Self(Arc::new(scan))).raised(py, Exception::Fit)
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
        let left = |shard: &Shard| match store.is_finished(shard) {
            true => 0,
            false => shard.rows.len() * shard.columns.len(),
        };
        Ok(store.shards().iter().map(|shard| (shard.to_string(), left(shard))).collect())
    }

    /// Maps all shards of the maps at `path` that are not finished, on all cores.
    fn map(
        &self,
        py: Python<'_>,
        path: PathBuf,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let scan = Arc::clone(&self.0);
        let store = py.detach(|| scan.store(path, StoreMode::Resume));
        let store = store.raised(py, Exception::Other)?;
        let text = |progress: &Progress| format!("{} of {} pixels", progress.done, progress.of);
        let mapped = run_with(py, progress, text, move |task| scan.map(&store, task))?;
        mapped.raised(py, Exception::Other).map(drop)
    }

    /// Maps the shards of the maps at `path` that are in `places` and not finished, one after
    /// another, and returns the number of their pixels.
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
