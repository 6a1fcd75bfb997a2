//! Painting the open stroke in slices, and the latency of its samples.

use std::collections::VecDeque;
use web_time::Instant;

use paint::painting::OpenStroke;
use paint::pose::Sample;
use paint::session::{PaintingSession, SessionError};

use super::event::HeadOnCanvas;
use super::meter::Meter;
use super::outbox::Outbox;

/// Arrival times of the samples of the session's open stroke, and the work done for it. The
/// stroke itself is in the session ([`PaintingSession::stroke_progress`]).
#[derive(Debug, Default)]
pub(super) struct StrokeTiming {
    /// Arrival times of the samples up to which the stroke is not painted yet.
    arrived: VecDeque<Instant>,
    /// Number of samples up to which the stroke is painted.
    reached: usize,
    /// Number of sub-steps painted.
    painted: usize,
    /// Whether a sample was refused.
    pub(super) refused: bool,
}

impl StrokeTiming {
    /// Adds a sample to the open stroke.
    ///
    /// # Errors
    /// [`SessionError`] for an impossible sample; the stroke goes on without it.
    pub(super) fn extend(
        &mut self,
        session: &mut PaintingSession,
        sample: &Sample,
        arrived: Instant,
    ) -> Result<(), SessionError> {
        session.extend(&[*sample])?;
        self.arrived.push_back(arrived);
        Ok(())
    }

    /// Paints one slice of the open stroke, about 8 ms of work. Returns whether anything was
    /// painted.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub(super) fn paint_slice(
        &mut self,
        session: &mut PaintingSession,
        meter: &mut Meter,
        outbox: &mut Outbox,
    ) -> Result<bool, SessionError> {
        let known = session.advance(0)?;
        let start = Instant::now();
        let waiting = session.advance(meter.slice())?;
        let now = Instant::now();
        let painted = known - waiting;
        meter.add_slice(now, painted, now - start);
        self.painted += painted;
        let reached = session.stroke_progress().map_or(0, OpenStroke::reached);
        for arrived in self.arrived.drain(..(reached - self.reached).min(self.arrived.len())) {
            outbox.add_reached(arrived);
        }
        self.reached = reached;
        Ok(painted > 0)
    }

    /// Mean number of sub-steps per sample of this stroke so far.
    pub(super) fn substeps_per_sample(&self, session: &PaintingSession) -> f64 {
        let samples = self.reached + self.arrived.len();
        (self.painted + waiting_substeps(session)) as f64 / samples.max(1) as f64
    }
}

/// Number of sub-steps of the open stroke that follow from its samples and are not painted yet.
pub(super) fn waiting_substeps(session: &PaintingSession) -> usize {
    session.stroke_progress().map_or(0, OpenStroke::waiting)
}

/// Whether the brush of the open stroke was lifted.
pub(super) fn is_lifted(session: &PaintingSession) -> bool {
    session.stroke_progress().is_some_and(OpenStroke::is_lifted)
}

/// Head of the brush of the open stroke, as it is bent now.
pub(super) fn head_on_canvas(session: &PaintingSession) -> Option<HeadOnCanvas> {
    let (surface, brush) = session.open_stroke()?;
    let id = session.brush_id_on(brush, surface)?;
    let mesh = session.painting(surface)?.head(id).mesh()?;
    Some(HeadOnCanvas { surface, around: mesh.around, along: mesh.along, vertices: mesh.vertices })
}
