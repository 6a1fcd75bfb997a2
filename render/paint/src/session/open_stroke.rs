//! The open stroke of a session.

use super::history::Carried;
use super::state::{PaintingSession, SessionError, SessionStroke};
use crate::painting::{OpenStroke, Painting, PaintingError, StrokeReport};
use crate::pose::Sample;
use crate::stroke::{Path, SampleDecimals};
use crate::strokes::{
    Action, ActionPigments, CheckContext, PerSurface, Stroke, StrokeTool, SurfaceId, check_brush,
    check_sample, check_tool, six_digits,
};

impl PaintingSession {
    /// The open stroke and the painting that it is on.
    fn stroke_and_painting(&mut self) -> Result<(&mut SessionStroke, &mut Painting), SessionError> {
        let open = self.stroke.as_mut().ok_or(SessionError::NoStroke)?;
        let painting = match (open.on, &mut self.palette) {
            (SurfaceId::Palette, Some(palette)) => palette,
            _ => &mut self.canvas,
        };
        Ok((open, painting))
    }

    /// Sets a brush down on a surface. Samples follow. Any open stroke or adjustment is
    /// finished first. Samples are rounded to [`SampleDecimals::RECORDING`].
    ///
    /// # Errors
    /// [`SessionError`] if there is no such brush or surface, or if the device was lost.
    pub fn begin_stroke(&mut self, on: SurfaceId, brush: &str) -> Result<(), SessionError> {
        self.begin_rounded_stroke(on, brush, SampleDecimals::RECORDING)
    }

    /// Sets a brush down like [`PaintingSession::begin_stroke`], for samples that are rounded
    /// to `decimals`, at most the decimals of a recording.
    ///
    /// # Errors
    /// [`SessionError`] if there is no such brush or surface, or if the device was lost.
    pub fn begin_rounded_stroke(
        &mut self,
        on: SurfaceId,
        brush: &str,
        decimals: SampleDecimals,
    ) -> Result<(), SessionError> {
        self.begin_stroke_as(StrokeTool::Paint, on, brush, decimals)
    }

    /// Sets the head of a brush down as `tool`, like [`PaintingSession::begin_rounded_stroke`]. The
    /// number of the tool is rounded to six digits.
    ///
    /// # Errors
    /// [`SessionError`] if there is no such brush or surface, if the number of the tool is out of
    /// range, or if the device was lost.
    pub fn begin_stroke_as(
        &mut self,
        tool: StrokeTool,
        on: SurfaceId,
        brush: &str,
        decimals: SampleDecimals,
    ) -> Result<(), SessionError> {
        let working = tool.map(six_digits);
        check_tool(&CheckContext::default(), working)?;
        self.finish_open()?;
        self.surface_mut(on)?;
        check_brush(&CheckContext::default(), brush, self.brushes.names().map(|(name, _)| name))?;
        if let Some(tool) = self.brushes.find(brush) {
            let size_mm = self.brushes.tools[tool].spec.size_mm;
            let stroke = OpenStroke::new(self.canvas.cell_mm(), size_mm, working)?;
            let samples = Vec::new();
            let from = None;
            self.stroke = Some(SessionStroke { on, tool, decimals, samples, from, stroke });
        }
        Ok(())
    }

    /// Rounds samples and adds them to the open stroke. [`PaintingSession::advance`] paints
    /// them. If one is refused, those before it count, and the stroke stays open.
    ///
    /// # Errors
    /// [`SessionError`] for an impossible sample (its index counts from the first of the
    /// stroke), if no stroke is open or it was lifted, and if the device was lost.
    pub fn extend(&mut self, samples: &[Sample]) -> Result<(), SessionError> {
        let surfaces = self.surfaces();
        for sample in samples {
            let stroke = self.stroke.as_mut().filter(|open| !open.stroke.is_lifted());
            let open = stroke.ok_or(SessionError::NoStroke)?;
            let at = CheckContext::default().sample(open.samples.len());
            let far_mm = surfaces.reach_mm(&at, open.on)?;
            let before = open.samples.last().map_or(0.0, |sample| sample.seconds);
            let sample = open.decimals.round(sample);
            check_sample(&at, &sample, before, far_mm)?;
            open.stroke.extend(&[sample]).map_err(PaintingError::from)?;
            open.samples.push(sample);
            // A stroke becomes an action with its first sample.
            if open.from.is_none() {
                let opened = self.open_in_painting();
                self.follow_failure(opened)?;
            }
        }
        Ok(())
    }

    /// Opens the stroke in its painting, and moves the brush there with its paint.
    fn open_in_painting(&mut self) -> Result<(), SessionError> {
        let open = self.stroke.as_ref().ok_or(SessionError::NoStroke)?;
        let on = open.on;
        let tool = open.tool;
        let from = self.brushes.tools[tool].at;
        let (id, paint) = if from == on {
            (self.brush_id(tool, on)?, None)
        } else {
            let away = self.brush_id(tool, from)?;
            let here = self.brush_id(tool, on)?;
            (here, Some(self.surface_mut(from)?.take_brush_paint(away)?))
        };
        let (open, painting) = self.stroke_and_painting()?;
        open.stroke.open(painting, id, paint.as_ref())?;
        open.from = Some(from);
        self.brushes.tools[tool].at = on;
        Ok(())
    }

