//! The open stroke: one state machine from the first sample to the last sub-step.

use super::batch::Batch;
use super::clean_head::CleanHead;
use super::failure::PaintingError;
use super::state::Painting;
use super::taken::TakenPaint;
use crate::brush::{Head, Relief, StrokeTool};
use crate::contact::{Contact, Touch};
use crate::engine::{BrushId, PaintEngine};
use crate::history::CommitOutcome;
use crate::layer::Layer;
use crate::motion::bed::BLOCK;
use crate::motion::levelling_sub_steps;
use crate::pose::Sample;
use crate::stroke::{Path, StrokeError};
use graphics::gpu::DeviceError;
use graphics::tile::{Rect, Tile, TileSet};

/// Work done for a finished stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StrokeReport {
    /// Sub-steps in which the head was over the canvas.
    pub substeps: u64,
    /// Total number of cells in the contact rectangles of these sub-steps.
    pub cells: u64,
    /// Whether the memory for undo can hold the stroke.
    pub undoable: bool,
    /// Paint that a tool took off the surface.
    pub taken: TakenPaint,
}

/// A stroke between the first and the last contact with a [`Painting`].
///
/// The caller owns it, adds samples with [`OpenStroke::extend`] as they come, paints in
/// portions with [`OpenStroke::advance`], so that pictures can be shown in between, and
/// closes the action with [`OpenStroke::finish`]. Paint and undo are the same to the bit
/// as those of [`Painting::stroke`] with all samples, for any portions.
///
/// Until it is finished, the painting refuses all other actions (they panic).
#[derive(Debug)]
#[must_use = "the painting refuses other actions until the stroke is finished"]
pub struct OpenStroke {
    /// Index of the brush, once the stroke is open in the painting.
    brush: Option<BrushId>,
    tool: StrokeTool,
    /// The head of a tool, while the stroke is open in the painting.
    clean: Option<CleanHead>,
    path: Path,
    lifted: bool,
    /// Whether the head was set down.
    down: bool,
    /// Contacts that are painted now.
    batch: Batch,
    /// Number of contacts of `batch` that are painted.
    painted: usize,
    /// Contacts that the head bends through while `batch` is painted.
    next: Batch,
    reached: usize,
    waiting: usize,
    /// Tiles that the head was over.
    touched: TileSet,
    /// Tiles whose surface before the stroke is noted.
    noted: TileSet,
    report: StrokeReport,
}

impl OpenStroke {
    /// A stroke without samples, on cells of `cell_mm` mm with a brush of `size_mm` as `tool`,
    /// that is not yet open in a painting.
    pub(crate) fn new(cell_mm: f64, size_mm: f64, tool: StrokeTool) -> Result<Self, PaintingError> {
        tool.check()?;
        Ok(Self {
            brush: None,
            tool,
            clean: None,
            path: Path::new(cell_mm, size_mm)?,
            lifted: false,
            down: false,
            batch: Batch::empty(),
            painted: 0,
            next: Batch::empty(),
            reached: 0,
            waiting: 0,
            touched: TileSet::default(),
            noted: TileSet::default(),
            report: StrokeReport::default(),
        })
    }

    /// Opens the stroke as an action of `painting`. With `paint`, the brush comes from
    /// another painting and starts with this paint.
    pub(crate) fn open(
        &mut self,
        painting: &mut Painting,
        brush: BrushId,
        paint: Option<&Layer>,
    ) -> Result<(), PaintingError> {
        painting.assert_idle("a stroke");
        let id = painting.brushes[brush.0].id;
        painting.history.begin(painting.undo_state());
        let engine = &mut painting.engine;
        let opened = painting.history.save_brush(engine, id).and_then(|()| {
            if let Some(paint) = paint {
                engine.set_brush_paint(id, paint)?;
            }
            CleanHead::of(self.tool, engine, id)
        });
        match opened {
            Ok(clean) => {
                self.clean = clean;
                (self.brush, painting.stroke_brush) = (Some(brush), Some(brush));
                Ok(())
            }
            Err(error) => {
                painting.history.abandon();
                Err(error.into())
            }
        }
    }

