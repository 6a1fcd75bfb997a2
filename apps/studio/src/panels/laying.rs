//! Laying a mixture on a free place of the palette, and keeping it for later.

use std::f64::consts::TAU;

use paint::strokes::Recipe;
use session::swatches::{KeptMixture, SwatchChange};
use session::{Command, PaintingState};

use super::context::PanelContext;
use crate::files::FileRequest;
use crate::view::Outline;

/// Clearance around a new heap of paint, divided by the cube root of its volume. The
/// heap's own radius is 0.94 of that root (`Painting::squeeze`).
const REACH: f64 = 1.2;

/// Squeezes a heap of a mixture, with the volume set in the tools, on a free place of the palette.
pub(super) fn lay_on_palette(cx: &mut PanelContext<'_>, recipe: Recipe, vehicle: f64) {
    let volume_mm3 = cx.tools.squeeze_mm3;
    let reach_mm = REACH * volume_mm3.cbrt();
    let places = candidates(cx.painting, reach_mm);
    cx.command(Command::SqueezeInFreeSpace { recipe, vehicle, volume_mm3, places, reach_mm });
}

/// Keeps a mixture in the painter's list, with its colour under the light of the painting. Does
/// nothing for a recipe without pigment.
pub(super) fn keep(cx: &mut PanelContext<'_>, recipe: Recipe, vehicle: f64) {
    let painting = cx.painting;
    let Ok(weights) = painting.light.viewing.weights(painting.library.grid) else { return };
    let light = (&weights, painting.lighting.illuminant.as_str());
    if let Some(kept) = KeptMixture::of(&painting.library, recipe, vehicle, light) {
        cx.file(FileRequest::Swatches(SwatchChange::Keep(Box::new(kept))));
    }
}

/// Positions on the palette, in mm, whose surroundings up to `reach_mm` are on its
/// wood; row by row from the upper left.
fn candidates(painting: &PaintingState, reach_mm: f64) -> Vec<[f64; 2]> {
    let cells = painting.palette_cells;
    let reach = reach_mm / painting.cell_mm;
    let step = (reach_mm / painting.cell_mm).max(1.0);
    let along = |size: usize| (size as f64 / step) as usize;
    let rim = |[x, y]: [f64; 2]| {
        let turns = (0..16).map(|turn| f64::from(turn) * TAU / 16.0);
        turns.map(move |turn| [x + reach * turn.cos(), y + reach * turn.sin()])
    };
    let rows = (1..=along(cells.1)).map(|row| row as f64 * step);
    let all = rows.flat_map(|y| (1..=along(cells.0)).map(move |column| [column as f64 * step, y]));
    let on_wood =
        all.filter(|&place| rim(place).all(|place| Outline::Palette.contains(place, cells)));
    on_wood.map(|place| place.map(|cells| cells * painting.cell_mm)).collect()
}
