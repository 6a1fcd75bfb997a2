//! Mixtures that fill gaps between sampled ones.

use std::collections::BTreeMap;

use super::paints::Palette;
use crate::appearance::Appearance;
use crate::recipe::Recipe;

/// Side of a cell in a* and b*; chosen by eye.
const CELL: f64 = 3.0;
/// Height of a cell in L*; chosen by eye.
const BAND: f64 = 10.0;
/// Number of passes. A gap of two or three cells is filled by mixtures of several passes.
const PASSES: usize = 4;

/// For each empty cell of CIELAB between two opposite neighbours that hold a sample, returns the mixture of
/// these two in equal parts. Mixtures found in one pass are samples for the next.
pub(super) fn between<'a>(
    palette: &Palette<'_>,
    samples: impl Iterator<Item = (&'a Recipe, &'a Appearance)>,
) -> Vec<(Recipe, Appearance)> {
    let mut cells: BTreeMap<[i32; 3], Recipe> = BTreeMap::new();
    for (recipe, color) in samples {
        cells.entry(cell(color)).or_insert_with(|| recipe.clone());
    }
    let mut found = Vec::new();
    for _ in 0..PASSES {
        let mut added: BTreeMap<[i32; 3], Recipe> = BTreeMap::new();
        for (&[band, a, b], recipe) in &cells {
            // Four of the eight directions; the cell on the other side of the gap covers the opposite ones.
            for (da, db) in [(1, 0), (0, 1), (1, 1), (1, -1)] {
                let gap = [band, a + da, b + db];
                let Some(other) = cells.get(&[band, a + 2 * da, b + 2 * db]) else { continue };
                if cells.contains_key(&gap) || added.contains_key(&gap) {
                    continue;
                }
                let mixed = halves(recipe, other);
                let color = palette.color(&mixed);
                added.entry(cell(&color)).or_insert_with(|| mixed.clone());
                found.push((mixed, color));
            }
        }
        for (place, recipe) in added {
            cells.entry(place).or_insert(recipe);
        }
    }
    found
}

fn cell(color: &Appearance) -> [i32; 3] {
    let index = |value: f64, side: f64| (value / side).floor() as i32;
    let lab = color.lab;
    [index(lab.lightness, BAND), index(lab.a, CELL), index(lab.b, CELL)]
}

/// Mixture of one half of each recipe.
fn halves(first: &Recipe, second: &Recipe) -> Recipe {
    let mut mixed = first.scaled(0.5);
    second.iter().for_each(|&(paint, share)| mixed.add(paint, 0.5 * share));
    mixed
}
