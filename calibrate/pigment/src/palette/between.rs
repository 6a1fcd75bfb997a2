//! Mixtures between sampled ones, where there are gaps.

use std::collections::BTreeMap;

use super::paints::{Appearance, Palette, Recipe};

/// Side of a cell in a* and b*.
const CELL: f64 = 3.0;
/// Height of a cell in L*.
const BAND: f64 = 10.0;
/// A gap of two cells or three closes in later passes.
const PASSES: usize = 4;

/// Recipes for cells of CIELAB that no sample lies in, though both neighbours on
/// opposite sides are filled: those two mixed, half and half. What is found
/// serves the next pass.
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
            // Half of the directions: the other half are these, from the far side.
            for (da, db) in [(1, 0), (0, 1), (1, 1), (1, -1)] {
                let gap = [band, a + da, b + db];
                let Some(other) = cells.get(&[band, a + 2 * da, b + 2 * db]) else { continue };
                if cells.contains_key(&gap) || added.contains_key(&gap) {
                    continue;
                }
                let mixed = halves(recipe, other);
                let color = palette.look(&mixed);
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

/// One half of each, by shares.
fn halves(first: &Recipe, second: &Recipe) -> Recipe {
    let mut mixed: Recipe = first.iter().map(|&(paint, share)| (paint, share / 2.0)).collect();
    for &(paint, share) in second {
        match mixed.iter_mut().find(|(known, _)| *known == paint) {
            Some((_, sum)) => *sum += share / 2.0,
            None => mixed.push((paint, share / 2.0)),
        }
    }
    mixed
}
