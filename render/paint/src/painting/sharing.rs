//! What two paintings share that stand beside each other: brushes that go from
//! one to the other, and the light.

use std::sync::Arc;

use super::failure::PaintingError;
use super::state::Painting;
use crate::layer::Layer;
use graphics::tile::TileSet;

impl Painting {
    /// Gives the paint of a brush away, to the brush of another painting (see
    /// [`Painting::begin_stroke_with`]); here the brush is clean then. An action
    /// of the history: undone, the brush has it back.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If there is no such brush, or a stroke is open.
    pub fn hand_over(&mut self, brush: usize) -> Result<Layer, PaintingError> {
        self.acting(|painting| {
            let id = painting.brushes[brush].id;
            painting.history.save_brush(&mut painting.engine, id)?;
            let paint = painting.engine.brush_paint(id)?;
            painting.wash(brush)?;
            Ok(paint)
        })
    }

    /// Shows the painting under the light of another one, which must be of the
    /// same library.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If a stroke is open.
    pub fn relight_as(&mut self, other: &Self) -> Result<(), PaintingError> {
        self.acting(|painting| {
            painting.state.lighting = other.state.lighting.clone();
            let bounds = painting.engine.bounds();
            if Arc::ptr_eq(&painting.light, &other.light) {
                painting.views.first.shown = TileSet::all(bounds);
            } else {
                painting.light = Arc::clone(&other.light);
                painting.views.first.unbake(bounds);
            }
            Ok(())
        })
    }
}
