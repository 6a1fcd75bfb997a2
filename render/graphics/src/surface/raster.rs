//! Rasterises triangles on the processor: projects and clips them, sorts them into bands of rows
//! and fills their pixels.
//!
//! This follows the rules of graphics devices, so that both agree up to rounding. We round
//! vertices to the 256th of a pixel. A pixel belongs to the triangle that contains its centre. If
//! the centre lies on an edge, it belongs to the triangle below or to the right of the edge. You
//! see the nearest triangle, and at equal depth the one with the lowest index. We clip triangles
//! at the near and far plane.

use std::ops::Range;

use glam::{Mat4, Vec4};
use rayon::prelude::*;

use super::{Fragment, Positioned, Vertex, VisibilityBuffer};
use crate::camera::Camera;
use crate::gpu::{RasterShader, layout};
use crate::mesh::{Mesh, Triangle};

/// This shader draws a visibility buffer on a graphics device. It reads buffers of [`Vertex`] and
/// [`Triangle`]. A pixel is a [`Fragment`].
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

/// Draws both sides of all triangles of a mesh as `camera` sees them. Use a [`Rasteriser`] if you
/// draw several pictures.
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

/// Draws triangles on the processor. It keeps its memory between pictures.
#[derive(Debug, Clone, Default)]
pub struct Rasteriser {
    bands: Bands,
}

impl Rasteriser {
    /// Draws triangles over all of `visible`. This clears it first.
    ///
    /// # Panics
    /// If a triangle has a corner that `vertices` does not have, or there are 2^31 triangles or
    /// more.
    pub fn draw(
        &mut self,
        clip_from_model: Mat4,
        vertices: &[impl Positioned],
        triangles: &[Triangle],
        sides: Sides,
        visible: &mut VisibilityBuffer,
    ) {
        let width = visible.width();
        let height = visible.height();
        if width * height == 0 {
            return;
        }
        let screen = Screen::new(clip_from_model, width, height);
        self.bands.sort(screen, (width, height), vertices, triangles, sides);
        let bands = visible.values_mut().par_chunks_mut(width * BAND).enumerate();
        bands.for_each(|(band, pixels)| {
            pixels.fill(Fragment::EMPTY);
            self.bands.for_each_shape(band, triangles, |shape: &Shape| {
                fill(shape, band * BAND, width, pixels);
            });
        });
    }
}

/// A thread draws this many rows of pixels at a time.
pub(super) const BAND: usize = 16;

/// A thread sorts this many triangles into bands at a time.
const CHUNK: usize = 2048;

/// An entry of a band has this bit if it is the index of a piece of a clipped triangle.
const PIECE: u32 = 1 << 31;

/// Which sides of triangles to draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sides {
    /// Front and back faces.
    Both,
    /// Only faces with corners that run counter-clockwise in the picture. Use this for a closed
    /// surface seen from outside, where nothing else is visible.
    Front,
}

/// Projected triangles by the bands in which they may have pixels. It keeps its memory between
/// pictures.
#[derive(Debug, Clone, Default)]
pub(super) struct Bands {
    corners: Vec<Corner>,
    chunks: Vec<Chunk>,
}

#[derive(Debug, Clone, Default)]
struct Chunk {
    /// For each band the triangles to draw there, or pieces of clipped ones ([`PIECE`]).
    bands: Vec<Vec<u32>>,
    pieces: Vec<Piece>,
}

#[derive(Debug, Clone)]
struct Piece {
    triangle: u32,
    corners: [Corner; 3],
    weights: [[f32; 2]; 3],
}

impl Bands {
    /// Projects triangles to a picture of (width, height) pixels and sorts them. This drops what
    /// you sorted before.
    ///
    /// # Panics
    /// If a triangle has a corner that `vertices` does not have, or there are 2^31 triangles or
    /// more.
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

    /// Calls `draw` with each shape of `band`, in the order of `triangles`, which must be the list
    /// that you sorted. The band starts at row [`BAND`] times its index.
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

