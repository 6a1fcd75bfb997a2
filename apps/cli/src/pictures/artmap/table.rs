//! Samples and maps as tables, as lines, as JSON and as CSV.

use std::path::Path;

use documents::{column_width, counted};
use pictures::{ArtMapOutcome, SampleFigures, SamplesOutcome};
use serde::Serialize;

use crate::console::Console;
use crate::csv_rows::at_most;
use crate::failure::Result;

/// How the outcome of a request is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Printed {
    /// Lines and tables for people.
    Text,
    Json,
    Csv,
}

impl Printed {
    /// The way that the options `--json` and `--csv` choose.
    pub(super) fn of(json: bool, csv: bool) -> Self {
        match (json, csv) {
            (_, true) => Self::Csv,
            (true, false) => Self::Json,
            (false, false) => Self::Text,
        }
    }

    /// Prints an outcome as JSON, or the list `rows` of this JSON as CSV. Returns whether it printed anything.
    pub(super) fn as_data(
        self,
        outcome: &impl Serialize,
        rows: &str,
        console: &mut Console<'_>,
    ) -> Result<bool> {
        if self == Self::Text {
            return Ok(false);
        }
        let outcome = serde_json::to_value(outcome).expect("an outcome serializes to JSON");
        match self {
            Self::Csv => {
                console.csv_rows(outcome[rows].as_array().map_or(&[], Vec::as_slice))?;
            }
            _ => console.json(&outcome)?,
        }
        Ok(true)
    }
}

/// Columns of text with a heading each.
pub(super) struct Table {
    pub(super) rows: Vec<Vec<String>>,
}

impl Table {
    pub(super) fn new(headings: &[&str]) -> Self {
        Self { rows: vec![headings.iter().map(|&heading| heading.to_owned()).collect()] }
    }

    pub(super) fn row(&mut self, cells: Vec<String>) {
        self.rows.push(cells);
    }

    /// Prints the rows, each column as wide as its widest cell.
    pub(super) fn print(&self, console: &mut Console<'_>) -> Result<()> {
        for row in &self.rows {
            let cells = row.iter().enumerate().map(|(column, cell)| {
                let width = column_width(self.rows.iter().filter_map(|row| row.get(column)), 0);
                format!("{cell:width$}")
            });
            console.line(cells.collect::<Vec<_>>().join("  ").trim_end())?;
        }
        Ok(())
    }
}

/// Width and height of a sample, such as `300 x 200`.
pub(super) fn size(sample: &SampleFigures) -> String {
    let (width, height) = sample.size;
    format!("{width} x {height}")
}

/// Distance between strokes in texels, and in mm if it is known: `16.0 texels (4 mm)`.
pub(super) fn spacing(outcome: &SamplesOutcome) -> String {
    let Some(spacing) = outcome.spacing else { return "no texels".to_owned() };
    let mm_per_texel = outcome.samples.first().and_then(|sample| sample.mm_per_texel);
    in_texels(spacing, mm_per_texel)
}

fn in_texels(spacing: f64, mm_per_texel: Option<f64>) -> String {
    let mm = mm_per_texel.map(|mm| format!(" ({} mm)", at_most(mm * spacing, 2)));
    format!("{spacing:.1} texels{}", mm.unwrap_or_default())
}

/// The names of pigments, separated by commas. Without pigments, this is `colours only`.
pub(super) fn names(pigments: &[String]) -> String {
    if pigments.is_empty() { "colours only".to_owned() } else { pigments.join(", ") }
}

/// Prints the samples of a set: size, colour, lightness and height of the paint.
pub(super) fn print_samples(samples: &[SampleFigures], console: &mut Console<'_>) -> Result<()> {
    let relief = samples.iter().any(|sample| sample.height_mm.is_some());
    let mut headings = vec!["name", "texels", "L*", "colour"];
    headings.extend(relief.then_some("height of the paint"));
    let mut table = Table::new(&headings);
    for sample in samples {
        let mut cells = vec![
            sample.name.clone(),
            size(sample),
            format!("{:.1}", sample.lightness),
            sample.colour.clone(),
        ];
        let guessed = if sample.guessed_relief { " (guessed)" } else { "" };
        cells.extend(sample.height_mm.map(|height| {
            format!("mean {:.3} mm, greatest {:.3} mm{guessed}", height.mean, height.greatest)
        }));
        table.row(cells);
    }
    table.print(console)
}

/// Size, spacing and pigments of a map in one line.
pub(super) fn summary(map: &ArtMapOutcome) -> String {
    let guessed = if map.guessed_relief { "; relief guessed" } else { "" };
    format!(
        "{} of {size} x {size} texels, strokes {} apart; {}{guessed}",
        counted(map.tiles.len(), "tile"),
        in_texels(map.spacing, map.mm_per_texel),
        names(&map.pigments),
        size = map.size,
    )
}

/// Prints the figures of the tiles, from dark to light.
pub(super) fn print_tiles(map: &ArtMapOutcome, console: &mut Console<'_>) -> Result<()> {
    let mut table =
        Table::new(&["tile", "L*", "contrast", "stroke", "coherence", "neighbour", "border"]);
    for tile in &map.tiles {
        let first = if tile.is_first { " (first)" } else { "" };
        table.row(vec![
            format!("{}{first}", tile.name),
            format!("{:.1}", tile.lightness),
            format!("{:.1}", tile.contrast),
            format!("{:.1} texels", tile.stroke_length),
            format!("{:.2}", tile.coherence),
            format!("{:.2}", tile.neighbour_coherence),
            format!("{:.2}", tile.border),
        ]);
    }
    table.print(console)
}

/// Last part of a path, as text.
pub(super) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
