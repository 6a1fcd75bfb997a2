//! Report of the recipes that `match` found: text and JSON.

use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::matching::{
    AmountLimit, FilmKind, RecipeMatch, RecipeMatches, RecipeSearch, SpectralTarget,
    SpectrumWeights, ToleranceOrigin,
};
use serde_json::{Map, Value, json};
use spectra::color::{Lab, Rgb, RgbSpace};

use super::illuminant_change::IlluminantChange;
use super::recipe_columns::RecipeColumns;
use crate::console::Console;
use crate::decimals::at_most;
use crate::failure::Result;
use crate::input::srgb;
use crate::shown_color::TableColors;

/// Largest difference at which a target counts as reached, in CIEDE2000 or, by spectrum, in percent of
/// reflectance. Larger differences are clearly visible side by side. Chosen by eye.
const REACHED: f64 = 1.0;

/// Library and settings that all recipes of a run share.
pub(super) struct RecipeReport<'a> {
    pub(super) library: &'a PigmentLibrary,
    pub(super) search: &'a RecipeSearch<'a>,
    /// Mass of the mixture in grams.
    pub(super) grams: Option<f64>,
}

impl RecipeReport<'_> {
    /// Names of the lights, in the order of the options.
    fn lights(&self) -> impl Iterator<Item = &str> {
        self.search.request.conditions.iter().map(|condition| condition.viewing.illuminant.name())
    }

    /// Encoded sRGB of `lab`, seen adapted to its light.
    fn display_color(&self, lab: Lab) -> Rgb {
        // Lab is relative to its white, so any white serves for the round trip.
        let white = RgbSpace::Srgb.white();
        srgb(lab.to_xyz(white), white)
    }

    /// Whether the library holds absolute amounts.
    fn is_absolute(&self) -> bool {
        self.library.amounts == AmountKind::Absolute
    }

    /// Amount of a pigment with the given share: grams, or absolute amounts in the library's unit.
    fn amount(&self, recipe: &RecipeMatch, share: f64) -> Option<f64> {
        match (self.grams, recipe.thickness) {
            (_, Some(thickness)) if self.is_absolute() => Some(share * thickness),
            (grams, _) => grams.map(|grams| share * grams),
        }
    }

    pub(super) fn print(&self, matched: &RecipeMatches, console: &mut Console<'_>) -> Result<()> {
        let target = &matched.target;
        let lab = target.lab[0];
        let rgb = self.display_color(lab);
        let patch = console.patch(rgb);
        let outside = match rgb.in_gamut() {
            true => String::new(),
            false => format!("  {}", RgbSpace::Srgb.outside_note()),
        };
        let [l, a, b] = lab.to_array();
        let light = self.lights().next().unwrap_or_default();
        console
            .line(format!("{patch}{}  Lab {l:.2} {a:.2} {b:.2} ({light}){outside}", target.name))?;
        let (nearest, unit) = (matched.nearest(), self.search.request.metric.unit());
        if nearest > REACHED {
            console.line(format!(
                "out of reach of these pigments: the nearest is {nearest:.2} {unit} away"
            ))?;
        }
        if let Some(measure) = self.spectrum_measure(matched) {
            console.line(format!("     {measure}"))?;
        }
        console.line(format!("     {}", self.equally_near()))?;
        if let Some(free) = matched.beyond_measured() {
            console.line(format!(
                "     amounts stay within those measured; without that limit (--beyond-measured) \
                 the nearest is {free:.2} away instead of {nearest:.2}"
            ))?;
        }
        let columns = RecipeColumns::of(self.lights(), target.spectrum.is_some());
        let mut colors = TableColors::of(RgbSpace::Srgb);
        for line in columns.headings() {
            console.line(line)?;
        }
        for (rank, recipe) in matched.recipes.iter().enumerate() {
            self.print_recipe(&(rank + 1).to_string(), recipe, (&columns, &mut colors), console)?;
        }
        if !matched.by_cie1976.is_empty() {
            console.line("     CIEDE2000 misleads at this distance; the nearest by CIE 1976 is")?;
        }
        for recipe in &matched.by_cie1976 {
            self.print_recipe("", recipe, (&columns, &mut colors), console)?;
        }
        colors.note("     ", console)
    }

    /// The tolerance of the search and its reason.
    fn equally_near(&self) -> String {
        let tolerance = self.search.request.tolerance;
        let reason = match self.search.tolerance_origin {
            ToleranceOrigin::Given => "as --tolerance says",
            ToleranceOrigin::Library => "the mean error of this library's fit",
            ToleranceOrigin::Usual => "the usual tolerance",
        };
        format!(
            "equally near within {} {}, {reason}: the plainest first",
            at_most(tolerance, 3),
            self.search.request.metric.unit()
        )
    }

    /// How differences of spectra are measured, for a search by spectrum.
    fn spectrum_measure(&self, matched: &RecipeMatches) -> Option<String> {
        let weights = match self.search.request.metric.spectrum_weights()? {
            SpectrumWeights::Even => "each wavelength equally",
            SpectrumWeights::Observer => "each wavelength as the observer sees it",
        };
        let [first, last] = matched.target.spectrum.as_ref()?.band_nm();
        Some(format!("by spectrum: rms of reflectance from {first} to {last} nm, {weights}"))
    }

    fn print_recipe(
        &self,
        rank: &str,
        recipe: &RecipeMatch,
        (columns, colors): (&RecipeColumns, &mut TableColors),
        console: &mut Console<'_>,
    ) -> Result<()> {
        let figures = columns.row(recipe);
        let shown = colors.cell(self.display_color(recipe.lab[0]), console);
        let mut line = format!("{rank:>3}  {figures}  {shown}");
        if let Some(thickness) = recipe.thickness {
            let label = if self.is_absolute() { "total" } else { "thickness" };
            line += &format!("  {label} {thickness:.4}");
        }
        if let Some(cost) = recipe.cost {
            line += &format!("  costs {:.2}", cost * self.grams.unwrap_or(1.0));
        }
        console.line(line.trim_end())?;
        for part in self.parts(recipe) {
            console.line(format!("       {part}"))?;
        }
        Ok(())
    }

    /// Returns one line per pigment of a recipe.
    fn parts(&self, recipe: &RecipeMatch) -> Vec<String> {
        let names = recipe.shares.iter().map(|(id, _)| &self.library[*id]);
        let width = names.clone().map(|p| p.name.chars().count()).max().unwrap_or(0);
        let mut lines = Vec::new();
        for (place, ((id, share), pigment)) in recipe.shares.iter().zip(names).enumerate() {
            let mut line = match &recipe.parts {
                Some(parts) => format!("{:4}  {:width$}", parts[place], pigment.name),
                None => format!("{:6.2} %  {:width$}", 100.0 * share, pigment.name),
            };
            match self.amount(recipe, *share) {
                Some(amount) if self.is_absolute() => line += &format!("  {amount:.5}"),
                Some(grams) => line += &format!("  {grams:8.2} g"),
                None => {}
            }
            if pigment.guessed {
                line += "  (guessed, not measured)";
            }
            match recipe.at_limit.iter().find(|(limited, _)| limited == id) {
                Some((_, AmountLimit::Least)) => line += "  (the least that was measured)",
                Some((_, AmountLimit::Greatest)) => line += "  (the most that was measured)",
                None => {}
            }
            lines.push(line.trim_end().to_owned());
        }
        lines
    }

    pub(super) fn json(&self, matched: &RecipeMatches) -> Value {
        let list = |recipes: &[RecipeMatch]| -> Vec<Value> {
            recipes.iter().map(|recipe| self.recipe_json(recipe)).collect()
        };
        let lab = |labs: &[Lab]| self.by_light(labs.iter().map(|lab| json!(lab.to_array())));
        json!({
            "target": matched.target.name,
            "lab": lab(&matched.target.lab),
            "hex": self.display_color(matched.target.lab[0]).to_hex(),
            "in_gamut": self.display_color(matched.target.lab[0]).in_gamut(),
            "reached": matched.nearest() <= REACHED,
            "nearest": matched.nearest(),
            "beyond_measured": matched.beyond_measured(),
            "by": self.search.request.metric.name(),
            "unit": self.search.request.metric.unit(),
            "band_nm": matched.target.spectrum.as_ref().map(SpectralTarget::band_nm),
            "tolerance": self.search.request.tolerance,
            "tolerance_origin": self.search.tolerance_origin.name(),
            "recipes": list(&matched.recipes),
            "by_cie1976": list(&matched.by_cie1976),
        })
    }

    /// One row for each pigment of each recipe.
    pub(super) fn rows(&self, matched: &RecipeMatches) -> Vec<Value> {
        let mut rows = Vec::new();
        for (rank, recipe) in (1..).zip(&matched.recipes) {
            let whole = self.recipe_json(recipe);
            for pigment in whole["pigments"].as_array().into_iter().flatten() {
                let mut row = Map::new();
                row.insert("target".to_owned(), json!(matched.target.name));
                row.insert("recipe".to_owned(), json!(rank));
                row.extend(pigment.as_object().into_iter().flatten().map(|(key, value)| {
                    let key = if key == "name" { "pigment" } else { key };
                    (key.to_owned(), value.clone())
                }));
                for key in ["delta_e", "thickness", "cost", "hex", "distance", "rms_percent"] {
                    row.extend(whole.get(key).map(|value| (key.to_owned(), value.clone())));
                }
                for index in whole["metamerism"].as_array().into_iter().flatten() {
                    let heading = format!("metamerism_{}", index["change"].as_str().unwrap_or(""));
                    row.insert(heading, index["index"].clone());
                }
                rows.push(Value::Object(row));
            }
        }
        rows
    }

    fn recipe_json(&self, recipe: &RecipeMatch) -> Value {
        let pigments = recipe.shares.iter().enumerate().map(|(place, (id, share))| {
            let mut entry = json!({ "name": self.library[*id].name, "share": share });
            if let Some(parts) = &recipe.parts {
                entry["parts"] = json!(parts[place]);
            }
            if let Some(amount) = self.amount(recipe, *share) {
                entry[if self.is_absolute() { "amount" } else { "grams" }] = json!(amount);
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
        let mut entry = json!({
            "pigments": pigments.collect::<Vec<Value>>(),
            "distance": recipe.distance,
            "delta_e": self.by_light(recipe.delta_e.iter().map(|d| json!(d))),
            "lab": self.by_light(recipe.lab.iter().map(|lab| json!(lab.to_array()))),
            "hex": self.display_color(recipe.lab[0]).to_hex(),
            "in_gamut": self.display_color(recipe.lab[0]).in_gamut(),
            "wavelengths_nm": wavelengths,
            "reflectance": recipe.reflectance,
        });
        if let Some(rms) = recipe.rms_percent {
            entry["rms_percent"] = json!(rms);
        }
        if !recipe.metamerism.is_empty() {
            entry["metamerism"] = self.metamerism(recipe);
        }
        if self.search.request.film != FilmKind::Hiding {
            entry["thickness"] = json!(recipe.thickness);
        }
        if let Some(cost) = recipe.cost {
            entry["cost"] = json!(cost * self.grams.unwrap_or(1.0));
        }
        entry
    }

    /// Metamerism indices of a recipe, each with what it is.
    fn metamerism(&self, recipe: &RecipeMatch) -> Value {
        let mut lights = self.lights();
        let reference = lights.next().unwrap_or_default();
        let each = lights.zip(&recipe.metamerism).map(|(test, index)| {
            let change = IlluminantChange { reference, test };
            change.json(*index)
        });
        Value::from(each.collect::<Vec<Value>>())
    }

    /// JSON object with one value per light, keyed by its name.
    fn by_light(&self, values: impl Iterator<Item = Value>) -> Value {
        Value::Object(self.lights().map(str::to_owned).zip(values).collect::<Map<_, _>>())
    }
}