    /// Adds `entry` to the bands in which the triangle with these corners may have pixels.
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

/// A triangle or a piece of a clipped one. Its corners run clockwise in the picture.
pub(super) struct Shape {
    triangle: u32,
    corners: [Corner; 3],
    /// Barycentric weights of the whole triangle's second and third corner, at each of
    /// this shape's corners.
    weights: [[f32; 2]; 3],
    twice_area: i64,
    /// Whether its corners were counter-clockwise in the picture.
    front: bool,
}

impl Shape {
    pub(super) fn whole(triangle: u32, at: [u32; 3], corners: &[Corner]) -> Self {
        let corners = at.map(|corner| corners[corner as usize]);
        Self::cut(triangle, corners, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    }

    pub(super) fn cut(triangle: u32, corners: [Corner; 3], weights: [[f32; 2]; 3]) -> Self {
        let [a, b, c] = corners;
        let [at_a, at_b, at_c] = weights;
        let twice_area = i64::from(b.x - a.x) * i64::from(c.y - a.y)
            - i64::from(c.x - a.x) * i64::from(b.y - a.y);
        match twice_area < 0 {
            false => Self { triangle, corners, weights, twice_area, front: false },
            true => Self {
                triangle,
                corners: [a, c, b],
                weights: [at_a, at_c, at_b],
                twice_area: -twice_area,
                front: true,
            },
        }
    }

    /// Index of the triangle that this is or belongs to.
    pub(super) fn triangle(&self) -> u32 {
        self.triangle
    }

    /// Whether its corners are counter-clockwise in the picture, as a front face has them.
    pub(super) fn is_front(&self) -> bool {
        self.front
    }

    pub(super) fn greatest_depth(&self) -> f32 {
        let [a, b, c] = &self.corners;
        a.depth.max(b.depth).max(c.depth)
    }

    /// The columns in which it may have pixels, in a picture of `width` columns.
    pub(super) fn columns(&self, width: usize) -> Range<usize> {
        let [a, b, c] = &self.corners;
        pixel_range(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x), width)
    }

    /// Depth where its second and third corner have these weights in the picture.
    #[inline]
    pub(super) fn depth(&self, second: f32, third: f32) -> f32 {
        let [a, b, c] = &self.corners;
        a.depth + (second * (b.depth - a.depth) + third * (c.depth - a.depth))
    }

    /// Shares of its corners in 1 / w where the second and third corner have these weights in the
    /// picture. These add up to 1 / w.
    #[inline]
    pub(super) fn inverse_w(&self, second: f32, third: f32) -> [f32; 3] {
        let [a, b, c] = &self.corners;
        [(1.0 - second - third) * a.inverse_w, second * b.inverse_w, third * c.inverse_w]
    }
}

/// An edge function: twice the signed area between the edge and the centre of a pixel,
/// positive inside.
#[derive(Clone, Copy)]
struct Edge {
    value: i64,
    by_column: i64,
    by_row: i64,
    /// Least value that counts as inside (the fill rule). This is 0 on upper and left edges, else
    /// 1.
    least: i64,
}

impl Edge {
    fn new(from: &Corner, to: &Corner, column: usize, row: usize) -> Self {
        fn center(pixel: usize) -> i64 {
            pixel as i64 * i64::from(STEPS) + i64::from(STEPS / 2)
        }
        let [dx, dy] = [i64::from(to.x - from.x), i64::from(to.y - from.y)];
        let [x, y] = [center(column) - i64::from(from.x), center(row) - i64::from(from.y)];
        let upper_or_left = dy < 0 || (dy == 0 && dx > 0);
        Self {
            value: dx * y - dy * x,
            by_column: -dy * i64::from(STEPS),
            by_row: dx * i64::from(STEPS),
            least: i64::from(!upper_or_left),
        }
    }
}

/// Calls `visit` with each pixel of `shape` among `pixels`. These are whole rows of `width`, from
/// row `first_row` on. `visit` gets the index, the pixel, and the weights of the shape's second
/// and third corner in the picture.
#[inline(always)]
pub(super) fn cover<P>(
    shape: &Shape,
    first_row: usize,
    width: usize,
    pixels: &mut [P],
    mut visit: impl FnMut(usize, &mut P, f32, f32),
) {
    let [a, b, c] = &shape.corners;
    let all_rows = pixel_range(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y), usize::MAX);
    let last_row = first_row + pixels.len() / width;
    let rows = all_rows.start.max(first_row)..all_rows.end.min(last_row);
    let columns = shape.columns(width);
    let mut edges =
        [(b, c), (c, a), (a, b)].map(|(from, to)| Edge::new(from, to, columns.start, rows.start));
    let per_area = 1.0 / shape.twice_area as f32;
    for row in rows {
        let first = (row - first_row) * width + columns.start;
        let pixels = &mut pixels[first..][..columns.len()];
        let [mut of_a, mut of_b, mut of_c] = edges.map(|edge| edge.value - edge.least);
        let mut entered = false;
        for (pixel, index) in pixels.iter_mut().zip(first..) {
            if of_a | of_b | of_c >= 0 {
                entered = true;
                let second = (of_b + edges[1].least) as f32 * per_area;
                let third = (of_c + edges[2].least) as f32 * per_area;
                visit(index, pixel, second, third);
            } else if entered {
                break;
            }
            of_a += edges[0].by_column;
            of_b += edges[1].by_column;
            of_c += edges[2].by_column;
        }
        for edge in &mut edges {
            edge.value += edge.by_row;
        }
    }
}

