//! The stack of dry layers: names, visibility and order.
//!
//! Dry layers are films of their own, so that one can be laid under another; wet paint is above all
//! of them. Heights add up in any order: moving a layer changes what covers what, not the relief.

use super::failure::PaintingError;
use super::layer_ref::LayerRef;
use super::state::Painting;
use crate::dry_layer::layer_name_violation;

impl Painting {
    /// Names a dry layer; an empty name takes its name away.
    ///
    /// # Errors
    /// [`PaintingError`] for the wet layer, a layer that does not exist, or a name that is not one
    /// line of at most 80 characters.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn name_layer(&mut self, layer: LayerRef, name: &str) -> Result<(), PaintingError> {
        let index = self.dry_index(layer)?.ok_or(PaintingError::WetLayer { what: "name" })?;
        if let Some(wanted) = layer_name_violation(name) {
            return Err(PaintingError::LayerName { wanted });
        }
        self.apply_action(|painting| {
            name.clone_into(&mut painting.state.dry[index].name);
            Ok(())
        })
    }

    /// Shows or hides a dry layer. Its opacity and its height stay.
    ///
    /// # Errors
    /// [`PaintingError`] for the wet layer, or a layer that does not exist.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn show_layer(&mut self, layer: LayerRef, visible: bool) -> Result<(), PaintingError> {
        let index = self.dry_index(layer)?.ok_or(PaintingError::WetLayer { what: "visibility" })?;
        self.apply_action(|painting| {
            painting.state.dry[index].visible = visible;
            painting.views.mark_all();
            Ok(())
        })
    }

    /// Moves a dry layer to place `to` of the stack; 0 is the lowest. The layers between move by
    /// one place. Returns whether it lay elsewhere before.
    ///
    /// # Errors
    /// [`PaintingError`] for the wet layer, a layer that does not exist, and a place above the
    /// topmost dry layer.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn move_layer(&mut self, layer: LayerRef, to: usize) -> Result<bool, PaintingError> {
        let from = self.dry_index(layer)?.ok_or(PaintingError::WetLayer { what: "place" })?;
        self.dry_index(LayerRef::Dry(to))?;
        if from == to {
            return Ok(false);
        }
        self.apply_action(|painting| {
            painting.history.move_dry_layer(&mut painting.engine, from, to);
            let moved = painting.state.dry.remove(from);
            painting.state.dry.insert(to, moved);
            painting.floor_changed()
        })?;
        Ok(true)
    }
}
