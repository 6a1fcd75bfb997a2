//! A brush head: its bending, its surface, and its contacts with the canvas.

use std::ops::Range;

use super::error::BrushError;
use super::footprint::Footprint;
use super::grip::Grip;
use super::locks::Locks;
use super::mesh::HeadMesh;
use super::net::{Net, Point, columns};
use super::relief::{Relief, ReliefView};
use super::shape::HeadShape;
use super::sides::{Extent, Sides};
use super::spines::Spines;
use super::surface::LimitSurface;
use super::uptake::{rates, rows_with_paint, wicking};
use super::vector::Vector;
use crate::amount::QUANTA_PER_CELL;
use crate::contact::{Contact, ExchangeRates, Wicking};
use crate::pose::Pose;
use graphics::lanes::{greater, lesser};
use graphics::tile::Rect;
use pulp::{Simd, WithSimd};

/// Range of the widths of heads, in mm.
const SIZES_MM: std::ops::RangeInclusive<f64> = 0.2..=100.0;

/// Maximum width of a head, in cells.
const WIDEST: f64 = 2048.0;

/// Minimum effective width of a head, in cells. A finer head could pass between cell centres
/// and touch none.
const NARROWEST: f32 = 1.5;

/// Height above the highest relief nearby up to which the surface of the head is drawn, in mm.
/// Wet paint above that height is not touched.
const HIGHEST_PAINT_MM: f64 = 2.0;

/// Distance from the tip in mm over which the hair loses its grasp of the paint, so that a
/// film does not depend on where in a cell the tip ends.
const TIP_MM: f64 = 0.8;

/// Height over the crests in mm up to which hair counts as touching.
const TOUCHING_MM: f32 = 0.1;

/// Maximum distance in cells along x or y that a head is dragged in a sub-step; after a longer
/// move it is set down anew.
const FARTHEST_DRAG: i64 = 64;

/// The head of one brush. Its paint is a grid of cells in the engine; the head computes the
/// position of each cell.
#[derive(Debug, Clone)]
pub struct Head {
    shape: HeadShape,
    size_mm: f64,
    cell_mm: f64,
    pub(super) spines: Spines,
    net: Net,
    surface: LimitSurface,
    footprint: Footprint,
    locks: Locks,
    sides: Sides,
    /// Number of sub-steps since the head was set down.
    sub_step: u32,
    /// Pose in the last sub-step.
    last: Option<Pose>,
    /// Area of a paint cell in cells of the canvas.
    paint_cell_area: f64,
    /// Origin of coordinates while the head touches the canvas.
    origin: Option<(i64, i64)>,
    /// Origin of coordinates while the head hovers.
    hovering: Option<(i64, i64)>,
}

impl Head {
    /// A head of `size_mm` mm width, for cells of `cell_mm` mm.
    ///
    /// # Errors
    /// [`BrushError`] if the size is not 0.2 to 100 mm or exceeds 2048 cells, or if `cell_mm` is
    /// not above 0.
    pub fn new(shape: HeadShape, size_mm: f64, cell_mm: f64) -> Result<Self, BrushError> {
        if !SIZES_MM.contains(&size_mm) {
            return Err(BrushError::Size { size_mm });
        }
        if !(cell_mm.is_finite() && cell_mm > 0.0) {
            return Err(BrushError::Cell { cell_mm });
        }
        if size_mm / cell_mm > WIDEST {
            return Err(BrushError::TooFine { size_mm, cell_mm });
        }
        let of = shape.proportions();
        let width = ((size_mm / cell_mm) as f32).max(NARROWEST);
        let spines = Spines::new(of, width, cell_mm);
        let perimeter = if of.spines == 1 {
            std::f32::consts::PI * width
        } else {
            2.0 * width * (1.0 + of.thickness)
        };
        let surface = LimitSurface::new(columns(of.spines), perimeter, spines.length());
        let (around, along) = cells(&surface);
        let hair = if of.gaps { tufts(&surface, of.spines) } else { Vec::new() };
        let area = f64::from(perimeter) * f64::from(spines.length());
        let column_mm = f64::from(perimeter) * cell_mm / around as f64;
        Ok(Self {
            shape,
            size_mm,
            cell_mm,
            net: Net::new(&spines),
            spines,
            footprint: Footprint::new(around, along, hair),
            locks: Locks::new(0, around, column_mm, (0.1 * of.recess, of.variation), cell_mm),
            sides: Sides::default(),
            sub_step: 0,
            last: None,
            paint_cell_area: area / (around * along) as f64,
            surface,
            origin: None,
            hovering: None,
        })
    }

    /// The head with other locks of hair: each seed gives locks of its own.
    #[must_use]
    pub fn with_locks(self, seed: u64) -> Self {
        Self { locks: self.locks.seeded(seed), ..self }
    }

    /// Shape of the head.
    #[must_use]
    pub fn shape(&self) -> HeadShape {
        self.shape
    }

