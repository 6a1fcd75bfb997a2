//! The pool of recipes that a plan is chosen from.

use super::palette::Palette;
use super::recipe::{Purpose, Recipe};

/// Parts of white to one of paint, and the reverse.
const TINTS: [(u32, u32); 10] =
    [(4, 1), (2, 1), (1, 1), (1, 2), (1, 4), (1, 9), (1, 19), (1, 39), (1, 79), (1, 159)];
/// Parts of colour to one of black.
const SHADES: [u32; 6] = [2, 4, 9, 19, 39, 79];
/// Two colours.
const CROSSES: [(u32, u32); 3] = [(1, 1), (1, 4), (4, 1)];
/// Two colours and the white.
const CROSS_TINTS: [(u32, u32, u32); 2] = [(1, 1, 2), (1, 1, 8)];

/// Every recipe whose smallest share is `least_share` or more: masstones, tints
/// and shades at a ladder of parts, two colours at three ratios, and the same
/// two with white.
#[must_use]
pub fn candidates(palette: &Palette, least_share: f64) -> Vec<Recipe> {
    let mut pool = Vec::new();
    let mut add = |purpose, parts: &[(usize, u32)]| {
        let recipe = Recipe { purpose, parts: parts.to_vec() };
        if recipe.least_share() >= least_share - 1e-9 {
            pool.push(recipe);
        }
    };
    for paint in 0..palette.names.len() {
        add(Purpose::Masstone, &[(paint, 1)]);
    }
    for (parts, white) in TINTS {
        for paint in 1..palette.names.len() {
            add(Purpose::Tint, &[(paint, parts), (Palette::WHITE, white)]);
        }
    }
    if let Some(black) = palette.black {
        for parts in SHADES {
            for paint in palette.colors() {
                add(Purpose::Shade, &[(paint, parts), (black, 1)]);
            }
        }
    }
    let pairs = palette.colors().flat_map(|a| palette.colors().map(move |b| (a, b)));
    for (a, b) in pairs.filter(|(a, b)| a < b) {
        for (of_a, of_b) in CROSSES {
            add(Purpose::Cross, &[(a, of_a), (b, of_b)]);
        }
        for (of_a, of_b, white) in CROSS_TINTS {
            add(Purpose::CrossTint, &[(a, of_a), (b, of_b), (Palette::WHITE, white)]);
        }
    }
    pool
}