    /// Paints at most `most_substeps` sub-steps of the open stroke, and returns the number
    /// of known sub-steps that remain. The paint lags one sample behind until the brush is
    /// lifted. With `most_substeps` 0 it only counts.
    ///
    /// # Errors
    /// [`SessionError`] if no stroke is open, or if the device was lost.
    pub fn advance(&mut self, most_substeps: usize) -> Result<usize, SessionError> {
        let (open, painting) = self.stroke_and_painting()?;
        let waiting = open.stroke.advance(painting, most_substeps);
        self.follow_failure(waiting.map_err(SessionError::from))
    }

    /// Lifts the brush: no more samples come, so that [`PaintingSession::advance`] can paint
    /// up to the last one.
    ///
    /// # Errors
    /// [`SessionError::NoStroke`] if no stroke is open.
    pub fn lift(&mut self) -> Result<(), SessionError> {
        self.stroke.as_mut().ok_or(SessionError::NoStroke)?.stroke.lift();
        Ok(())
    }

    /// Surface and brush of the open stroke, if one is open.
    #[must_use]
    pub fn open_stroke(&self) -> Option<(SurfaceId, &str)> {
        let open = self.stroke.as_ref()?;
        Some((open.on, self.brushes.tools[open.tool].name.as_str()))
    }

    /// Progress of the open stroke, if one is open.
    #[must_use]
    pub fn stroke_progress(&self) -> Option<&OpenStroke> {
        self.stroke.as_ref().map(|open| &open.stroke)
    }

    /// Paints a whole stroke. One that is `cut` is not lifted at its end. A stroke that is too long
    /// is refused before any of it is painted.
    pub(super) fn apply_stroke(
        &mut self,
        Stroke { brush, on, tool: working, samples }: &Stroke,
        cut: bool,
    ) -> Result<Option<StrokeReport>, SessionError> {
        let samples: Vec<_> =
            samples.iter().map(|sample| SampleDecimals::RECORDING.round(sample)).collect();
        let tool = self.brushes.find(brush).map(|tool| &self.brushes.tools[tool]);
        let size_mm = tool.map_or(0.0, |tool| tool.spec.size_mm);
        let mut path = Path::new(self.canvas.cell_mm(), size_mm).map_err(PaintingError::from)?;
        path.push(&samples).map_err(PaintingError::from)?;
        self.begin_stroke_as(*working, *on, brush, SampleDecimals::RECORDING)?;
        let extended = self.extend(&samples);
        let report = self.close_stroke(cut)?;
        extended?;
        Ok(report)
    }

    /// The open stroke as the action that paints what is painted of it, once nothing known waits
    /// (see [`PaintingSession::advance`]), with the recorded name of its brush. `None` without a
    /// sample.
    pub(super) fn cut_so_far(&self) -> Option<Action> {
        let SessionStroke { on, tool, samples, from, stroke, .. } = self.stroke.as_ref()?;
        from.as_ref()?;
        let brush = self.brushes.tools[*tool].recorded.clone();
        Some(Action::Cut(Stroke { brush, on: *on, tool: stroke.tool(), samples: samples.clone() }))
    }

    /// Paints the rest of the open stroke and closes it, as one action. Returns `None` if it
    /// had no sample.
    ///
    /// # Errors
    /// [`SessionError`] if no stroke is open, or if the device was lost.
    pub fn end_stroke(&mut self) -> Result<Option<StrokeReport>, SessionError> {
        self.close_stroke(false)
    }

    fn close_stroke(&mut self, cut: bool) -> Result<Option<StrokeReport>, SessionError> {
        let open = self.stroke.take().ok_or(SessionError::NoStroke)?;
        let SessionStroke { on, tool, samples, from: Some(from), stroke, .. } = open else {
            return Ok(None);
        };
        let working = stroke.tool();
        let painting = self.surface_mut(on)?;
        let finished = if cut { stroke.cut(painting) } else { stroke.finish(painting) };
        let report = self.follow_failure(finished.map_err(SessionError::from))?;
        let brush = self.brushes.tools[tool].name.clone();
        let stroke = Stroke { brush, on, tool: working, samples };
        let action = if cut { Action::Cut(stroke) } else { Action::Stroke(stroke) };
        let mut touched = PerSurface::default();
        (touched[on], touched[from]) = (true, true);
        let label = action.label(&ActionPigments::None, &self.canvas);
        let carried = Some(Carried { tool, from, to: on });
        self.history.add(label, touched, carried);
        self.limit_history();
        self.note_with(action, Some(tool));
        Ok(Some(report))
    }
}
