//! A map as a table and as JSON.

use artmap::map::{ArtMap, KeyFigures, MapFigures};
use artmap::sample::PaintOfSamples;
use serde_json::{Value, json};

use super::table::Table;
use crate::console::Console;
use crate::decimals::at_most;
use crate::failure::Result;

/// Size, spacing and pigments of a map in one line.
pub(super) fn summary(map: &ArtMap) -> String {
    let mm = map.mm_per_texel.map(|mm| format!(" ({} mm)", at_most(mm * map.spacing, 2)));
    let names = pigment_names(map);
    let pigments = if names.is_empty() { "colours only".to_owned() } else { names.join(", ") };
    let guessed = if map.guessed_relief { "; relief guessed" } else { "" };
    format!(
        "{} of {size} x {size} texels, strokes {:.1} texels{} apart; {pigments}{guessed}",
        documents::counted(map.keys.len(), "tile"),
        map.spacing,
        mm.unwrap_or_default(),
        size = map.size(),
    )
}

/// Prints the figures of the tiles, from dark to light.
pub(super) fn print_tiles(figures: &MapFigures, console: &mut Console<'_>) -> Result<()> {
    let mut table =
        Table::new(&["tile", "L*", "contrast", "stroke", "coherence", "neighbour", "border"]);
    for (index, key) in figures.keys.iter().enumerate() {
        let first = if index == figures.first { " (first)" } else { "" };
        table.row(vec![
            format!("{}{first}", key.name),
            format!("{:.1}", key.tone),
            format!("{:.1}", key.contrast),
            format!("{:.1} texels", key.stroke_length),
            format!("{:.2}", key.coherence),
            format!("{:.2}", key.neighbour_coherence),
            format!("{:.2}", key.wrap_ratio),
        ]);
    }
    table.print(console)
}

/// A map and its figures as JSON, with `more` beside them.
pub(super) fn map_json(map: &ArtMap, figures: &MapFigures) -> Value {
    let tile = |key: &KeyFigures| {
        json!({
            "name": key.name,
            "lightness": key.tone,
            "contrast": key.contrast,
            "stroke_length": key.stroke_length,
            "coherence": key.coherence,
            "neighbour_coherence": key.neighbour_coherence,
            "border": key.wrap_ratio,
        })
    };
    json!({
        "provenance": map.provenance,
        "size": map.size(),
        "spacing": map.spacing,
        "mm_per_texel": map.mm_per_texel,
        "guessed_relief": map.guessed_relief,
        "pigments": pigment_names(map),
        "first": map.keys[map.first].name,
        "patch": map.patch,
        "levels": map.levels,
        "settings": map.settings,
        "tiles": figures.keys.iter().map(tile).collect::<Vec<_>>(),
        "faults": figures.faults().iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

/// Prints the tiles of a map in its JSON as CSV.
pub(super) fn csv_tiles(map: &Value, console: &mut Console<'_>) -> Result<()> {
    console.csv_rows(map["tiles"].as_array().map_or(&[], Vec::as_slice))
}

fn pigment_names(map: &ArtMap) -> Vec<String> {
    map.paint.as_ref().map(PaintOfSamples::pigment_names).unwrap_or_default()
}
