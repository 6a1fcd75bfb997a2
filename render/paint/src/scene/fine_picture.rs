//! Picture of a painting at rest with several pixels a cell.

use documents::hint::{Explain, Fault, Hint};
use rayon::prelude::*;

use super::picture::{ALL, lay_row, tops};
use crate::document::Document;
use crate::optics::{Lamp, Scene};
use crate::shade::{TopMaterial, Tops, color_row, relieve_row};
use graphics::field::Field;

/// Pixels of a picture along a cell's width.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelsPerCell(u8);

/// A number of pixels along a cell is out of range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a cell has 1 to {} pixels along its width, found `{found}`", PixelsPerCell::MOST)]
pub struct PixelsPerCellError {
    /// The number that was asked for.
    pub found: u8,
}

impl Explain for PixelsPerCellError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new("2 hides the cells on most screens"))
    }

    fn fault(&self) -> Fault {
        Fault::Setting
    }
}

impl Default for PixelsPerCell {
    /// One pixel a cell.
    fn default() -> Self {
        Self(1)
    }
}

impl PixelsPerCell {
    /// Most pixels along a cell's width.
    pub const MOST: u8 = 4;

    /// Checks a number of pixels along a cell's width, 1 to [`PixelsPerCell::MOST`].
    ///
    /// # Errors
    /// [`PixelsPerCellError`] outside that range.
    pub fn new(count: u8) -> Result<Self, PixelsPerCellError> {
        match (1..=Self::MOST).contains(&count) {
            true => Ok(Self(count)),
            false => Err(PixelsPerCellError { found: count }),
        }
    }

    /// Number of pixels along a cell's width.
    #[must_use]
    pub fn count(self) -> usize {
        usize::from(self.0)
    }
}

/// Picture of a document in linear sRGB, white at 1, like [`picture`](super::picture) but with
/// `pixels` along the width and the height of every cell. Heights and the light of level
/// paint between the centres of cells are those of Mitchell and Netravali's (1988) bicubic filter,
/// and relief and gloss are shaded at the finer grid. Even paint has its exact colour. Takes 21
/// bytes per cell and 20 bytes per pixel beside the document.
///
/// `scene` must have been made for `document`.
#[must_use]
pub fn fine_picture(document: &Document, scene: &Scene, pixels: PixelsPerCell) -> Field<[f32; 4]> {
    let count = pixels.count();
    let cells = Cells::of(document, scene);
    let width = document.wet.width() * count;
    let height = document.wet.height() * count;
    let mut picture = Field::filled(width, height, [0.0; 4]);
    if picture.values().is_empty() {
        return picture;
    }
    let between = Between::new(pixels, document.wet.width(), document.wet.height());
    let coarse = tops(document, ALL);
    let mut fine = Tops::level(width, height);
    fine.set_all(|x, y| {
        let from = f64::from(coarse.at(between.cell(x, y)));
        let mut more = 0.0;
        between.around(x, y, |weight, cell| {
            more += f64::from(weight) * (f64::from(coarse.at(cell)) - from);
        });
        (from + more).round() as i32
    });
    // Heights are in widths of a cell, so those of the finer grid count more.
    let relief = scene.lamp.relief * count as f32;
    let lamp = Lamp { relief, ..scene.lamp };
    let scene = Scene { lamp, cell_mm: scene.cell_mm / count as f32, ..scene.clone() };
    picture.values_mut().par_chunks_mut(width).enumerate().for_each_init(
        || vec![TopMaterial::Ground; width],
        |materials, (y, out)| {
            for (x, (out, material)) in out.iter_mut().zip(&mut *materials).enumerate() {
                (*out, *material) = cells.between(&between, x, y);
            }
            relieve_row(&scene, (&fine, (0, y)), materials, out);
        },
    );
    picture
}

/// Light of level paint and topmost material of every cell.
struct Cells {
    /// Linear sRGB without relief and gloss.
    colors: Field<[f32; 4]>,
    materials: Field<TopMaterial>,
}

