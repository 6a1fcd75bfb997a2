//! The contact of a bent head with the canvas. We draw the facets near the canvas cell by cell.
//!
//! Drawing does not change the head, so you can draw several sub-steps side by side.
//!
//! A pressed head squeezes paint to its sides, where it stands up as a lip. This flow is between
//! the hairs, below the size of a cell, so we do not compute it. Instead we make the coat thicker
//! near the sides of the contact.
//!
//! A side that crosses the rows of cells at a small angle takes one cell after another. We let the
//! velocity fall to 0 over the last cell. Otherwise the paint that the head drags along would stay
//! as a bead in each cell that the side leaves.

use std::ops::Range;

use graphics::lanes::{greater, lesser};
use graphics::tile::Rect;
use pulp::{Simd, WithSimd};

use super::locks::Lock;
use super::relief::Relief;
use super::spines::Grip;
use super::surface::{LimitSurface, Net, Point};
use crate::amount::QUANTA_PER_CELL;
use crate::contact::{Contact, Touch};

/// The number 1 in fixed point with 16 fractional bits. We use this format for values interpolated
/// along a row.
const ONE: f32 = 65536.0;

/// Indices of the values that we interpolate over a facet: height in quanta, velocity along x and y
/// in 1/256 cell per sub-step, speed weight, and the number of paint cells around and along from
/// the facet's first cell. All except the height are multiplied by 65536.
const HEIGHT: usize = 0;
const X: usize = 1;
const Y: usize = 2;
const SPEED: usize = 3;
const AROUND: usize = 4;
const ALONG: usize = 5;

/// Rasterises the surface of a head into a contact. Vertices are x and y in cells from an origin,
/// then height in quanta, velocity in x and y in 1/256 cell per sub-step and speed weight. We
/// multiply the last three by 65536.
#[derive(Debug, Clone)]
pub(super) struct Footprint {
    facets: Vec<Facet>,
    /// Number of canvas cells under each paint cell.
    sharers: Vec<u16>,
    /// For each row of the contact, the columns between which all touches lie.
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

/// Height in cells by which hair that bends away rises from one row of paint cells to the next (chosen by
/// eye).
const BENDS: f32 = 0.4;

impl Footprint {
    /// A footprint of a head of `width` x `height` paint cells.
    pub(super) fn new(width: usize, height: usize) -> Self {
        let sharers = vec![0; width * height];
        let width = width as u32;
        Self { facets: Vec::new(), sharers, spans: Vec::new(), width }
    }

    /// Fills `out` with the part of `surface` below `ceiling` (in quanta) and within the cells of
    /// `bounds`, in coordinates from the cell `origin`. `locks` has the lock of each column of
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
        let rise = (BENDS * QUANTA_PER_CELL as f32) as i32;
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
                first_row: (facet.cell / self.width) as i32,
                rise,
                locks: &locks[facet.cell as usize % locks.len()..],
            };
            canvas.triangle(&corners[0], &corners[1], &corners[2]);
            canvas.triangle(&corners[3], &corners[2], &corners[1]);
        }
        self.count(out);
    }

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

#[inline(always)]
fn touching(touch: &&Touch) -> bool {
    touch.height != Touch::NONE.height
}

/// The touches of all rows within their `spans`. A row has `width` touches.
#[inline(always)]
fn within<'a>(
    touches: &'a [Touch],
    width: usize,
    spans: &'a [Range<usize>],
) -> impl Iterator<Item = &'a Touch> {
    let rows = touches.chunks_exact(width).zip(spans);
    rows.flat_map(|(row, span)| row.get(span.clone()).unwrap_or_default())
}

/// Cells of `bounds` with centres that may lie within `reach`.
fn cells_within(reach: [f32; 4], origin: (i64, i64), bounds: Rect) -> Rect {
    if reach[0] > reach[2] {
        return Rect::default();
    }
    let (x, width) = side(reach[0], reach[2], origin.0, bounds.x, bounds.width);
    let (y, height) = side(reach[1], reach[3], origin.1, bounds.y, bounds.height);
    let rect = Rect { x, y, width, height };
    if rect.is_empty() { Rect::default() } else { rect }
}

