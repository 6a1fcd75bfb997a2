//! Brushes of a painting and the paint on them.

use std::ops::Range;

use super::failure::PaintingError;
use super::state::{Brush, Painting};
use crate::amount::{MAX_COLUMN, mm_from_quanta, quanta_from_mm};
use crate::brush::{Head, HeadShape};
use crate::engine::BrushId;
use crate::layer::{Cell, Layer, SLOTS};
use crate::pose::Sample;

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

    /// Adds paint to a brush: all over its hair, or along the edge of a knife, `amount_mm` mm of the
    /// mixture of `recipe` (parts by slot), of which the fraction `vehicle` (0 to 1) is clear
    /// medium. With `vehicle` 1 the recipe may be empty.
    ///
    /// # Errors
    /// [`PaintingError`] if the recipe has no parts or parts of an empty slot, or if the
    /// brush cannot hold that much.
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
        let fresh = self.mixture(recipe, vehicle, amount_mm * area)?;
        let mut paint = self.engine.brush_paint(self.brushes[brush.0].id)?;
        let most_mm = self.most_load_mm(brush, &paint);
        if amount_mm > most_mm {
            return Err(PaintingError::Overloaded { amount_mm, most_mm });
        }
        for index in self.cells_with_paint(brush) {
            paint.set_cell(index, paint.cell(index).plus(&fresh));
        }
        self.change_brush(brush, &paint)
    }

    /// Largest amount, in mm, that [`Painting::load`] can add to a brush on which there is `paint`.
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
            return Err(PaintingError::Share { what: "vehicle", value: vehicle });
        }
        let total: f64 = recipe.iter().sum();
        let parts = total.is_finite() && recipe.iter().all(|&part| part >= 0.0);
        if !(parts && (total > 0.0 || vehicle == 1.0)) {
            return Err(PaintingError::NoMixture);
        }
        if let Some(slot) = (0..SLOTS).find(|&i| recipe[i] > 0.0 && self.state.slots[i].is_none()) {
            return Err(PaintingError::EmptySlot { slot });
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
            return Err(PaintingError::Amount { value: amount_mm });
        }
        let [pigments @ .., vehicle] =
            shares.map(|share| quanta_from_mm(amount_mm * share, self.cell_mm));
        Ok(Cell { pigments, vehicle })
    }

    /// Wipes a brush on a rag; the fraction `kept` (0 to 1) of its paint stays.
    ///
    /// # Errors
    /// [`PaintingError`] if `kept` is outside 0 to 1.
    ///
    /// # Panics
    /// If there is no such brush.
    pub fn wipe(&mut self, brush: BrushId, kept: f64) -> Result<(), PaintingError> {
        let share = share_of_65536_parts("kept", kept)?;
        let mut paint = self.engine.brush_paint(self.brushes[brush.0].id)?;
        for index in 0..paint.vehicle.values().len() {
            paint.set_cell(index, paint.cell(index).share_of_65536(share));
        }
        self.change_brush(brush, &paint)
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
        self.change_brush(brush, &Layer::empty(width, height))
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

    /// Replaces the paint on a brush by `paint`, whose slots are those of this painting's
    /// palette. Not an action of the history.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If there is no such brush, or `paint` does not have the cells of the head.
    pub fn set_brush_paint(&mut self, brush: BrushId, paint: &Layer) -> Result<(), PaintingError> {
        self.change_brush(brush, paint)
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
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If there is no such brush, or a stroke is open.
    pub fn take_brush_paint(&mut self, brush: BrushId) -> Result<Layer, PaintingError> {
        self.apply_action(|painting| {
            let id = painting.brushes[brush.0].id;
            painting.history.save_brush(&mut painting.engine, id)?;
            let paint = painting.engine.brush_paint(id)?;
            painting.wash(brush)?;
            Ok(paint)
        })
    }

    fn change_brush(&mut self, brush: BrushId, paint: &Layer) -> Result<(), PaintingError> {
        Ok(self.engine.set_brush_paint(self.brushes[brush.0].id, paint)?)
    }
}

/// A fraction of 0 to 1 as parts of 65536.
pub(super) fn share_of_65536_parts(what: &'static str, value: f64) -> Result<u32, PaintingError> {
    if !(0.0..=1.0).contains(&value) {
        return Err(PaintingError::Share { what, value });
    }
    Ok((value * 65536.0).round() as u32)
}
