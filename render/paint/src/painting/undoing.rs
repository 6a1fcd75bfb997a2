//! Undo and redo.

use std::sync::Arc;

use super::failure::PaintingError;
use super::state::{Painting, State};
use crate::history::Restored;
use crate::layer::Layer;
use crate::light::Light;
use graphics::tile::TileSet;

/// What an undo brings back besides paint.
#[derive(Debug, Clone)]
pub(super) struct Before {
    state: State,
    light: Arc<Light>,
    /// How many brushes there were.
    brushes: usize,
}

/// An adjustment that is open.
#[derive(Debug, Clone, Copy)]
pub(super) enum Adjusting {
    /// Nothing was changed yet, and no action is open in the history.
    Begun,
    /// What was changed is an action that is open.
    Changed,
}

impl Painting {
    /// Takes the last action back; whether there was one. Loading, wiping and
    /// washing are no actions of their own: a stroke taken back takes its brush
    /// back to what it held before. Brushes that came since then hold paint of
    /// another palette if that changes; they are washed.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If a stroke or an adjustment is open.
    pub fn undo(&mut self) -> Result<bool, PaintingError> {
        self.assert_idle("an undo");
        let now = self.now();
        match self.history.undo(&mut self.engine, now)? {
            Some(restored) => self.back_to(restored).map(|()| true),
            None => Ok(false),
        }
    }

    /// Does again what was taken back last; whether there was something.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If a stroke or an adjustment is open.
    pub fn redo(&mut self) -> Result<bool, PaintingError> {
        self.assert_idle("a redo");
        let now = self.now();
        match self.history.redo(&mut self.engine, now)? {
            Some(restored) => self.back_to(restored).map(|()| true),
            None => Ok(false),
        }
    }

    /// Begins an adjustment, as of a slider that is dragged: all actions until
    /// [`Painting::end_adjusting`] are one, and each is shown as it comes.
    /// Without any there is no action.
    ///
    /// # Panics
    /// If a stroke is open, or an adjustment.
    pub fn begin_adjusting(&mut self) {
        self.assert_idle("an adjustment");
        self.adjusting = Some(Adjusting::Begun);
    }

    /// Ends the adjustment.
    ///
    /// # Panics
    /// If none is open.
    pub fn end_adjusting(&mut self) {
        if let Adjusting::Changed = self.adjusting.take().expect("an adjustment is open") {
            self.history.commit();
        }
    }

    /// How many actions can be taken back.
    #[must_use]
    pub fn undo_count(&self) -> usize {
        self.history.undo_count()
    }

    /// How many actions can be done again.
    #[must_use]
    pub fn redo_count(&self) -> usize {
        self.history.redo_count()
    }

    /// The bytes of paint that undo keeps, and the most that it may keep.
    #[must_use]
    pub fn undo_bytes(&self) -> (u64, u64) {
        (self.history.bytes(), self.history.limit_bytes())
    }

    /// Sets the most bytes that undo may keep; what is furthest from now is
    /// forgotten until the rest fits.
    pub fn set_undo_bytes(&mut self, limit: u64) {
        self.history.set_limit_bytes(limit);
    }

    /// Does `change` as one action of the history, or as part of the adjustment
    /// that is open. What fails half way can be taken back as well.
    ///
    /// # Panics
    /// If a stroke is open.
    pub(super) fn acting<T>(
        &mut self,
        change: impl FnOnce(&mut Self) -> Result<T, PaintingError>,
    ) -> Result<T, PaintingError> {
        assert!(self.stroke.is_none(), "a stroke is open; it ends before another action");
        if let Some(Adjusting::Changed) = self.adjusting {
            return change(self);
        }
        self.history.begin(self.now());
        let done = change(self);
        match &mut self.adjusting {
            Some(adjusting) => *adjusting = Adjusting::Changed,
            None => _ = self.history.commit(),
        }
        done
    }

    /// Nothing is half done before `what`.
    pub(super) fn assert_idle(&self, what: &str) {
        assert!(self.stroke.is_none(), "a stroke is open; it ends before {what}");
        assert!(self.adjusting.is_none(), "an adjustment is open; it ends before {what}");
    }

    pub(super) fn now(&self) -> Before {
        Before {
            state: self.state.clone(),
            light: Arc::clone(&self.light),
            brushes: self.brushes.len(),
        }
    }

    fn back_to(&mut self, restored: Restored<Before>) -> Result<(), PaintingError> {
        let Before { state, light, brushes } = restored.caller;
        let other_palette = state.slots != self.state.slots;
        let other_paint = other_palette || state.dry != self.state.dry;
        let other_light = !Arc::ptr_eq(&light, &self.light);
        let other_lamp = state.lighting != self.state.lighting;
        let other_shine = state.medium != self.state.medium;
        (self.state, self.light) = (state, light);
        if other_palette {
            for brush in &self.brushes[brushes.min(self.brushes.len())..] {
                let clean = Layer::empty(brush.cells.0, brush.cells.1);
                self.engine.set_brush_paint(brush.id, &clean)?;
            }
        }
        if restored.dry_changed {
            self.floor_changed()?;
        }
        let bounds = self.engine.bounds();
        if other_paint {
            self.views.unseen();
        }
        if other_shine {
            self.views.unshown();
        }
        if other_light {
            self.views.first.unbake(bounds);
        } else if other_lamp {
            self.views.first.shown = TileSet::all(bounds);
        }
        restored.tiles.iter().for_each(|tile| self.views.touch_tile(tile));
        Ok(())
    }
}
