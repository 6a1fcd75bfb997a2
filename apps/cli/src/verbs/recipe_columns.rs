//! Columns of figures in the table of recipes: differences under each light, metamerism, reflectance.

use calibrate::IlluminantChange;
use calibrate::matching::RecipeMatch;

/// Least width of a column.
const WIDTH: usize = 8;
/// Between the indices, whose headings are several words.
const GAP: &str = "  ";
/// Title and headings of the difference of reflectance.
const REFLECTANCE: [&str; 2] = ["reflectance", "rms, %"];

/// Headings and widths of the figures of a recipe.
#[derive(Debug)]
pub(super) struct RecipeColumns {
    /// Names of the lights, in the order of the options.
    lights: Vec<String>,
    /// Changes of light that have a metamerism index.
    changes: Vec<String>,
    /// Whether the target was measured, so that spectra are compared.
    is_measured: bool,
}

impl RecipeColumns {
    pub(super) fn of<'a>(lights: impl Iterator<Item = &'a str>, is_measured: bool) -> Self {
        let lights: Vec<String> = lights.map(str::to_owned).collect();
        let later = if is_measured { &lights[1..] } else { &[] };
        let changes = later.iter().map(|test| {
            let change = IlluminantChange { reference: &lights[0], test };
            change.heading()
        });
        Self { changes: changes.collect(), lights, is_measured }
    }

    /// Lines above the recipes.
    pub(super) fn headings(&self) -> Vec<String> {
        let joined = |names: &[String], gap: &str| -> String {
            let each: Vec<String> = names.iter().map(|name| format!("{name:>WIDTH$}")).collect();
            each.join(gap)
        };
        let lights = joined(&self.lights, " ");
        if !self.is_measured {
            return vec![format!("     {lights}  (CIEDE2000)")];
        }
        let mut groups = vec![("CIEDE2000", lights)];
        if !self.changes.is_empty() {
            groups.push(("metamerism", joined(&self.changes, GAP)));
        }
        let [title, rms] = REFLECTANCE;
        groups.push((title, rms.to_owned()));
        let mut lines = [String::from("   "), String::from("   ")];
        for (title, below) in groups {
            let width = title.len().max(below.chars().count());
            lines[0] += &format!("  {title:>width$}");
            lines[1] += &format!("  {below:>width$}");
        }
        let legend =
            (!self.changes.is_empty()).then(|| format!("     {}", IlluminantChange::LEGEND));
        legend.into_iter().chain(lines).collect()
    }

    /// Figures of a recipe below the headings.
    pub(super) fn row(&self, recipe: &RecipeMatch) -> String {
        // As wide as the light's name, which may be the path of a lamp's file.
        let cell = |(value, name): (Option<f64>, &String)| {
            let width = name.chars().count().max(WIDTH);
            value.map_or_else(|| format!("{:>width$}", "-"), |value| format!("{value:width$.2}"))
        };
        let delta_e = recipe.delta_e.iter().copied().map(Some).zip(&self.lights);
        let delta_e = delta_e.map(cell).collect::<Vec<String>>().join(" ");
        let Some(rms) = recipe.rms_percent.filter(|_| self.is_measured) else { return delta_e };
        let mut line = format!("{delta_e:>width$}", width = "CIEDE2000".len());
        if !self.changes.is_empty() {
            let indices = recipe.metamerism.iter().copied().zip(&self.changes);
            let indices = indices.map(cell).collect::<Vec<String>>().join(GAP);
            line += &format!("  {indices:>width$}", width = "metamerism".len());
        }
        line + &format!("  {rms:width$.2}", width = REFLECTANCE[0].len())
    }
}
