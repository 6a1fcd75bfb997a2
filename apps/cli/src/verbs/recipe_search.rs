//! `impasto match`: finds recipes for a target colour or spectrum, and prints them as text or rows. The
//! table of recipes has columns for differences under each light, metamerism and reflectance.

use std::path::Path;

use calibrate::IlluminantChange;
use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::matching::{
    AmountLimit, MatchRequest, Metric, RecipeMatch, RecipeMatches, RecipeSearch, RequiredName,
    SpectrumWeights, ToleranceOrigin, parse_share,
};
use clap::{Arg, Args};
use documents::{Task, column_width};
use serde_json::{Map, Value, json};
use spectra::color::{Lab, Rgb, RgbSpace};

use crate::console::Console;
use crate::csv_rows::{self, TableColors, at_most};
use crate::failure::{Failure, Result};
use crate::library_choice::{ChosenLibrary, chosen, split};
use crate::progress::Progress;
use crate::readings::{ReadingOptions, TargetOptions, condition, prices, srgb, targets};
use crate::request_options::{CommandLine, RequestOptions, without_value};
use crate::surface::ground;

/// Find recipes for a colour or a measured spectrum
///
/// Every set of up to --at-most pigments is tried, and its shares are found by least squares in
/// CIEDE2000, or in the difference of reflectance with --by spectrum. A target is `#rrggbb`, a CIELAB
/// colour `L,a,b` (under the first light), or a file: FILE for all of it but bare cards, FILE#NAME for one.
/// Files hold spectra or named colours: .ase, .aco, .gpl, or a table of names with L, a, b, with X, Y, Z or
/// with codes. FILE#3 is the third colour. Recipes within --tolerance of the nearest one count as equally near: they are
/// sorted by cost if costs are given, else by the number of pigments. The others follow by distance.
#[derive(Debug, Args)]
#[command(
    override_usage = "impasto match [OPTIONS] [LIBRARY] <TARGET>...",
    mut_arg("white_reading", |option| option.alias("white"))
)]
pub(crate) struct Match {
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship], then target colours, one or more
    #[arg(required = true, value_name = "[LIBRARY] TARGET", allow_negative_numbers = true)]
    words: Vec<String>,
    #[command(flatten)]
    request: RequestOptions<MatchRequest>,
    /// Light, as in `color`, with its weight where there are several (may be repeated) [default: D65;
    /// with --by spectrum D65, A and FL11, used only to print differences]
    #[arg(long, value_name = "LIGHT[=WEIGHT]")]
    illuminant: Vec<String>,
    /// Observer: 1931-2 (or 2), 1964-10 (or 10), 2015-2, 2015-10
    #[arg(long, value_name = "NAME", default_value = "1931-2")]
    observer: String,
    #[command(flatten)]
    target: TargetOptions,
    #[command(flatten)]
    reading: ReadingOptions,
    /// Print JSON: a list of targets, each with its recipes
    #[arg(long)]
    json: bool,
    /// Print the recipes as CSV, a row for each pigment of each recipe
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl CommandLine for MatchRequest {
    fn adapted(key: &str, option: Arg) -> Arg {
        match key {
            "by" => without_value(option, Metric::Cie1976.name()),
            "only" | "without" => option.value_name("PIGMENT"),
            "with" => option.value_name("PIGMENT[=SHARE]"),
            "at_most" => option.value_name("K"),
            "least_share" => option.long("least").value_name("SHARE"),
            "balance" => option.value_name("GRAMS"),
            "whole_parts" => option.long("parts").value_name("N"),
            "prices" => option.long("cost").value_name("PRICE"),
            "tolerance" => option.value_name("DIFFERENCE"),
            "count" => option.value_name("N"),
            "thickness" => option.value_name("T"),
            "over" => option.value_name("GROUND"),
            _ => option,
        }
    }
}

impl Match {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let (path, texts) = split(&self.words, true);
        let ChosenLibrary { library, .. } = chosen(path.as_deref(), console)?;
        if texts.is_empty() {
            return Err(Failure::usage(
                "no target colour is given",
                "add one, such as \"#4a7d8c\", 52,-10.5,8, swatches.csv#NAME or book.ase",
            ));
        }
        check_words(path.as_deref(), texts)?;
        let options = self.options(&library, console)?;
        let search = library.recipe_search(&options)?;
        console.remarks(&search.remarks)?;
        let mut all_targets = Vec::new();
        for text in texts {
            all_targets.extend(targets(text, &self.target, &self.reading, console)?);
        }
        let report = RecipeReport { library: &library, search: &search, grams: options.grams };
        let progress = Progress::new(all_targets.len(), "matching", console.shows_progress());
        let mut found = Vec::new();
        for target in &all_targets {
            found.push(search.recipes_for(target, &Task::default())?);
            progress.step();
        }
        progress.done();
        if self.csv {
            let rows: Vec<Value> = found.iter().flat_map(|matches| report.rows(matches)).collect();
            return console.csv_rows(&rows);
        }
        if self.json {
            let list: Vec<Value> =
                found.iter().map(|one| search.to_json(one, options.grams)).collect();
            return console.json(&Value::from(list));
        }
        for (index, matches) in found.iter().enumerate() {
            if index > 0 {
                console.line("")?;
            }
            report.print(matches, console)?;
        }
        Ok(())
    }

    /// Options of the search; reads the files that they name.
    fn options(&self, library: &PigmentLibrary, console: &mut Console<'_>) -> Result<MatchRequest> {
        let mut request = self.request.clone();
        let with = request.take("with");
        let costs = request.take("prices");
        let over = request.take("over");
        let request = request.request()?;
        if let Some(grams) = request.grams.filter(|grams| !(*grams > 0.0 && *grams < 1e9)) {
            return Err(Failure::usage(
                format!("--grams must be above 0, found `{grams}`"),
                "try --grams 40",
            ));
        }
        if request.grams.is_some() && library.amounts == AmountKind::Absolute {
            return Err(Failure::usage(
                "--grams divides a mass by shares, but this library's amounts are absolute",
                "leave it out: the recipe gives each amount on the library's area",
            ));
        }
        let usual: &[&str] = match (self.illuminant.is_empty(), request.metric) {
            (false, _) => &[],
            (true, Metric::Spectrum(_)) => &["D65", "A", "FL11"],
            (true, Metric::Ciede2000 | Metric::Cie1976) => &["D65"],
        };
        let lights = self.illuminant.iter().map(String::as_str).chain(usual.iter().copied());
        let conditions = lights.map(|text| condition(text, &self.observer, console));
        let with = with.iter().map(|text| required(text, library));
        Ok(MatchRequest {
            conditions: conditions.collect::<Result<_>>()?,
            over: over.first().map(|text| ground(text, console)).transpose()?,
            with: with.collect::<Result<_>>()?,
            prices: prices(&costs)?,
            ..request
        })
    }
}