/// Draws `shape` into `pixels` wherever it is nearer than what they show. These are whole rows of
/// `width`, from row `first_row` on.
pub(super) fn fill(shape: &Shape, first_row: usize, width: usize, pixels: &mut [Fragment]) {
    cover(shape, first_row, width, pixels, |_, pixel, second, third| {
        let depth = shape.depth(second, third);
        if depth < pixel.depth {
            let [first, second, third] = shape.inverse_w(second, third);
            let whole = 1.0 / (first + second + third);
            let [second, third] = [0, 1].map(|i: usize| {
                let [by_a, by_b, by_c] = shape.weights.map(|weights| weights[i]);
                (first * by_a + second * by_b + third * by_c) * whole
            });
            *pixel = Fragment { triangle: shape.triangle, second, third, depth };
        }
    });
}

/// We round vertices to this many steps per pixel, so that edge functions are exact in integers.
/// Graphics devices do this too (8 bits of sub-pixel precision).
pub(super) const STEPS: i32 = 256;

/// Size of the guard band. We clip triangles where they reach further than this from the centre of
/// the picture, in halves of its size. This keeps edge functions within 64 bits.
const GUARD: f32 = 16.0;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    /// Distance from the left edge, in [`STEPS`] of a pixel.
    pub(super) x: i32,
    /// Distance from the upper edge, in [`STEPS`] of a pixel.
    pub(super) y: i32,
    /// Depth, 0 (near plane) to 1 (far plane).
    pub(super) depth: f32,
    /// 1 / w of the clip coordinates. If the vertex is outside the guard band, this is 0, and `x`
    /// has one bit for each plane of [`PLANES`] that the vertex is beyond.
    pub(super) inverse_w: f32,
}

/// Transforms model coordinates to pixels of a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Screen {
    clip_from_model: Mat4,
    half_width: f32,
    half_height: f32,
    planes: [Vec4; 6],
}

#[derive(Debug, Clone, Copy)]
struct ClippedCorner {
    clip: Vec4,
    /// Barycentric weights of the triangle's second and third corner.
    weights: [f32; 2],
}

impl Screen {
    pub(super) fn new(clip_from_model: Mat4, width: usize, height: usize) -> Self {
        let [half_width, half_height] = [width, height].map(|cells| cells as f32 / 2.0);
        Self { clip_from_model, half_width, half_height, planes: PLANES }
    }

    /// This transform without a far plane. Nothing is too far away, and depth may exceed 1.
    pub(super) fn without_far_plane(mut self) -> Self {
        self.planes[FAR] = BEFORE_EYE;
        self
    }

    fn corner(&self, position: [f32; 3]) -> Corner {
        let clip = self.clip(position);
        match self
            .planes
            .iter()
            .fold(0, |bits, plane| bits << 1 | i32::from(plane.dot(clip) < 0.0 || clip.is_nan()))
        {
            0 => self.project(clip),
            x => Corner { x, y: 0, depth: 0.0, inverse_w: 0.0 },
        }
    }

