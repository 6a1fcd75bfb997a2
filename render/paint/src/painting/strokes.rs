//! Strokes of a painting, whole or with samples that come later.

use super::failure::PaintingError;
use super::open_stroke::{OpenStroke, StrokeReport};
use super::state::Painting;
use crate::brush::StrokeTool;
use crate::engine::BrushId;
use crate::pose::Sample;
use crate::stroke::StrokeError;

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
    ///
    /// # Errors
    /// [`PaintingError`] for impossible samples and tools, before anything is changed, or if the
    /// device was lost.
    ///
    /// # Panics
    /// If there is no such brush, or a stroke is open.
    pub fn stroke_as(
        &mut self,
        tool: StrokeTool,
        brush: BrushId,
        samples: &[Sample],
    ) -> Result<StrokeReport, PaintingError> {
        if samples.is_empty() {
            return Err(StrokeError::Empty.into());
        }
        let size_mm = self.brushes[brush.0].head.size_mm();
        let mut stroke = OpenStroke::new(self.cell_mm, size_mm, tool)?;
        stroke.extend(samples)?;
        stroke.open(self, brush, None)?;
        stroke.finish(self)
    }

    /// Begins a stroke whose samples come later.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If there is no such brush, or a stroke is open.
    pub fn begin_stroke(&mut self, brush: BrushId) -> Result<OpenStroke, PaintingError> {
        self.begin_stroke_as(StrokeTool::Paint, brush)
    }

    /// Begins a stroke of a brush as `tool` whose samples come later.
    ///
    /// # Errors
    /// [`PaintingError`] for a tool out of range, or if the device was lost.
    ///
    /// # Panics
    /// If there is no such brush, or a stroke is open.
    pub fn begin_stroke_as(
        &mut self,
        tool: StrokeTool,
        brush: BrushId,
    ) -> Result<OpenStroke, PaintingError> {
        let size_mm = self.brushes[brush.0].head.size_mm();
        let mut stroke = OpenStroke::new(self.cell_mm, size_mm, tool)?;
        stroke.open(self, brush, None)?;
        Ok(stroke)
    }

    /// Whether a stroke is open.
    #[must_use]
    pub fn stroke_open(&self) -> bool {
        self.stroke_brush.is_some()
    }
}