impl Cells {
    fn of(document: &Document, scene: &Scene) -> Self {
        let width = document.wet.width();
        let height = document.wet.height();
        let mut colors = Field::filled(width, height, [0.0; 4]);
        let mut materials = Field::filled(width, height, TopMaterial::Ground);
        if width > 0 {
            let rows = colors.values_mut().par_chunks_mut(width);
            let rows = rows.zip(materials.values_mut().par_chunks_mut(width)).enumerate();
            rows.for_each_init(
                || vec![scene.ground; width],
                |internal, (y, (colors, materials))| {
                    lay_row((document, ALL), scene, y, internal, materials);
                    color_row(scene, internal, colors);
                },
            );
        }
        Self { colors, materials }
    }

    /// Colour and topmost material of a pixel: that which covers most of it.
    fn between(&self, between: &Between, x: usize, y: usize) -> ([f32; 4], TopMaterial) {
        let from = self.colors[between.cell(x, y)];
        let mut more = [0.0; 4];
        let mut shares = [0.0f32; 3];
        between.around(x, y, |weight, cell| {
            let there = &self.colors[cell];
            for i in 0..4 {
                more[i] += weight * (there[i] - from[i]);
            }
            shares[self.materials[cell] as usize] += weight;
        });
        let [wet, dry, ground] = shares;
        let material = match wet.max(dry) >= ground {
            true if wet >= dry => TopMaterial::Wet,
            true => TopMaterial::Dry,
            false => TopMaterial::Ground,
        };
        (std::array::from_fn(|i| from[i] + more[i]), material)
    }
}

/// Weights of the cells around the pixels of a finer grid.
struct Between {
    /// For each pixel along a cell, the weights of the cells at -2 to 2 from its own.
    weights: Vec<[f32; 5]>,
    width: usize,
    height: usize,
}

impl Between {
    fn new(pixels: PixelsPerCell, width: usize, height: usize) -> Self {
        let count = pixels.count();
        let weights = (0..count).map(|pixel| {
            let from_center = (pixel as f32 + 0.5) / count as f32 - 0.5;
            std::array::from_fn(|cell| mitchell(cell as f32 - 2.0 - from_center))
        });
        Self { weights: weights.collect(), width, height }
    }

    /// The cell in which a pixel lies.
    fn cell(&self, x: usize, y: usize) -> (usize, usize) {
        (x / self.weights.len(), y / self.weights.len())
    }

    /// Calls `add` with the weight of each cell around a pixel; the weights sum to 1. Beyond the
    /// edges of the canvas its last cells go on.
    fn around(&self, x: usize, y: usize, mut add: impl FnMut(f32, (usize, usize))) {
        let count = self.weights.len();
        let across = &self.weights[x % count];
        let down = &self.weights[y % count];
        let (x, y) = self.cell(x, y);
        for (j, down) in down.iter().enumerate() {
            let row = (y + j).saturating_sub(2).min(self.height - 1);
            for (i, across) in across.iter().enumerate() {
                add(across * down, ((x + i).saturating_sub(2).min(self.width - 1), row));
            }
        }
    }
}

/// The cubic filter of Mitchell and Netravali (1988) with B = C = 1/3, at a distance in cells.
fn mitchell(distance: f32) -> f32 {
    let d = distance.abs();
    let sixfold = match d {
        ..1.0 => (7.0 * d - 12.0) * d * d + 16.0 / 3.0,
        1.0..2.0 => ((-7.0 / 3.0 * d + 12.0) * d - 20.0) * d + 32.0 / 3.0,
        _ => 0.0,
    };
    sixfold / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_sum_to_one_and_are_those_of_a_mirrored_cell() {
        for count in 1..=PixelsPerCell::MOST {
            let between = Between::new(PixelsPerCell::new(count).unwrap(), 9, 9);
            for (weights, mirrored) in between.weights.iter().zip(between.weights.iter().rev()) {
                assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{weights:?}");
                for (weight, mirrored) in weights.iter().zip(mirrored.iter().rev()) {
                    assert!((weight - mirrored).abs() < 1e-6, "{weights:?}");
                }
            }
        }
        for found in [0, 5] {
            assert_eq!(PixelsPerCell::new(found), Err(PixelsPerCellError { found }));
        }
    }
}
