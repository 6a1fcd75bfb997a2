//! Recipes for target colours.

use std::sync::Arc;

use calibrate::Viewing;
use calibrate::library::PigmentLibrary;
use calibrate::matching::{
    ColorTarget, MatchOptions, Metric, PriceList, RequiredName, SpectrumWeights, Thickness,
    ViewingCondition,
};
use documents::hint::Fault;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use spectra::Observer;

use crate::arrays::{GridNumbers, reflectance};
use crate::failure::{Exception, Raised};
use crate::json::{RemarkTuple, remarks};
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

/// Options of a search, as the public Python functions pass them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options<'py> {
    by: String,
    lights: Vec<(PyRef<'py, Light>, f64)>,
    observer: String,
    thickness: Option<(f64, f64)>,
    over: Option<Ground<'py>>,
    only: Vec<String>,
    with: Vec<(String, Option<f64>)>,
    without: Vec<String>,
    at_most: usize,
    least_share: f64,
    whole_parts: Option<u32>,
    prices: Vec<(String, f64)>,
    tolerance: Option<f64>,
    beyond_measured: bool,
    count: usize,
}

impl Options<'_> {
    fn options(&self, py: Python<'_>) -> PyResult<MatchOptions> {
        let observer = Observer::named(&self.observer).raised(py, Exception::Other)?;
        let condition = |(light, weight): &(PyRef<'_, Light>, f64)| ViewingCondition {
            viewing: Viewing { illuminant: light.0.clone(), observer },
            weight: *weight,
        };
        let mut prices = PriceList::default();
        for (pigment, price) in &self.prices {
            prices.set(pigment, *price).raised(py, Exception::Recipe)?;
        }
        Ok(MatchOptions {
            metric: metric(py, &self.by)?,
            conditions: self.lights.iter().map(condition).collect(),
            thickness: self.thickness.map(|(least, most)| {
                if least == most {
                    Thickness::Fixed(least)
                } else {
                    Thickness::Between(least, most)
                }
            }),
            over: self.over.as_ref().map(|ground| ground.backing(py)).transpose()?,
            only: self.only.clone(),
            with: self
                .with
                .iter()
                .map(|(name, share): &(String, Option<f64>)| RequiredName {
                    name: name.clone(),
                    share: *share,
                })
                .collect(),
            without: self.without.clone(),
            at_most: self.at_most,
            least_share: self.least_share,
            whole_parts: self.whole_parts,
            prices,
            tolerance: self.tolerance,
            beyond_measured: self.beyond_measured,
            count: self.count,
        })
    }
}

fn metric(py: Python<'_>, name: &str) -> PyResult<Metric> {
    let known = [
        Metric::Ciede2000,
        Metric::Cie1976,
        Metric::Spectrum(SpectrumWeights::Even),
        Metric::Spectrum(SpectrumWeights::Observer),
    ];
    known.into_iter().find(|metric| metric.name() == name).ok_or_else(|| {
        let names = known.map(Metric::name).join(", ");
        let message = format!("unknown measure `{name}`");
        Exception::Recipe.with(
            py,
            Fault::Setting,
            &message,
            Some(&format!("`by` is one of {names}")),
        )
    })
}

/// Searches recipes for each target. Returns one JSON object a target, with the keys of
/// `impasto match --json`, and remarks.
#[pyfunction]
pub(crate) fn recipes_for(
    py: Python<'_>,
    library: &Library,
    targets: Vec<Target<'_>>,
    options: Options<'_>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<(String, Vec<RemarkTuple>)>> {
    let options = options.options(py)?;
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
