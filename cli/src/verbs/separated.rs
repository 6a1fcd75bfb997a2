//! `impasto paint --separate`: how much of each pigment every cell takes.

use std::path::Path;

use anyhow::Context;
use render::export::{PigmentMap, pigment_maps, png8};
use render::field::Field;
use render::photograph::{ColorErrors, Picture, Separation, rebuild_picture};
use serde_json::json;

use crate::console::Console;
use crate::output::Output;

/// The start of every file's name.
const STEM: &str = "separation";

/// Writes a map of each pigment, the picture that they make together, and how
/// far it is from `target`.
pub(super) fn write(
    folder: &Path,
    separation: &Separation,
    target: &Picture,
    names: &[String],
    cell_mm: f64,
) -> anyhow::Result<ColorErrors> {
    std::fs::create_dir_all(folder)
        .with_context(|| format!("{}: cannot be made", folder.display()))?;
    let heights = separation.separate(target);
    let (width, height) = (target.width(), target.height());
    let maps: Vec<PigmentMap> = names
        .iter()
        .enumerate()
        .map(|(slot, name)| {
            let values = heights.values().iter().map(|cell| cell[slot]).collect();
            PigmentMap { name: name.clone(), height_mm: Field::from_values(width, height, values) }
        })
        .collect();
    let picture = rebuild_picture(separation.film(), &heights);
    let errors = ColorErrors::between(separation, target, &picture);
    let opaque = picture.values().iter().map(|&[red, green, blue]| [red, green, blue, 1.0]);
    let opaque = Field::from_values(width, height, opaque.collect());
    let mut files = pigment_maps(STEM, &maps, cell_mm)?;
    for file in files.drain(..) {
        Output::open(&folder.join(file.name), &[])?.write(file.bytes)?;
    }
    let file = |ending: &str| Output::open(&folder.join(format!("{STEM}.{ending}")), &[]);
    file("rebuilt.png")?.write(png8(&opaque, cell_mm)?.bytes)?;
    let told = json!({"palette": names, "error": errors});
    file("errors.json")?.write(calibrate::library::to_text(&told))?;
    Ok(errors)
}

/// Says how far the separation is from the photograph.
pub(super) fn tell(
    errors: &ColorErrors,
    names: &[String],
    as_json: bool,
    console: &mut Console<'_>,
) -> anyhow::Result<()> {
    if as_json {
        return console.json(&json!({"palette": names, "error": errors}));
    }
    console.line(format!("separated into {}", names.join(", ")))?;
    console.line(format!("colour error (CIEDE2000): {}", in_words(errors)))
}

/// Errors on a line.
pub(super) fn in_words(errors: &ColorErrors) -> String {
    let ColorErrors { mean, median, p95, max, out_of_gamut, .. } = errors;
    format!(
        "mean {mean:.2}, median {median:.2}, 95th percentile {p95:.2}, largest {max:.2}; {:.1} % out of gamut",
        100.0 * out_of_gamut
    )
}
