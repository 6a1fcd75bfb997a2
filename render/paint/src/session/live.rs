//! Strokes as a pen tells them.

use super::failure::SessionError;
use super::history::{Carried, Entry};
use super::label::label;
use super::state::PaintingSession;
use crate::painting::{PaintingError, StrokeReport};
use crate::pose::Sample;
use crate::stroke::Path;
use crate::strokes::{
    Action, ActionPigments, CheckContext, SampleDecimals, Stroke, SurfaceId, check_brush,
    check_sample,
};

/// A stroke that is open.
#[derive(Debug)]
pub(super) struct Live {
    on: SurfaceId,
    tool: usize,
    /// Those that were taken.
    samples: Vec<Sample>,
    /// Where the brush came from, once the stroke is open in the painting: with
    /// its first sample.
    from: Option<SurfaceId>,
    lifted: bool,
}

impl PaintingSession {
    /// Sets a brush down on a surface; samples follow. What is open ends first.
    ///
    /// # Errors
    /// [`SessionError`] if there is no such brush or surface, or if the device was
    /// lost.
    pub fn begin_stroke(&mut self, on: SurfaceId, brush: &str) -> Result<(), SessionError> {
        self.finish_open()?;
        self.surface_mut(on)?;
        check_brush(&CheckContext::default(), brush, self.brushes.names().map(|(name, _)| name))?;
        if let Some(tool) = self.brushes.find(brush) {
            let samples = Vec::new();
            self.live = Some(Live { on, tool, samples, from: None, lifted: false });
        }
        Ok(())
    }

    /// Leads the brush on; [`PaintingSession::advance`] paints. Samples are rounded to four
    /// decimals, as a file has them. If one is refused those before it are
    /// taken, and the stroke stays open.
    ///
    /// # Errors
    /// [`SessionError`] for an impossible sample, counted from the first of the
    /// stroke, where none is open or it was lifted, or if the device was lost.
    pub fn extend(&mut self, samples: &[Sample]) -> Result<(), SessionError> {
        let surfaces = self.surfaces();
        for sample in samples {
            let live = self.live.as_ref().filter(|live| !live.lifted);
            let live = live.ok_or(SessionError::NoStroke)?;
            let at = CheckContext::default().sample(live.samples.len());
            let far_mm = surfaces.reach_mm(&at, live.on)?;
            let before = live.samples.last().map_or(0.0, |sample| sample.seconds);
            let sample = SampleDecimals::RECORDING.round(sample);
            check_sample(&at, &sample, before, far_mm)?;
            if live.from.is_none() {
                // A stroke without a sample that could be painted was none.
                let mut path = Path::new(self.canvas.cell_mm()).map_err(PaintingError::from)?;
                path.push(&[sample]).map_err(PaintingError::from)?;
                let opened = self.open();
                self.followed(opened)?;
            }
            let on = live_surface(self.live.as_ref())?;
            self.surface_mut(on)?.extend_stroke(&[sample])?;
            self.live.iter_mut().for_each(|live| live.samples.push(sample));
        }
        Ok(())
    }

    /// Opens the stroke in its painting, and takes the brush there with the paint
    /// on it.
    fn open(&mut self) -> Result<(), SessionError> {
        let live = self.live.as_ref().ok_or(SessionError::NoStroke)?;
        let (on, tool) = (live.on, live.tool);
        let from = self.brushes.tools[tool].at;
        if from == on {
            let number = self.number(tool, on)?;
            self.surface_mut(on)?.begin_stroke(number)?;
        } else {
            let (away, here) = (self.number(tool, from)?, self.number(tool, on)?);
            let paint = self.surface_mut(from)?.hand_over(away)?;
            self.surface_mut(on)?.begin_stroke_with(here, &paint)?;
            self.brushes.tools[tool].at = on;
        }
        self.live.iter_mut().for_each(|live| live.from = Some(from));
        Ok(())
    }

    /// Paints on, at most `most_substeps` of the brush's way; gives how many
    /// sub-steps wait, as far as known. The paint lags a sample behind, until the
    /// stroke is lifted.
    ///
    /// # Errors
    /// [`SessionError`] where no stroke is open, or if the device was lost.
    pub fn advance(&mut self, most_substeps: usize) -> Result<usize, SessionError> {
        let live = self.live.as_ref().ok_or(SessionError::NoStroke)?;
        if live.from.is_none() {
            return Ok(0);
        }
        let on = live.on;
        let waiting = self.surface_mut(on)?.advance_stroke(most_substeps);
        self.followed(waiting.map_err(SessionError::from))
    }

    /// Says that no more samples come: [`PaintingSession::advance`] can paint all there is.
    ///
    /// # Errors
    /// [`SessionError::NoStroke`] where no stroke is open.
    pub fn lift(&mut self) -> Result<(), SessionError> {
        let live = self.live.as_mut().ok_or(SessionError::NoStroke)?;
        live.lifted = true;
        if live.from.is_some() {
            let on = live.on;
            self.surface_mut(on)?.lift_stroke();
        }
        Ok(())
    }

    /// SurfaceId and brush of the stroke that is open, if one is.
    #[must_use]
    pub fn open_stroke(&self) -> Option<(SurfaceId, &str)> {
        let live = self.live.as_ref()?;
        Some((live.on, self.brushes.tools[live.tool].name.as_str()))
    }

    /// Paints what is left and closes the stroke, as one action; nothing if it
    /// had no sample.
    ///
    /// # Errors
    /// [`SessionError`] where no stroke is open, or if the device was lost.
    pub fn end_stroke(&mut self) -> Result<Option<StrokeReport>, SessionError> {
        let live = self.live.take().ok_or(SessionError::NoStroke)?;
        let Live { on, tool, samples, from: Some(from), .. } = live else { return Ok(None) };
        let ended = self.surface_mut(on)?.end_stroke();
        let report = self.followed(ended.map_err(SessionError::from))?;
        let brush = self.brushes.tools[tool].name.clone();
        let action = Action::Stroke(Stroke { brush, on, samples });
        let mut touched = [false; 2];
        (touched[on as usize], touched[from as usize]) = (true, true);
        let label = label(&action, &ActionPigments::None, self.canvas.library());
        let carried = Some(Carried { tool, from, to: on });
        self.history.add(Entry { label, on: touched, carried });
        self.follow();
        self.note_with(action, Some(tool));
        Ok(Some(report))
    }
}

fn live_surface(live: Option<&Live>) -> Result<SurfaceId, SessionError> {
    live.map(|live| live.on).ok_or(SessionError::NoStroke)
}
