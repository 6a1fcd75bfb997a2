//! Rasterisation of the facets near the canvas.

use std::ops::Range;

use super::locks::Lock;
use super::net::Point;
use super::surface::LimitSurface;
use crate::contact::{Contact, Touch};
use graphics::lanes::{greater, lesser};
use graphics::tile::Rect;

/// The number 1 in fixed point with 16 fractional bits, the format of values interpolated
/// along a row.
const ONE: f32 = 65536.0;

/// Indices of the values interpolated over a facet: height in quanta, velocity along x and y in
/// 1/256 cell per sub-step, speed weight, and paint cells around and along from the facet's
/// first. All but the height are times 65536.
const HEIGHT: usize = 0;
const X: usize = 1;
const Y: usize = 2;
const SPEED: usize = 3;
const AROUND: usize = 4;
const ALONG: usize = 5;

/// Rasterises the surface of a head into a contact. Vertices are x and y in cells from an
/// origin, then height in quanta, velocity in x and y in 1/256 cell per sub-step and speed
/// weight, these three times 65536.
#[derive(Debug, Clone)]
pub(super) struct Footprint {
    /// Whether each facet has hair; empty if all have.
    hair: Vec<bool>,
    facets: Vec<Facet>,
    /// Number of canvas cells under each paint cell.
    sharers: Vec<u16>,
    /// Columns of each row of the contact between which all touches lie.
    spans: Vec<Range<usize>>,
    /// Number of paint cells in a row.
    width: u32,
}

/// A facet to draw: its corners and the first of its paint cells.
#[derive(Debug, Clone, Copy)]
struct Facet {
    corners: [u32; 4],
    cell: u32,
}

impl Footprint {
    /// A footprint of a head of `width` x `height` paint cells with hair on these facets.
    pub(super) fn new(width: usize, height: usize, hair: Vec<bool>) -> Self {
        let sharers = vec![0; width * height];
        let width = width as u32;
        Self { hair, facets: Vec::new(), sharers, spans: Vec::new(), width }
    }

    /// Fills `out` with the part of `surface` below `ceiling` (in quanta) and within the cells
    /// of `bounds`, in coordinates from the cell `origin`. `locks` are those of each column of
    /// paint cells.
    #[inline(always)]
    pub(super) fn draw(
        &mut self,
        surface: &LimitSurface,
        locks: &[Lock],
        ceiling: f32,
        origin: (i64, i64),
        bounds: Rect,
        out: &mut Contact,
    ) {
        let reach = self.choose(surface, ceiling);
        out.rect = cells_within(reach, origin, bounds);
        out.touches.resize(out.rect.width * out.rect.height, Touch::NONE);
        self.spans.clear();
        self.spans.resize(out.rect.height, 0..0);
        if out.rect.is_empty() {
            return;
        }
        let first = ((out.rect.x as i64 - origin.0) as f32, (out.rect.y as i64 - origin.1) as f32);
        let (cells_around, cells_along) = surface.cells_of_facet();
        let around = cells_around as f32 * ONE;
        let along = cells_along as f32 * ONE;
        let most = (cells_around as i32 - 1, cells_along as i32 - 1);
        for facet in &self.facets {
            let [a, b, c, d] = facet.corners.map(|i| &surface.vertices[i as usize]);
            let corners = [
                Corner::new(a, first, (0.0, 0.0)),
                Corner::new(b, first, (around, 0.0)),
                Corner::new(c, first, (0.0, along)),
                Corner::new(d, first, (around, along)),
            ];
            let mut canvas = Canvas {
                touches: &mut out.touches,
                spans: &mut self.spans,
                width: out.rect.width,
                height: out.rect.height,
                cell: facet.cell,
                row: self.width,
                most,
                locks: &locks[facet.cell as usize % locks.len()..],
            };
            canvas.triangle(&corners[0], &corners[1], &corners[2]);
            canvas.triangle(&corners[3], &corners[2], &corners[1]);
        }
        self.count(out);
    }

    /// The columns of each row of the contact drawn last between which all touches lie.
    pub(super) fn spans(&self) -> &[Range<usize>] {
        &self.spans
    }

