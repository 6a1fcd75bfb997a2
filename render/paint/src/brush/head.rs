//! A brush head: its bending, its surface, and its contacts with the canvas.

use std::ops::Range;

use super::footprint::{Hold, Imprint, Sides};
use super::locks::Locks;
use super::relief::Relief;
use super::spines::{Grip, Spines, Vector};
use super::surface::{HeadMesh, LimitSurface, Net, columns};
use super::uptake::{rates, rows_with_paint, wicking};
use super::{BrushError, HeadShape};
use crate::contact::{Contact, ExchangeRates, Wicking};
use crate::pose::Pose;
use graphics::tile::Rect;

/// Range of the widths of heads, in mm.
const SIZES_MM: std::ops::RangeInclusive<f64> = 0.2..=100.0;

/// Maximum width of a head, in cells.
const WIDEST: f64 = 2048.0;

/// Minimum effective width of a head, in cells. A finer head could pass between cell centres
/// and touch none.
const NARROWEST: f32 = 1.5;

/// Maximum distance in cells along x or y that we drag a head in a sub-step. After a longer move we
/// set it down anew.
const FARTHEST_DRAG: i64 = 64;

/// The head of one brush. Its paint is a grid of cells in the engine. The head computes the
/// position of each cell.
#[derive(Debug, Clone)]
pub struct Head {
    shape: HeadShape,
    size_mm: f64,
    cell_mm: f64,
    pub(super) spines: Spines,
    pub(super) net: Net,
    pub(super) imprint: Imprint,
    pub(super) locks: Locks,
    pub(super) sides: Sides,
    /// Mean height in mm of the paint with which a blade began its stroke. 0 for hair.
    bank_mm: f64,
    /// Number of sub-steps since the head was set down.
    sub_step: u32,
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
            return Err(BrushError::Size(size_mm));
        }
        if !(cell_mm.is_finite() && cell_mm > 0.0) {
            return Err(BrushError::Cell(cell_mm));
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
        let (around, along) = surface.cells();
        let area = f64::from(perimeter) * f64::from(spines.length());
        let column_mm = f64::from(perimeter) * cell_mm / around as f64;
        Ok(Self {
            shape,
            size_mm,
            cell_mm,
            net: Net::new(&spines),
            spines,
            imprint: Imprint::new(surface, cell_mm),
            locks: Locks::new(0, (around, along), column_mm, of, (size_mm, cell_mm)),
            sides: Sides::default(),
            bank_mm: 0.0,
            sub_step: 0,
            last: None,
            paint_cell_area: area / (around * along) as f64,
            origin: None,
            hovering: None,
        })
    }

    /// This head with other locks of hair. Each seed gives different locks.
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

    /// Width in mm of the cells for which you made this head.
    #[must_use]
    pub fn cell_mm(&self) -> f64 {
        self.cell_mm
    }

    /// Number of paint cells around the head (x of their grid) and from the ferrule to the
    /// tip. Paint cells are about as large as cells of the canvas, or larger where a head would
    /// have more than about a million.
    #[must_use]
    pub fn paint_grid(&self) -> (usize, usize) {
        self.imprint.paint_grid()
    }

    /// Rows of paint cells that hold the paint of a fresh load. For a brush these are all rows of
    /// hair, for a blade the rows at its edge.
    #[must_use]
    pub fn rows_with_paint(&self) -> Range<usize> {
        let rows = self.paint_grid().1;
        rows - rows_with_paint(self.spines.of, rows, self.cell_mm)..rows
    }

    /// Prepares a stroke. `bank_mm` is the mean height in mm of the paint on a blade, which only blades ask
    /// for. The locks of hair land, lie and leave `one_by_one`, or all at once.
    pub(crate) fn begin(&mut self, bank_mm: f64, one_by_one: bool) {
        self.bank_mm = bank_mm;
        self.locks.land_one_by_one(one_by_one);
    }

    pub(super) fn sub_step(&self) -> u32 {
        self.sub_step
    }

    /// Area of a paint cell, in cells of the canvas. For example, if the paint on the head is `d`
    /// mm thick, each paint cell holds a column of `d` times this area, in mm.
    #[must_use]
    pub fn paint_cell_area(&self) -> f64 {
        self.paint_cell_area
    }

    /// Lifts the head off the canvas. This straightens it.
    pub fn lift(&mut self) {
        self.straighten();
        self.sides.lift();
    }

    /// Lifts the head, but does not forget the sides of its last contact. The sides of the next
    /// contact start from these.
    fn straighten(&mut self) {
        (self.origin, self.hovering) = (None, None);
        self.locks.lift();
        (self.sub_step, self.last) = (0, None);
    }

    /// Holds the straight head just above the canvas at `pose`, for any pressure, so that it
    /// touches nothing. This does not affect the next stroke.
    pub fn hover(&mut self, pose: &Pose, relief: &Relief) {
        self.lift();
        let held = Pose { pressure: 1.0, ..*pose };
        let Some(grip) = Grip::new(&held, self.spines.of) else { return };
        self.spines.hold_above(&grip, &relief.seen_from(grip.origin));
        self.net.follow(&self.spines, &grip);
        self.net.rest();
        self.hovering = Some(grip.origin);
    }

    /// Surface of the head with its present bend. While the head is lifted, this is `None`. It
    /// takes about 30 us.
    #[must_use]
    pub fn mesh(&self) -> Option<HeadMesh> {
        let origin = self.origin.or(self.hovering)?;
        Some(HeadMesh::of(&self.net, origin))
    }

    /// Sets the head down at `pose`. The pressure bends it, and we do not drag it. Its tip bends
    /// opposite to `heading`, the direction of the stroke, unless you pass (0, 0). At pressure 0 it
    /// stays lifted.
    pub fn set_down(&mut self, pose: &Pose, heading: (f64, f64), relief: &Relief) {
        self.sides.lift();
        self.lower(pose, heading, relief);
    }

    fn lower(&mut self, pose: &Pose, heading: (f64, f64), relief: &Relief) {
        self.straighten();
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

    /// Moves the head to `pose` and fills `out` with its contact with the canvas `bounds`. If the
    /// head touches nothing, the rectangle is empty. This is always so at pressure 0 and at poses
    /// that are not finite. Beyond the canvas, paint may still flow along the hair. A lifted head
    /// comes down from just above the canvas. If the head is more than 64 cells away, we set it
    /// down anew.
    ///
    /// The speed that governs transfer includes the surface's vertical motion and the change of
    /// pressure. So if you press a head straight down, it leaves paint too.
    pub fn advance(&mut self, pose: &Pose, relief: &Relief, bounds: Rect, out: &mut Contact) {
        let (lifted, hold) = self.bend(pose, relief, out);
        if lifted {
            self.sides.lift();
        }
        let Some(hold) = hold else { return };
        self.imprint.evaluate(&self.net, &hold, relief);
        let border = self.sides.follow(self.imprint.extent());
        self.imprint.draw(&self.locks.columns, &hold, border, bounds, out);
    }

    /// Bends the head at `pose`. This does the work of [`Head::advance`] except for the touches of
    /// `out` and the sides of the contact. Returns whether we lifted the head from its last
    /// position, and how you hold it now unless it stays lifted.
    pub(super) fn bend(
        &mut self,
        pose: &Pose,
        relief: &Relief,
        out: &mut Contact,
    ) -> (bool, Option<Hold>) {
        out.rect = Rect::default();
        out.touches.clear();
        (out.rates, out.wicking) = (ExchangeRates::default(), Wicking::default());
        let Some(grip) = Grip::new(pose, self.spines.of) else {
            self.straighten();
            return (true, None);
        };
        let view = relief.seen_from(grip.origin);
        let mut lifted = false;
        match self.origin {
            None => {
                self.spines.hang(&grip, Vector::ZERO, &view);
                self.net.follow(&self.spines, &grip);
                self.net.rest();
            }
            Some(origin) => {
                let moved = (grip.origin.0 - origin.0, grip.origin.1 - origin.1);
                lifted = moved.0.abs().max(moved.1.abs()) > FARTHEST_DRAG;
                if lifted {
                    self.lower(pose, (0.0, 0.0), relief);
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
            // Its edge stays in place, so this does not sweep the blade over the paint.
            self.net.rest();
        }
        let before = self.last.map_or(0.0, |last| last.pressure) as f32;
        let hold = Hold {
            grip,
            moved: self.locks.follow(&grip),
            pressed: (grip.pressure - before).abs() * self.spines.width,
            reach: self.spines.width + grip.pressure * self.spines.length(),
        };
        out.rates = rates(
            self.spines.of,
            (grip.pressure, pose.speed_mm_s),
            self.bank_mm,
            self.cell_mm,
            self.paint_cell_area,
        );
        // Hair that you lift lets the paint go.
        let share = f64::from(self.locks.pressed());
        let grasp = share * share * (2.0 * self.travelled(pose)).min(1.0);
        out.rates.drag = (f64::from(out.rates.drag) * grasp) as u32;
        out.wicking = wicking(self.spines.of, self.sub_step, self.paint_grid().1, self.cell_mm);
        self.sub_step += 1;
        self.last = Some(*pose);
        (lifted, Some(hold))
    }

    /// Distance in cells by which the sides of the head move from the last sub-step to `pose`. If
    /// you press or lift the head on the spot, this is 0, and the head does not drag paint along.
    fn travelled(&self, pose: &Pose) -> f64 {
        let Some(last) = self.last else { return 0.0 };
        let turned = (pose.twist_deg - last.twist_deg).to_radians().abs();
        libm::hypot(pose.x - last.x, pose.y - last.y) + 0.5 * f64::from(self.spines.width) * turned
    }
}
