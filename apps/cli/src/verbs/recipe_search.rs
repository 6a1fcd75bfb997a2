//! `impasto match`: finds recipes for a target colour or spectrum.

use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::matching::{MatchOptions, RequiredName, Thickness};
use clap::Args;
use serde_json::Value;

use super::match_by::MatchBy;
use super::recipe_report::RecipeReport;
use crate::console::Console;
use crate::costs::prices;
use crate::failure::{Failure, Result};
use crate::ground::ground;
use crate::input::condition;
use crate::library_choice::{ChosenLibrary, chosen, split};
use crate::progress::Progress;
use crate::readings::ReadingOptions;
use crate::targets::targets;

/// Find recipes for a colour or a measured spectrum
///
/// Every set of up to --at-most pigments is tried, and its shares are found by least squares in
/// CIEDE2000, or in the difference of reflectance with --by spectrum. A target is `#rrggbb`, a CIELAB colour `L,a,b` (under the first light), or a file of
/// spectra: FILE for all of them but bare cards, FILE#SAMPLE for one. Recipes that are as near as the
/// nearest, within --tolerance, are sorted by cost if costs are given, else by the number of
/// pigments; the others follow by distance.
#[derive(Debug, Args)]
#[command(
    override_usage = "impasto match [OPTIONS] [LIBRARY] <TARGET>...",
    mut_arg("white_reading", |option| option.alias("white"))
)]
pub(crate) struct Match {
    /// The pigment library (JSON) [default: that of IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship], then target colours, one or more
    #[arg(required = true, value_name = "[LIBRARY] TARGET")]
    words: Vec<String>,
    /// Match the color under the lights, or the spectrum of a measured target
    #[arg(long, value_enum, default_value = "color")]
    by: MatchBy,
    /// Use only these pigments (may be repeated) [default: all whose S is known]
    #[arg(long, value_name = "PIGMENT")]
    only: Vec<String>,
    /// A pigment that every recipe must contain, with a share if that is fixed (may be repeated)
    #[arg(long, value_name = "PIGMENT[=SHARE]")]
    with: Vec<String>,
    /// A pigment that no recipe may contain (may be repeated)
    #[arg(long, value_name = "PIGMENT")]
    without: Vec<String>,
    /// Maximum number of pigments of a recipe, 1 to 8
    #[arg(long, value_name = "K", default_value_t = 4)]
    at_most: usize,
    /// Minimum share of each pigment of a recipe, such as 0.02 or 1/50, about the least that a
    /// palette knife can cut off
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true, default_value = "1/50")]
    least: String,
    /// Give recipes in whole parts whose sum is at most N
    #[arg(long, value_name = "N")]
    parts: Option<u32>,
    /// Total mass of the mixture in grams; amounts are then by mass
    #[arg(long, value_name = "GRAMS", allow_hyphen_values = true)]
    grams: Option<f64>,
    /// Price of one gram (or one unit of absolute amounts), NAME=PRICE, in any currency (may be
    /// repeated), or a CSV with the columns pigment and price
    #[arg(long, value_name = "PRICE")]
    cost: Vec<String>,
    /// Difference within which recipes count as equally near, in CIEDE2000 [default: the mean error of
    /// the library's fit, or 0.05 if it records none]; by spectrum in % of reflectance [default: 0.2]
    #[arg(long, value_name = "DIFFERENCE", allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// Allow absolute amounts outside the range that was measured of each pigment
    #[arg(long)]
    beyond_measured: bool,
    /// Number of recipes to show for each target
    #[arg(long, value_name = "N", default_value_t = 5)]
    count: usize,
    /// Thickness of the film, or LEAST:MOST to let the search choose; 1 is where the reference white
    /// has S d = 1 (for absolute amounts, all amounts together) [default: hiding; for absolute
    /// amounts from nearly clear to nearly hiding]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    thickness: Option<String>,
    /// Measured reflectance of the ground, as in `mix` [default: white]
    #[arg(long, value_name = "GROUND", allow_hyphen_values = true)]
    over: Option<String>,
    /// Light, as in `color`, with its weight where there are several (may be repeated) [default: D65;
    /// by spectrum, where lights only tell the differences, D65, A and FL11]
    #[arg(long, value_name = "LIGHT[=WEIGHT]")]
    illuminant: Vec<String>,
    /// Observer: 1931-2 (or 2), 1964-10 (or 10), 2015-2, 2015-10
    #[arg(long, value_name = "NAME", default_value = "1931-2")]
    observer: String,
    #[command(flatten)]
    reading: ReadingOptions,
    /// Print JSON: a list of targets, each with its recipes
    #[arg(long)]
    json: bool,
    /// Print the recipes, a row for each pigment of one, as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Match {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let (path, texts) = split(&self.words, true);
        let ChosenLibrary { library, .. } = chosen(path.as_deref(), console)?;
        if texts.is_empty() {
            return Err(Failure::usage(
                "no target colour is given",
                "add one, such as \"#4a7d8c\", 52,-10.5,8 or swatches.csv#NAME",
            ));
        }
        let options = self.options(&library, console)?;
        let search = library.recipe_search(&options)?;
        console.remarks(&search.remarks)?;
        let mut all_targets = Vec::new();
        for text in texts {
            all_targets.extend(targets(text, &self.reading, console)?);
        }
        let report = RecipeReport { library: &library, search: &search, grams: self.grams };
        let progress = Progress::new(all_targets.len(), "matching", console.shows_progress());
        let mut found = Vec::new();
        for target in &all_targets {
            found.push(search.recipes_for(target)?);
            progress.step();
        }
        progress.done();
        if self.csv {
            let rows: Vec<Value> = found.iter().flat_map(|matches| report.rows(matches)).collect();
            return console.csv_rows(&rows);
        }
        if self.json {
            let list: Vec<Value> =
                found.iter().map(|one| search.to_json(one, self.grams)).collect();
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
    fn options(&self, library: &PigmentLibrary, console: &mut Console<'_>) -> Result<MatchOptions> {
        if let Some(grams) = self.grams.filter(|grams| !(*grams > 0.0 && *grams < 1e9)) {
            return Err(Failure::usage(
                format!("--grams must be above 0, found `{grams}`"),
                "try --grams 40",
            ));
        }
        if self.grams.is_some() && library.amounts == AmountKind::Absolute {
            return Err(Failure::usage(
                "--grams shares out a mixture, but this library's amounts are absolute",
                "leave it out: the recipe gives each amount on the library's area",
            ));
        }
        let usual: &[&str] = match (self.illuminant.is_empty(), self.by) {
            (false, _) => &[],
            (true, MatchBy::Color) => &["D65"],
            (true, MatchBy::Spectrum | MatchBy::WeightedSpectrum) => &["D65", "A", "FL11"],
        };
        let lights = self.illuminant.iter().map(String::as_str).chain(usual.iter().copied());
        let conditions = lights.map(|text| condition(text, &self.observer));
        let with = self.with.iter().map(|text| required(text, library));
        Ok(MatchOptions {
            metric: self.by.metric(),
            conditions: conditions.collect::<Result<_>>()?,
            thickness: self.thickness.as_deref().map(thickness).transpose()?,
            over: self.over.as_deref().map(|text| ground(text, console)).transpose()?,
            only: self.only.clone(),
            with: with.collect::<Result<_>>()?,
            without: self.without.clone(),
            at_most: self.at_most,
            least_share: share("--least", &self.least)?,
            whole_parts: self.parts,
            prices: prices(&self.cost)?,
            tolerance: self.tolerance,
            beyond_measured: self.beyond_measured,
            count: self.count,
        })
    }
}