    /// Width of the head in mm.
    #[must_use]
    pub fn size_mm(&self) -> f64 {
        self.size_mm
    }

    /// Width in mm of the cells that it was made for.
    #[must_use]
    pub fn cell_mm(&self) -> f64 {
        self.cell_mm
    }

    /// Number of paint cells around the head (x of their grid) and from the ferrule to the
    /// tip. Paint cells are about as large as cells of the canvas, or larger where a head would
    /// have more than about a million.
    #[must_use]
    pub fn paint_grid(&self) -> (usize, usize) {
        cells(&self.surface)
    }

    /// Rows of paint cells that hold the paint of a fresh load: all rows of hair, those at the edge
    /// of a blade.
    #[must_use]
    pub fn rows_with_paint(&self) -> Range<usize> {
        let rows = self.paint_grid().1;
        rows - rows_with_paint(self.spines.of, rows, self.cell_mm)..rows
    }

    /// Number of sub-steps since the head was set down.
    pub(super) fn sub_step(&self) -> u32 {
        self.sub_step
    }

    /// Area of a paint cell, in cells of the canvas. Paint `d` mm thick on the head takes a column
    /// of `d` times this area in each of its cells.
    #[must_use]
    pub fn paint_cell_area(&self) -> f64 {
        self.paint_cell_area
    }

    /// Lifts the head off the canvas, which straightens it.
    pub fn lift(&mut self) {
        (self.origin, self.hovering) = (None, None);
        self.locks.lift();
        self.sides.lift();
        (self.sub_step, self.last) = (0, None);
    }

    /// Holds the straight head just above the canvas at `pose`, for any pressure, so that it
    /// touches nothing. Does not affect the next stroke.
    pub fn hover(&mut self, pose: &Pose, relief: &Relief) {
        self.lift();
        let held = Pose { pressure: 1.0, ..*pose };
        let Some(grip) = Grip::new(&held, self.spines.of) else { return };
        self.spines.hold_above(&grip, &relief.seen_from(grip.origin));
        self.net.follow(&self.spines, &grip);
        self.net.rest();
        self.hovering = Some(grip.origin);
    }

    /// Surface of the head as it is bent now; `None` while it is lifted. Takes about 30 us.
    #[must_use]
    pub fn mesh(&self) -> Option<HeadMesh> {
        let origin = self.origin.or(self.hovering)?;
        Some(HeadMesh::of(&self.net, origin))
    }

    /// Sets the head down at `pose`, bent by its pressure, without dragging it. Its tip bends
    /// opposite to `heading`, the direction of the stroke, unless that is (0, 0). At pressure 0 it
    /// stays lifted.
    pub fn set_down(&mut self, pose: &Pose, heading: (f64, f64), relief: &Relief) {
        self.lift();
        let Some(grip) = Grip::new(pose, self.spines.of) else { return };
        self.origin = Some(grip.origin);
        let view = relief.seen_from(grip.origin);
        let way = Vector::new(heading.0 as f32, heading.1 as f32, 0.0);
        self.spines.hang(&grip, way, &view);
        self.spines.lower(&grip, &view);
        self.last = Some(*pose);
        self.net.follow(&self.spines, &grip);
        self.net.rest();
    }

    /// Moves the head to `pose` and fills `out` with its contact with the canvas `bounds`. The
    /// rectangle is empty if nothing is touched, always at pressure 0 and at poses that are not
    /// finite; over no canvas, paint may still flow along the hair. A lifted head comes down from
    /// just above the canvas; a head that is more than 64 cells away is set down anew.
    ///
    /// The speed that governs transfer includes the surface's vertical motion and the change of
    /// pressure, so that a head that is pressed straight down leaves paint too.
    pub fn advance(&mut self, pose: &Pose, relief: &Relief, bounds: Rect, out: &mut Contact) {
        out.rect = Rect::default();
        out.touches.clear();
        (out.rates, out.wicking) = (ExchangeRates::default(), Wicking::default());
        let Some(grip) = Grip::new(pose, self.spines.of) else {
            self.lift();
            return;
        };
        let view = relief.seen_from(grip.origin);
        match self.origin {
            None => {
                self.spines.hang(&grip, Vector::ZERO, &view);
                self.net.follow(&self.spines, &grip);
                self.net.rest();
            }
            Some(origin) => {
                let moved = (grip.origin.0 - origin.0, grip.origin.1 - origin.1);
                if moved.0.abs().max(moved.1.abs()) > FARTHEST_DRAG {
                    self.set_down(pose, (0.0, 0.0), relief);
                } else {
                    let moved = Vector::new(moved.0 as f32, moved.1 as f32, 0.0);
                    self.spines.rebase(moved);
                    self.net.rebase(moved);
                }
            }
        }
        self.origin = Some(grip.origin);
        let turned_over = self.spines.turns_over(&grip);
        self.spines.advance(&grip, &view);
        self.net.follow(&self.spines, &grip);
        if turned_over {
            // Its edge stays where it is; the blade does not sweep over the paint.
            self.net.rest();
        }
        graphics::lanes::vectorized(Touching { head: self, grip: &grip, view, bounds, out });
        out.rates = rates(self.spines.of, grip.pressure, self.cell_mm, self.paint_cell_area);
        out.rates.drag = (f64::from(out.rates.drag) * (2.0 * self.travelled(pose)).min(1.0)) as u32;
        out.wicking = wicking(self.spines.of, self.sub_step, self.paint_grid().1, self.cell_mm);
        self.sub_step += 1;
        self.last = Some(*pose);
    }

