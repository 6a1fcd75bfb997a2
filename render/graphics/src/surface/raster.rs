//! Triangles to pixels.
//!
//! As graphics devices do it, so that both agree but for rounding: vertices are
//! moved to the 256th of a pixel; a pixel belongs to the triangle that its middle
//! is in, on an edge to the one below or to the right of the edge; of several the
//! nearest is seen, at equal depth the one of the lowest index. What crosses the
//! near or far plane is cut.

use glam::Mat4;
use rayon::prelude::*;

use super::fill::{Shape, fill};
use super::packed::{Placed, Vertex};
use super::screen::{Corner, Screen, middles};
use super::visible::{Seen, Visible};
use crate::camera::Camera;
use crate::gpu::{RasterShader, layout};
use crate::mesh::{Mesh, Triangle};

/// How a device draws it: buffers of [`Vertex`] and [`Triangle`]; a pixel is a
/// [`Seen`].
pub static RASTER: RasterShader = RasterShader {
    name: "raster",
    source: include_str!("raster.wgsl"),
    parameters: layout!(View { clip_from_model }),
    structs: &[Vertex::LAYOUT],
    buffers: 2,
};

/// What [`RASTER`] is told.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct View {
    /// Column by column.
    pub clip_from_model: [[f32; 4]; 4],
}

/// Rows of pixels that are drawn by one thread at a time.
const BAND: usize = 16;

/// Triangles that are sorted into bands by one thread at a time.
const CHUNK: usize = 2048;

/// Set where an entry is the index of a piece, not of a triangle.
const PIECE: u32 = 1 << 31;

/// Which sides of triangles are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sides {
    /// Both.
    Both,
    /// Those from which the corners run counter-clockwise: of a closed surface seen
    /// from outside, all that can be seen.
    Front,
}

/// What `camera` sees of a mesh at the middle of every pixel, of both sides of its
/// triangles.
///
/// # Panics
/// If a triangle has a corner that there is not.
#[must_use]
pub fn visible(mesh: &Mesh, camera: &Camera, width: usize, height: usize) -> Visible {
    let mut visible = Visible::filled(width, height, Seen::EMPTY);
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

/// Draws triangles with the processor; keeps its memory between pictures.
#[derive(Debug, Clone, Default)]
pub struct Rasteriser {
    corners: Vec<Corner>,
    chunks: Vec<Chunk>,
}

/// What some triangles come to.
#[derive(Debug, Clone, Default)]
struct Chunk {
    /// For every band what is drawn there: triangles, or pieces.
    bands: Vec<Vec<u32>>,
    pieces: Vec<Piece>,
}

/// A part of a triangle that was cut.
#[derive(Debug, Clone)]
struct Piece {
    triangle: u32,
    corners: [Corner; 3],
    weights: [[f32; 2]; 3],
}

impl Rasteriser {
    /// Draws over all of `visible`.
    ///
    /// # Panics
    /// If a triangle has a corner that there is not, or there are 2^31 triangles.
    pub fn draw(
        &mut self,
        clip_from_model: Mat4,
        vertices: &[impl Placed],
        triangles: &[Triangle],
        sides: Sides,
        visible: &mut Visible,
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
            pixels.fill(Seen::EMPTY);
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

/// Sorts triangles into bands.
struct Sorter<'a, V> {
    screen: Screen,
    vertices: &'a [V],
    corners: &'a [Corner],
    sides: Sides,
    width: usize,
    height: usize,
}

impl<V: Placed> Sorter<'_, V> {
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
        let places = triangle.corners.map(|corner| self.vertices[corner as usize].place());
        let polygon = self.screen.cut(places);
        for i in 2..polygon.len() {
            let fan = [polygon[0], polygon[i - 1], polygon[i]];
            let corners = fan.map(|(corner, _)| corner);
            self.add(&corners, PIECE | chunk.pieces.len() as u32, &mut chunk.bands);
            let weights = fan.map(|(_, weights)| weights);
            chunk.pieces.push(Piece { triangle: number, corners, weights });
        }
    }

    /// Puts `entry` where a triangle may have pixels.
    fn add(&self, corners: &[Corner; 3], entry: u32, bands: &mut [Vec<u32>]) {
        let [a, b, c] = corners;
        let twice_area = i64::from(b.x - a.x) * i64::from(c.y - a.y)
            - i64::from(c.x - a.x) * i64::from(b.y - a.y);
        // The rows run downwards: counter-clockwise is negative.
        if twice_area == 0 || (twice_area > 0 && self.sides == Sides::Front) {
            return;
        }
        let columns = middles(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x), self.width);
        let rows = middles(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y), self.height);
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        for band in &mut bands[rows.start / BAND..=(rows.end - 1) / BAND] {
            band.push(entry);
        }
    }
}
