//! `impasto match`: a target colour or spectrum to recipes.

use std::path::PathBuf;

use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::matching::{FilmKind, MatchRequest, Metric, Sight, Target, Thickness, recipes};
use clap::Args;
use serde_json::Value;

use super::recipe_report::{Matched, Sheet};
use crate::console::Console;
use crate::costs::costs;
use crate::failure::Refusal;
use crate::ground::ground;
use crate::input::{color_weights, library, viewing};
use crate::progress::Progress;
use crate::readings::ReadingOptions;
use crate::targets::targets;

/// Find recipes for a colour or a measured spectrum
///
/// Every set of up to --at-most pigments is tried, and the shares of each found by least squares in
/// CIEDE2000. A target is `#rrggbb`, a CIELAB colour `L,a,b` (under the first light), or a file of
/// spectra: FILE for all of them but bare cards, FILE#SAMPLE for one. Recipes as near as the nearest (--tolerance)
/// come cheapest first if costs are given, else with the fewest pigments; the rest by distance.
#[derive(Debug, Args)]
pub(crate) struct Match {
    /// The pigment library (JSON)
    library: PathBuf,
    /// Colours to be met
    #[arg(required = true, value_name = "TARGET")]
    targets: Vec<String>,
    /// Use these pigments only (may be repeated) [default: all whose S is known]
    #[arg(long, value_name = "PIGMENT")]
    only: Vec<String>,
    /// A pigment that must take part, with its share of the whole where it is fixed (may be
    /// repeated)
    #[arg(long, value_name = "PIGMENT[=SHARE]")]
    with: Vec<String>,
    /// A pigment that must not take part (may be repeated)
    #[arg(long, value_name = "PIGMENT")]
    without: Vec<String>,
    /// The most pigments of one recipe, 1 to 8
    #[arg(long, value_name = "K", default_value_t = 4)]
    at_most: usize,
    /// The least share of a pigment that takes part: 0.02 or 1/50, what a palette knife can cut off
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true, default_value = "1/50")]
    least: String,
    /// Recipes in whole parts, together at most N
    #[arg(long, value_name = "N")]
    parts: Option<u32>,
    /// Grams of paint wanted in all, amounts being by mass
    #[arg(long, value_name = "GRAMS", allow_hyphen_values = true)]
    grams: Option<f64>,
    /// Price of one gram (of one unit of absolute amounts), NAME=PRICE, in any currency (may be repeated), or a CSV with the columns
    /// pigment and price
    #[arg(long, value_name = "PRICE")]
    cost: Vec<String>,
    /// CIEDE2000 within which recipes count as equally near
    #[arg(long, value_name = "DELTA_E", allow_hyphen_values = true, default_value_t = 0.05)]
    tolerance: f64,
    /// How many recipes to show for each target
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
    /// Light, as in `color`, with its weight where there are several (may be repeated)
    #[arg(long, value_name = "LIGHT[=WEIGHT]", default_value = "D65")]
    illuminant: Vec<String>,
    /// Observer: 1931-2 (or 2), 1964-10 (or 10), 2015-2, 2015-10
    #[arg(long, value_name = "NAME", default_value = "1931-2")]
    observer: String,
    #[command(flatten)]
    reading: ReadingOptions,
    /// Print JSON: a list of targets, each with its recipes
    #[arg(long)]
    json: bool,
}

impl Match {
    pub(super) fn run(self, console: &mut Console<'_>) -> anyhow::Result<()> {
        let sights = self.sights()?;
        let library = library(&self.library)?;
        let request = self.request(&library, &sights, console)?;
        for sight in &sights {
            color_weights(&sight.viewing, library.grid, console)?;
        }
        let mut wanted: Vec<Target> = Vec::new();
        for text in &self.targets {
            wanted.extend(targets(text, &sights, &self.reading, console)?);
        }
        let sheet = Sheet { library: &library, request: &request, grams: self.grams };
        let progress = Progress::new(wanted.len(), "matching", console.screen.progress);
        let mut matched = Vec::new();
        for target in wanted {
            matched.push(matched_with(&library, target, &request)?);
            progress.step();
        }
        progress.done();
        if self.json {
            let list: Vec<Value> = matched.iter().map(|matched| sheet.json(matched)).collect();
            return console.json(&Value::from(list));
        }
        for (index, matched) in matched.iter().enumerate() {
            if index > 0 {
                console.line("")?;
            }
            sheet.print(matched, console)?;
        }
        Ok(())
    }

