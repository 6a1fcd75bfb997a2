//! Recipes that were found, as JSON for programs.

use serde_json::{Map, Value, json};
use spectra::color::{Adaptation, Lab, Rgb, RgbSpace};

use super::film::FilmKind;
use super::ranking::{AmountLimit, RecipeMatch};
use super::recipe_search::{RecipeMatches, RecipeSearch};
use super::spectral_target::SpectralTarget;
use crate::illuminant_change::IlluminantChange;
use crate::library::AmountKind;

impl RecipeSearch<'_> {
    /// The result for one target as JSON: the target's name, Lab by light, `hex` and `in_gamut`; `reached`,
    /// `nearest`, `beyond_measured`, measure and tolerance; `recipes` and `by_cie1976`, each as
    /// [`Self::recipe_json`]. With `grams`, the mass of the mixture, recipes tell amounts.
    #[must_use]
    pub fn to_json(&self, matched: &RecipeMatches, grams: Option<f64>) -> Value {
        let list = |recipes: &[RecipeMatch]| -> Vec<Value> {
            recipes.iter().map(|recipe| self.recipe_json(recipe, grams)).collect()
        };
        let target = &matched.target;
        json!({
            "target": target.name,
            "lab": self.by_light(target.lab.iter().map(|lab| json!(lab.to_array()))),
            "hex": displayed(target.lab[0]).to_hex(),
            "in_gamut": displayed(target.lab[0]).in_gamut(),
            "reached": matched.is_reached(),
            "nearest": matched.nearest(),
            "beyond_measured": matched.beyond_measured(),
            "by": self.request.metric.name(),
            "unit": self.request.metric.unit(),
            "band_nm": target.spectrum.as_ref().map(SpectralTarget::band_nm),
            "tolerance": self.request.tolerance,
            "tolerance_origin": self.tolerance_origin.name(),
            "recipes": list(&matched.recipes),
            "by_cie1976": list(&matched.by_cie1976),
        })
    }

    /// One recipe: pigments with their shares, distance, errors and colours by light, reflectance. Only
    /// where they are known: parts, amounts, `rms_percent`, metamerism, thickness, and the cost of `grams`,
    /// or of a unit of mass.
    #[must_use]
    pub fn recipe_json(&self, recipe: &RecipeMatch, grams: Option<f64>) -> Value {
        let amount_key = if self.is_absolute() { "amount" } else { "grams" };
        let pigments = recipe.shares.iter().enumerate().map(|(place, (id, share))| {
            let mut entry = json!({ "name": self.library[*id].name, "share": share });
            if let Some(parts) = &recipe.parts {
                entry["parts"] = json!(parts[place]);
            }
            if let Some(amount) = self.amount(recipe, *share, grams) {
                entry[amount_key] = json!(amount);
            }
            if self.library[*id].guessed {
                entry["guessed"] = json!(true);
            }
            if let Some((_, limit)) = recipe.at_limit.iter().find(|(limited, _)| limited == id) {
                entry["at_limit"] = match limit {
                    AmountLimit::Least => json!("least measured"),
                    AmountLimit::Greatest => json!("greatest measured"),
                };
            }
            entry
        });
        let wavelengths: Vec<f64> = self.library.grid.wavelengths_nm().collect();
        let color = displayed(recipe.lab[0]);
        let mut entry = json!({
            "pigments": pigments.collect::<Vec<Value>>(),
            "distance": recipe.distance,
            "delta_e": self.by_light(recipe.delta_e.iter().map(|d| json!(d))),
            "lab": self.by_light(recipe.lab.iter().map(|lab| json!(lab.to_array()))),
            "hex": color.to_hex(),
            "in_gamut": color.in_gamut(),
            "wavelengths_nm": wavelengths,
            "reflectance": recipe.reflectance,
        });
        if let Some(rms) = recipe.rms_percent {
            entry["rms_percent"] = json!(rms);
        }
        if !recipe.metamerism.is_empty() {
            entry["metamerism"] = self.metamerism(recipe);
        }
        if self.request.film != FilmKind::Hiding {
            entry["thickness"] = json!(recipe.thickness);
        }
        if let Some(cost) = recipe.cost {
            entry["cost"] = json!(cost * grams.unwrap_or(1.0));
        }
        entry
    }

    /// Amount of a pigment with the given share: grams of a mixture of `grams`, or absolute amounts in the
    /// library's unit. `None` where neither is known.
    #[must_use]
    pub fn amount(&self, recipe: &RecipeMatch, share: f64, grams: Option<f64>) -> Option<f64> {
        match (grams, recipe.thickness) {
            (_, Some(thickness)) if self.is_absolute() => Some(share * thickness),
            (grams, _) => grams.map(|grams| share * grams),
        }
    }

    /// Names of the lights, in the order of the request.
    pub fn lights(&self) -> impl Iterator<Item = &str> {
        self.request.conditions.iter().map(|condition| condition.viewing.illuminant.name())
    }

    fn is_absolute(&self) -> bool {
        self.library.amounts == AmountKind::Absolute
    }

    /// Metamerism indices of a recipe, each with what it is.
    fn metamerism(&self, recipe: &RecipeMatch) -> Value {
        let mut lights = self.lights();
        let reference = lights.next().unwrap_or_default();
        let each = lights.zip(&recipe.metamerism).map(|(test, index)| {
            let change = IlluminantChange { reference, test };
            change.to_json(*index)
        });
        Value::from(each.collect::<Vec<Value>>())
    }

    /// JSON object with one value per light, keyed by its name.
    fn by_light(&self, values: impl Iterator<Item = Value>) -> Value {
        Value::Object(self.lights().map(str::to_owned).zip(values).collect::<Map<_, _>>())
    }
}

/// Encoded sRGB of `lab`, seen adapted to its light.
fn displayed(lab: Lab) -> Rgb {
    // Lab is relative to its white, so any white serves for the round trip.
    let white = RgbSpace::Srgb.white();
    RgbSpace::Srgb.encoded_from_xyz(lab.to_xyz(white), white, Adaptation::Bradford)
}
