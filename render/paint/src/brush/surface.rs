//! Limit surface of the control net, as a grid of facets.
//!
//! Over a regular net the limit of Catmull-Clark subdivision (1978) is the uniform bicubic
//! B-spline, so that it can be evaluated directly.

use super::b_spline::b_spline;
use super::net::{Net, Point, ROWS};
use graphics::lanes::lesser;

/// Number of paint cells of a facet along the head and around it, if the head has enough cells.
/// The head bends along its hair, so its facets are shorter there.
const ALONG: f32 = 4.0;
const AROUND: f32 = 6.0;

/// Longest spans along the head and around it, in paint cells, whose facets are that long: those of
/// a round brush of 60 cells.
const SPAN_ALONG: f32 = 30.0;
const SPAN_AROUND: f32 = 24.0;

/// Maximum number of paint cells of a head. On a larger head they are wider than the cells of
/// the canvas.
const MOST_CELLS: f32 = 1_048_576.0;

/// Number of spans of the surface along the head.
pub(super) const SPANS: usize = ROWS - 3;

/// Division of a span, along or around, into facets.
#[derive(Debug, Clone)]
struct Span {
    facets: usize,
    /// Number of paint cells of each facet.
    cells: usize,
    /// Weights of the four control points at the start of each facet and at the end of the span.
    weights: Vec<[f32; 4]>,
}

impl Span {
    /// Facets of a span of `length` paint cells, each of about `facet` cells. On a span longer than
    /// `usual`, facets grow with the square root of its length: a larger head bends less, so they
    /// stay as near to its surface.
    fn new(length: f32, facet: f32, usual: f32) -> Self {
        let facet = (facet * (length / usual).max(1.0).sqrt()).round();
        let facets = (length / facet).round().max(1.0);
        let cells = (length / facets).round().clamp(1.0, facet);
        let weights = (0..=facets as usize).map(|i| b_spline(i as f32 / facets)).collect();
        Self { facets: facets as usize, cells: cells as usize, weights }
    }
}

/// Surface of a head; vertices row by row from the ferrule.
#[derive(Debug, Clone)]
pub(super) struct LimitSurface {
    around: Span,
    along: Span,
    columns: usize,
    /// Positions and displacements of vertices; valid where [`LimitSurface::is_near`].
    pub(super) vertices: Vec<Point>,
    near: Vec<bool>,
    /// The net evaluated along the head but not around it.
    line: Vec<Point>,
}

impl LimitSurface {
    /// Surface of a net of `columns` columns around a head of this perimeter and length, in
    /// cells of the canvas.
    pub(super) fn new(columns: usize, perimeter: f32, length: f32) -> Self {
        let cell = (perimeter * length / MOST_CELLS).sqrt().max(1.0);
        let around = Span::new(perimeter / columns as f32 / cell, AROUND, SPAN_AROUND);
        let along = Span::new(length / SPANS as f32 / cell, ALONG, SPAN_ALONG);
        let vertices = (SPANS * along.facets + 1) * columns * around.facets;
        Self {
            columns,
            vertices: vec![[0.0; 8]; vertices],
            near: vec![false; SPANS * columns],
            line: vec![[0.0; 8]; columns],
            around,
            along,
        }
    }

    /// Number of facets around and along.
    pub(super) fn facets(&self) -> (usize, usize) {
        (self.columns * self.around.facets, SPANS * self.along.facets)
    }

    /// Number of paint cells of each facet, around and along.
    pub(super) fn cells_of_facet(&self) -> (usize, usize) {
        (self.around.cells, self.along.cells)
    }

    /// Number of paint cells of the head, around and along.
    pub(super) fn cells(&self) -> (usize, usize) {
        let facets = self.facets();
        let cells = self.cells_of_facet();
        (facets.0 * cells.0, facets.1 * cells.1)
    }

    /// Whether a facet may reach below the ceiling of the last evaluation.
    #[inline]
    pub(super) fn is_near(&self, column: usize, row: usize) -> bool {
        self.near[row / self.along.facets * self.columns + column / self.around.facets]
    }

