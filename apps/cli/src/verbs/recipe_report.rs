//! Report of the recipes that `match` found: text and rows.

use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::matching::{
    AmountLimit, RecipeMatch, RecipeMatches, RecipeSearch, SpectrumWeights, ToleranceOrigin,
};
use serde_json::{Map, Value, json};
use spectra::color::{Lab, Rgb, RgbSpace};

use super::recipe_columns::RecipeColumns;
use crate::console::Console;
use crate::decimals::{self, at_most};
use crate::failure::Result;
use crate::input::srgb;
use crate::shown_color::TableColors;

/// Library and settings that all recipes of a run share.
pub(super) struct RecipeReport<'a> {
    pub(super) library: &'a PigmentLibrary,
    pub(super) search: &'a RecipeSearch<'a>,
    /// Mass of the mixture in grams.
    pub(super) grams: Option<f64>,
}

impl RecipeReport<'_> {
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

    pub(super) fn print(&self, matched: &RecipeMatches, console: &mut Console<'_>) -> Result<()> {
        let target = &matched.target;
        let lab = target.lab[0];
        let rgb = self.display_color(lab);
        let patch = console.patch(rgb);
        let outside = match rgb.in_gamut() {
            true => String::new(),
            false => format!("  {}", RgbSpace::Srgb.outside_note()),
        };
        let light = self.search.lights().next().unwrap_or_default();
        let lab = decimals::lab(lab);
        console.line(format!("{patch}{}  Lab {lab} ({light}){outside}", target.name))?;
        let nearest = matched.nearest();
        let unit = self.search.request.metric.unit();
        if !matched.is_reached() {
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
        let columns = RecipeColumns::of(self.search.lights(), target.spectrum.is_some());
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
            match self.search.amount(recipe, *share, self.grams) {
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

    /// One row for each pigment of each recipe.
    pub(super) fn rows(&self, matched: &RecipeMatches) -> Vec<Value> {
        let mut rows = Vec::new();
        for (rank, recipe) in (1..).zip(&matched.recipes) {
            let whole = self.search.recipe_json(recipe, self.grams);
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
}
