//! Sums over the crossings of eye rays with closed surfaces, on the processor.

use rayon::prelude::*;

use super::crossing::{Crossing, CrossingSum};
use super::surfaces::ClosedSurfaces;
use crate::camera::Camera;
use crate::field::Field;
use crate::surface::bands::{BAND, Bands, Sides};
use crate::surface::fill::{Shape, cover};
use crate::surface::packed::Positioned;
use crate::surface::screen::Screen;
use crate::surface::visibility::{Fragment, NO_TRIANGLE, VisibilityBuffer};

/// Columns of a tile, whose nearest seen depth lets faces before it be skipped.
const TILE: usize = 16;

/// Depths of a face within this much of the nearest seen one are looked at pixel by pixel:
/// interpolated depths may exceed those of the corners by rounding.
const MARGIN: f32 = 1e-5;

/// Sums over the crossings of eye rays with the faces of closed surfaces, on the processor.
/// Keeps its memory between pictures.
#[derive(Debug, Clone, Default)]
pub struct Crossings {
    bands: Bands,
}

impl Crossings {
    /// The sum of each pixel of `visible`, which `camera` sees.
    ///
    /// The bits are the same for any number of threads.
    ///
    /// # Panics
    /// If a triangle has a corner that `vertices` does not have, or there are 2^31
    /// triangles or more.
    #[must_use]
    pub fn sum<S: CrossingSum>(
        &mut self,
        summed: &S,
        surfaces: ClosedSurfaces<'_, impl Positioned>,
        camera: &Camera,
        visible: &VisibilityBuffer,
    ) -> Field<S::Sum> {
        let ClosedSurfaces { vertices, triangles } = surfaces;
        let width = visible.width();
        let height = visible.height();
        let mut sums = Field::filled(width, height, S::Sum::default());
        if width * height == 0 {
            return sums;
        }
        let clip_from_model = camera.clip_from_model(width as f32 / height as f32);
        let screen = Screen::new(clip_from_model, width, height).without_far_plane();
        self.bands.sort(screen, (width, height), vertices, triangles, Sides::Both);
        let cells = width * BAND;
        let sums_of_bands = sums.values_mut().par_chunks_mut(cells);
        let bands = sums_of_bands.zip(visible.values().par_chunks(cells)).enumerate();
        bands.for_each(|(band, (sums, fragments))| {
            let seen = SeenBand::new(fragments, width);
            self.bands.for_each_shape(band, triangles, |shape| {
                if S::EVERY_CROSSING || seen.reaches_behind(shape) {
                    let surface = triangles[shape.triangle() as usize].material;
                    add(summed, shape, surface, (band * BAND, width), &seen, sums);
                }
            });
        });
        sums
    }
}

/// Adds the crossings of one shape to `sums`, the pixels of a band.
fn add<S: CrossingSum>(
    summed: &S,
    shape: &Shape,
    surface: u32,
    (first_row, width): (usize, usize),
    seen: &SeenBand,
    sums: &mut [S::Sum],
) {
    let sign = if shape.is_front() { -1 } else { 1 };
    cover(shape, first_row, width, sums, |index, sum, second, third| {
        let depth = shape.depth(second, third);
        if S::EVERY_CROSSING || depth >= seen.depths[index] {
            let inverse_w = shape.inverse_w(second, third);
            let pixel = first_row * width + index;
            summed.add(sum, &Crossing { pixel, surface, depth, sign, inverse_w });
        }
    });
}

/// The seen depths of a band.
struct SeenBand {
    width: usize,
    /// Of each pixel; infinite where nothing is seen.
    depths: Vec<f32>,
    /// The least of every [`TILE`] columns.
    nearest: Vec<f32>,
}

impl SeenBand {
    fn new(fragments: &[Fragment], width: usize) -> Self {
        let depth = |seen: &Fragment| match seen.triangle {
            NO_TRIANGLE => f32::INFINITY,
            _ => seen.depth,
        };
        let depths: Vec<f32> = fragments.iter().map(depth).collect();
        let mut nearest = vec![f32::INFINITY; width.div_ceil(TILE)];
        for row in depths.chunks(width) {
            for (nearest, depths) in nearest.iter_mut().zip(row.chunks(TILE)) {
                *nearest = depths.iter().copied().fold(*nearest, f32::min);
            }
        }
        Self { width, depths, nearest }
    }

    /// Whether a shape may have a pixel at or behind what is seen there.
    fn reaches_behind(&self, shape: &Shape) -> bool {
        let columns = shape.columns(self.width);
        let tiles = &self.nearest[columns.start / TILE..columns.end.div_ceil(TILE)];
        let farthest = shape.greatest_depth() + MARGIN;
        tiles.iter().any(|&nearest| farthest >= nearest)
    }
}