    /// Number of facets of each span around the head. [`LimitSurface::is_near`] is the same for
    /// all facets of a span.
    pub(super) fn facets_of_span(&self) -> usize {
        self.around.facets
    }

    /// Evaluates the surface where it may reach below `ceiling`, and passes each vertex with
    /// its row to `finish`.
    #[inline(always)]
    pub(super) fn evaluate(
        &mut self,
        net: &Net,
        ceiling: f32,
        mut finish: impl FnMut(usize, &mut Point),
    ) {
        self.find_near(net, ceiling);
        let columns = self.columns;
        let width = columns * self.around.facets;
        for row in 0..=SPANS * self.along.facets {
            let span = (row / self.along.facets).min(SPANS - 1);
            let step = row - span * self.along.facets;
            // A row between two spans belongs to both.
            let other = if step == 0 { span.saturating_sub(1) } else { span };
            let near = |c: usize| self.near[span * columns + c] || self.near[other * columns + c];
            if !(0..columns).any(near) {
                continue;
            }
            let weights = &self.along.weights[step];
            for (column, point) in self.line.iter_mut().enumerate() {
                let control = |i: usize| &net.points[(span + i) * columns + column];
                *point = combined(weights, control(0), control(1), control(2), control(3));
            }
            for column in 0..columns {
                let before = if column == 0 { columns - 1 } else { column - 1 };
                let count = match (near(column), near(before)) {
                    (true, _) => self.around.facets,
                    (false, true) => 1,
                    (false, false) => continue,
                };
                let after =
                    |i: usize| if column + i < columns { column + i } else { column + i - columns };
                let line = [before, column, after(1), after(2)].map(|i| self.line[i]);
                let vertices =
                    &mut self.vertices[row * width + column * self.around.facets..][..count];
                for (vertex, weights) in vertices.iter_mut().zip(&self.around.weights) {
                    *vertex = combined(weights, &line[0], &line[1], &line[2], &line[3]);
                    finish(row, vertex);
                }
            }
        }
    }

    fn find_near(&mut self, net: &Net, ceiling: f32) {
        for span in 0..SPANS {
            // The lowest of four control points along, then the lowest of four of these around.
            for column in 0..self.columns {
                let lowest = (0..4).map(|i| net.points[(span + i) * self.columns + column][2]);
                self.line[column][2] = lowest.fold(f32::INFINITY, lesser);
            }
            for column in 0..self.columns {
                let around =
                    (0..4).map(|i| self.line[(column + self.columns - 1 + i) % self.columns][2]);
                self.near[span * self.columns + column] =
                    around.fold(f32::INFINITY, lesser) < ceiling;
            }
        }
    }
}

#[inline(always)]
fn combined(weights: &[f32; 4], a: &Point, b: &Point, c: &Point, d: &Point) -> Point {
    let mut sum = [0.0; 8];
    for i in 0..8 {
        sum[i] = weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i] + weights[3] * d[i];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_sum_to_one_and_reproduce_a_line() {
        for i in 0..=10 {
            let t = i as f32 / 10.0;
            let w = b_spline(t);
            let line: f32 = w.iter().zip([-1.0, 0.0, 1.0, 2.0]).map(|(w, x)| w * x).sum();
            assert!((w.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{t}: {w:?}");
            assert!((line - t).abs() < 1e-6, "{t}: {line}");
        }
    }

    #[test]
    fn facets_have_about_as_many_cells_as_asked_for_and_large_heads_wider_ones() {
        for length in 8..200 {
            let span = Span::new(length as f32, 6.0, 200.0);
            let cell = length as f32 / (span.facets * span.cells) as f32;
            assert!((4..=6).contains(&span.cells), "{length}: {span:?}");
            assert!((0.8..1.5).contains(&cell), "{length}: {cell}");
        }
        let of_a_long_span = Span::new(96.0, AROUND, SPAN_AROUND);
        assert_eq!((of_a_long_span.facets, of_a_long_span.cells), (8, 12), "twice as long");
        let large = LimitSurface::new(8, 6000.0, 5000.0);
        let around = large.facets();
        let along = large.cells_of_facet();
        let cells = around.0 * along.0 * around.1 * along.1;
        assert!(cells < 1_100_000, "{cells}");
    }
}