/// First cell and number of cells of one side of [`cells_within`].
fn side(low: f32, high: f32, origin: i64, start: usize, count: usize) -> (usize, usize) {
    let end = (start + count) as i64;
    let start = start as i64;
    let low = (origin + (low - 0.5).ceil() as i64).clamp(start, end);
    let high = (origin + (high - 0.5).ceil() as i64).clamp(start, end);
    (low as usize, (high - low) as usize)
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
    /// Row of the facet's first paint cell, from the ferrule.
    first_row: i32,
    /// Height in quanta by which hair that bends away rises from one row of paint cells to the next.
    rise: i32,
    /// Locks from the first column of the facet on.
    locks: &'a [Lock],
}

impl Canvas<'_> {
    /// Rasterises a triangle if its corners follow each other in the direction from the x axis to
    /// the y axis. This skips other triangles. A cell centre on an edge belongs to the triangle
    /// right of it or below it.
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
        // The slopes of a sliver are inaccurate, so we clamp heights to the heights of its corners.
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
                let along = (at[ALONG] >> 16).max(0).min(self.most.1);
                let bent = (lock.front - self.first_row - along).max(0) * self.rise;
                let height = at[HEIGHT] + lock.recess + bent;
                if height < touch.height {
                    let along = along as u32;
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

/// Line through two corners. You get equal bits for either order of the corners.
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
        // Horizontal edges do not bound a row. We never use their slope.
        let slope = (lower.x - upper.x) / (lower.y - upper.y);
        Self { x: upper.x, y: upper.y, slope, side }
    }
}

/// First cell, up to `end`, with its centre at `place` or beyond.
#[inline(always)]
fn first_middle(place: f32, end: usize) -> usize {
    let cells = lesser(greater(place - 0.5, 0.0), end as f32);
    let near = nearest(cells);
    (near + i32::from((near as f32) < cells)) as usize
}

#[inline(always)]
fn whole(values: &Point) -> [i32; 8] {
    // This is a loop, since the compiler does not always inline the closure of `map`.
    let mut wholes = [0; 8];
    for i in 0..8 {
        wholes[i] = nearest(values[i]);
    }
    wholes
}

/// Low 32 bits of the nearest whole number. This avoids the range checks of `as`, which take longer
/// than the rest of a row.
#[inline(always)]
fn nearest(value: f32) -> i32 {
    /// 1.5 * 2^52: near this number, neighbouring f64 values are 1 apart.
    const UNIT: f64 = 6_755_399_441_055_744.0;
    (f64::from(value) + UNIT).to_bits() as i32
}

/// Height above the highest relief nearby up to which we draw the surface of the head, in mm. The
/// head does not touch wet paint above this height.
const HIGHEST_PAINT_MM: f64 = 2.0;

/// Distance from the tip in mm over which the hair loses its grasp of the paint. We need this so
/// that a film does not depend on where in a cell the tip ends.
const TIP_MM: f64 = 0.8;

/// Height over the crests in mm up to which we treat hair as touching.
const TOUCHING_MM: f32 = 0.1;

/// How a bent head is held in one sub-step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hold {
    pub(super) grip: Grip,
    /// Motion of the pen since the sub-step before, in cells.
    pub(super) moved: (f32, f32),
    /// Cells by which the sides of the mark move as the pressure changes.
    pub(super) pressed: f32,
    /// Distance in cells from the pen beyond which the head does not reach.
    pub(super) reach: f32,
}

/// The surface of a head and its contact, for one sub-step after another.
#[derive(Debug, Clone)]
pub(super) struct Imprint {
    surface: LimitSurface,
    footprint: Footprint,
    cell_mm: f64,
    /// Height in quanta up to which the surface is drawn.
    ceiling: f32,
    /// Extent of the contact across the stroke. `None` if the head hardly moved.
    extent: Option<Extent>,
}

