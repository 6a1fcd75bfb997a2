//! Strokes on the canvas.

use super::failure::PaintingError;
use super::state::Painting;
use crate::brush::{Head, Relief};
use crate::contact::Contact;
use crate::history::CommitOutcome;
use crate::layer::Layer;
use crate::pose::Sample;
use crate::stroke::{Path, StrokeError};
use graphics::tile::Rect;

/// Sub-steps that go to the backend together: enough to hide what a call costs,
/// few enough that the contacts stay in the cache.
const BATCH: usize = 32;

/// What a stroke was.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StrokeReport {
    /// Sub-steps in which the head was over the canvas.
    pub substeps: u64,
    /// Cells of all their rectangles.
    pub cells: u64,
    /// Whether it fits what undo may keep.
    pub undoable: bool,
}

/// A stroke that is being drawn.
#[derive(Debug)]
pub(super) struct OpenStroke {
    brush: usize,
    path: Path,
    /// Whether the head was set down.
    down: bool,
    /// What is played now, and how much of it was.
    batch: Batch,
    played: usize,
    /// What the head bends through meanwhile.
    next: Batch,
    /// Samples that the paint has reached.
    reached: usize,
    report: StrokeReport,
}

/// Sub-steps that the head has bent through.
#[derive(Debug, Clone)]
struct Batch {
    contacts: Vec<Contact>,
    /// How many of them are.
    count: usize,
    /// Samples that the head had reached after them.
    reached: usize,
}

impl Batch {
    fn empty() -> Self {
        let nothing = Contact { rect: Rect::default(), touches: Vec::new() };
        Self { contacts: vec![nothing; BATCH], count: 0, reached: 0 }
    }

    /// Bends `head` through the next poses of `path`.
    fn bend(&mut self, path: &mut Path, head: &mut Head, relief: &Relief, bounds: Rect) {
        self.count = 0;
        for contact in &mut self.contacts {
            let Some(pose) = path.next() else { break };
            head.advance(&pose, relief, bounds, contact);
            self.count += 1;
        }
        self.reached = path.reached();
    }
}

impl OpenStroke {
    fn new(brush: usize, path: Path) -> Self {
        Self {
            brush,
            path,
            down: false,
            batch: Batch::empty(),
            played: 0,
            next: Batch::empty(),
            reached: 0,
            report: StrokeReport::default(),
        }
    }

    /// Sets the head down at the first pose, once it is known where it goes.
    fn set_down(&mut self, head: &mut Head, relief: &Relief) {
        if self.down {
            return;
        }
        if let Some((first, next)) = self.path.set_out() {
            head.set_down(&first, (next.x - first.x, next.y - first.y), relief);
            self.down = true;
        }
    }

    /// Sub-steps that wait, as far as known.
    fn waiting(&mut self) -> usize {
        let known = if self.down { self.path.waiting() } else { 0 };
        self.batch.count - self.played + known
    }
}

impl Painting {
    /// Draws a stroke. One undo takes it back, with the paint that it took from
    /// the brush or gave to it.
    ///
    /// # Errors
    /// [`PaintingError`] for impossible samples, before anything is painted, or
    /// if the device was lost.
    ///
    /// # Panics
    /// If there is no such brush, or a stroke is open.
    pub fn stroke(
        &mut self,
        brush: usize,
        samples: &[Sample],
    ) -> Result<StrokeReport, PaintingError> {
        if samples.is_empty() {
            return Err(StrokeError::Empty.into());
        }
        let mut path = Path::new(self.cell_mm)?;
        path.push(samples)?;
        self.open_stroke(OpenStroke::new(brush, path), None)?;
        self.end_stroke()
    }

    /// Begins a stroke that is told piece by piece, as a pen tells it:
    /// [`Painting::extend_stroke`] takes samples, [`Painting::advance_stroke`]
    /// paints what they tell, in portions, so that pictures can be shown in
    /// between, and [`Painting::end_stroke`] closes the action. However samples
    /// and portions are cut, paint and undo are to the bit those of
    /// [`Painting::stroke`] with all samples.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If there is no such brush, or a stroke is open.
    pub fn begin_stroke(&mut self, brush: usize) -> Result<(), PaintingError> {
        let path = Path::new(self.cell_mm)?;
        self.open_stroke(OpenStroke::new(brush, path), None)
    }

    /// The same with a brush that comes from elsewhere with `paint` on it: an
    /// undo gives it back what it held here before.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// As [`Painting::begin_stroke`], and if `paint` has not the cells of the
    /// head.
    pub fn begin_stroke_with(&mut self, brush: usize, paint: &Layer) -> Result<(), PaintingError> {
        let path = Path::new(self.cell_mm)?;
        self.open_stroke(OpenStroke::new(brush, path), Some(paint))
    }

