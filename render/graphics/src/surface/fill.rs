//! Fills the pixels of one triangle.

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
}

impl Shape {
    pub(super) fn whole(triangle: u32, at: [u32; 3], corners: &[Corner]) -> Self {
        let corners = at.map(|corner| corners[corner as usize]);
        Self::cut(triangle, corners, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    }

    pub(super) fn cut(triangle: u32, corners: [Corner; 3], weights: [[f32; 2]; 3]) -> Self {
        let ([a, b, c], [at_a, at_b, at_c]) = (corners, weights);
        let twice_area = i64::from(b.x - a.x) * i64::from(c.y - a.y)
            - i64::from(c.x - a.x) * i64::from(b.y - a.y);
        match twice_area < 0 {
            false => Self { triangle, corners, weights, twice_area },
            true => Self {
                triangle,
                corners: [a, c, b],
                weights: [at_a, at_c, at_b],
                twice_area: -twice_area,
            },
        }
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

/// Draws `shape` into `pixels`, which are whole rows of `width` from row `first_row` on,
/// wherever it is nearer than what they show.
pub(super) fn fill(shape: &Shape, first_row: usize, width: usize, pixels: &mut [Fragment]) {
    let [a, b, c] = &shape.corners;
    let all_rows = pixel_range(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y), usize::MAX);
    let last_row = first_row + pixels.len() / width;
    let rows = all_rows.start.max(first_row)..all_rows.end.min(last_row);
    let columns = pixel_range(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x), width);
    let edge = |from, to| Edge::new(from, to, columns.start, rows.start);
    let mut edges = [edge(b, c), edge(c, a), edge(a, b)];
    let per_area = 1.0 / shape.twice_area as f32;
    let [to_b, to_c] = [b.depth - a.depth, c.depth - a.depth];
    for row in rows {
        let pixels = &mut pixels[(row - first_row) * width..][columns.clone()];
        let [mut of_a, mut of_b, mut of_c] = edges.map(|edge| edge.value - edge.least);
        let mut entered = false;
        for pixel in pixels {
            if of_a | of_b | of_c >= 0 {
                entered = true;
                let second = (of_b + edges[1].least) as f32 * per_area;
                let third = (of_c + edges[2].least) as f32 * per_area;
                let depth = a.depth + (second * to_b + third * to_c);
                if depth < pixel.depth {
                    let [first, second, third] = [
                        (1.0 - second - third) * a.inverse_w,
                        second * b.inverse_w,
                        third * c.inverse_w,
                    ];
                    let whole = 1.0 / (first + second + third);
                    let at = |i: usize| {
                        let [by_a, by_b, by_c] = shape.weights.map(|weights| weights[i]);
                        (first * by_a + second * by_b + third * by_c) * whole
                    };
                    *pixel =
                        Fragment { triangle: shape.triangle, second: at(0), third: at(1), depth };
                }
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
