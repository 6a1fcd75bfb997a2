//! Brushes of a painting and the paint on them, whole strokes, heaps of paint from a tube, and
//! scraping paint away.

use std::ops::Range;

use graphics::tile::Rect;

use super::failure::PaintingError;
use super::open_stroke::{OpenStroke, StrokeReport};
use super::state::{Brush, HIGHEST, Painting};
use crate::amount::{MAX_COLUMN, QUANTA_PER_CELL, mm_from_quanta, quanta_from_mm};
use crate::brush::{Head, HeadShape, StrokeTool};
use crate::engine::BrushId;
use crate::layer::{Cell, Layer, SLOTS};
use crate::motion::press::CROWDED_VOLUME;
use crate::pose::Sample;
use crate::stroke::{SampleDecimals, StrokeError};
use crate::strokes::Stroke;

/// Maximum paint in a cell of a head after loading, in quanta: 32 cell widths, far more than
/// clings to bristles, and little enough that no pile reaches [`MAX_COLUMN`].
const CAPACITY: u32 = MAX_COLUMN / 16;

impl Painting {
    /// Adds a clean brush of `size_mm` mm and returns its id.
    ///
    /// # Errors
    /// [`PaintingError`] if the size is out of range, or the memory of the device does not
    /// suffice.
    pub fn add_brush(&mut self, shape: HeadShape, size_mm: f64) -> Result<BrushId, PaintingError> {
        let seed = self.brushes.len() as u64 + 1;
        let head = Head::new(shape, size_mm, self.cell_mm)?.with_locks(seed);
        let cells = head.paint_grid();
        let id = self.engine.add_brush(cells.0, cells.1)?;
        debug_assert_eq!(id.0, self.brushes.len(), "the engine numbers brushes from 0");
        self.brushes.push(Brush { id, head, cells });
        Ok(id)
    }

    /// Adds paint to a brush: all over its hair, or along the edge of a knife, `amount_mm` mm of
    /// the mixture of `recipe` (parts by slot), of which the fraction `vehicle` (0 to 1) is clear
    /// medium. With `vehicle` 1 the recipe may be empty. A brush with paint on it takes as much as it has room
    /// for, so that no script fails in the middle because strokes left a bit more on its brush.
    ///
    /// # Errors
    /// [`PaintingError`] if the recipe has no parts or parts of an empty slot, or if a clean brush
    /// could not hold that much.
    ///
    /// # Panics
    /// If there is no such brush.
    pub fn load(
        &mut self,
        brush: BrushId,
        recipe: &[f64; SLOTS],
        vehicle: f64,
        amount_mm: f64,
    ) -> Result<(), PaintingError> {
        let area = self.brushes[brush.0].head.paint_cell_area();
        self.mixture(recipe, vehicle, amount_mm * area)?;
        check_load(&self.brushes[brush.0].head, self.cell_mm, amount_mm)?;
        let mut paint = self.engine.brush_paint(self.brushes[brush.0].id)?;
        let taken_mm = amount_mm.min(self.most_load_mm(brush, &paint));
        let fresh = self.mixture(recipe, vehicle, taken_mm * area)?;
        for index in self.cells_with_paint(brush) {
            paint.set_cell(index, paint.cell(index).plus(&fresh));
        }
        self.set_brush_paint(brush, &paint)
    }

    /// Greatest load, in mm, that still fits on a brush that holds `paint`. [`Painting::load`] adds no more
    /// than this, even if you ask for more.
    ///
    /// # Panics
    /// If there is no such brush, or `paint` does not have the cells of the head.
    #[must_use]
    pub fn most_load_mm(&self, brush: BrushId, paint: &Layer) -> f64 {
        let volumes = self.cells_with_paint(brush).map(|index| paint.cell(index).volume());
        let left = CAPACITY.saturating_sub(volumes.max().unwrap_or(0));
        mm_from_quanta(left, self.cell_mm) / self.brushes[brush.0].head.paint_cell_area()
    }

    /// Indices of the cells of a head that hold paint.
    fn cells_with_paint(&self, brush: BrushId) -> Range<usize> {
        let Brush { head, cells, .. } = &self.brushes[brush.0];
        let rows = head.rows_with_paint();
        rows.start * cells.0..rows.end * cells.0
    }

