//! Undo and redo.

use std::sync::Arc;

use super::failure::PaintingError;
use super::state::{Adjusting, Painting, State, UndoState};
use crate::history::Restored;
use crate::layer::Layer;
use graphics::tile::TileSet;

impl Painting {
    /// Undoes the last action; returns whether there was one.
    ///
    /// Loading, wiping and washing are not actions of their own: the undo of a stroke
    /// restores the paint that its brush held before. If the undo changes the palette,
    /// brushes that were added since are washed, as their paint is of the other palette.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If a stroke or an adjustment is open.
    pub fn undo(&mut self) -> Result<bool, PaintingError> {
        self.assert_idle("an undo");
        let now = self.undo_state();
        match self.history.undo(&mut self.engine, now)? {
            Some(restored) => self.restore(restored).map(|()| true),
            None => Ok(false),
        }
    }

    /// Repeats the action that was undone last; returns whether there was one.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If a stroke or an adjustment is open.
    pub fn redo(&mut self) -> Result<bool, PaintingError> {
        self.assert_idle("a redo");
        let now = self.undo_state();
        match self.history.redo(&mut self.engine, now)? {
            Some(restored) => self.restore(restored).map(|()| true),
            None => Ok(false),
        }
    }

    /// Begins an adjustment, for example when a slider is dragged. All actions until
    /// [`Painting::end_adjusting`] count as one action in the history, but each takes effect at
    /// once. Without any, the history stays unchanged.
    ///
    /// # Panics
    /// If a stroke or an adjustment is open.
    pub fn begin_adjusting(&mut self) {
        self.assert_idle("an adjustment");
        self.adjusting = Some(Adjusting::Unchanged);
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

    /// Number of actions that can be undone.
    #[must_use]
    pub fn undo_count(&self) -> usize {
        self.history.undo_count()
    }

    /// Number of actions that can be repeated.
    #[must_use]
    pub fn redo_count(&self) -> usize {
        self.history.redo_count()
    }

    /// Memory that undo takes now, and its limit, both in bytes.
    #[must_use]
    pub fn undo_bytes(&self) -> (u64, u64) {
        (self.history.bytes(), self.history.limit_bytes())
    }

    /// Sets the limit of the memory for undo, in bytes. The actions furthest from the present
    /// are dropped until the rest fits.
    pub fn set_undo_bytes(&mut self, limit: u64) {
        self.history.set_limit_bytes(limit);
    }

    /// Forgets all but the last `undo` actions that can be undone, and all but the next `redo`
    /// that can be repeated, to use their memory for others.
    pub fn keep_actions(&mut self, undo: usize, redo: usize) {
        self.history.keep_only(undo, redo);
    }

    /// Applies `change` as one action of the history, or as part of the open adjustment. A
    /// change that fails half way can be undone as well.
    ///
    /// # Panics
    /// If a stroke is open.
    pub(super) fn apply_action<T>(
        &mut self,
        change: impl FnOnce(&mut Self) -> Result<T, PaintingError>,
    ) -> Result<T, PaintingError> {
        assert!(self.stroke_brush.is_none(), "a stroke is open; it ends before another action");
        if let Some(Adjusting::Changed) = self.adjusting {
            return change(self);
        }
        self.history.begin(self.undo_state());
        let result = change(self);
        match &mut self.adjusting {
            Some(adjusting) => *adjusting = Adjusting::Changed,
            None => _ = self.history.commit(),
        }
        result
    }

    /// Panics if a stroke or an adjustment is open; `what` names the next action.
    pub(super) fn assert_idle(&self, what: &str) {
        assert!(self.stroke_brush.is_none(), "a stroke is open; it ends before {what}");
        assert!(self.adjusting.is_none(), "an adjustment is open; it ends before {what}");
    }

    /// State for the next entry of the history.
    pub(super) fn undo_state(&self) -> UndoState {
        UndoState {
            state: self.state.clone(),
            light: Arc::clone(&self.light),
            brushes: self.brushes.len(),
            mask: self.mask.clone(),
        }
    }

    fn restore(&mut self, restored: Restored<UndoState>) -> Result<(), PaintingError> {
        let UndoState { state, light, brushes, mask } = restored.caller;
        self.hold_mask(mask)?;
        let palette_changed = state.slots != self.state.slots;
        let look = |state: &State| -> Vec<_> {
            state.dry.iter().map(|layer| (layer.slots, layer.shown_opacity())).collect()
        };
        let paint_changed = palette_changed || look(&state) != look(&self.state);
        let light_changed = !Arc::ptr_eq(&light, &self.light);
        let lighting_changed = state.lighting != self.state.lighting;
        let medium_changed = state.medium != self.state.medium;
        (self.state, self.light) = (state, light);
        if palette_changed {
            for brush in &self.brushes[brushes.min(self.brushes.len())..] {
                let clean = Layer::empty(brush.cells.0, brush.cells.1);
                self.engine.set_brush_paint(brush.id, &clean)?;
            }
        }
        if restored.dry_changed {
            self.floor_changed()?;
        }
        let bounds = self.engine.bounds();
        if paint_changed {
            self.views.mark_all();
        }
        if medium_changed {
            self.views.mark_all_wet();
        }
        if light_changed {
            self.views.first.mark_all(bounds);
        } else if lighting_changed {
            self.views.first.wet = TileSet::all(bounds);
        }
        restored.tiles.iter().for_each(|tile| self.views.mark_wet_tile(tile));
        Ok(())
    }
}