    fn sights(&self) -> anyhow::Result<Vec<Sight>> {
        let sight = |text: &String| {
            let told = text.rsplit_once('=').and_then(|(light, weight)| {
                let weight: f64 = weight.parse().ok()?;
                Some((light, weight))
            });
            let (light, weight) = told.unwrap_or((text, 1.0));
            Ok(Sight { viewing: viewing(light, &self.observer)?, weight })
        };
        let sights = self.illuminant.iter().map(sight).collect::<anyhow::Result<Vec<Sight>>>()?;
        let name = |sight: &Sight| sight.viewing.illuminant.name().to_owned();
        let twice = |(at, sight)| sights[..at].iter().any(|before| name(before) == name(sight));
        if let Some(repeated) = sights.iter().enumerate().find(|&pair| twice(pair)) {
            return Err(Refusal::usage(
                format!("the light {} is given twice", name(repeated.1)),
                "give each light once, with its weight: --illuminant D65=2 --illuminant A",
            ));
        }
        Ok(sights)
    }

    fn request(
        &self,
        library: &PigmentLibrary,
        sights: &[Sight],
        console: &mut Console<'_>,
    ) -> anyhow::Result<MatchRequest> {
        let film = self.film(library, console)?;
        let mut request = MatchRequest::new(library, sights.to_vec(), film);
        self.choose_pigments(library, &mut request, console)?;
        request.at_most = self.at_most;
        request.least_share = share("--least", &self.least)?;
        request.whole_parts = self.parts;
        request.tolerance = self.tolerance;
        request.count = self.count;
        request.costs = costs(&self.cost, library, &request.allowed)?;
        if self.count == 0 {
            return Err(Refusal::usage("--count is 1 or more", "leave it out for 5 recipes"));
        }
        if let Some(grams) = self.grams.filter(|grams| !(*grams > 0.0 && *grams < 1e9)) {
            return Err(Refusal::usage(
                format!("--grams must be above 0, found `{grams}`"),
                "try --grams 40",
            ));
        }
        if self.grams.is_some() && library.amounts == AmountKind::Absolute {
            return Err(Refusal::usage(
                "--grams shares out a mixture, but this library's amounts are absolute",
                "leave it out: the recipe tells each amount on the library's area",
            ));
        }
        Ok(request)
    }

    fn film(
        &self,
        library: &PigmentLibrary,
        console: &mut Console<'_>,
    ) -> anyhow::Result<FilmKind> {
        if self.thickness.is_none()
            && self.over.is_some()
            && library.amounts == AmountKind::Relative
        {
            return Err(Refusal::usage(
                "a film that hides shows no ground",
                "give --over a --thickness, such as 1 or 0.2:3",
            ));
        }
        if self.thickness.is_none() && library.amounts == AmountKind::Relative {
            return Ok(FilmKind::Hiding);
        }
        if self.over.is_none() {
            console.remark("over a perfect white; give the paper or ground by --over")?;
        }
        let ground = ground(self.over.as_deref().unwrap_or("white"), library, console)?;
        let Some(text) = &self.thickness else {
            return Ok(MatchRequest::usual_film(library, ground));
        };
        let number = |text: &str| text.parse::<f64>().ok().filter(|t| *t > 0.0 && *t <= 1e9);
        let thickness = match text.split_once(':') {
            Some((least, most)) => number(least).zip(number(most)).filter(|(l, m)| l < m),
            None => number(text).map(|thickness| (thickness, thickness)),
        };
        let (least, most) = thickness.ok_or_else(|| {
            Refusal::usage(
                format!("--thickness is T or LEAST:MOST, above 0 and up to 1e9, found `{text}`"),
                "try --thickness 1 or --thickness 0.2:3",
            )
        })?;
        let thickness =
            if least < most { Thickness::Between(least, most) } else { Thickness::Fixed(least) };
        Ok(FilmKind::Over { ground, thickness })
    }