    /// Fraction of each slot and, last, of vehicle in a mixture.
    pub(super) fn shares(
        &self,
        recipe: &[f64; SLOTS],
        vehicle: f64,
    ) -> Result<[f64; SLOTS + 1], PaintingError> {
        if !(0.0..=1.0).contains(&vehicle) {
            return Err(PaintingError::Range {
                what: "vehicle is a share of 0 to 1",
                value: vehicle,
            });
        }
        let total: f64 = recipe.iter().sum();
        let parts = total.is_finite() && recipe.iter().all(|&part| part >= 0.0);
        if !(parts && (total > 0.0 || vehicle == 1.0)) {
            return Err(PaintingError::NoMixture);
        }
        if let Some(slot) = (0..SLOTS).find(|&i| recipe[i] > 0.0 && self.state.slots[i].is_none()) {
            return Err(PaintingError::EmptySlot(slot));
        }
        let mut shares = [0.0; SLOTS + 1];
        // Clear vehicle alone needs no parts.
        if total > 0.0 {
            for (share, part) in shares.iter_mut().zip(recipe) {
                *share = part / total * (1.0 - vehicle);
            }
        }
        shares[SLOTS] = vehicle;
        Ok(shares)
    }

    /// Paint of one cell: `amount_mm` mm of a mixture.
    fn mixture(
        &self,
        recipe: &[f64; SLOTS],
        vehicle: f64,
        amount_mm: f64,
    ) -> Result<Cell, PaintingError> {
        let shares = self.shares(recipe, vehicle)?;
        if !(amount_mm >= 0.0 && amount_mm.is_finite()) {
            let what = "an amount of paint is 0 mm or more";
            return Err(PaintingError::Range { what, value: amount_mm });
        }
        let [pigments @ .., vehicle] =
            shares.map(|share| quanta_from_mm(amount_mm * share, self.cell_mm));
        Ok(Cell { pigments, vehicle })
    }

    /// Wipes a brush on a rag. The fraction `kept` (0 to 1) of its paint stays.
    pub(crate) fn wipe(&mut self, brush: BrushId, kept: f64) -> Result<(), PaintingError> {
        let share = share_of_65536_parts("kept is a share of 0 to 1", kept)?;
        let mut paint = self.engine.brush_paint(self.brushes[brush.0].id)?;
        for index in 0..paint.vehicle.values().len() {
            paint.set_cell(index, paint.cell(index).share_of_65536(share));
        }
        self.set_brush_paint(brush, &paint)
    }

    /// Removes all paint from a brush.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If there is no such brush.
    pub fn wash(&mut self, brush: BrushId) -> Result<(), PaintingError> {
        let (width, height) = self.brushes[brush.0].cells;
        self.set_brush_paint(brush, &Layer::empty(width, height))
    }

    /// Paint on a brush.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If there is no such brush.
    pub fn brush_paint(&mut self, brush: BrushId) -> Result<Layer, PaintingError> {
        Ok(self.engine.brush_paint(self.brushes[brush.0].id)?)
    }

    /// Replaces the paint on a brush by `paint`, with the slots of this painting's palette. This is
    /// not an action of the history.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If there is no such brush, or `paint` does not have the cells of the head.
    pub fn set_brush_paint(&mut self, brush: BrushId, paint: &Layer) -> Result<(), PaintingError> {
        Ok(self.engine.set_brush_paint(self.brushes[brush.0].id, paint)?)
    }

    /// Head of a brush, as it is bent now.
    ///
    /// # Panics
    /// If there is no such brush.
    #[must_use]
    pub fn head(&self, brush: BrushId) -> &Head {
        &self.brushes[brush.0].head
    }

    /// Holds a brush just above the canvas, for drawing its [`Painting::head`] there. Does
    /// nothing while a stroke with this brush is open.
    ///
    /// # Panics
    /// If there is no such brush.
    pub fn hover(&mut self, brush: BrushId, sample: &Sample) {
        if self.stroke_brush != Some(brush) {
            self.brushes[brush.0].head.hover(&sample.pose(self.cell_mm), &self.relief);
        }
    }

    /// Removes the paint of a brush and returns it, for the brush of another painting. An
    /// action of the history: an undo puts it back.
    pub(crate) fn take_brush_paint(&mut self, brush: BrushId) -> Result<Layer, PaintingError> {
        self.apply_action(|painting| {
            let id = painting.brushes[brush.0].id;
            painting.history.save_brush(&mut painting.engine, id)?;
            let paint = painting.engine.brush_paint(id)?;
            painting.wash(brush)?;
            Ok(paint)
        })
    }
}