    /// Collects the facets that face the canvas and reach below `ceiling`. Returns their extent
    /// in cells: lowest x and y, highest x and y.
    #[inline(always)]
    fn choose(&mut self, surface: &LimitSurface, ceiling: f32) -> [f32; 4] {
        self.facets.clear();
        let (around, along) = surface.facets();
        let (cells_around, cells_along) = surface.cells_of_facet();
        let span = surface.facets_of_span();
        let mut reach = [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY];
        for row in 0..along {
            for first in (0..around).step_by(span) {
                if !surface.is_near(first, row) {
                    continue;
                }
                for column in first..first + span {
                    if self.hair.get(row * around + column) == Some(&false) {
                        continue;
                    }
                    let next = if column + 1 < around { column + 1 } else { 0 };
                    let corners = [
                        row * around + column,
                        row * around + next,
                        (row + 1) * around + column,
                        (row + 1) * around + next,
                    ];
                    let [a, b, c, d] = corners.map(|i| &surface.vertices[i]);
                    let looks = (d[0] - a[0]) * (c[1] - b[1]) - (d[1] - a[1]) * (c[0] - b[0]);
                    let lowest = lesser(lesser(a[2], b[2]), lesser(c[2], d[2]));
                    if looks <= 0.0 || lowest >= ceiling {
                        continue;
                    }
                    for v in [a, b, c, d] {
                        reach[0] = lesser(v[0], reach[0]);
                        reach[1] = lesser(v[1], reach[1]);
                        reach[2] = greater(v[0], reach[2]);
                        reach[3] = greater(v[1], reach[3]);
                    }
                    self.facets.push(Facet {
                        corners: corners.map(|i| i as u32),
                        cell: (row * cells_along) as u32 * self.width
                            + (column * cells_around) as u32,
                    });
                }
            }
        }
        reach
    }

    /// Sets in each touch the number of touches that share its paint cell.
    #[inline(always)]
    fn count(&mut self, contact: &mut Contact) {
        let Self { sharers, spans, .. } = self;
        let touching = |touch: &&Touch| touch.height != Touch::NONE.height;
        for touch in within(&contact.touches, contact.rect.width, spans).filter(touching) {
            let sharers = &mut sharers[touch.brush_cell as usize];
            *sharers = sharers.saturating_add(1);
        }
        let rows = contact.touches.chunks_exact_mut(contact.rect.width);
        for touch in rows.zip(&*spans).flat_map(|(row, span)| row.get_mut(span.clone())).flatten() {
            if touch.height != Touch::NONE.height {
                touch.weights |= u32::from(sharers[touch.brush_cell as usize]) << 16;
            }
        }
        for touch in within(&contact.touches, contact.rect.width, spans).filter(touching) {
            sharers[touch.brush_cell as usize] = 0;
        }
    }
}

/// The touches of the `spans` of the rows, which are `width` long.
#[inline(always)]
fn within<'a>(
    touches: &'a [Touch],
    width: usize,
    spans: &'a [Range<usize>],
) -> impl Iterator<Item = &'a Touch> {
    let rows = touches.chunks_exact(width).zip(spans);
    rows.flat_map(|(row, span)| row.get(span.clone()).unwrap_or_default())
}

/// Cells of `bounds` whose centre may lie within `reach`.
fn cells_within(reach: [f32; 4], origin: (i64, i64), bounds: Rect) -> Rect {
    if reach[0] > reach[2] {
        return Rect::default();
    }
    let side = |low: f32, high: f32, origin: i64, start: usize, count: usize| {
        let (start, end) = (start as i64, (start + count) as i64);
        let low = (origin + (low - 0.5).ceil() as i64).clamp(start, end);
        let high = (origin + (high - 0.5).ceil() as i64).clamp(start, end);
        (low as usize, (high - low) as usize)
    };
    let (x, width) = side(reach[0], reach[2], origin.0, bounds.x, bounds.width);
    let (y, height) = side(reach[1], reach[3], origin.1, bounds.y, bounds.height);
    let rect = Rect { x, y, width, height };
    if rect.is_empty() { Rect::default() } else { rect }
}

/// A corner of a facet, in cells from the first cell of the contact.
struct Corner {
    x: f32,
    y: f32,
    values: Point,
}

impl Corner {
    /// The corner at `vertex`, in cells from the cell `first`. `cells` are its paint cells around
    /// and along from the facet's first, times 65536.
    #[inline(always)]
    fn new(vertex: &Point, first: (f32, f32), cells: (f32, f32)) -> Self {
        let &[x, y, height, right, down, speed, ..] = vertex;
        let values = [height, right, down, speed, cells.0, cells.1, 0.0, 0.0];
        Self { x: x - first.0, y: y - first.1, values }
    }
}

/// Target of the rasterisation of a facet.
struct Canvas<'a> {
    touches: &'a mut [Touch],
    spans: &'a mut [Range<usize>],
    width: usize,
    height: usize,
    /// First paint cell of the facet, and number of paint cells in a row.
    cell: u32,
    row: u32,
    /// Index of the facet's last paint cell, around and along.
    most: (i32, i32),
    /// Locks from the first column of the facet on.
    locks: &'a [Lock],
}

