//! Rasterises triangles on the processor.
//!
//! Follows the rules of graphics devices, so that both agree up to rounding. Vertices are
//! rounded to the 256th of a pixel. A pixel belongs to the triangle that contains its
//! centre; a centre on an edge belongs to the triangle below or to the right of the edge.
//! The nearest triangle is seen; at equal depth, the one with the lowest index. Triangles
//! are clipped at the near and far plane.

use glam::Mat4;
use rayon::prelude::*;

use super::fill::{Shape, fill};
use super::packed::{Positioned, Vertex};
use super::screen::{Corner, Screen, pixel_range};
use super::visibility::{Fragment, VisibilityBuffer};
use crate::camera::Camera;
use crate::gpu::{RasterShader, layout};
use crate::mesh::{Mesh, Triangle};

/// The shader that draws a visibility buffer on a graphics device. It reads buffers of
/// [`Vertex`] and [`Triangle`]; a pixel is a [`Fragment`].
pub static RASTER: RasterShader = RasterShader {
    name: "raster",
    source: include_str!("raster.wgsl"),
    parameters: layout!(RasterParams { clip_from_model }),
    structs: &[Vertex::LAYOUT],
    buffers: 2,
};

/// Parameters of [`RASTER`].
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct RasterParams {
    /// The 4 x 4 matrix from model to clip coordinates, column by column.
    pub clip_from_model: [[f32; 4]; 4],
}

/// Rows of pixels that one thread draws at a time.
const BAND: usize = 16;

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

/// Draws both sides of all triangles of a mesh as `camera` sees them.
///
/// # Panics
/// If a triangle has a corner that the mesh does not have.
#[must_use]
pub fn visible(mesh: &Mesh, camera: &Camera, width: usize, height: usize) -> VisibilityBuffer {
    let mut visible = VisibilityBuffer::filled(width, height, Fragment::EMPTY);
    let clip_from_model = camera.clip_from_model(width as f32 / height.max(1) as f32);
    Rasteriser::default().draw(
        clip_from_model,
        &mesh.positions,
        &mesh.triangles,
        Sides::Both,
        &mut visible,
    );
    visible
}

/// Draws triangles on the processor. Keeps its memory between pictures.
#[derive(Debug, Clone, Default)]
pub struct Rasteriser {
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

impl Rasteriser {
    /// Draws triangles over all of `visible`, which is cleared first.
    ///
    /// # Panics
    /// If a triangle has a corner that `vertices` does not have, or there are 2^31
    /// triangles or more.
    pub fn draw(
        &mut self,
        clip_from_model: Mat4,
        vertices: &[impl Positioned],
        triangles: &[Triangle],
        sides: Sides,
        visible: &mut VisibilityBuffer,
    ) {
        assert!(triangles.len() < PIECE as usize, "{} triangles", triangles.len());
        let (width, height) = (visible.width(), visible.height());
        if width * height == 0 {
            return;
        }
        let screen = Screen::new(clip_from_model, width, height);
        screen.corners(vertices, &mut self.corners);
        let corners = &self.corners;
        self.chunks.resize_with(triangles.len().div_ceil(CHUNK), Chunk::default);
        let sorter = Sorter { screen, vertices, corners, sides, width, height };
        self.chunks.par_iter_mut().zip(triangles.par_chunks(CHUNK)).enumerate().for_each(
            |(number, (chunk, triangles))| sorter.sort((number * CHUNK) as u32, triangles, chunk),
        );
        let chunks = &self.chunks;
        let bands = visible.values_mut().par_chunks_mut(width * BAND).enumerate();
        bands.for_each(|(band, pixels)| {
            pixels.fill(Fragment::EMPTY);
            for chunk in chunks {
                for &entry in &chunk.bands[band] {
                    let shape = match entry & PIECE {
                        0 => Shape::whole(entry, triangles[entry as usize].corners, corners),
                        _ => {
                            let piece = &chunk.pieces[(entry & !PIECE) as usize];
                            Shape::cut(piece.triangle, piece.corners, piece.weights)
                        }
                    };
                    fill(&shape, band * BAND, width, pixels);
                }
            }
        });
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
