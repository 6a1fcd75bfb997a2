//! The stroke that is being painted.

use std::collections::VecDeque;
use std::time::Instant;

use render::paint::easel::{Easel, EaselError};
use render::paint::pose::Sample;
use render::paint::strokes::Surface;

use super::event::HeadOnCanvas;
use super::meter::Meter;
use super::outbox::Outbox;

/// A stroke from where the brush is set down to where all of it is painted,
/// which may be long after the pen was lifted.
#[derive(Debug)]
pub(super) struct Live {
    surface: Surface,
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

impl Live {
    /// Sets a brush down.
    ///
    /// # Errors
    /// [`EaselError`] if there is no such brush, or the device was lost.
    pub(super) fn begin(
        easel: &mut Easel,
        surface: Surface,
        brush: &str,
    ) -> Result<Self, EaselError> {
        easel.begin_stroke(surface, brush)?;
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
    /// [`EaselError`] for an impossible sample; the stroke goes on without it.
    pub(super) fn extend(
        &mut self,
        easel: &mut Easel,
        sample: &Sample,
        arrived: Instant,
    ) -> Result<(), EaselError> {
        easel.extend(&[*sample])?;
        self.arrived.push_back(arrived);
        Ok(())
    }

    /// Asks how many sub-steps wait.
    ///
    /// # Errors
    /// [`EaselError`] if the device was lost.
    pub(super) fn know(&mut self, easel: &mut Easel) -> Result<(), EaselError> {
        self.waiting = easel.advance(0)?;
        Ok(())
    }

    /// No more samples come.
    ///
    /// # Errors
    /// [`EaselError`] where the easel knows of no stroke.
    pub(super) fn lift(&mut self, easel: &mut Easel) -> Result<(), EaselError> {
        if !self.lifted {
            easel.lift()?;
            self.lifted = true;
        }
        Ok(())
    }

    /// Paints on for a while; whether anything was painted.
    ///
    /// # Errors
    /// [`EaselError`] if the device was lost.
    pub(super) fn slice(
        &mut self,
        easel: &mut Easel,
        meter: &mut Meter,
        outbox: &mut Outbox,
    ) -> Result<bool, EaselError> {
        self.know(easel)?;
        let (known, began) = (self.waiting, Instant::now());
        self.waiting = easel.advance(meter.slice())?;
        let (now, played) = (Instant::now(), known - self.waiting);
        meter.played(now, played, now - began);
        self.played += played;
        let reached = easel.painting(self.surface).map_or(0, |painting| painting.stroke_reached());
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
    pub(super) fn head(&self, easel: &Easel) -> Option<HeadOnCanvas> {
        let number = easel.brush_number(&self.brush, self.surface)?;
        let mesh = easel.painting(self.surface)?.head(number).mesh()?;
        Some(HeadOnCanvas {
            surface: self.surface,
            around: mesh.around,
            along: mesh.along,
            vertices: mesh.vertices,
        })
    }
}
