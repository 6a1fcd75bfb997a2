//! The contact of a bent head with the canvas, drawn from its net.
//!
//! Drawing changes nothing of the head, so several sub-steps can be drawn side by side.

use super::footprint::Footprint;
use super::grip::Grip;
use super::locks::Lock;
use super::net::{Net, Point};
use super::relief::Relief;
use super::sides::{Border, Extent};
use super::surface::LimitSurface;
use crate::amount::QUANTA_PER_CELL;
use crate::contact::Contact;
use graphics::lanes::{greater, lesser};
use graphics::tile::Rect;
use pulp::{Simd, WithSimd};

/// Height above the highest relief nearby up to which the surface of the head is drawn, in mm.
/// Wet paint above that height is not touched.
const HIGHEST_PAINT_MM: f64 = 2.0;

/// Distance from the tip in mm over which the hair loses its grasp of the paint, so that a
/// film does not depend on where in a cell the tip ends.
const TIP_MM: f64 = 0.8;

/// Height over the crests in mm up to which hair counts as touching.
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
    /// Extent of the contact across the stroke; `None` if the head hardly moved.
    extent: Option<Extent>,
}

impl Imprint {
    /// Buffers for a head with this surface and, unless it is empty, hair on these facets only.
    pub(super) fn new(surface: LimitSurface, hair: Vec<bool>, cell_mm: f64) -> Self {
        let (around, along) = surface.cells();
        let footprint = Footprint::new(around, along, hair);
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

    /// Extent across the stroke of the contact evaluated last.
    pub(super) fn extent(&self) -> Option<Extent> {
        self.extent
    }

    /// Fills `out` with the contact evaluated last. `locks` are those of each column of paint
    /// cells; `border` is where its sides are, if the head moved.
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
