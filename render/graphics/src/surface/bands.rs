//! Triangles projected to the picture and sorted into bands of its rows.

use rayon::prelude::*;

use super::fill::Shape;
use super::packed::Positioned;
use super::screen::{Corner, Screen, pixel_range};
use crate::mesh::Triangle;

/// Rows of pixels that one thread draws at a time.
pub(super) const BAND: usize = 16;

/// Triangles that one thread sorts into bands at a time.
const CHUNK: usize = 2048;

/// This bit is set where an entry of a band is the index of a piece of a clipped triangle.
const PIECE: u32 = 1 << 31;

/// Which sides of triangles are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sides {
    /// Front and back faces.
    Both,
    /// Only faces whose corners run counter-clockwise in the picture. Of a closed surface
    /// seen from outside, nothing else is visible.
    Front,
}

/// Projected triangles by the bands in which they may have pixels. Keeps its memory between
/// pictures.
#[derive(Debug, Clone, Default)]
pub(super) struct Bands {
    corners: Vec<Corner>,
    chunks: Vec<Chunk>,
}

/// Some triangles, sorted into bands.
#[derive(Debug, Clone, Default)]
struct Chunk {
    /// For each band the triangles to draw there, or pieces of clipped ones ([`PIECE`]).
    bands: Vec<Vec<u32>>,
    pieces: Vec<Piece>,
}

/// A triangular piece of a clipped triangle.
#[derive(Debug, Clone)]
struct Piece {
    triangle: u32,
    corners: [Corner; 3],
    weights: [[f32; 2]; 3],
}

impl Bands {
    /// Projects triangles to a picture of (width, height) pixels and sorts them; what was
    /// sorted before is dropped.
    ///
    /// # Panics
    /// If a triangle has a corner that `vertices` does not have, or there are 2^31
    /// triangles or more.
    pub(super) fn sort(
        &mut self,
        screen: Screen,
        (width, height): (usize, usize),
        vertices: &[impl Positioned],
        triangles: &[Triangle],
        sides: Sides,
    ) {
        assert!(triangles.len() < PIECE as usize, "{} triangles", triangles.len());
        screen.corners(vertices, &mut self.corners);
        let corners = &self.corners;
        self.chunks.resize_with(triangles.len().div_ceil(CHUNK), Chunk::default);
        let sorter = Sorter { screen, vertices, corners, sides, width, height };
        self.chunks.par_iter_mut().zip(triangles.par_chunks(CHUNK)).enumerate().for_each(
            |(number, (chunk, triangles))| sorter.sort((number * CHUNK) as u32, triangles, chunk),
        );
    }

    /// Calls `draw` with each shape of `band`, which starts at row [`BAND`] times its index,
    /// in the order of `triangles`, the list that was sorted.
    #[inline]
    pub(super) fn for_each_shape(
        &self,
        band: usize,
        triangles: &[Triangle],
        mut draw: impl FnMut(&Shape),
    ) {
        for chunk in &self.chunks {
            for &entry in &chunk.bands[band] {
                draw(&match entry & PIECE {
                    0 => Shape::whole(entry, triangles[entry as usize].corners, &self.corners),
                    _ => {
                        let piece = &chunk.pieces[(entry & !PIECE) as usize];
                        Shape::cut(piece.triangle, piece.corners, piece.weights)
                    }
                });
            }
        }
    }
}

/// Sorts triangles into the bands that they touch.
struct Sorter<'a, V> {
    screen: Screen,
    vertices: &'a [V],
    corners: &'a [Corner],
    sides: Sides,
    width: usize,
    height: usize,
}

impl<V: Positioned> Sorter<'_, V> {
    fn sort(&self, first: u32, triangles: &[Triangle], chunk: &mut Chunk) {
        chunk.bands.resize_with(self.height.div_ceil(BAND), Vec::new);
        chunk.bands.iter_mut().for_each(Vec::clear);
        chunk.pieces.clear();
        for (triangle, number) in triangles.iter().zip(first..) {
            let corners = triangle.corners.map(|corner| self.corners[corner as usize]);
            let outside = corners.map(|at| if at.inverse_w == 0.0 { at.x } else { 0 });
            if outside == [0; 3] {
                self.add(&corners, number, &mut chunk.bands);
            } else if outside[0] & outside[1] & outside[2] == 0 {
                self.add_pieces(*triangle, number, chunk);
            }
        }
    }

    fn add_pieces(&self, triangle: Triangle, number: u32, chunk: &mut Chunk) {
        let positions = triangle.corners.map(|corner| self.vertices[corner as usize].position());
        let polygon = self.screen.clip_triangle(positions);
        for i in 2..polygon.len() {
            let fan = [polygon[0], polygon[i - 1], polygon[i]];
            let corners = fan.map(|(corner, _)| corner);
            self.add(&corners, PIECE | chunk.pieces.len() as u32, &mut chunk.bands);
            let weights = fan.map(|(_, weights)| weights);
            chunk.pieces.push(Piece { triangle: number, corners, weights });
        }
    }

    /// Adds `entry` to the bands in which the triangle of these corners may have pixels.
    fn add(&self, corners: &[Corner; 3], entry: u32, bands: &mut [Vec<u32>]) {
        let [a, b, c] = corners;
        let twice_area = i64::from(b.x - a.x) * i64::from(c.y - a.y)
            - i64::from(c.x - a.x) * i64::from(b.y - a.y);
        // Rows run downwards, so counter-clockwise triangles have a negative area.
        if twice_area == 0 || (twice_area > 0 && self.sides == Sides::Front) {
            return;
        }
        let columns = pixel_range(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x), self.width);
        let rows = pixel_range(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y), self.height);
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        for band in &mut bands[rows.start / BAND..=(rows.end - 1) / BAND] {
            band.push(entry);
        }
    }
}
