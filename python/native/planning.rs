//! Plans of swatches.

use calibrate::fit::ExpectedNoise;
use calibrate::plan::{
    Forecast, MeasurementForm, Plan, PlanOptions, RelativeDeviation, plan_until,
};
use calibrate::{PigmentId, PigmentLibrary, Recipe};
use pyo3::prelude::*;
use serde_json::{Map, Value, json};

use crate::arrays::{GridNumbers, grid};
use crate::failure::{Exception, Raised};
use crate::json::{RemarkTuple, remarks};
use crate::library::Library;
use crate::running::run;

/// Options of a plan, as the public face passes them.
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

/// Plans swatches. Returns JSON (swatches, totals_g, prior), the measurement form as bytes, and remarks.
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
    let planned = run(py, None, move |reporter| {
        plan_until(&pigments, &white, &chosen, reporter.cancellation())
    })?;
    let planned = planned.raised(py, Exception::Fit)?;
    Ok((json(&planned).to_string(), planned.form(&form), remarks(&planned.remarks)))
}

fn json(plan: &Plan) -> Value {
    let name = |paint: PigmentId| plan.paints.name(paint).to_owned();
    let swatches = plan.swatches.iter().map(|swatch| {
        let parts = swatch.recipe.parts.iter().map(|&(id, parts)| (name(id), json!(parts)));
        let grams = |recipe: &Recipe| -> Map<String, Value> {
            recipe.iter().map(|&(id, grams)| (name(id), json!(grams))).collect()
        };
        json!({
            "sample": swatch.name, "purpose": swatch.recipe.purpose.word(),
            "parts": parts.collect::<Map<_, _>>(), "grams": grams(&swatch.grams),
            "why": swatch.recipe.purpose.why(),
        })
    });
    let swatches: Vec<Value> = swatches.collect();
    // Removes the floating-point error of a sum of balance steps.
    let rounded = |total: f64| json!((1e6 * total).round() / 1e6);
    let totals = plan.paints.ids().zip(plan.totals_g());
    let totals: Map<_, _> = totals.map(|(id, total)| (name(id), rounded(total))).collect();
    json!({
        "swatches": swatches,
        "totals_g": totals,
        "prior": plan.forecast.as_ref().map(|forecast| forecast_json(plan, forecast)),
    })
}

fn forecast_json(plan: &Plan, forecast: &Forecast) -> Value {
    let by_paint = |deviations: &[RelativeDeviation]| -> Map<String, Value> {
        let pairs = plan.paints.ids().zip(deviations);
        let pair = |d: &RelativeDeviation| json!({ "absorption": d.absorption, "scattering": d.scattering });
        pairs.map(|(id, d)| (plan.paints.name(id).to_owned(), pair(d))).collect()
    };
    json!({
        "usual_efficiency": forecast.usual_efficiency,
        "relative_sd": by_paint(&forecast.deviations),
        "usual_relative_sd": by_paint(&forecast.usual_deviations),
        "noise": [forecast.noise.constant, forecast.noise.even],
    })
}
