//! A picture of a map for you to look at.

use graphics::field::Field;
use graphics::picture::Picture;
use rayon::prelude::*;

use super::{ArtMap, Between};
use crate::relief::{raked, raking_tangent, slopes};

const SIDE: usize = 256;
const GAP: usize = 12;
/// Linear grey of the background. Its L* is 60, which lies between the tones of most maps.
const GROUND: [f32; 3] = [0.281; 3];
const SHARES: [f32; 3] = [0.25, 0.5, 0.75];
const REPEATS: usize = 3;

impl ArtMap {
    /// A picture of the map in linear sRGB, dark tones to the left.
    ///
    /// Rows from the top: the key tiles, then the tiles at 25, 50 and 75 % of the way between two
    /// neighbours, in the gap below both. Then each key tile, repeated three times in both
    /// directions. Where height and size are known, you also see the surfaces of the key tiles in
    /// grey, under a light from the upper left. We show tiles above 256 texels smaller.
    #[must_use]
    pub fn sheet(&self, between: Between) -> Picture {
        let size = self.size();
        let step = size.div_ceil(SIDE).max(1);
        let side = size / step;
        let column = side + GAP;
        let keys = &self.keys;
        let mut rows: Vec<Row> = Vec::new();
        rows.push(Row {
            left: GAP,
            tiles: keys.par_iter().map(|key| shrunk(&key.tile.color, side, step)).collect(),
        });
        rows.extend(self.between_rows(between, side, step));
        let tiles =
            keys.par_iter().map(|key| shrunk(&key.tile.color, side, REPEATS * step)).collect();
        rows.push(Row { left: GAP, tiles });
        rows.extend(self.relief_row(side, step));
        let width = GAP + column * keys.len();
        let height = GAP + column * rows.len();
        let mut sheet = Field::filled(width, height, GROUND);
        for (index, row) in rows.iter().enumerate() {
            for (at, tile) in row.tiles.iter().enumerate() {
                sheet.put((row.left + at * column, GAP + index * column), tile);
            }
        }
        sheet
    }

    fn relief_row(&self, side: usize, step: usize) -> Option<Row> {
        let mm = self.mm_per_texel?;
        let everywhere = Field::filled(self.size(), self.size(), true);
        let heights = self.keys.iter().map(|key| key.tile.height_mm.as_ref());
        let surfaces: Vec<Option<Field<[f32; 2]>>> =
            heights.map(|height| Some(slopes(height?, &everywhere, mm))).collect();
        if surfaces.iter().all(Option::is_none) {
            return None;
        }
        let tangent = raking_tangent(surfaces.iter().flatten());
        let tiles = surfaces.par_iter().map(|surface| {
            surface.as_ref().map_or_else(
                || Field::filled(side, side, GROUND),
                |slopes: &Field<[f32; 2]>| shrunk(&raked(slopes, tangent), side, step),
            )
        });
        Some(Row { left: GAP, tiles: tiles.collect() })
    }

    /// A row of in-betweens for each share. A map of one tile has none.
    fn between_rows(&self, between: Between, side: usize, step: usize) -> Vec<Row> {
        let columns: Vec<[Picture; 3]> = (0..self.keys.len())
            .into_par_iter()
            .filter_map(|lower: usize| {
                let transition = self.transition(lower, between)?;
                Some(SHARES.map(|share| shrunk(&transition.at(share).color, side, step)))
            })
            .collect();
        if columns.is_empty() {
            return Vec::new();
        }
        let left = GAP + (side + GAP) / 2;
        (0..SHARES.len())
            .map(|index: usize| Row {
                left,
                tiles: columns.iter().map(|column| column[index].clone()).collect(),
            })
            .collect()
    }
}

struct Row {
    left: usize,
    tiles: Vec<Picture>,
}

