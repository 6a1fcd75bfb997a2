//! Strokes on the canvas.

use super::failure::PaintingError;
use super::state::Painting;
use crate::layer::Layer;
use crate::paint::brush::{Head, Relief};
use crate::paint::contact::Contact;
use crate::paint::history::Kept;
use crate::paint::pose::Sample;
use crate::paint::stroke::{Path, StrokeError};
use crate::tile::Rect;

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
    /// The first `ready` of these come next; the head has bent through them.
    bent: Vec<Contact>,
    ready: usize,
    /// Where the head bends through those after them.
    spare: Vec<Contact>,
    /// Samples that the head has reached, and the paint.
    head_reached: usize,
    reached: usize,
    report: StrokeReport,
}

impl OpenStroke {
    fn new(brush: usize, path: Path) -> Self {
        let bent = vec![Contact { rect: Rect::default(), touches: Vec::new() }; BATCH];
        Self {
            brush,
            path,
            down: false,
            spare: bent.clone(),
            bent,
            ready: 0,
            head_reached: 0,
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
        self.ready + known
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
        assert!(self.stroke.is_none(), "a stroke is open; it ends before the next");
        let id = self.brushes[stroke.brush].id;
        self.history.begin(self.now());
        let opened =
            self.history.touch_brush(self.engine.as_mut(), id).and_then(|()| match paint {
                Some(paint) => self.engine.set_brush(id, paint),
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
    /// While the backend moves the paint of some sub-steps, the head bends
    /// through the next ones on another thread.
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
        let (engine, history) = (self.engine.as_mut(), &mut self.history);
        stroke.set_down(head, relief);
        let mut left = if stroke.down { most_substeps } else { 0 };
        while left > 0 {
            let (path, next) = (&mut stroke.path, &mut stroke.spare);
            let playing = &stroke.bent[..stroke.ready];
            let (played, made) = rayon::join(
                || {
                    for contact in playing {
                        history.touch(engine, contact.rect.grown(2, bounds))?;
                    }
                    engine.play(tool.id, &self.motion, playing)
                },
                || {
                    let mut made = 0;
                    while let Some(contact) = next.get_mut(made).filter(|_| left > 0) {
                        let Some(pose) = path.next() else { break };
                        left -= 1;
                        head.advance(&pose, relief, bounds, contact);
                        made += usize::from(!contact.rect.is_empty());
                    }
                    made
                },
            );
            for contact in playing {
                self.unshown.insert(contact.rect.grown(2, bounds));
                stroke.report.substeps += 1;
                stroke.report.cells += (contact.rect.width * contact.rect.height) as u64;
            }
            let idle = stroke.ready == 0 && made == 0;
            std::mem::swap(&mut stroke.bent, &mut stroke.spare);
            stroke.ready = made;
            stroke.reached = stroke.head_reached;
            stroke.head_reached = stroke.path.reached();
            played?;
            if idle {
                break;
            }
        }
        if stroke.ready == 0 {
            stroke.reached = stroke.head_reached;
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
            report.undoable = self.history.commit() == Kept::Undoable;
        }
        painted?;
        Ok(report)
    }

    fn open_one(&mut self) -> &mut OpenStroke {
        self.stroke.as_mut().expect(OPEN)
    }
}

const OPEN: &str = "a stroke is open, as the caller must know";
