//! Samples as a table and as JSON.

use artmap::sample::{PaintOfSamples, Sample, SampleSet};
use serde_json::{Value, json};
use spectra::color::Rgb;

use crate::console::Console;
use crate::decimals::at_most;
use crate::failure::Result;

/// Columns of text with a heading each.
pub(super) struct Table {
    rows: Vec<Vec<String>>,
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
        let width = |column: usize| {
            let cells = self.rows.iter().filter_map(|row| row.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        for row in &self.rows {
            let cells = row.iter().enumerate();
            let cells = cells.map(|(column, cell)| format!("{cell:0$}", width(column)));
            console.line(cells.collect::<Vec<_>>().join("  ").trim_end())?;
        }
        Ok(())
    }
}

/// Mean colour of a sample in encoded sRGB.
pub(super) fn mean_color(sample: &Sample) -> Rgb {
    Rgb(sample.mean_color().map(|value| value.clamp(0.0, 1.0))).encoded()
}

/// Width and height of a sample, such as `300 x 200`.
pub(super) fn size(sample: &Sample) -> String {
    let (width, height) = sample.size();
    format!("{width} x {height}")
}

/// Mean and greatest height of the paint of a sample in mm, where it has relief.
pub(super) fn heights_mm(sample: &Sample) -> Option<[f64; 2]> {
    let heights = sample.height_mm.as_ref()?.values().iter().zip(sample.mask.values());
    let inside = heights.filter(|(_, inside)| **inside).map(|(height, _)| f64::from(*height));
    let (sum, most) =
        inside.fold((0.0, 0.0), |(sum, most): (f64, f64), height| (sum + height, most.max(height)));
    Some([sum / sample.texels().max(1) as f64, most])
}

/// Names of the pigments of a set; empty without paint.
pub(super) fn pigment_names(set: &SampleSet) -> Vec<String> {
    set.paint.as_ref().map(PaintOfSamples::pigment_names).unwrap_or_default()
}

/// Distance of strokes in texels, and in mm where it is known: `16.0 texels (4 mm)`.
pub(super) fn spacing(set: &SampleSet) -> String {
    let Some(first) = set.samples.first() else { return "no texels".to_owned() };
    let mm = first.mm_per_texel.map(|mm| format!(" ({} mm)", at_most(mm * first.spacing, 2)));
    format!("{:.1} texels{}", first.spacing, mm.unwrap_or_default())
}

/// Prints the samples of a set: size, colour, lightness and height of the paint.
pub(super) fn print_samples(set: &SampleSet, console: &mut Console<'_>) -> Result<()> {
    let relief = set.samples.iter().any(|sample| sample.height_mm.is_some());
    let mut headings = vec!["name", "texels", "L*", "colour"];
    headings.extend(relief.then_some("height of the paint"));
    let mut table = Table::new(&headings);
    for sample in &set.samples {
        let mut cells = vec![
            sample.name.clone(),
            size(sample),
            format!("{:.1}", sample.mean_lightness()),
            mean_color(sample).to_hex(),
        ];
        let heights = heights_mm(sample);
        let guessed = if sample.guessed_relief { " (guessed)" } else { "" };
        cells.extend(
            heights
                .map(|[mean, most]| format!("mean {mean:.3} mm, greatest {most:.3} mm{guessed}")),
        );
        table.row(cells);
    }
    table.print(console)
}

/// A sample as JSON.
pub(super) fn sample_json(sample: &Sample) -> Value {
    let (width, height) = sample.size();
    let heights = heights_mm(sample);
    json!({
        "name": sample.name,
        "size": [width, height],
        "texels": sample.texels(),
        "lightness": sample.mean_lightness(),
        "colour": mean_color(sample).to_hex(),
        "mm_per_texel": sample.mm_per_texel,
        "height_mm": heights.map(|[mean, most]| json!({"mean": mean, "greatest": most})),
        "guessed_relief": sample.guessed_relief,
    })
}

/// A set as JSON, with its samples as `samples`.
pub(super) fn set_json(set: &SampleSet, samples: Vec<Value>) -> Value {
    json!({
        "provenance": set.provenance,
        "spacing": set.samples.first().map(|sample| sample.spacing),
        "pigments": pigment_names(set),
        "samples": samples,
    })
}