/// The texels of a tile that repeats, from its upper left corner on, as `side` x `side` pixels.
/// Each pixel is the mean of `step` x `step` texels.
fn shrunk(tile: &Picture, side: usize, step: usize) -> Picture {
    let width = tile.width();
    let height = tile.height();
    let share = 1.0 / (step * step) as f32;
    let mut pixels = Vec::with_capacity(side * side);
    for y in 0..side {
        for x in 0..side {
            let mut sum = [0.0; 3];
            for v in y * step..(y + 1) * step {
                for u in x * step..(x + 1) * step {
                    let texel = tile[(u % width, v % height)];
                    sum = std::array::from_fn(|i| sum[i] + texel[i]);
                }
            }
            pixels.push(sum.map(|sum| sum * share));
        }
    }
    Field::from_values(side, side, pixels)
}

#[cfg(test)]
mod tests {
    use super::super::{KeyMap, Tile};
    use super::*;
    use crate::synthesis::SynthesisSettings;

    /// A map of even tiles with one bright texel in their upper left corner. The first one has
    /// relief.
    fn map(size: usize, greys: &[f32]) -> ArtMap {
        ArtMap {
            keys: greys
                .iter()
                .enumerate()
                .map(|(index, grey): (usize, &f32)| {
                    let mut color = Field::filled(size, size, [*grey; 3]);
                    color[(0, 0)] = [2.0; 3];
                    let height_mm = (index == 0).then(|| Field::filled(size, size, 0.1));
                    let tile = Tile { color, paint: None, height_mm };
                    let sources = Field::filled(size, size, [0; 2]);
                    KeyMap { name: index.to_string(), tone: tile.tone(), tile, sources }
                })
                .collect(),
            first: 0,
            paint: None,
            spacing: 8.0,
            mm_per_texel: Some(0.2),
            guessed_relief: false,
            patch: 16,
            levels: 1,
            settings: SynthesisSettings::default(),
            provenance: String::new(),
        }
    }

    #[test]
    fn rows_show_tiles_in_betweens_repeats_and_relief() {
        let size = 30;
        let greys = [0.1_f32, 0.3, 0.6];
        let sheet = map(size, &greys).sheet(Between::Blend);
        let column = size + GAP;
        assert_eq!((sheet.width(), sheet.height()), (GAP + 3 * column, GAP + 6 * column));
        for (index, grey) in greys.into_iter().enumerate() {
            let left = GAP + index * column;
            assert_eq!(sheet[(left, GAP)], [2.0; 3]);
            assert_eq!(sheet[(left + 15, GAP + 15)], [grey; 3]);
            // Three repeats of ten pixels each, of which the first holds the bright texel.
            let row = GAP + 4 * column;
            for repeat in [0, 10, 20] {
                let found = sheet[(left + repeat, row + 10)][0];
                assert!((found - (8.0 * grey + 2.0) / 9.0).abs() < 1e-5, "{found}");
                assert!((sheet[(left + repeat + 1, row)][0] - grey).abs() < 1e-5);
            }
        }
        // Between the columns of both key tiles, lighter from row to row.
        let left = GAP + column / 2 + 15;
        let middles: Vec<f32> =
            (1..4).map(|row| sheet[(left, GAP + row * column + 15)][0]).collect();
        let rising = middles.windows(2).all(|pair| pair[0] < pair[1]);
        assert!(rising && middles[0] > 0.1 && middles[2] < 0.3, "{middles:?}");
        assert_eq!(sheet[(GAP - 1, GAP)], GROUND);
        // Only the first tile has relief, which is level.
        let relief = GAP + 5 * column + 15;
        assert!((sheet[(GAP + 15, relief)][0] - 0.25).abs() < 1e-6);
        assert_eq!(sheet[(GAP + column + 15, relief)], GROUND);
    }

    #[test]
    fn large_tiles_are_shown_smaller_and_single_ones_without_in_betweens() {
        let sheet = map(600, &[0.1]).sheet(Between::Dissolve);
        assert_eq!((sheet.width(), sheet.height()), (GAP + 212, GAP + 3 * 212));
        let found = sheet[(GAP, GAP)][0];
        assert!((found - (2.0 + 0.8) / 9.0).abs() < 1e-5, "{found}");
    }
}
