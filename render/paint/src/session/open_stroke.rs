//! The open stroke of a session, and whole strokes.

use super::history::Carried;
use super::state::PaintingSession;
use crate::painting::{OpenStroke, Painting, PaintingError, StrokeReport};
use crate::pose::Sample;
use crate::stroke::{Path, SampleDecimals};
use crate::strokes::{
    Action, ActionPigments, CheckContext, PerSurface, Stroke, StrokeTool, SurfaceId, check_sample,
    check_tool, six_digits, unknown_brush,
};

impl PaintingSession {
    /// Sets a brush down on a surface. Samples follow. Any open stroke or adjustment is
    /// finished first. Samples are rounded to [`SampleDecimals::RECORDING`].
    ///
    /// # Errors
    /// [`PaintingError`] if there is no such brush or surface, or if the device was lost.
    pub fn begin_stroke(&mut self, on: SurfaceId, brush: &str) -> Result<(), PaintingError> {
        self.begin_stroke_as(StrokeTool::Paint, on, brush, SampleDecimals::RECORDING)
    }

    /// Sets the head of a brush down as `tool`, like [`PaintingSession::begin_stroke`], for samples
    /// that are rounded to `decimals`, at most the decimals of a recording. The number of the tool
    /// is rounded to six digits.
    ///
    /// # Errors
    /// [`PaintingError`] if there is no such brush or surface, if the number of the tool is out of
    /// range, or if the device was lost.
    pub fn begin_stroke_as(
        &mut self,
        tool: StrokeTool,
        on: SurfaceId,
        brush: &str,
        decimals: SampleDecimals,
    ) -> Result<(), PaintingError> {
        let tool = tool.map(six_digits);
        check_tool(&CheckContext::default(), tool)?;
        self.finish_open()?;
        self.surface_mut(on)?;
        let size_mm = self.brushes.tools[self.tool(brush)?].spec.size_mm;
        let stroke = Stroke { brush: brush.to_owned(), on, tool, samples: Vec::new() };
        self.stroke = Some(OpenStroke::new(self.canvas.cell_mm(), size_mm, stroke, decimals)?);
        Ok(())
    }

    /// Index of the head that has a name now.
    pub(super) fn tool(&self, brush: &str) -> Result<usize, PaintingError> {
        let names = self.brushes.named_heads().map(|(name, _)| name);
        let found = self.brushes.find(brush);
        Ok(found.ok_or_else(|| unknown_brush(&CheckContext::default(), brush, names))?)
    }

    /// Rounds samples and adds them to the open stroke. [`PaintingSession::advance`] paints them.
    /// If we refuse a sample, the samples before it count, and the stroke stays open.
    ///
    /// # Errors
    /// [`PaintingError`] for an impossible sample (its index counts from the first of the
    /// stroke), if no stroke is open or it was lifted, and if the device was lost.
    pub fn extend(&mut self, samples: &[Sample]) -> Result<(), PaintingError> {
        let surfaces = self.surfaces();
        for sample in samples {
            let open = self.stroke.as_mut().filter(|open| !open.is_lifted());
            let open = open.ok_or(PaintingError::NoStroke)?;
            let Stroke { on, samples: before, .. } = open.stroke();
            let at = CheckContext::default().sample(before.len());
            let far_mm = surfaces.reach_mm(&at, *on)?;
            let before = before.last().map_or(0.0, |sample| sample.seconds);
            let sample = open.decimals.round(sample);
            check_sample(&at, &sample, before, far_mm)?;
            open.extend(&[sample])?;
            // A stroke becomes an action with its first sample.
            if !open.is_open() {
                let opened = self.open_in_painting();
                self.follow_failure(opened)?;
            }
        }
        Ok(())
    }

    /// Opens the stroke in its painting, and moves the brush there with its paint.
    fn open_in_painting(&mut self) -> Result<(), PaintingError> {
        let Stroke { brush, on, .. } =
            self.stroke.as_ref().ok_or(PaintingError::NoStroke)?.stroke();
        let on = *on;
        let tool = self.tool(brush)?;
        let from = self.brushes.tools[tool].at;
        let id = self.brush_id(tool, on)?;
        let paint = if from == on {
            None
        } else {
            let away = self.brush_id(tool, from)?;
            Some(self.surface_mut(from)?.take_brush_paint(away)?)
        };
        let (open, painting) = self.stroke_and_painting()?;
        open.open(painting, id, paint.as_ref())?;
        open.from = from;
        self.brushes.tools[tool].at = on;
        Ok(())
    }

