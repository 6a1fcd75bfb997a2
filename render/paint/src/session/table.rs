//! The brushes of a session with their loads, for the file of a painting and back.

use super::failure::SessionError;
use super::state::PaintingSession;
use crate::amount::MAX_COLUMN;
use crate::strokes::{KeptBrush, SurfaceId};

/// Most paint in a cell of a brush that is taken up, in quanta: half of what a cell can hold, so
/// that it still fits into one of the canvas.
const MOST: u32 = MAX_COLUMN / 2;

impl PaintingSession {
    /// All brushes in the order of their names, with the paint that they hold.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub fn kept_brushes(&mut self) -> Result<Vec<KeptBrush>, SessionError> {
        let names: Vec<String> = self.brushes.names().map(|(name, _)| name.to_owned()).collect();
        let mut kept = Vec::with_capacity(names.len());
        for name in names {
            let paint = self.brush_paint(&name)?;
            let paint = paint.filter(|paint| paint.totals().iter().any(|total| *total > 0));
            let Some(tool) = self.brushes.find(&name) else { continue };
            let tool = &self.brushes.tools[tool];
            kept.push(KeptBrush { spec: tool.spec.clone(), at: tool.at, paint, name });
        }
        Ok(kept)
    }

    /// Adds brushes with the paint that they held when they were kept, under the pigments of this
    /// session, before anything else is done in it. Returns the names of those that are left clean:
    /// their heads have other cells than in the version that kept them, or hold more than a brush
    /// can.
    ///
    /// It is no action of history and recording: a recording of such a session replays on a
    /// session that has taken up the same brushes.
    ///
    /// # Errors
    /// [`SessionError`] for a head that cannot be made on cells of this width, or if the device was
    /// lost.
    pub fn take_up(&mut self, brushes: &[KeptBrush]) -> Result<Vec<String>, SessionError> {
        let mut left = Vec::new();
        for KeptBrush { name, spec, at, paint } in brushes {
            self.set_brush(name, spec)?;
            let (Some(tool), Some(paint)) = (self.brushes.find(name), paint) else { continue };
            let at = if self.palette.is_some() { *at } else { SurfaceId::Canvas };
            let id = self.brush_id(tool, at)?;
            let painting = self.surface_mut(at)?;
            let fits = painting.head(id).paint_grid() == (paint.width(), paint.height());
            let cells = 0..paint.vehicle.values().len();
            let most = cells.map(|index| paint.cell(index).volume()).max().unwrap_or(0);
            if fits && most <= MOST {
                painting.set_brush_paint(id, paint)?;
                self.brushes.tools[tool].at = at;
            } else {
                left.push(name.clone());
            }
        }
        Ok(left)
    }
}