/// Refuses targets that are words of another place: a library, or the parts of one CIELAB colour.
fn check_words(library: Option<&Path>, texts: &[String]) -> Result<()> {
    let is_json = |text: &&String| text.ends_with(".json") && Path::new(text.as_str()).is_file();
    if let (None, Some(later)) = (library, texts.iter().find(is_json)) {
        return Err(Failure::usage(
            format!("{later} stands behind a target"),
            format!("the library goes first: impasto match {later} \"{}\"", texts[0]),
        ));
    }
    let numbers = texts.iter().filter(|text| text.parse::<f64>().is_ok()).count();
    if texts.len() == 3 && numbers == 3 {
        return Err(Failure::usage(
            format!("a CIELAB colour is one word, found `{}`", texts.join(" ")),
            format!("write {}", texts.join(",")),
        ));
    }
    Ok(())
}

/// Parses `PIGMENT` or `PIGMENT=SHARE`.
fn required(text: &str, library: &PigmentLibrary) -> Result<RequiredName> {
    // The name of a pigment may contain an equals sign.
    let (name, fixed) = match text.rsplit_once('=') {
        Some((name, fixed)) if library.find(text).is_err() => (name, Some(fixed)),
        _ => (text, None),
    };
    let share = fixed.map(|fixed| parse_share(fixed, "with")).transpose();
    let share =
        share.map_err(|error| Failure::of_request(&error.at("with"), |_| "--with".into()))?;
    Ok(RequiredName { name: name.to_owned(), share })
}

/// Library and settings that all recipes of a run share.
pub(super) struct RecipeReport<'a> {
    pub(super) library: &'a PigmentLibrary,
    pub(super) search: &'a RecipeSearch<'a>,
    /// Mass of the mixture in grams.
    pub(super) grams: Option<f64>,
}

impl RecipeReport<'_> {
    /// Encoded sRGB of `lab`, as seen by an eye that is adapted to its light.
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
        let lab = csv_rows::lab(lab);
        console.line(format!("{patch}{}  Lab {lab} ({light}){outside}", target.name))?;
        let nearest = matched.nearest();
        let unit = self.search.limits.metric.unit();
        let least = 100.0 * self.search.limits.least_share;
        if matched.is_reached_below_least() {
            console.line(format!(
                "reached only with shares below {least} %: with these the nearest is {nearest:.2} {unit} away"
            ))?;
        } else if let ([smaller], false) = (&matched.below_least[..], matched.is_reached()) {
            console.line(format!(
                "out of reach of these pigments: the nearest is {:.2} {unit} away, and with shares of \
                 {least} % or more {nearest:.2}",
                smaller.distance
            ))?;
        } else if !matched.is_reached() {
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
        if !matched.below_least.is_empty() {
            console.line(format!("     nearer with shares below {least} % (--least) is"))?;
        }
        for recipe in &matched.below_least {
            self.print_recipe("", recipe, (&columns, &mut colors), console)?;
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
        let tolerance = self.search.limits.tolerance;
        let reason = match self.search.tolerance_origin {
            ToleranceOrigin::Given => "as --tolerance says",
            ToleranceOrigin::Library => "the mean error of this library's fit",
            ToleranceOrigin::Usual => "the usual tolerance",
        };
        format!(
            "equally near within {} {}, {reason}: the plainest first",
            at_most(tolerance, 3),
            self.search.limits.metric.unit()
        )
    }

    /// How differences of spectra are measured, for a search by spectrum.
    fn spectrum_measure(&self, matched: &RecipeMatches) -> Option<String> {
        let weights = match self.search.limits.metric.spectrum_weights()? {
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
        let width = column_width(names.clone().map(|p| &p.name), 0);
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

/// Least width of a column.
const WIDTH: usize = 8;
/// Gap between columns of metamerism indices, because their headings have several words.
const GAP: &str = "  ";
/// Title and headings of the difference of reflectance.
const REFLECTANCE: [&str; 2] = ["reflectance", "rms, %"];

/// Names in columns of the least width.
fn joined(names: &[String], gap: &str) -> String {
    let each: Vec<String> = names.iter().map(|name| format!("{name:>WIDTH$}")).collect();
    each.join(gap)
}

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
            let width = column_width([&below], title.len());
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
            let width = column_width([name], WIDTH);
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
