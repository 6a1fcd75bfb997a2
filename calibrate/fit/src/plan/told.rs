//! A plan as JSON for programs.

use pigment::PigmentId;
use serde_json::{Map, Value, json};

use super::information::RelativeDeviation;
use super::planned::{Forecast, Plan, PlannedSwatch};

impl Plan {
    /// The plan as JSON: `swatches` (sample, purpose, parts, grams, why), `totals_g` by paint, the
    /// `unknowns` of a wavelength, `identified`, and the forecast of the `prior` library, null without one.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let swatches: Vec<Value> = self.swatches.iter().map(|s| self.swatch_json(s)).collect();
        // Removes the floating-point error of a sum of balance steps.
        let rounded = |total: f64| (1e6 * total).round() / 1e6;
        let totals = self.paints.ids().zip(self.totals_g());
        let totals = totals.map(|(paint, total)| (self.name(paint), json!(rounded(total))));
        json!({
            "swatches": swatches,
            "totals_g": totals.collect::<Map<String, Value>>(),
            "unknowns": self.paints.unknowns(),
            "identified": true,
            "prior": self.forecast.as_ref().map(|forecast| self.forecast_json(forecast)),
        })
    }

    fn name(&self, paint: PigmentId) -> String {
        self.paints.name(paint).to_owned()
    }

    fn swatch_json(&self, swatch: &PlannedSwatch) -> Value {
        let parts = swatch.recipe.parts.iter();
        let parts = parts.map(|&(paint, parts)| (self.name(paint), json!(parts)));
        let grams = swatch.grams.iter();
        let grams = grams.map(|&(paint, grams)| (self.name(paint), json!(grams)));
        json!({
            "sample": swatch.name,
            "purpose": swatch.recipe.purpose.word(),
            "parts": parts.collect::<Map<String, Value>>(),
            "grams": grams.collect::<Map<String, Value>>(),
            "why": swatch.recipe.purpose.why(),
        })
    }

    fn forecast_json(&self, forecast: &Forecast) -> Value {
        let of = |deviations: &[RelativeDeviation]| -> Map<String, Value> {
            let pairs = self.paints.ids().zip(deviations).map(|(paint, deviation)| {
                let pair = json!({
                    "absorption": deviation.absorption,
                    "scattering": deviation.scattering,
                });
                (self.name(paint), pair)
            });
            pairs.collect()
        };
        json!({
            "usual_efficiency": forecast.usual_efficiency,
            "noise": {"constant": forecast.noise.constant, "even": forecast.noise.even},
            "relative_deviations": of(&forecast.deviations),
            "usual_relative_deviations": of(&forecast.usual_deviations),
        })
    }
}