    /// The open stroke and the painting that it is on.
    fn stroke_and_painting(&mut self) -> Result<(&mut OpenStroke, &mut Painting), PaintingError> {
        let open = self.stroke.as_mut().ok_or(PaintingError::NoStroke)?;
        let painting = match (open.stroke().on, &mut self.palette) {
            (SurfaceId::Palette, Some(palette)) => palette,
            _ => &mut self.canvas,
        };
        Ok((open, painting))
    }

    /// Paints at most `most_substeps` sub-steps of the open stroke, and returns the number
    /// of known sub-steps that remain. The paint lags one sample behind until the brush is
    /// lifted. With `most_substeps` 0 it only counts.
    ///
    /// # Errors
    /// [`PaintingError`] if no stroke is open, or if the device was lost.
    pub fn advance(&mut self, most_substeps: usize) -> Result<usize, PaintingError> {
        let (open, painting) = self.stroke_and_painting()?;
        let waiting = open.advance(painting, most_substeps);
        self.follow_failure(waiting)
    }

    /// Lifts the brush: no more samples come, so that [`PaintingSession::advance`] can paint
    /// up to the last one.
    ///
    /// # Errors
    /// [`PaintingError::NoStroke`] if no stroke is open.
    pub fn lift(&mut self) -> Result<(), PaintingError> {
        self.stroke.as_mut().ok_or(PaintingError::NoStroke)?.lift();
        Ok(())
    }

    /// The open stroke, if one is open.
    #[must_use]
    pub fn open_stroke(&self) -> Option<&OpenStroke> {
        self.stroke.as_ref()
    }

    /// Paints a whole stroke. If it is `cut`, we do not lift the brush at its end. We refuse a
    /// stroke that is too long before we paint any of it.
    pub(super) fn apply_stroke(
        &mut self,
        Stroke { brush, on, tool, samples }: &Stroke,
        cut: bool,
    ) -> Result<Option<StrokeReport>, PaintingError> {
        let samples: Vec<_> =
            samples.iter().map(|sample| SampleDecimals::RECORDING.round(sample)).collect();
        let size_mm = self.brushes.tools[self.tool(brush)?].spec.size_mm;
        let mut path = Path::new(self.canvas.cell_mm(), size_mm)?;
        samples.iter().try_for_each(|sample| path.push(sample))?;
        self.begin_stroke_as(*tool, *on, brush, SampleDecimals::RECORDING)?;
        let extended = self.extend(&samples);
        let report = self.close_stroke(cut)?;
        extended?;
        Ok(report)
    }

    /// An action that paints what we have painted of the open stroke so far. Call this when no
    /// known sample waits (see [`PaintingSession::advance`]). It has the recorded name of the
    /// brush. `None` if the stroke has no sample.
    pub(super) fn cut_so_far(&self) -> Option<Action> {
        let mut stroke = self.stroke.as_ref().filter(|open| open.is_open())?.stroke().clone();
        let tool = self.brushes.find(&stroke.brush)?;
        stroke.brush.clone_from(&self.brushes.tools[tool].recorded);
        Some(Action::Cut(stroke))
    }

    /// Paints the rest of the open stroke and closes it, as one action. Returns `None` if it
    /// had no sample.
    ///
    /// # Errors
    /// [`PaintingError`] if no stroke is open, or if the device was lost.
    pub fn end_stroke(&mut self) -> Result<Option<StrokeReport>, PaintingError> {
        self.close_stroke(false)
    }

    fn close_stroke(&mut self, cut: bool) -> Result<Option<StrokeReport>, PaintingError> {
        let open = self.stroke.take().ok_or(PaintingError::NoStroke)?;
        if !open.is_open() {
            return Ok(None);
        }
        let from = open.from;
        let on = open.stroke().on;
        let (stroke, finished) = open.end(self.surface_mut(on)?, !cut);
        let report = self.follow_failure(finished)?;
        let tool = self.tool(&stroke.brush)?;
        let action = if cut { Action::Cut(stroke) } else { Action::Stroke(stroke) };
        let touched = PerSurface::from_fn(|surface| surface == on || surface == from);
        let carried = Some(Carried { tool, from, to: on });
        let label = self.label(&action, &ActionPigments::None);
        self.record_done(action, &ActionPigments::None, label, (touched, carried));
        Ok(Some(report))
    }
}