impl Imprint {
    /// Buffers for a head with this surface.
    pub(super) fn new(surface: LimitSurface, cell_mm: f64) -> Self {
        let (around, along) = surface.cells();
        let footprint = Footprint::new(around, along);
        Self { surface, footprint, cell_mm, ceiling: 0.0, extent: None }
    }

    /// Number of paint cells of the head, around and along.
    pub(super) fn paint_grid(&self) -> (usize, usize) {
        self.surface.cells()
    }

    /// Evaluates the surface of `net` near the canvas.
    pub(super) fn evaluate(&mut self, net: &Net, hold: &Hold, relief: &Relief) {
        graphics::lanes::vectorized(Evaluate { imprint: self, net, hold, relief });
    }

    pub(super) fn extent(&self) -> Option<Extent> {
        self.extent
    }

    /// Fills `out` with the contact of the surface that you evaluated last. `locks` has the lock of
    /// each column of paint cells. `border` tells you where the sides of the contact are, if the
    /// head moved.
    pub(super) fn draw(
        &mut self,
        locks: &[Lock],
        hold: &Hold,
        border: Option<Border>,
        bounds: Rect,
        out: &mut Contact,
    ) {
        graphics::lanes::vectorized(Draw { imprint: self, locks, hold, border, bounds, out });
    }

    #[inline(always)]
    fn find_surface(&mut self, net: &Net, hold: &Hold, relief: &Relief) {
        let view = relief.seen_from(hold.grip.origin);
        let (lowest, highest) = view.range(hold.grip.tip, hold.reach);
        let ceiling = highest + (HIGHEST_PAINT_MM / self.cell_mm) as f32;
        let plane = lowest == highest;
        let mut extent = Extent::new(hold.grip.tip, hold.moved);
        let touching = (highest + TOUCHING_MM / self.cell_mm as f32) * QUANTA_PER_CELL as f32;
        let facets = self.surface.facets().1;
        let cells = self.surface.cells_of_facet().1;
        let row_mm = cells as f64 * self.cell_mm;
        let fade = (row_mm / TIP_MM) as f32;
        let pressed = hold.pressed;
        self.surface.evaluate(
            net,
            ceiling,
            #[inline(always)]
            |row, vertex| {
                let relief = if plane { lowest } else { view.height(vertex[0], vertex[1]) };
                let grasp = lesser((facets - row) as f32 * fade, 1.0);
                *vertex = finished(vertex, relief, grasp, pressed);
                if let (Some(extent), true) = (&mut extent, vertex[2] < touching) {
                    extent.include(vertex[0], vertex[1]);
                }
            },
        );
        (self.ceiling, self.extent) = (ceiling * QUANTA_PER_CELL as f32, extent);
    }
}

/// The work of a sub-step that pulp compiles once per instruction set.
struct Evaluate<'a> {
    imprint: &'a mut Imprint,
    net: &'a Net,
    hold: &'a Hold,
    relief: &'a Relief,
}

struct Draw<'a> {
    imprint: &'a mut Imprint,
    locks: &'a [Lock],
    hold: &'a Hold,
    border: Option<Border>,
    bounds: Rect,
    out: &'a mut Contact,
}

impl WithSimd for Evaluate<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.imprint.find_surface(self.net, self.hold, self.relief);
    }
}

impl WithSimd for Draw<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { imprint, locks, hold, border, bounds, out } = self;
        let Imprint { surface, footprint, cell_mm, ceiling, .. } = imprint;
        let origin = hold.grip.origin;
        footprint.draw(surface, locks, *ceiling, origin, bounds, out);
        if let Some(border) = border {
            border.shape((out, footprint.spans()), origin, *cell_mm as f32);
        }
    }
}

