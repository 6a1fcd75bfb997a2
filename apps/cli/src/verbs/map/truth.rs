//! Text, JSON and CSV of maps beside the truth of a simulated scan.

use maps::truth::{CHI2_RISEN, Comparison};
use serde_json::{Value, json};

use crate::console::Console;
use crate::failure::Result;

/// Part of the pixels below which a pigment is not named in the text.
const NAMED: f64 = 0.001;

/// A row for each kind of pixels.
pub(super) fn rows(compared: &Comparison) -> Vec<Value> {
    let row = |row: &maps::truth::ComparisonRow| {
        json!({
            "kind": row.kind,
            "pixels": row.pixels,
            "mapped": row.mapped,
            "precision": row.scores.precision,
            "recall": row.scores.recall,
            "share_error": row.scores.share_error,
            "within_sd": row.within_sd,
            "chi2_risen": row.chi2_risen,
        })
    };
    compared.rows.iter().map(row).collect()
}

pub(super) fn json(compared: &Comparison) -> Value {
    let pigments = compared.pigments.iter().map(|pigment| {
        json!({
            "pigment": pigment.name,
            "there": pigment.there,
            "told": pigment.told,
            "right": pigment.right,
        })
    });
    json!({ "kinds": rows(compared), "pigments": pigments.collect::<Vec<Value>>() })
}

/// Prints a line for each kind of pixels, then one for each pigment that is there or told.
pub(super) fn print(compared: &Comparison, console: &mut Console<'_>) -> Result<()> {
    console.line(format!(
        "{:14}  {:>8}  precision  recall  share error  within sd  chi-square above {CHI2_RISEN}",
        "truth", "pixels"
    ))?;
    for row in compared.rows.iter().filter(|row| row.pixels > 0) {
        console.line(format!(
            "{:14}  {:8}       {:.2}    {:.2}         {:.2}       {:.2}  {:>16.0} %",
            row.kind,
            row.pixels,
            row.scores.precision,
            row.scores.recall,
            row.scores.share_error,
            row.within_sd,
            100.0 * row.chi2_risen
        ))?;
    }
    let named = compared.pigments.iter().filter(|p| p.there >= NAMED || p.told >= NAMED);
    let named: Vec<_> = named.collect();
    let width = named.iter().map(|pigment| pigment.name.chars().count()).max().unwrap_or(0).max(7);
    console.line(format!("{:width$}  there  told  rightly told (% of the pixels)", "pigment"))?;
    for pigment in named {
        let [there, told, right] =
            [pigment.there, pigment.told, pigment.right].map(|part| 100.0 * part);
        let name = &pigment.name;
        console.line(format!("{name:width$}  {there:5.1} {told:5.1} {right:5.1}"))?;
    }
    Ok(())
}