    fn open_stroke(
        &mut self,
        stroke: OpenStroke,
        paint: Option<&Layer>,
    ) -> Result<(), PaintingError> {
        self.assert_idle("a stroke");
        let id = self.brushes[stroke.brush].id;
        self.history.begin(self.now());
        let opened = self.history.save_brush(&mut self.engine, id).and_then(|()| match paint {
            Some(paint) => self.engine.set_brush_paint(id, paint),
            None => Ok(()),
        });
        match opened {
            Ok(()) => self.stroke = Some(stroke),
            Err(_) => self.history.abandon(),
        }
        Ok(opened?)
    }

    /// Whether a stroke is open.
    #[must_use]
    pub fn stroke_open(&self) -> bool {
        self.stroke.is_some()
    }

    /// Whether a stroke with this brush is open.
    pub(super) fn strokes_with(&self, brush: usize) -> bool {
        self.stroke.as_ref().is_some_and(|stroke| stroke.brush == brush)
    }

    /// Leads the stroke on through `samples`, which [`Painting::advance_stroke`]
    /// will paint. If one is refused those before it are taken, and the stroke
    /// stays open: it can go on with others, or end.
    ///
    /// # Errors
    /// [`PaintingError::Stroke`] for an impossible sample, counted from the first
    /// of the stroke.
    ///
    /// # Panics
    /// If no stroke is open, or after [`Painting::lift_stroke`].
    pub fn extend_stroke(&mut self, samples: &[Sample]) -> Result<(), PaintingError> {
        Ok(self.open_one().path.push(samples)?)
    }

    /// Says that no more samples come, so that [`Painting::advance_stroke`] can
    /// paint all there is.
    ///
    /// # Panics
    /// If no stroke is open.
    pub fn lift_stroke(&mut self) {
        self.open_one().path.finish();
    }

    /// Paints on, at most `most_substeps` of the head's way; gives how many
    /// sub-steps wait, as far as known: 0 if nothing more can be painted before
    /// samples come or the stroke is lifted. The paint lags one sample behind,
    /// as the way to a sample bends with the one after it; a dab is painted when
    /// the stroke is lifted.
    ///
    /// While the backend moves the paint of 32 sub-steps, the head bends through
    /// the next 32 on another thread; multiples of that cost least.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If no stroke is open.
    pub fn advance_stroke(&mut self, most_substeps: usize) -> Result<usize, PaintingError> {
        let bounds = self.engine.bounds();
        let stroke = self.stroke.as_mut().expect(OPEN);
        let tool = &mut self.brushes[stroke.brush];
        let (head, relief) = (&mut tool.head, &self.relief);
        let (engine, history) = (&mut self.engine, &mut self.history);
        stroke.set_down(head, relief);
        let mut left = if stroke.down { most_substeps } else { 0 };
        while left > 0 {
            let rest = &stroke.batch.contacts[stroke.played..stroke.batch.count];
            let playing = &rest[..left.min(rest.len())];
            let all = playing.len() == rest.len();
            let touching = playing.iter().filter(|contact| !contact.rect.is_empty());
            let (path, next) = (&mut stroke.path, &mut stroke.next);
            let (played, ()) = rayon::join(
                || {
                    for contact in touching.clone() {
                        history.save_tiles(engine, contact.rect.grown(2, bounds))?;
                    }
                    engine.apply_contacts(tool.id, &self.motion, playing)
                },
                || {
                    if all {
                        next.bend(path, head, relief, bounds);
                    }
                },
            );
            for contact in touching {
                self.views.touch(contact.rect.grown(2, bounds));
                stroke.report.substeps += 1;
                stroke.report.cells += (contact.rect.width * contact.rect.height) as u64;
            }
            let idle = rest.is_empty() && stroke.next.count == 0;
            left -= playing.len();
            stroke.played += playing.len();
            if all {
                stroke.reached = stroke.batch.reached;
                std::mem::swap(&mut stroke.batch, &mut stroke.next);
                stroke.played = 0;
            }
            played?;
            if idle {
                break;
            }
        }
        if stroke.batch.count == stroke.played {
            stroke.reached = stroke.batch.reached;
        }
        Ok(stroke.waiting())
    }

    /// How many samples of the open stroke the paint has reached; 0 if none is
    /// open.
    #[must_use]
    pub fn stroke_reached(&self) -> usize {
        self.stroke.as_ref().map_or(0, |stroke| stroke.reached)
    }

    /// Paints what is left of the stroke and closes it, as one action. Without a
    /// sample there was no action; the brush keeps what it holds.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost; the stroke is closed as far as it
    /// came.
    ///
    /// # Panics
    /// If no stroke is open.
    pub fn end_stroke(&mut self) -> Result<StrokeReport, PaintingError> {
        self.lift_stroke();
        let painted = self.advance_stroke(usize::MAX);
        let OpenStroke { path, mut report, .. } = self.stroke.take().expect(OPEN);
        if path.samples() == 0 {
            self.history.abandon();
            report.undoable = true;
        } else {
            report.undoable = self.history.commit() == CommitOutcome::Undoable;
        }
        painted?;
        Ok(report)
    }

    fn open_one(&mut self) -> &mut OpenStroke {
        self.stroke.as_mut().expect(OPEN)
    }
}

const OPEN: &str = "a stroke is open, as the caller must know";