    fn clip(&self, [x, y, z]: [f32; 3]) -> Vec4 {
        self.clip_from_model * Vec4::new(x, y, z, 1.0)
    }

    fn project(&self, clip: Vec4) -> Corner {
        let inverse_w = 1.0 / clip.w;
        fn steps(at: f32, half: f32) -> i32 {
            ((1.0 + at) * (half * STEPS as f32)).round() as i32
        }
        Corner {
            x: steps(clip.x * inverse_w, self.half_width),
            y: steps(-clip.y * inverse_w, self.half_height),
            depth: clip.z * inverse_w,
            inverse_w,
        }
    }

    /// Projects many positions of the model. This overwrites `corners`.
    pub(super) fn corners(&self, positions: &[impl Positioned], corners: &mut Vec<Corner>) {
        let each = positions.par_iter().with_min_len(1 << 11).map(|at| self.corner(at.position()));
        each.collect_into_vec(corners);
    }

    /// Clips a triangle to the view frustum plus guard band. You get a convex polygon of 0 or 3 to
    /// 9 projected corners, each with the barycentric weights of the triangle's second and third
    /// corner.
    pub(super) fn clip_triangle(&self, positions: [[f32; 3]; 3]) -> Vec<(Corner, [f32; 2])> {
        let weights = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let clips = positions.map(|position| self.clip(position));
        let mut polygon: Vec<ClippedCorner> = clips
            .into_iter()
            .zip(weights)
            .map(|(clip, weights)| ClippedCorner { clip, weights })
            .collect();
        for plane in self.planes {
            let sides: Vec<f32> = polygon.iter().map(|at| plane.dot(at.clip)).collect();
            let mut left = Vec::with_capacity(polygon.len() + 1);
            for (i, &here) in polygon.iter().enumerate() {
                let next = (i + 1) % polygon.len();
                if sides[i] >= 0.0 {
                    left.push(here);
                }
                // We always interpolate from the inside outwards, so that two triangles that share
                // the edge are clipped at the same point.
                if sides[i] >= 0.0 && sides[next] < 0.0 {
                    left.push(interpolated(
                        here,
                        polygon[next],
                        sides[i] / (sides[i] - sides[next]),
                    ));
                } else if sides[i] < 0.0 && sides[next] >= 0.0 {
                    left.push(interpolated(
                        polygon[next],
                        here,
                        sides[next] / (sides[next] - sides[i]),
                    ));
                }
            }
            polygon = left;
        }
        polygon.iter().map(|at| (self.project(at.clip), at.weights)).collect()
    }
}

/// Position of the far plane in [`PLANES`].
const FAR: usize = 1;

/// The plane through the eye parallel to the picture. Everything beyond the near plane is inside.
const BEFORE_EYE: Vec4 = Vec4::W;

/// Near and far plane, then the four planes of the guard band. A point is inside where the
/// dot product with its clip coordinates is not negative.
const PLANES: [Vec4; 6] = [
    Vec4::new(0.0, 0.0, 1.0, 0.0),
    Vec4::new(0.0, 0.0, -1.0, 1.0),
    Vec4::new(1.0, 0.0, 0.0, GUARD),
    Vec4::new(-1.0, 0.0, 0.0, GUARD),
    Vec4::new(0.0, 1.0, 0.0, GUARD),
    Vec4::new(0.0, -1.0, 0.0, GUARD),
];

fn interpolated(from: ClippedCorner, to: ClippedCorner, share: f32) -> ClippedCorner {
    let weights =
        std::array::from_fn(|i| from.weights[i] + (to.weights[i] - from.weights[i]) * share);
    ClippedCorner { clip: from.clip + (to.clip - from.clip) * share, weights }
}

/// The pixels with a centre from `low` to `high`, in a row or column of `count` pixels. Both limits
/// are in [`STEPS`] of a pixel.
pub(super) fn pixel_range(low: i32, high: i32, count: usize) -> Range<usize> {
    let first = (low + STEPS / 2 - 1).div_euclid(STEPS).max(0) as usize;
    let after = ((high + STEPS / 2).div_euclid(STEPS).max(0) as usize).min(count);
    first..after.max(first)
}
