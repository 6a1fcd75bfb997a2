//! The stroke that is being painted.

use std::collections::VecDeque;
use std::time::Instant;

use render::paint::pose::Sample;
use render::paint::session::{PaintingSession, SessionError};
use render::paint::strokes::SurfaceId;

use super::event::HeadOnCanvas;
use super::meter::Meter;
use super::outbox::Outbox;

/// A stroke from where the brush is set down to where all of it is painted,
/// which may be long after the pen was lifted.
#[derive(Debug)]
pub(super) struct LiveStroke {
    surface: SurfaceId,
    brush: String,
    /// When the samples arrived that the paint has not reached.
    arrived: VecDeque<Instant>,
    /// How many it has.
    reached: usize,
    /// Whether a sample was refused.
    pub(super) refused: bool,
    pub(super) lifted: bool,
    /// Sub-steps that wait, as far as known.
    pub(super) waiting: usize,
    played: usize,
}

impl LiveStroke {
    /// Sets a brush down.
    ///
    /// # Errors
    /// [`SessionError`] if there is no such brush, or the device was lost.
    pub(super) fn begin(
        session: &mut PaintingSession,
        surface: SurfaceId,
        brush: &str,
    ) -> Result<Self, SessionError> {
        session.begin_stroke(surface, brush)?;
        Ok(Self {
            surface,
            brush: brush.to_owned(),
            arrived: VecDeque::new(),
            reached: 0,
            refused: false,
            lifted: false,
            waiting: 0,
            played: 0,
        })
    }

    /// Leads it on to a sample that arrived then.
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

    /// Asks how many sub-steps wait.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub(super) fn know(&mut self, session: &mut PaintingSession) -> Result<(), SessionError> {
        self.waiting = session.advance(0)?;
        Ok(())
    }

    /// No more samples come.
    ///
    /// # Errors
    /// [`SessionError`] where the session knows of no stroke.
    pub(super) fn lift(&mut self, session: &mut PaintingSession) -> Result<(), SessionError> {
        if !self.lifted {
            session.lift()?;
            self.lifted = true;
        }
        Ok(())
    }

    /// Paints on for a while; whether anything was painted.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub(super) fn slice(
        &mut self,
        session: &mut PaintingSession,
        meter: &mut Meter,
        outbox: &mut Outbox,
    ) -> Result<bool, SessionError> {
        self.know(session)?;
        let (known, began) = (self.waiting, Instant::now());
        self.waiting = session.advance(meter.slice())?;
        let (now, played) = (Instant::now(), known - self.waiting);
        meter.played(now, played, now - began);
        self.played += played;
        let reached =
            session.painting(self.surface).map_or(0, |painting| painting.stroke_reached());
        for arrived in self.arrived.drain(..(reached - self.reached).min(self.arrived.len())) {
            outbox.reached(arrived);
        }
        self.reached = reached;
        Ok(played > 0)
    }

    /// Whether the pen was lifted and all is painted.
    pub(super) fn is_over(&self) -> bool {
        self.lifted && self.waiting == 0
    }

    /// Its brush.
    pub(super) fn brush(&self) -> &str {
        &self.brush
    }

    /// Sub-steps that a sample of this stroke took so far.
    pub(super) fn substeps_a_sample(&self) -> f64 {
        let samples = self.reached + self.arrived.len();
        (self.played + self.waiting) as f64 / samples.max(1) as f64
    }

    /// The head as it is bent now.
    pub(super) fn head(&self, session: &PaintingSession) -> Option<HeadOnCanvas> {
        let number = session.brush_number(&self.brush, self.surface)?;
        let mesh = session.painting(self.surface)?.head(number).mesh()?;
        Some(HeadOnCanvas {
            surface: self.surface,
            around: mesh.around,
            along: mesh.along,
            vertices: mesh.vertices,
        })
    }
}