impl Painting {
    /// Paints a whole stroke. One undo takes it back, including the paint that moved
    /// between brush and canvas.
    ///
    /// # Errors
    /// [`PaintingError`] for impossible samples, before anything is painted, or if the
    /// device was lost.
    ///
    /// # Panics
    /// If there is no such brush, or a stroke is open.
    pub fn stroke(
        &mut self,
        brush: BrushId,
        samples: &[Sample],
    ) -> Result<StrokeReport, PaintingError> {
        self.stroke_as(StrokeTool::Paint, brush, samples)
    }

    /// Works the paint with the head of a brush as `tool`, like [`Painting::stroke`]. The paint on
    /// the brush stays as it is.
    pub(crate) fn stroke_as(
        &mut self,
        tool: StrokeTool,
        brush: BrushId,
        samples: &[Sample],
    ) -> Result<StrokeReport, PaintingError> {
        if samples.is_empty() {
            return Err(StrokeError::Empty.into());
        }
        let mut stroke = self.new_stroke(tool, brush)?;
        stroke.extend(samples)?;
        stroke.open(self, brush, None)?;
        stroke.finish(self)
    }

    /// Begins a stroke of a brush as `tool` whose samples come later.
    ///
    /// # Errors
    /// [`PaintingError`] for a tool out of range, or if the device was lost.
    ///
    /// # Panics
    /// If there is no such brush, or a stroke is open.
    pub fn begin_stroke(
        &mut self,
        tool: StrokeTool,
        brush: BrushId,
    ) -> Result<OpenStroke, PaintingError> {
        let mut stroke = self.new_stroke(tool, brush)?;
        stroke.open(self, brush, None)?;
        Ok(stroke)
    }

    fn new_stroke(&self, tool: StrokeTool, brush: BrushId) -> Result<OpenStroke, PaintingError> {
        let size_mm = self.brushes[brush.0].head.size_mm();
        let stroke = Stroke { tool, ..Stroke::default() };
        OpenStroke::new(self.cell_mm, size_mm, stroke, SampleDecimals::RECORDING)
    }

    /// Whether a stroke is open.
    #[must_use]
    pub fn stroke_open(&self) -> bool {
        self.stroke_brush.is_some()
    }
}

/// A fraction of 0 to 1 as parts of 65536.
pub(super) fn share_of_65536_parts(what: &'static str, value: f64) -> Result<u32, PaintingError> {
    if !(0.0..=1.0).contains(&value) {
        return Err(PaintingError::Range { what, value });
    }
    Ok((value * 65536.0).round() as u32)
}

/// Checks that a clean head can hold `amount_mm` mm of paint, which depends on the cells.
///
/// # Errors
/// [`PaintingError::Overloaded`] if it cannot.
pub(crate) fn check_load(head: &Head, cell_mm: f64, amount_mm: f64) -> Result<(), PaintingError> {
    let most_mm = mm_from_quanta(CAPACITY, cell_mm) / head.paint_cell_area();
    match amount_mm <= most_mm {
        true => Ok(()),
        false => Err(PaintingError::Overloaded { amount_mm, most_mm, cell_mm }),
    }
}

/// Maximum volume of a heap, in mm3: a litre.
const MOST_MM3: f64 = 1e6;

/// Ratio of the height of a heap to its radius (chosen by eye).
const STEEPNESS: f64 = 2.0 / 3.0;

/// Maximum height of a heap, in quanta: half of what a brush can still move. Where cells
/// are small, large heaps are flatter.
const HIGHEST_HEAP: f64 = CROWDED_VOLUME as f64 / 2.0;

/// Volume of a heap divided by its height and the square of its radius.
const FULLNESS: f64 = std::f64::consts::PI / 1.75;

/// Relative height of a heap (1 at the top) at the squared relative distance `square` from
/// its middle (1 at the edge). The shape lies between an ellipsoid, whose edge would be
/// vertical, and a paraboloid.
fn profile(square: f64) -> f64 {
    let root = (1.0 - square).max(0.0).sqrt();
    root * root.sqrt()
}

/// A heap of paint, in cells.
#[derive(Debug, Clone, Copy)]
struct Heap {
    middle: (f64, f64),
    radius: f64,
}