/// A vertex of the footprint: position, height in quanta, velocity and speed weight. Velocity and
/// weight are multiplied by `grasp`. The weight is 0 up to a speed of 0.2 cells per sub-step and
/// full from 0.3. If `pressed` exceeds the speed, it counts as the speed. A vertex below the relief
/// is raised to it.
#[inline(always)]
fn finished(vertex: &Point, relief: f32, grasp: f32, pressed: f32) -> Point {
    let &[x, y, z, _, dx, dy, dz, _] = vertex;
    let height = greater(z, relief);
    let speed = greater((dx * dx + dy * dy + dz * dz).sqrt(), pressed);
    // Lifted hair springs back faster than a cell a sub-step, and paint cannot follow.
    let way = greater((dx * dx + dy * dy).sqrt(), 1.0);
    let dx = dx / way;
    let dy = dy / way;
    let t = ((speed - 0.2) * 10.0).clamp(0.0, 1.0);
    [
        x,
        y,
        height * QUANTA_PER_CELL as f32,
        fixed(grasp * dx),
        fixed(grasp * dy),
        grasp * t * t * (3.0 - 2.0 * t) * (256.0 * 65536.0),
        0.0,
        0.0,
    ]
}

#[inline(always)]
fn fixed(cells: f32) -> f32 {
    (cells * 256.0).clamp(-32767.0, 32767.0) * 65536.0
}

/// Increase of the coat at the sides (chosen by measured lips).
const THICKER: f32 = 1.1;

/// Distance from a side in mm over which the coat falls to its usual thickness.
const REACH_MM: f32 = 0.7;

/// Share of a change of the sides that we follow in a sub-step, so that the sides do not jump from
/// cell to cell.
const FOLLOWED: f32 = 0.2;

/// Where the sides of the contact are, seen from the pen.
#[derive(Debug, Clone, Default)]
pub(super) struct Sides {
    /// Lowest and highest position of the contact across the stroke, in cells from the pen. It
    /// follows the head with a delay. `None` until the head first touches in a stroke.
    extent: Option<(f32, f32)>,
}

/// Extent of a contact across the stroke, in cells from the pen.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    pen: (f32, f32),
    across: (f32, f32),
    low: f32,
    high: f32,
}

impl Extent {
    /// An empty extent around `pen`, which moved by `moved` cells. `None` if it hardly moved.
    pub(super) fn new(pen: (f32, f32), (x, y): (f32, f32)) -> Option<Self> {
        let length = libm::hypotf(x, y);
        let across = (-y / length, x / length);
        (length >= 0.2).then_some(Self { pen, across, low: f32::INFINITY, high: f32::NEG_INFINITY })
    }

    #[inline(always)]
    fn at(&self, x: f32, y: f32) -> f32 {
        (x - self.pen.0) * self.across.0 + (y - self.pen.1) * self.across.1
    }

    /// Extends the extent so that it includes a touching point of the head.
    #[inline(always)]
    pub(super) fn include(&mut self, x: f32, y: f32) {
        let at = self.at(x, y);
        self.low = lesser(at, self.low);
        self.high = greater(at, self.high);
    }
}

impl Sides {
    /// Ends a stroke.
    pub(super) fn lift(&mut self) {
        self.extent = None;
    }