/// Parses a thickness `T` or `LEAST:MOST`.
fn thickness(text: &str) -> Result<Thickness> {
    let number = |text: &str| text.parse::<f64>().ok().filter(|t| *t > 0.0 && *t <= 1e9);
    let thickness = match text.split_once(':') {
        Some((least, most)) => number(least)
            .zip(number(most))
            .filter(|(least, most)| least < most)
            .map(|(least, most)| Thickness::Between(least, most)),
        None => number(text).map(Thickness::Fixed),
    };
    thickness.ok_or_else(|| {
        Failure::usage(
            format!("--thickness takes T or LEAST:MOST, above 0 and up to 1e9, found `{text}`"),
            "try --thickness 1 or --thickness 0.2:3",
        )
    })
}

/// Parses `PIGMENT` or `PIGMENT=SHARE`.
fn required(text: &str, library: &PigmentLibrary) -> Result<RequiredName> {
    // The name of a pigment may contain an equals sign.
    let (name, fixed) = match text.rsplit_once('=') {
        Some((name, fixed)) if library.find(text).is_err() => (name, Some(fixed)),
        _ => (text, None),
    };
    let share = fixed.map(|fixed| share("--with", fixed)).transpose()?;
    Ok(RequiredName { name: name.to_owned(), share })
}

/// Parses a share from 0 to 1, written as a number or as a fraction such as 1/50.
fn share(option: &str, text: &str) -> Result<f64> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let value = match text.split_once('/') {
        Some((numerator, denominator)) => {
            number(numerator).zip(number(denominator)).map(|(n, d)| n / d)
        }
        None => number(text),
    };
    value.filter(|value| (0.0..=1.0).contains(value)).ok_or_else(|| {
        Failure::usage(
            format!("{option} takes a share from 0 to 1, found `{text}`"),
            format!(
                "try {option} {}0.25 or a fraction such as 1/4",
                if option == "--with" { "NAME=" } else { "" }
            ),
        )
    })
}
