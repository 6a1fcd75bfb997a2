//! Report of a plan as text.

use calibrate::plan::{Forecast, PaintSet, Plan};
use calibrate::{PigmentId, Recipe};

use crate::console::Console;
use crate::failure::Result;

pub(super) fn print_swatches(plan: &Plan, console: &mut Console<'_>) -> Result<()> {
    let part =
        |&(paint, grams): &(PigmentId, f64)| format!("{grams} g {}", plan.paints.name(paint));
    let recipe = |grams: &Recipe| grams.iter().map(part).collect::<Vec<_>>().join(" + ");
    let recipes: Vec<String> = plan.swatches.iter().map(|swatch| recipe(&swatch.grams)).collect();
    let width = plan.swatches.iter().map(|s| s.name.chars().count()).max().unwrap_or(0);
    let recipe_width = recipes.iter().map(|text| text.chars().count()).max().unwrap_or(0);
    for (swatch, recipe) in plan.swatches.iter().zip(&recipes) {
        let name = &swatch.name;
        let purpose = swatch.recipe.purpose;
        console.line(format!("{name:width$}  {recipe:recipe_width$}  {}", purpose.why()))?;
    }
    Ok(())
}

pub(super) fn print_totals(plan: &Plan, console: &mut Console<'_>) -> Result<()> {
    console.line("")?;
    console.line("Paint for all of them:")?;
    for (name, total) in plan.paints.names.iter().zip(plan.totals_g()) {
        console.line(format!("{total:9.2} g {name}"))?;
    }
    Ok(())
}

pub(super) fn print_forecast(
    paints: &PaintSet,
    forecast: &Forecast,
    console: &mut Console<'_>,
) -> Result<()> {
    console.line(format!(
        "the usual plan with as many swatches has {:.0} % of the information of this one (D-efficiency)",
        100.0 * forecast.usual_efficiency
    ))?;
    console.line("")?;
    console.line(format!(
        "Predicted standard deviations, in percent of K and S, median over wavelength (noise {}, {:.3}):",
        forecast.noise.constant, forecast.noise.even
    ))?;
    let width = paints.names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    console.line(format!("{:width$}       K       S   usual K  usual S", ""))?;
    let percent = |value: f64| match 100.0 * value {
        large if large > 999.0 => ">999".to_owned(),
        value => format!("{value:.1}"),
    };
    let unit = || "unit".to_owned();
    let pairs = forecast.deviations.iter().zip(&forecast.usual_deviations);
    for (name, (own, usual)) in paints.names.iter().zip(pairs) {
        console.line(format!(
            "{name:width$} {:>7} {:>7}  {:>8} {:>8}",
            percent(own.absorption),
            own.scattering.map_or_else(unit, percent),
            percent(usual.absorption),
            usual.scattering.map_or_else(unit, percent),
        ))?;
    }
    Ok(())
}
