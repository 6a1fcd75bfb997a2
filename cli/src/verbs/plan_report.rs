//! A plan in words, and as JSON.

use calibrate::fit::ExpectedNoise;
use calibrate::plan::{Palette, Recipe, RelativeDeviation};
use serde_json::{Map, Value, json};

use crate::console::Console;

/// What a prior library says of the plan.
pub(super) struct Forecast {
    /// D-efficiency of the usual design against this one.
    pub(super) usual_efficiency: f64,
    pub(super) deviations: Vec<RelativeDeviation>,
    pub(super) usual_deviations: Vec<RelativeDeviation>,
    pub(super) noise: ExpectedNoise,
}

pub(super) fn print_swatches(
    palette: &Palette,
    recipes: &[Recipe],
    samples: &[String],
    grams: &[Vec<(usize, f64)>],
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    let width = samples.iter().map(|sample| sample.chars().count()).max().unwrap_or(0);
    let words: Vec<String> = grams
        .iter()
        .map(|grams| {
            let word =
                |&(paint, grams): &(usize, f64)| format!("{grams} g {}", palette.names[paint]);
            grams.iter().map(word).collect::<Vec<_>>().join(" + ")
        })
        .collect();
    let wide = words.iter().map(|word| word.chars().count()).max().unwrap_or(0);
    for ((recipe, sample), word) in recipes.iter().zip(samples).zip(&words) {
        console.line(format!("{sample:width$}  {word:wide$}  {}", recipe.purpose.why()))?;
    }
    Ok(())
}

/// Grams of each paint over all swatches.
fn totals(palette: &Palette, grams: &[Vec<(usize, f64)>]) -> Vec<f64> {
    let mut totals = vec![0.0; palette.names.len()];
    grams.iter().flatten().for_each(|(paint, grams)| totals[*paint] += grams);
    totals
}

pub(super) fn print_totals(
    palette: &Palette,
    grams: &[Vec<(usize, f64)>],
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    console.line("")?;
    console.line("Paint for all of them:")?;
    for (name, total) in palette.names.iter().zip(totals(palette, grams)) {
        console.line(format!("{total:9.2} g {name}"))?;
    }
    Ok(())
}

pub(super) fn print_forecast(
    palette: &Palette,
    forecast: &Forecast,
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    console.line(format!(
        "the usual plan of as many swatches has {:.0} % of this one's information (D-efficiency)",
        100.0 * forecast.usual_efficiency
    ))?;
    console.line("")?;
    console.line(format!(
        "Predicted standard deviations, in percent of K and S, median over wavelength (noise {}, {:.3}):",
        forecast.noise.constant, forecast.noise.even
    ))?;
    let width = palette.names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    console.line(format!("{:width$}       K       S   usual K  usual S", ""))?;
    let percent = |value: f64| match 100.0 * value {
        large if large > 999.0 => ">999".to_owned(),
        value => format!("{value:.1}"),
    };
    let of_white = || "unit".to_owned();
    let pairs = forecast.deviations.iter().zip(&forecast.usual_deviations);
    for (name, (own, usual)) in palette.names.iter().zip(pairs) {
        console.line(format!(
            "{name:width$} {:>7} {:>7}  {:>8} {:>8}",
            percent(own.absorption),
            own.scattering.map_or_else(of_white, percent),
            percent(usual.absorption),
            usual.scattering.map_or_else(of_white, percent),
        ))?;
    }
    Ok(())
}

pub(super) fn as_json(
    palette: &Palette,
    recipes: &[Recipe],
    samples: &[String],
    grams: &[Vec<(usize, f64)>],
    forecast: Option<&Forecast>,
) -> Value {
    let name = |paint: usize| palette.names[paint].clone();
    let swatches = recipes.iter().zip(samples).zip(grams).map(|((recipe, sample), grams)| {
        let parts: Map<String, Value> =
            recipe.parts.iter().map(|&(paint, parts)| (name(paint), json!(parts))).collect();
        let grams: Map<String, Value> =
            grams.iter().map(|&(paint, grams)| (name(paint), json!(grams))).collect();
        json!({
            "sample": sample,
            "purpose": recipe.purpose.word(),
            "parts": parts,
            "grams": grams,
            "why": recipe.purpose.why(),
        })
    });
    let swatches: Vec<Value> = swatches.collect();
    // Sums of steps of a balance, without the noise of adding.
    let rounded = |total: f64| (1e6 * total).round() / 1e6;
    let totals: Map<String, Value> = totals(palette, grams)
        .into_iter()
        .enumerate()
        .map(|(paint, total)| (name(paint), json!(rounded(total))))
        .collect();
    let prior = forecast.map(|forecast| {
        let of = |deviations: &[RelativeDeviation]| -> Map<String, Value> {
            let pairs = deviations.iter().enumerate().map(|(paint, deviation)| {
                let pair = json!({
                    "absorption": deviation.absorption,
                    "scattering": deviation.scattering,
                });
                (name(paint), pair)
            });
            pairs.collect()
        };
        json!({
            "usual_efficiency": forecast.usual_efficiency,
            "noise": {"constant": forecast.noise.constant, "even": forecast.noise.even},
            "relative_deviations": of(&forecast.deviations),
            "usual_relative_deviations": of(&forecast.usual_deviations),
        })
    });
    json!({
        "swatches": swatches,
        "totals_g": totals,
        "unknowns": palette.unknowns(),
        "identified": true,
        "prior": prior,
    })
}
