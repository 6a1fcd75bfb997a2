//! Finds the closed surfaces that hold each visible point. For this we count faces behind it
//! (z-fail, as for shadow volumes: Crow 1977, Heidmann 1991, Everitt and Kilgard 2002).
//!
//! A face of a closed surface that covers a pixel at or behind the point seen there adds +1 if it
//! faces away and -1 if it faces the eye. The sum is the number of surfaces that hold the point,
//! wherever the eye stands. The near plane cuts off only faces before the point, which do not
//! count, and there is no far plane for faces.
//!
//! We round vertices to the 256th of a pixel, and every pixel belongs to one of two faces that
//! share an edge. So the faces of a closed surface sum to 0 over every pixel, without cracks.
//! Surfaces may overlap. Each must be closed, without self-intersections, its faces
//! counter-clockwise seen from outside.
mod counter;

#[cfg(test)]
mod tests;

use rayon::prelude::*;

use crate::camera::Camera;
use crate::compute::Image;
use crate::field::Field;
use crate::mesh::Triangle;
use crate::surface::raster::{BAND, Bands, Screen, Shape, Sides, cover};
use crate::surface::{Fragment, NO_TRIANGLE, Positioned, VisibilityBuffer};

pub use counter::{ADD_STENCIL, GATED_FACES, InsideCounter, STENCIL_FACES, WEIGHED_FACES};

/// Closed surfaces, which may overlap. Each must be closed and must not intersect itself. Its
/// triangles must be counter-clockwise seen from outside.
#[derive(Debug)]
pub struct ClosedSurfaces<'a, V> {
    /// The vertices of all surfaces, in the unit of the model.
    pub vertices: &'a [V],
    /// The triangles of all surfaces. [`Triangle::material`] is the index of the surface.
    pub triangles: &'a [Triangle],
}

impl<V> Clone for ClosedSurfaces<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V> Copy for ClosedSurfaces<'_, V> {}

/// A crossing of the ray from the eye through the centre of a pixel with a face of a closed
/// surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Index of the pixel, row by row.
    pub pixel: usize,
    /// Index of the surface.
    pub surface: u32,
    /// Depth as in [`crate::surface::Fragment`], above 1 beyond the far plane.
    pub depth: f32,
    /// 1 where the ray leaves the surface (a back face), -1 where it enters.
    pub sign: i32,
    inverse_w: [f32; 3],
}

impl Crossing {
    /// Distance from the eye along the viewing direction (not along the ray), above 0, in the
    /// unit of the model.
    #[must_use]
    #[inline]
    pub fn view_depth(&self) -> f32 {
        let [a, b, c] = self.inverse_w;
        1.0 / (a + b + c)
    }
}

/// A sum over the crossings of each pixel's eye ray.
///
/// We add the crossings of a pixel in the order of the triangles. If you sum whole numbers that
/// wrap, the result does not depend on this order.
pub trait CrossingSum: Sync {
    /// The sum of a pixel. Its default must be the sum over no crossing.
    type Sum: Copy + Default + Send + Sync;

    /// Set this if you want all crossings: also those before the seen point, and at pixels that
    /// show nothing. Otherwise you get only crossings at or behind the seen point.
    const EVERY_CROSSING: bool = false;

    /// Adds a crossing to the sum of its pixel.
    fn add(&self, sum: &mut Self::Sum, crossing: &Crossing);
}

/// Counts the closed surfaces that hold the seen point. This is 0 where nothing is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Count;

impl CrossingSum for Count {
    type Sum = i32;

    #[inline]
    fn add(&self, sum: &mut i32, crossing: &Crossing) {
        *sum = sum.wrapping_add(crossing.sign);
    }
}

/// Sums the weights of the closed surfaces that hold the seen point. This is 0 where nothing is
/// seen or no surface holds the point.
///
/// You pass a function that gives the weight of a surface (first argument) at a pixel (second
/// argument). It must depend on these two alone, so that the crossings of a surface that does not
/// hold the point cancel. Sums beyond the range of `i32` wrap.
#[derive(Debug, Clone, Copy)]
pub struct WeighedCount<W>(pub W);

impl<W: Fn(u32, usize) -> i32 + Sync> CrossingSum for WeighedCount<W> {
    type Sum = i32;

    #[inline]
    fn add(&self, sum: &mut i32, crossing: &Crossing) {
        let weight = (self.0)(crossing.surface, crossing.pixel);
        *sum = sum.wrapping_add(crossing.sign.wrapping_mul(weight));
    }
}

/// Limits what closed surfaces hold to the triangles of a scene that face the same way. For
/// example, this keeps paint on one side of a thin wall from showing on the other.
#[derive(Debug, Clone, Copy)]
pub struct Gates<'a> {
    /// For each closed surface: a unit vector, and as the fourth number the least cosine between
    /// this vector and the normal of a triangle that the surface holds. Use -2 for a surface that
    /// holds all triangles. The fifth number is a body: the surface holds only triangles of this
    /// body. Use 0 for a surface that holds triangles of any body. The other numbers do not matter.
    pub surfaces: &'a [[f32; 8]],
    /// For each triangle of the scene: its unit normal, and as the fourth number its body. Use 0
    /// for a triangle that surfaces of any body can hold. This image must be in the memory of the
    /// compute that counts.
    pub normals: &'a Image<[f32; 4]>,
}

#[derive(Debug, Clone, Copy)]
struct GatedCount<'a> {
    surfaces: &'a [[f32; 8]],
    normals: &'a [[f32; 4]],
    seen: &'a [Fragment],
}

impl CrossingSum for GatedCount<'_> {
    type Sum = i32;

    #[inline]
    fn add(&self, sum: &mut i32, crossing: &Crossing) {
        // We add crossings only where a triangle is seen.
        let [x, y, z, of] = self.normals[self.seen[crossing.pixel].triangle as usize];
        let [to_x, to_y, to_z, least, body, ..] = self.surfaces[crossing.surface as usize];
        let is_own = body == 0.0 || of == 0.0 || body == of;
        if is_own && x * to_x + y * to_y + z * to_z >= least {
            *sum = sum.wrapping_add(crossing.sign);
        }
    }
}

/// Columns of a tile. With the nearest depth in a tile we can skip faces before it.
const TILE: usize = 16;

/// If the depths of a face come this close to the nearest seen one, we look at them pixel by
/// pixel. Interpolated depths may exceed the depths of the corners by rounding.
const MARGIN: f32 = 1e-5;

/// Sums over the crossings of eye rays with the faces of closed surfaces, on the processor. It
/// keeps its memory between pictures.
#[derive(Debug, Clone, Default)]
pub struct Crossings {
    bands: Bands,
}

impl Crossings {
    /// The sum of each pixel of `visible`, which `camera` sees. You get the same bits for any
    /// number of threads.
    ///
    /// # Panics
    /// If a triangle has a corner that `vertices` does not have, or there are 2^31 triangles or
    /// more.
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

struct SeenBand {
    width: usize,
    /// One for each pixel, infinite where nothing is seen.
    depths: Vec<f32>,
    /// The least of every [`TILE`] columns.
    nearest: Vec<f32>,
}

impl SeenBand {
    fn new(fragments: &[Fragment], width: usize) -> Self {
        let depths: Vec<f32> = fragments
            .iter()
            .map(|seen: &Fragment| match seen.triangle {
                NO_TRIANGLE => f32::INFINITY,
                _ => seen.depth,
            })
            .collect();
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