impl Canvas<'_> {
    /// Rasterises a triangle whose corners follow each other in the direction from the x axis
    /// to the y axis; others are skipped. A cell centre on an edge belongs
    /// to the triangle right of it or below it.
    #[inline(always)]
    fn triangle(&mut self, a: &Corner, b: &Corner, c: &Corner) {
        let bx = b.x - a.x;
        let by = b.y - a.y;
        let cx = c.x - a.x;
        let cy = c.y - a.y;
        let area = bx * cy - by * cx;
        if area <= 0.0 {
            return;
        }
        let top = first_middle(lesser(lesser(a.y, b.y), c.y), self.height);
        let bottom = first_middle(greater(greater(a.y, b.y), c.y), self.height);
        if top >= bottom {
            return;
        }
        let (right, down) = slopes(a, b, c, [bx / area, by / area, cx / area, cy / area]);
        let edges = [Edge::new(a, b), Edge::new(b, c), Edge::new(c, a)];
        let step = whole(&right);
        // The slopes of a sliver are inaccurate, so heights are clamped to those of its corners.
        let heights = [a, b, c].map(|corner| corner.values[HEIGHT]);
        let lowest = lesser(lesser(heights[0], heights[1]), heights[2]);
        let highest = greater(greater(heights[0], heights[1]), heights[2]);
        for y in top..bottom {
            let middle = y as f32 + 0.5;
            let mut from = 0.0_f32;
            let mut to = self.width as f32;
            for edge in &edges {
                let x = edge.x + (middle - edge.y) * edge.slope;
                from = if edge.side < 0.0 { greater(from, x) } else { from };
                to = if edge.side > 0.0 { lesser(to, x) } else { to };
            }
            let start = first_middle(from, self.width);
            let end = first_middle(to, self.width);
            if start >= end {
                continue;
            }
            let span = &mut self.spans[y];
            let first = if span.end == 0 { start } else { span.start.min(start) };
            *span = first..span.end.max(end);
            let x = start as f32 + 0.5 - a.x;
            let y_off = middle - a.y;
            let mut begin = a.values;
            for i in 0..8 {
                begin[i] += right[i] * x + down[i] * y_off;
            }
            begin[HEIGHT] = lesser(greater(begin[HEIGHT], lowest), highest);
            let row = &mut self.touches[y * self.width..][start..end];
            let mut at = whole(&begin);
            for touch in row {
                let around = (at[AROUND] >> 16).max(0).min(self.most.0) as u32;
                let lock = self.locks[around as usize];
                let height = at[HEIGHT] + lock.recess;
                if height < touch.height {
                    let along = (at[ALONG] >> 16).max(0).min(self.most.1) as u32;
                    touch.height = height;
                    touch.brush_cell = self.cell + along * self.row + around;
                    touch.velocity = (at[X] as u32) >> 16 | (at[Y] as u32) & 0xffff_0000;
                    touch.weights = (at[SPEED] >> 16).clamp(0, 256) as u32 | lock.release;
                }
                for i in 0..8 {
                    at[i] = at[i].wrapping_add(step[i]);
                }
            }
        }
    }
}

/// Change of the values per cell along x and along y.
#[inline(always)]
fn slopes(a: &Corner, b: &Corner, c: &Corner, [bx, by, cx, cy]: [f32; 4]) -> (Point, Point) {
    let mut right = [0.0; 8];
    let mut down = [0.0; 8];
    for i in 0..8 {
        let to_b = b.values[i] - a.values[i];
        let to_c = c.values[i] - a.values[i];
        right[i] = to_b * cy - to_c * by;
        down[i] = to_c * bx - to_b * cx;
    }
    (right, down)
}

/// Line through two corners, the same to the bit for either order of the corners.
struct Edge {
    x: f32,
    y: f32,
    slope: f32,
    /// Negative left of the triangle, positive right of it.
    side: f32,
}

impl Edge {
    #[inline(always)]
    fn new(from: &Corner, to: &Corner) -> Self {
        let side = to.y - from.y;
        let (upper, lower) = if side > 0.0 { (from, to) } else { (to, from) };
        // Horizontal edges bound no row; their slope is never used.
        let slope = (lower.x - upper.x) / (lower.y - upper.y);
        Self { x: upper.x, y: upper.y, slope, side }
    }
}

/// First cell, up to `end`, whose centre is at `place` or beyond.
#[inline(always)]
fn first_middle(place: f32, end: usize) -> usize {
    let cells = lesser(greater(place - 0.5, 0.0), end as f32);
    let near = nearest(cells);
    (near + i32::from((near as f32) < cells)) as usize
}

#[inline(always)]
fn whole(values: &Point) -> [i32; 8] {
    // A loop, since the closure of `map` is not always inlined.
    let mut wholes = [0; 8];
    for i in 0..8 {
        wholes[i] = nearest(values[i]);
    }
    wholes
}

/// Low 32 bits of the nearest whole number. Avoids the range checks of `as`, which take longer
/// than the rest of a row.
#[inline(always)]
fn nearest(value: f32) -> i32 {
    /// 1.5 * 2^52: near this number, neighbouring f64 values are 1 apart.
    const UNIT: f64 = 6_755_399_441_055_744.0;
    (f64::from(value) + UNIT).to_bits() as i32
}
