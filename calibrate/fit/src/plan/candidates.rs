//! The pool of recipes from which a plan is chosen.

use super::paints::PaintSet;
use super::swatch_recipe::{Purpose, SwatchRecipe};
use pigment::PigmentId;

/// Parts of the paint and of the white in tints.
const TINTS: [(u32, u32); 10] =
    [(4, 1), (2, 1), (1, 1), (1, 2), (1, 4), (1, 9), (1, 19), (1, 39), (1, 79), (1, 159)];
/// Parts of the colour to one of the black in shades.
const SHADES: [u32; 6] = [2, 4, 9, 19, 39, 79];
/// Parts of two colours mixed with each other.
const CROSSES: [(u32, u32); 3] = [(1, 1), (1, 4), (4, 1)];
/// Parts of two colours and of the white.
const CROSS_TINTS: [(u32, u32, u32); 2] = [(1, 1, 2), (1, 1, 8)];

/// Lists every recipe whose smallest share is `least_share` or more: masstones, tints and shades at a
/// ladder of parts, two colours at three ratios, and two colours with white.
#[must_use]
pub fn candidates(paints: &PaintSet, least_share: f64) -> Vec<SwatchRecipe> {
    let mut pool = Vec::new();
    let mut add = |purpose, parts: &[(PigmentId, u32)]| {
        let recipe = SwatchRecipe { purpose, parts: parts.to_vec() };
        if recipe.least_share() >= least_share - 1e-9 {
            pool.push(recipe);
        }
    };
    for paint in paints.ids() {
        add(Purpose::Masstone, &[(paint, 1)]);
    }
    for (parts, white) in TINTS {
        for paint in paints.ids().skip(1) {
            add(Purpose::Tint, &[(paint, parts), (PaintSet::WHITE, white)]);
        }
    }
    if let Some(black) = paints.black {
        for parts in SHADES {
            for paint in paints.colors() {
                add(Purpose::Shade, &[(paint, parts), (black, 1)]);
            }
        }
    }
    let pairs = paints.colors().flat_map(|a| paints.colors().map(move |b| (a, b)));
    for (a, b) in pairs.filter(|(a, b)| a < b) {
        for (of_a, of_b) in CROSSES {
            add(Purpose::Cross, &[(a, of_a), (b, of_b)]);
        }
        for (of_a, of_b, white) in CROSS_TINTS {
            add(Purpose::CrossTint, &[(a, of_a), (b, of_b), (PaintSet::WHITE, white)]);
        }
    }
    pool
}