impl Heap {
    /// A heap of `volume` quanta, at most `most` quanta high.
    fn new(middle: (f64, f64), volume: f64, most: f64) -> Self {
        let quanta = f64::from(QUANTA_PER_CELL);
        let natural = libm::cbrt(volume / quanta / (FULLNESS * STEEPNESS));
        let radius = if natural * STEEPNESS * quanta > most {
            (volume / (FULLNESS * most)).sqrt()
        } else {
            natural
        };
        // A smaller heap could lie between the centres of cells.
        Self { middle, radius: radius.max(1.0) }
    }

    /// Relative height at the centre of a cell, 1 at the top.
    fn height(&self, x: i64, y: i64) -> f64 {
        let right = x as f64 + 0.5 - self.middle.0;
        let down = y as f64 + 0.5 - self.middle.1;
        profile((right * right + down * down) / (self.radius * self.radius))
    }

    /// Ranges of columns and rows that it covers, also outside the canvas.
    fn reach(&self) -> [Range<i64>; 2] {
        let (x, y) = self.middle;
        [x, y].map(|at| (at - self.radius).floor() as i64..(at + self.radius).ceil() as i64)
    }

    /// Rectangle that it covers within `bounds`.
    fn rect(&self, bounds: Rect) -> Rect {
        let [columns, rows] = self.reach();
        let (x, right) = cut(columns, bounds.width);
        let (y, bottom) = cut(rows, bounds.height);
        Rect { x, y, width: right - x, height: bottom - y }
    }

    /// Distributes `totals` quanta of each paint over the cells of the heap, also outside the
    /// canvas, and passes each column, row and amount to `add`. Rounding errors are carried
    /// to the next cell, so that the totals are exact.
    fn spread(&self, totals: [f64; SLOTS + 1], mut add: impl FnMut(i64, i64, Cell)) {
        let [columns, rows] = self.reach();
        let cells = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
        let whole: f64 = cells.clone().map(|(x, y)| self.height(x, y)).sum();
        let mut so_far = 0.0;
        let mut spent = [0_u64; SLOTS + 1];
        for (x, y) in cells {
            let height = self.height(x, y);
            if height == 0.0 {
                continue;
            }
            so_far += height;
            let mut cell = [0; SLOTS + 1];
            for ((cell, spent), total) in cell.iter_mut().zip(&mut spent).zip(totals) {
                let due = (total * (so_far / whole)).round() as u64;
                *cell = due.saturating_sub(*spent) as u32;
                *spent = due.max(*spent);
            }
            let [pigments @ .., vehicle] = cell;
            add(x, y, Cell { pigments, vehicle });
        }
    }
}

fn cut(range: Range<i64>, end: usize) -> (usize, usize) {
    let end = end as i64;
    (range.start.clamp(0, end) as usize, range.end.clamp(0, end) as usize)
}

