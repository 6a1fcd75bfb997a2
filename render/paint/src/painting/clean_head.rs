//! The clean head of a tool, and what it takes.

use super::taken::TakenPaint;
use crate::brush::StrokeTool;
use crate::engine::{BrushId, PaintEngine};
use crate::layer::Layer;
use graphics::gpu::DeviceError;

/// Number of sub-steps after which a head that only takes paint is emptied, so that no column of it
/// is ever full.
const EMPTIED_EVERY: usize = 128;

/// A head while it works as a tool: the paint of its brush is set aside.
#[derive(Debug)]
pub(super) struct CleanHead {
    brush: BrushId,
    /// Paint of the brush.
    kept: Layer,
    taken: TakenPaint,
    /// Number of sub-steps since the head was emptied; `None` if it lays its paint again.
    since: Option<usize>,
}

impl CleanHead {
    /// Sets the paint of `brush` aside, if `tool` needs a clean head.
    pub(super) fn of(
        tool: StrokeTool,
        engine: &mut PaintEngine,
        brush: BrushId,
    ) -> Result<Option<Self>, DeviceError> {
        let since = match tool {
            StrokeTool::Paint => return Ok(None),
            StrokeTool::Blend { .. } => None,
            StrokeTool::Scrape { .. } | StrokeTool::Erase { .. } => Some(0),
        };
        let kept = engine.brush_paint(brush)?;
        engine.set_brush_paint(brush, &Layer::empty(kept.width(), kept.height()))?;
        Ok(Some(Self { brush, kept, taken: TakenPaint::default(), since }))
    }

    /// Number of sub-steps that may be painted before the head is emptied.
    pub(super) fn left(&self) -> usize {
        self.since.map_or(usize::MAX, |since| EMPTIED_EVERY - since)
    }

    /// Counts sub-steps, at most those of [`CleanHead::left`], and empties the head when it is time.
    /// The count does not depend on the portions of a stroke.
    pub(super) fn painted(
        &mut self,
        engine: &mut PaintEngine,
        count: usize,
    ) -> Result<(), DeviceError> {
        let Some(since) = &mut self.since else { return Ok(()) };
        *since += count;
        if *since >= EMPTIED_EVERY {
            *since = 0;
            self.empty(engine)?;
        }
        Ok(())
    }

    fn empty(&mut self, engine: &mut PaintEngine) -> Result<(), DeviceError> {
        self.taken.add(&engine.brush_paint(self.brush)?);
        engine.set_brush_paint(self.brush, &Layer::empty(self.kept.width(), self.kept.height()))
    }

    /// Wipes the head, gives the brush its paint back and returns all paint that was taken.
    pub(super) fn finish(mut self, engine: &mut PaintEngine) -> Result<TakenPaint, DeviceError> {
        self.taken.add(&engine.brush_paint(self.brush)?);
        engine.set_brush_paint(self.brush, &self.kept)?;
        Ok(self.taken)
    }
}