    /// Follows the extent `now` of a contact and returns where its sides are. If the head hardly
    /// moved or does not touch, you get `None`.
    pub(super) fn follow(&mut self, now: Option<Extent>) -> Option<Border> {
        let now = now.filter(|now| now.low <= now.high)?;
        let (before_low, before_high) = self.extent.unwrap_or((now.low, now.high));
        let low = before_low + (now.low - before_low) * FOLLOWED;
        let high = before_high + (now.high - before_high) * FOLLOWED;
        self.extent = Some((low, high));
        Some(Border { across: Extent { low, high, ..now } })
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Border {
    across: Extent,
}

impl Border {
    /// Thickens the coat near the sides of `contact`, and slows the cells at the very sides. The
    /// extent counts positions from the cell `origin`. `spans` are the columns of its rows that may
    /// have touches.
    #[inline(always)]
    pub(super) fn shape(
        &self,
        (contact, spans): (&mut Contact, &[Range<usize>]),
        origin: (i64, i64),
        cell_mm: f32,
    ) {
        let across = &self.across;
        let low = across.low;
        let high = across.high;
        let reach = (REACH_MM / cell_mm).min(0.25 * (high - low)).max(1.0);
        let left = (contact.rect.x as i64 - origin.0) as f32 + 0.5;
        let top = (contact.rect.y as i64 - origin.1) as f32 + 0.5;
        let width = contact.rect.width.max(1);
        let rows = contact.touches.chunks_exact_mut(width).zip(spans);
        for (row, (touches, span)) in rows.enumerate() {
            let start = across.at(left, top + row as f32);
            for (column, touch) in
                span.clone().zip(touches.get_mut(span.clone()).unwrap_or_default())
            {
                let at = start + column as f32 * across.across.0;
                let inside = lesser(at - low, high - at);
                if inside >= reach || touch.height == Touch::NONE.height {
                    continue;
                }
                let near = 1.0 - greater(inside / reach, 0.0);
                let release = touch.release() as f32 * (1.0 + THICKER * near * near);
                touch.set_release(lesser(release, 127.0) as u32);
                if inside < 1.0 {
                    touch.slow(greater(inside, 0.0));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use graphics::tile::Rect;

    /// Coat at each touch in the middle row of a contact of 40 x 3 cells, after the head moved by
    /// `moved` cells.
    fn coats(moved: (f32, f32)) -> Vec<u32> {
        touches(moved, 10.0).iter().map(Touch::release).collect()
    }

    /// Touches of the middle row of a contact of 40 x 3 cells, after the head moved by `moved`
    /// cells. The head reaches from `side` to 50 cells along x.
    fn touches(moved: (f32, f32), side: f32) -> Vec<Touch> {
        let rect = Rect { x: 10, y: 20, width: 40, height: 3 };
        let touch = Touch::new(0, 0, (200, -100), 256, 1);
        let mut contact = Contact { rect, touches: vec![touch; 120], ..Contact::default() };
        let mut extent = Extent::new((30.0, 21.5), moved);
        for x in [side, 50.0] {
            extent.iter_mut().for_each(|extent| extent.include(x, 21.5));
        }
        let whole = [0..40, 0..40, 0..40];
        if let Some(border) = Sides::default().follow(extent) {
            border.shape((&mut contact, &whole), (0, 0), 0.1);
        }
        contact.touches[40..80].to_vec()
    }

    #[test]
    fn the_coat_is_thicker_at_both_sides_of_the_way_only() {
        for moved in [(0.0, 0.9), (0.0, -0.9)] {
            let across = coats(moved);
            let mirrored: Vec<u32> = across.iter().rev().copied().collect();
            assert_eq!(across, mirrored);
            assert!(across[0] > 48 && across[0] > across[3] && across[3] > 32, "{across:?}");
            assert!(across[10..30].iter().all(|&coat| coat == 32), "{across:?}");
        }
        assert_eq!(coats((0.0, 0.1)), [32; 40], "a head that hardly moves has no sides");
    }

    #[test]
    fn the_velocity_falls_to_nothing_over_the_last_cell() {
        for (side, shares) in [(10.0, [0.5, 1.0]), (10.4, [0.1, 1.0]), (10.6, [0.0, 0.9])] {
            let across = touches((0.0, 0.9), side);
            for (touch, share) in across.iter().zip(shares) {
                let (right, down) = touch.velocity();
                let far = (f64::from(right) - share * 200.0).abs();
                assert!(far.max((f64::from(down) + share * 100.0).abs()) <= 1.0, "{across:?}");
            }
            assert!(across[2..38].iter().all(|touch| touch.velocity() == (200, -100)));
        }
    }

    #[test]
    fn the_sides_follow_a_change_slowly_within_a_stroke() {
        let mut sides = Sides::default();
        let mut reach = |half: f32| {
            let mut extent = Extent::new((0.0, 0.0), (1.0, 0.0)).unwrap();
            extent.include(0.0, -half);
            extent.include(0.0, half);
            sides.follow(Some(extent));
            sides.extent.unwrap().1
        };
        assert_eq!(reach(10.0), 10.0);
        let second = reach(20.0);
        assert!(second > 10.5 && second < 19.0, "{second}");
        sides.lift();
        assert_eq!(sides.extent, None);
    }
}
