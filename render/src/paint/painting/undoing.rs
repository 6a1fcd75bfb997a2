//! Undo and redo.

use super::failure::PaintingError;
use super::state::{Painting, State};
use crate::light::Light;
use crate::paint::document::Lighting;
use crate::paint::history::Restored;

impl Painting {
    /// Takes the last action back; whether there was one.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn undo(&mut self) -> Result<bool, PaintingError> {
        let now = self.state.clone();
        match self.history.undo(self.engine.as_mut(), now)? {
            Some(restored) => self.back_to(restored).map(|()| true),
            None => Ok(false),
        }
    }

    /// Does again what was taken back last; whether there was something.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn redo(&mut self) -> Result<bool, PaintingError> {
        let now = self.state.clone();
        match self.history.redo(self.engine.as_mut(), now)? {
            Some(restored) => self.back_to(restored).map(|()| true),
            None => Ok(false),
        }
    }

    fn back_to(&mut self, restored: Restored<State>) -> Result<(), PaintingError> {
        let state = restored.caller;
        let lamp =
            |state: &State| (state.lighting.illuminant.clone(), state.lighting.observer.clone());
        if lamp(&state) != lamp(&self.state) {
            let Lighting { illuminant, observer, .. } = &state.lighting;
            self.light = Light::named(&self.library, illuminant, observer)?;
        }
        let same = state == self.state;
        self.state = state;
        if restored.dry_changed {
            return self.floor_changed();
        }
        if same {
            let bounds = self.engine.bounds();
            for tile in restored.tiles.iter() {
                self.unshown.insert(tile.rect(bounds));
            }
        } else {
            self.all_unseen();
        }
        Ok(())
    }
}
