//! The pixels of one triangle.

use std::ops::Range;

use super::screen::{Corner, STEPS, pixel_range};
use super::visibility::Fragment;

/// A triangle or a piece of a clipped one, its corners clockwise in the picture.
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

    /// Index of the triangle that it is or belongs to.
    pub(super) fn triangle(&self) -> u32 {
        self.triangle
    }

    /// Whether its corners are counter-clockwise in the picture, as a front face has them.
    pub(super) fn is_front(&self) -> bool {
        self.front
    }

    /// Greatest depth of a corner.
    pub(super) fn greatest_depth(&self) -> f32 {
        let [a, b, c] = &self.corners;
        a.depth.max(b.depth).max(c.depth)
    }

    /// The columns, out of `width`, in which it may have pixels.
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

    /// Shares of its corners in 1 / w where the second and third corner have these weights
    /// in the picture; they add up to 1 / w.
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
    /// Value at the first pixel of the row.
    value: i64,
    by_column: i64,
    by_row: i64,
    /// Least value that counts as inside: 0 on upper and left edges, else 1 (the fill rule).
    least: i64,
}

impl Edge {
    fn new(from: &Corner, to: &Corner, column: usize, row: usize) -> Self {
        let center = |pixel: usize| pixel as i64 * i64::from(STEPS) + i64::from(STEPS / 2);
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

/// Calls `visit` with each pixel of `shape` among `pixels`, which are whole rows of `width`
/// from row `first_row` on: its index, the pixel, and the weights of the shape's second and
/// third corner in the picture.
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
    let edge = |from, to| Edge::new(from, to, columns.start, rows.start);
    let mut edges = [edge(b, c), edge(c, a), edge(a, b)];
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

/// Draws `shape` into `pixels`, which are whole rows of `width` from row `first_row` on,
/// wherever it is nearer than what they show.
pub(super) fn fill(shape: &Shape, first_row: usize, width: usize, pixels: &mut [Fragment]) {
    cover(shape, first_row, width, pixels, |_, pixel, second, third| {
        let depth = shape.depth(second, third);
        if depth < pixel.depth {
            let [first, second, third] = shape.inverse_w(second, third);
            let whole = 1.0 / (first + second + third);
            let at = |i: usize| {
                let [by_a, by_b, by_c] = shape.weights.map(|weights| weights[i]);
                (first * by_a + second * by_b + third * by_c) * whole
            };
            *pixel = Fragment { triangle: shape.triangle, second: at(0), third: at(1), depth };
        }
    });
}