    /// The tool that the head is used as.
    #[must_use]
    pub fn tool(&self) -> StrokeTool {
        self.tool
    }

    /// Whether the stroke is open in a painting.
    pub(crate) fn is_open(&self) -> bool {
        self.brush.is_some()
    }

    /// Adds samples; [`OpenStroke::advance`] paints them. If one is refused, those before
    /// it are kept, and the stroke can continue with others.
    ///
    /// # Errors
    /// [`StrokeError`] for an impossible sample (its index counts from the first of the
    /// stroke), and after [`OpenStroke::lift`].
    pub fn extend(&mut self, samples: &[Sample]) -> Result<(), StrokeError> {
        if self.lifted {
            return Err(StrokeError::Lifted);
        }
        self.path.push(samples)
    }

    /// Lifts the brush: no more samples come, so that [`OpenStroke::advance`] can paint up
    /// to the last one.
    pub fn lift(&mut self) {
        self.lifted = true;
        self.path.finish();
    }

    /// Whether the brush was lifted.
    #[must_use]
    pub fn is_lifted(&self) -> bool {
        self.lifted
    }

    /// Number of samples so far.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.path.samples()
    }

    /// Number of samples that the paint has reached.
    #[must_use]
    pub fn reached(&self) -> usize {
        self.reached
    }

    /// Number of sub-steps that were known and not painted after the last
    /// [`OpenStroke::advance`].
    #[must_use]
    pub fn waiting(&self) -> usize {
        self.waiting
    }

    /// Paints at most `most_substeps` sub-steps, and returns how many more are known: 0 if
    /// nothing can be painted before samples come or the brush is lifted. With
    /// `most_substeps` 0 it only counts.
    ///
    /// The paint lags one sample behind, as the path to a sample depends on the one after
    /// it; a dab is painted once the brush is lifted.
    ///
    /// While the backend moves the paint of 32 sub-steps, the head bends through the next
    /// 32 on another thread, so multiples of 32 are fastest.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    ///
    /// # Panics
    /// If the stroke was begun on another painting.
    pub fn advance(
        &mut self,
        painting: &mut Painting,
        most_substeps: usize,
    ) -> Result<usize, PaintingError> {
        let Some(brush) = self.brush else { return Ok(0) };
        let open = painting.stroke_brush;
        assert_eq!(open, Some(brush), "the stroke was begun on another painting");
        let bounds = painting.engine.bounds();
        let motion = painting.motion();
        let tool = &mut painting.brushes[brush.0];
        let head = &mut tool.head;
        let relief = &painting.relief;
        let engine = &mut painting.engine;
        let history = &mut painting.history;
        self.set_down(head, relief);
        let mut left = if self.down { most_substeps } else { 0 };
        while left > 0 {
            let rest = &self.batch.contacts[self.painted..self.batch.count];
            let room = self.clean.as_ref().map_or(usize::MAX, CleanHead::left);
            let now = &rest[..left.min(rest.len()).min(room)];
            let all = now.len() == rest.len();
            let touching = now.iter().filter(|contact| !contact.rect.is_empty());
            let path = &mut self.path;
            let next = &mut self.next;
            let noted = &mut self.noted;
            let clean = &mut self.clean;
            let as_tool = self.tool;
            let (result, ()) = rayon::join(
                || {
                    for contact in touching.clone() {
                        let reach = contact.rect.grown(2, bounds);
                        history.save_tiles(engine, reach)?;
                        note_bed(engine, noted, contact.rect.grown(BLOCK, bounds))?;
                    }
                    engine.apply_contacts(tool.id, &motion, now)?;
                    clean.as_mut().map_or(Ok(()), |clean| clean.painted(engine, now.len()))
                },
                || {
                    if all {
                        next.bend(path, (head, as_tool), relief, bounds);
                    }
                },
            );
            for contact in touching {
                painting.views.mark_wet(contact.rect.grown(2, bounds));
                self.touched.insert(contact.rect);
                self.report.substeps += 1;
                self.report.cells += (contact.rect.width * contact.rect.height) as u64;
            }
            let idle = rest.is_empty() && self.next.count == 0;
            left -= now.len();
            self.painted += now.len();
            if all {
                self.reached = self.batch.reached;
                std::mem::swap(&mut self.batch, &mut self.next);
                self.painted = 0;
            }
            result?;
            if idle {
                break;
            }
        }
        if self.batch.count == self.painted {
            self.reached = self.batch.reached;
        }
        let known = if self.down { self.path.waiting() } else { 0 };
        self.waiting = self.batch.count - self.painted + known;
        Ok(self.waiting)
    }

    /// Paints the rest of the stroke and closes it, as one action. A stroke without
    /// samples is no action; its brush keeps its paint.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost; the part that was painted is closed as an
    /// action.
    ///
    /// # Panics
    /// If the stroke was begun on another painting.
    pub fn finish(mut self, painting: &mut Painting) -> Result<StrokeReport, PaintingError> {
        self.lift();
        let painted = self.advance(painting, usize::MAX).and_then(|_| self.level(painting));
        self.close(painting, painted)
    }

    /// Paints what is known of the stroke and closes it as one action, without lifting the brush:
    /// the paint is as it was while the stroke was open.
    ///
    /// # Errors
    /// [`PaintingError`] like [`OpenStroke::finish`].
    ///
    /// # Panics
    /// If the stroke was begun on another painting.
    pub fn cut(mut self, painting: &mut Painting) -> Result<StrokeReport, PaintingError> {
        let painted = self.advance(painting, usize::MAX).map(drop);
        self.close(painting, painted)
    }

    fn close(
        mut self,
        painting: &mut Painting,
        painted: Result<(), PaintingError>,
    ) -> Result<StrokeReport, PaintingError> {
        let wiped = self.clean.take().map(|clean| clean.finish(&mut painting.engine));
        if self.is_open() {
            painting.stroke_brush = None;
            if self.samples() == 0 {
                painting.history.abandon();
                self.report.undoable = true;
            } else {
                self.report.undoable = painting.history.commit() == CommitOutcome::Undoable;
            }
        }
        painted?;
        self.report.taken = wiped.transpose()?.unwrap_or_default();
        Ok(self.report)
    }

    /// Lets fluid paint level where the head was.
    fn level(&self, painting: &mut Painting) -> Result<(), PaintingError> {
        let Some(brush) = self.brush else { return Ok(()) };
        let bounds = painting.engine.bounds();
        let motion = painting.motion().everywhere();
        let stiffness = painting.state.medium.stiffness;
        let sub_steps = levelling_sub_steps(painting.cell_mm, stiffness);
        if sub_steps == 0 {
            return Ok(());
        }
        let id = painting.brushes[brush.0].id;
        let resting = |tile: Tile| {
            let rect = tile.rect(bounds);
            let touches = vec![Touch::NONE; rect.width * rect.height];
            Contact { rect, touches, ..Contact::default() }
        };
        let contacts: Vec<Contact> = self.touched.iter().map(resting).collect();
        for contact in &contacts {
            let reach = contact.rect.grown(2, bounds);
            painting.history.save_tiles(&mut painting.engine, reach)?;
            painting.views.mark_wet(reach);
        }
        for _ in 0..sub_steps {
            painting.engine.apply_contacts(id, &motion, &contacts)?;
        }
        Ok(())
    }

    /// Sets the head down at the first pose, once its direction is known.
    fn set_down(&mut self, head: &mut Head, relief: &Relief) {
        if self.down {
            return;
        }
        if let Some((first, next)) = self.path.set_out() {
            head.set_down(&first, (next.x - first.x, next.y - first.y), relief);
            self.down = true;
        }
    }
}

/// Notes the surface of the tiles under `rect` that are not yet `noted`.
fn note_bed(engine: &mut PaintEngine, noted: &mut TileSet, rect: Rect) -> Result<(), DeviceError> {
    let mut tiles = TileSet::default();
    tiles.insert(rect);
    for tile in tiles.iter() {
        if noted.insert_tile(tile) {
            engine.note_bed(tile)?;
        }
    }
    Ok(())
}