impl Painting {
    /// Squeezes a heap of `volume_mm3` mm3 out of a tube at the position `x_mm`, `y_mm`. The
    /// paint is the mixture of `recipe` (parts by slot), of which the fraction `vehicle` (0
    /// to 1) is clear medium.
    ///
    /// The heap has a round top and is a third as high as wide, or flatter where the columns
    /// of cells cannot hold more. The volume is exact to the quantum, except for paint that
    /// falls outside the canvas or on its mask.
    ///
    /// # Errors
    /// [`PaintingError`] for an invalid recipe (see [`Painting::load`]), a volume that is not
    /// above 0 and at most a litre, a position outside the canvas, and where the paint is too
    /// high already.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn squeeze(
        &mut self,
        recipe: &[f64; SLOTS],
        vehicle: f64,
        x_mm: f64,
        y_mm: f64,
        volume_mm3: f64,
    ) -> Result<(), PaintingError> {
        let shares = self.shares(recipe, vehicle)?;
        if !(volume_mm3 > 0.0 && volume_mm3 <= MOST_MM3) {
            let what = "a volume of paint is above 0 mm3 and at most a litre, 1000000 mm3";
            return Err(PaintingError::Range { what, value: volume_mm3 });
        }
        let bounds = self.engine.bounds();
        let middle = (x_mm / self.cell_mm, y_mm / self.cell_mm);
        let inside = (0.0..=bounds.width as f64).contains(&middle.0)
            && (0.0..=bounds.height as f64).contains(&middle.1);
        if !inside {
            return Err(PaintingError::OffCanvas { x_mm, y_mm });
        }
        let quanta = volume_mm3 / self.cell_mm.powi(3) * f64::from(QUANTA_PER_CELL);
        let natural = Heap::new(middle, quanta, HIGHEST_HEAP);
        let free = f64::from(CROWDED_VOLUME) - f64::from(self.fullest(natural.rect(bounds))?);
        let heap = Heap::new(middle, quanta, free.clamp(f64::from(QUANTA_PER_CELL), HIGHEST_HEAP));
        let rect = heap.rect(bounds);
        let mut paint = self.engine.wet_in(rect)?;
        let mut too_high = false;
        heap.spread(shares.map(|share| (share * quanta).round()), |x, y, more| {
            let x = x - rect.x as i64;
            let y = y - rect.y as i64;
            let width = rect.width as i64;
            let height = rect.height as i64;
            if !((0..width).contains(&x) && (0..height).contains(&y)) {
                return;
            }
            let index = (y * width + x) as usize;
            let cell = (rect.y + y as usize) * bounds.width + rect.x + x as usize;
            if self.mask.as_ref().is_some_and(|mask| mask.covers(cell)) {
                return;
            }
            let there = paint.cell(index);
            if volume(&there) + volume(&more) > u64::from(HIGHEST) {
                too_high = true;
            } else {
                paint.set_cell(index, there.plus(&more));
            }
        });
        if too_high {
            return Err(PaintingError::NoRoom { x_mm, y_mm });
        }
        self.apply_action(|painting| {
            painting.history.save_tiles(&mut painting.engine, rect)?;
            painting.views.mark_wet(rect);
            Ok(painting.engine.set_wet_in(rect, &paint)?)
        })
    }

    /// Maximum height of wet paint in `rect`, in quanta.
    fn fullest(&mut self, rect: Rect) -> Result<u32, PaintingError> {
        let paint = self.engine.wet_in(rect)?;
        let cells = 0..rect.width * rect.height;
        Ok(cells.map(|index| paint.cell(index).volume()).max().unwrap_or(0))
    }

    /// Scrapes all wet paint off the canvas, but not off covered cells. Returns whether there was
    /// any.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn scrape(&mut self) -> Result<bool, PaintingError> {
        let bounds = self.engine.bounds();
        let painted = self.engine.wet_tiles()?;
        if painted.is_empty() {
            return Ok(false);
        }
        self.apply_action(|painting| {
            for tile in painted.iter() {
                painting.history.save_tiles(&mut painting.engine, tile.rect(bounds))?;
                painting.views.mark_wet_tile(tile);
            }
            let rect = painted.extent(bounds);
            let mut left = Layer::empty(rect.width, rect.height);
            if let Some(mask) = &painting.mask {
                let before = painting.engine.wet_in(rect)?;
                for index in 0..rect.width * rect.height {
                    let x = rect.x + index % rect.width;
                    let y = rect.y + index / rect.width;
                    if mask.covers(y * bounds.width + x) {
                        left.set_films(index, before.films(index));
                    }
                }
            }
            painting.engine.set_wet_in(rect, &left)?;
            Ok(true)
        })
    }
}

fn volume(cell: &Cell) -> u64 {
    u64::from(cell.vehicle) + cell.pigments.iter().map(|&amount| u64::from(amount)).sum::<u64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heap_is_a_third_as_high_as_wide_unless_that_is_too_high() {
        let quanta = f64::from(QUANTA_PER_CELL);
        for (volume, flat) in [(4e3, false), (3.2e4, false), (1e6, true)] {
            let heap = Heap::new((300.0, 300.0), volume * quanta, HIGHEST_HEAP);
            let mut totals = [0.0; SLOTS + 1];
            totals[3] = (volume * quanta).round();
            let mut highest = 0;
            let mut sum = 0;
            heap.spread(totals, |_, _, cell| {
                highest = highest.max(cell.volume());
                sum += u64::from(cell.volume());
            });
            assert_eq!(sum, totals[3] as u64, "{volume}");
            let wanted = if flat { HIGHEST_HEAP } else { heap.radius * STEEPNESS * quanta };
            assert!((f64::from(highest) / wanted - 1.0).abs() < 0.01, "{volume}: {highest}");
        }
        // Eight times the paint, twice the width.
        let [small, large] =
            [1e3, 8e3].map(|volume| Heap::new((0.0, 0.0), volume * quanta, HIGHEST_HEAP).radius);
        assert!((large / small - 2.0).abs() < 1e-9);
    }
}