    /// Who may take part, who must, and who is left out.
    fn choose_pigments(
        &self,
        library: &PigmentLibrary,
        request: &mut MatchRequest,
        console: &mut Console<'_>,
    ) -> anyhow::Result<()> {
        let find = |names: &[String]| -> anyhow::Result<Vec<usize>> {
            names.iter().map(|name| Ok(library.find(name)?)).collect()
        };
        if !self.only.is_empty() {
            request.allowed = find(&self.only)?;
        }
        for text in &self.with {
            // A pigment's own name may hold an equals sign.
            let (name, told) = match text.rsplit_once('=') {
                Some((name, told)) if library.find(text).is_err() => (name, Some(told)),
                _ => (text.as_str(), None),
            };
            let share = told.map(|told| share("--with", told)).transpose()?;
            let pigment = library.find(name)?;
            request.required.retain(|(known, _)| *known != pigment);
            request.required.push((pigment, share));
            request.allowed.push(pigment);
        }
        let without = find(&self.without)?;
        if let Some((pigment, _)) = request.required.iter().find(|(p, _)| without.contains(p)) {
            return Err(Refusal::usage(
                format!("{} stands under --with and --without", library.pigments[*pigment].name),
                "leave out one of the two",
            ));
        }
        request.allowed.retain(|pigment| !without.contains(pigment));
        request.allowed.sort_unstable();
        request.allowed.dedup();
        let unknown = |chosen: bool| -> Vec<&str> {
            let pigments = library.pigments.iter().enumerate();
            let of_those = pigments.filter(|(index, pigment)| {
                !pigment.identified
                    && request.allowed.contains(index) == chosen
                    && !without.contains(index)
            });
            of_those.map(|(_, pigment)| pigment.name.as_str()).collect()
        };
        let (used, left_out) = (unknown(true), unknown(false));
        if !used.is_empty() {
            console.warnings(&[format!(
                "S is not known of {}; recipes with it are a guess",
                used.join(", ")
            )])?;
        }
        if !left_out.is_empty() && self.only.is_empty() {
            console.remark(format!("left out, their S is not known: {}", left_out.join(", ")))?;
        }
        Ok(())
    }
}

/// CIEDE2000 is made for differences up to about this many units.
const FAR: f64 = 5.0;

fn matched_with(
    library: &PigmentLibrary,
    target: Target,
    request: &MatchRequest,
) -> anyhow::Result<Matched> {
    let found = recipes(library, &target, request)?;
    if found.is_empty() {
        return Err(Refusal::data(
            "no recipe fits inside these limits",
            "allow more pigments (--at-most), more parts (--parts) or a smaller --least",
        ));
    }
    let mut matched = Matched { target, recipes: found, by_cie1976: Vec::new() };
    if matched.nearest() > FAR {
        let request = MatchRequest { metric: Metric::Cie1976, count: 1, ..request.clone() };
        matched.by_cie1976 = recipes(library, &matched.target, &request)?;
    }
    Ok(matched)
}

/// A share from 0 to 1: a number, or a fraction such as 1/50.
fn share(option: &str, text: &str) -> anyhow::Result<f64> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let value = match text.split_once('/') {
        Some((above, below)) => number(above).zip(number(below)).map(|(a, b)| a / b),
        None => number(text),
    };
    value.filter(|value| (0.0..=1.0).contains(value)).ok_or_else(|| {
        Refusal::usage(
            format!("{option} takes a share from 0 to 1, found `{text}`"),
            format!(
                "try {option} {}0.25 or a fraction such as 1/4",
                if option == "--with" { "NAME=" } else { "" }
            ),
        )
    })
}