    /// Way in cells of the sides of the head from the last sub-step to `pose`: 0 where it is pressed
    /// or lifted on the spot, which drags no paint along.
    fn travelled(&self, pose: &Pose) -> f64 {
        let Some(last) = self.last else { return 0.0 };
        let turned = (pose.twist_deg - last.twist_deg).to_radians().abs();
        libm::hypot(pose.x - last.x, pose.y - last.y) + 0.5 * f64::from(self.spines.width) * turned
    }

    /// Fills the touches of `out`.
    #[inline(always)]
    fn touch(&mut self, grip: &Grip, view: &ReliefView<'_>, bounds: Rect, out: &mut Contact) {
        let reach = self.spines.width + grip.pressure * self.spines.length();
        let (lowest, highest) = view.range(grip.tip, reach);
        let ceiling = highest + (HIGHEST_PAINT_MM / self.cell_mm) as f32;
        let plane = lowest == highest;
        let moved = self.locks.follow(grip);
        let mut extent = Extent::new(grip.tip, moved);
        let touching = (highest + TOUCHING_MM / self.cell_mm as f32) * QUANTA_PER_CELL as f32;
        let (facets, cells) = (self.surface.facets().1, self.surface.cells_of_facet().1);
        let row_mm = cells as f64 * self.cell_mm;
        let fade = (row_mm / TIP_MM) as f32;
        // Cells by which the sides of the mark move as pressure changes.
        let before = self.last.map_or(0.0, |last| last.pressure) as f32;
        let pressed = (grip.pressure - before).abs() * self.spines.width;
        self.surface.evaluate(
            &self.net,
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
        let ceiling = ceiling * QUANTA_PER_CELL as f32;
        self.footprint.draw(&self.surface, &self.locks.columns, ceiling, grip.origin, bounds, out);
        let spans = self.footprint.spans();
        self.sides.apply((out, spans), extent, grip.origin, self.cell_mm as f32);
    }
}

/// The work of a sub-step that pulp compiles once per instruction set.
struct Touching<'a, 'b> {
    head: &'a mut Head,
    grip: &'a Grip,
    view: ReliefView<'b>,
    bounds: Rect,
    out: &'a mut Contact,
}

impl WithSimd for Touching<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.head.touch(self.grip, &self.view, self.bounds, self.out);
    }
}

/// Number of paint cells of the head, around and along.
fn cells(surface: &LimitSurface) -> (usize, usize) {
    let (facets, cells) = (surface.facets(), surface.cells_of_facet());
    (facets.0 * cells.0, facets.1 * cells.1)
}

/// A vertex of the footprint: position, height in quanta, velocity and speed weight (0 up to
/// 0.2 cells per sub-step, full from 0.3, and at least that of a speed of `pressed`), both times
/// `grasp`. Where the surface would be below the relief, it is raised to it.
#[inline(always)]
fn finished(vertex: &Point, relief: f32, grasp: f32, pressed: f32) -> Point {
    let &[x, y, z, _, dx, dy, dz, _] = vertex;
    let height = greater(z, relief);
    let speed = greater((dx * dx + dy * dy + dz * dz).sqrt(), pressed);
    let t = ((speed - 0.2) * 10.0).clamp(0.0, 1.0);
    let fixed = |cells: f32| (cells * 256.0).clamp(-32767.0, 32767.0) * 65536.0;
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

/// Whether each facet of a fan has hair: all near the ferrule, only tufts around the spines near
/// the tip. A small fan, whose facets are no finer than its tufts, has tufts around pairs of
/// spines.
fn tufts(surface: &LimitSurface, spines: usize) -> Vec<bool> {
    let (around, along) = surface.facets();
    let in_span = surface.facets_of_span();
    let hair = |i: usize| {
        let (column, down) = (i % around, (i / around) as f32 / along as f32);
        // Columns of the net lie on spines, so a gap is between two columns.
        let span = column / in_span;
        if span == 0 || span == spines || span == spines + 1 || span == 2 * spines + 1 {
            return true;
        }
        if in_span < 3 {
            return span.is_multiple_of(2) || down < 0.6;
        }
        let off = ((column % in_span) as f32 + 0.5) / in_span as f32 - 0.5;
        off.abs() >= 0.35 * ((down - 0.45) / 0.55).max(0.0)
    };
    (0..around * along).map(hair).collect()
}
