//! Samples and maps as tables and as JSON, their output files, and the picture that samples are taken
//! from.

use std::path::{Path, PathBuf};

use artmap::map::{ArtMap, MapFigures};
use artmap::passages::SourcePicture;
use artmap::sample::{PaintOfSamples, Sample, SampleSet, WholePainting};
use graphics::picture::{Photograph, Picture};
use serde_json::{Value, json};
use spectra::color::Rgb;

use crate::console::Console;
use crate::csv_rows::at_most;
use crate::failure::Result;
use crate::output::Output;
use crate::pictures::{picture_bytes, picture_output, refuse_same};
use paint::document::Document;

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
                let cells = self.rows.iter().filter_map(|row| row.get(column));
                let width = cells.map(|cell| cell.chars().count()).max().unwrap_or(0);
                format!("{cell:width$}")
            });
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

/// Names of the pigments of a set. This is empty without paint.
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

/// Size, spacing and pigments of a map in one line.
pub(super) fn summary(map: &ArtMap) -> String {
    let mm = map.mm_per_texel.map(|mm| format!(" ({} mm)", at_most(mm * map.spacing, 2)));
    let names = names_of_pigments(map);
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
    let tiles = figures.keys.iter().map(|key| {
        json!({
            "name": key.name,
            "lightness": key.tone,
            "contrast": key.contrast,
            "stroke_length": key.stroke_length,
            "coherence": key.coherence,
            "neighbour_coherence": key.neighbour_coherence,
            "border": key.wrap_ratio,
        })
    });
    json!({
        "provenance": map.provenance,
        "size": map.size(),
        "spacing": map.spacing,
        "mm_per_texel": map.mm_per_texel,
        "guessed_relief": map.guessed_relief,
        "pigments": names_of_pigments(map),
        "first": map.keys[map.first].name,
        "patch": map.patch,
        "levels": map.levels,
        "settings": map.settings,
        "tiles": tiles.collect::<Vec<_>>(),
        "faults": figures.faults().iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

/// Prints the tiles of a map in its JSON as CSV.
pub(super) fn csv_tiles(map: &Value, console: &mut Console<'_>) -> Result<()> {
    console.csv_rows(map["tiles"].as_array().map_or(&[], Vec::as_slice))
}

pub(super) fn names_of_pigments(map: &ArtMap) -> Vec<String> {
    map.paint.as_ref().map(PaintOfSamples::pigment_names).unwrap_or_default()
}

/// A file of samples or a map and its sheet, checked to be writable.
pub(super) struct FileAndSheet {
    pub(super) file: Output,
    pub(super) sheet: Option<Output>,
}

impl FileAndSheet {
    /// Checks, before the slow part of a verb, that both files can be written.
    pub(super) fn open(file: &Path, sheet: Option<&Path>, inputs: &[PathBuf]) -> Result<Self> {
        let file = Output::with_ending(file, &["exr"], inputs)?;
        let sheet = picture_output(sheet, inputs)?;
        refuse_same(&[Some(&file), sheet.as_deref()])?;
        Ok(Self { file, sheet })
    }

    /// Writes both files, once both are encoded. `sheet` draws the sheet if one is wanted.
    pub(super) fn write(
        self,
        bytes: Vec<u8>,
        sheet: impl FnOnce() -> Picture,
        console: &mut Console<'_>,
    ) -> Result<()> {
        let sheet = match self.sheet {
            Some(output) => Some((picture_bytes(&sheet(), &output, console)?, output)),
            None => None,
        };
        self.file.write(bytes, console)?;
        match sheet {
            Some((bytes, output)) => output.write(bytes, console),
            None => Ok(()),
        }
    }

    pub(super) fn outputs(&self) -> [Option<&documents::file::Output>; 2] {
        [Some(&self.file), self.sheet.as_deref()]
    }
}

/// Last part of a path, as text.
pub(super) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// Reads the picture at `path`. A painting (.exr) keeps its paint and relief; with `merge_minor`,
/// pigments below 1 % count as others if there are more than eight.
pub(super) fn source(
    path: &Path,
    merge_minor: bool,
    console: &mut Console<'_>,
) -> Result<SourcePicture> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr")) {
        let painting = WholePainting::of(&Document::open(path)?, merge_minor)?;
        for [minor, into] in &painting.merged {
            console.remark(format!("{minor} is below 1 % of the pigment and counts as {into}"))?;
        }
        return Ok(SourcePicture::of_painting(painting));
    }
    let photograph = Photograph::open(path)?;
    let (width, height) = photograph.size();
    let provenance = format!("picture {}", file_name(path));
    Ok(SourcePicture::of_colors(photograph.on_canvas(width, height), provenance))
}
