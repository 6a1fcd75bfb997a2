//! The open stroke: one state machine from the first sample to the last sub-step.
//!
//! The head bends through one batch of sub-steps while the batch before is painted. A tool works
//! with a clean head: the paint of the brush is set aside, and the paint that the tool takes off is
//! counted.

use graphics::gpu::DeviceError;
use graphics::tile::{Rect, Tile, TileSet};

use super::failure::PaintingError;
use super::state::Painting;
use super::tip_load::TipLoad;
use crate::amount::mm_from_quanta;
use crate::brush::{Head, HeadShape, Relief, SideBySide, StrokeTool};
use crate::contact::{Contact, Touch};
use crate::engine::{BrushId, PaintEngine};
use crate::history::CommitOutcome;
use crate::layer::{Layer, SLOTS};
use crate::motion::bed::BLOCK;
use crate::motion::levelling_sub_steps;
use crate::pose::{Pose, Sample};
use crate::stroke::{Path, SampleDecimals, StrokeError};
use crate::strokes::{Stroke, SurfaceId};

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

/// A stroke between the first and the last contact with a [`Painting`]: the samples so far and
/// what is painted of them.
///
/// A [`PaintingSession`](crate::PaintingSession) holds its open stroke. On a painting alone you
/// own it: add samples with [`OpenStroke::extend`] as they come, paint in portions with
/// [`OpenStroke::advance`], so that pictures can be shown in between, and close the action with
/// [`OpenStroke::finish`]. Paint and undo are the same to the bit as with [`Painting::stroke`]
/// with all samples, for any portions.
///
/// Until it is finished, the painting refuses all other actions (they panic).
#[derive(Debug)]
#[must_use = "the painting refuses other actions until the stroke is finished"]
pub struct OpenStroke {
    /// Brush, surface and tool, with the samples that were accepted.
    stroke: Stroke,
    /// Decimals that a session rounds samples to.
    pub(crate) decimals: SampleDecimals,
    /// Surface that the brush came from.
    pub(crate) from: SurfaceId,
    /// Brush of the painting that the stroke is open in.
    brush: Option<BrushId>,
    /// The clean head of a tool that blends or takes paint, while the stroke is open in the painting.
    /// `None` for a stroke that paints.
    clean: Option<CleanHead>,
    path: Path,
    /// Whether the head was set down.
    down: bool,
    /// Contacts that are painted now.
    batch: Batch,
    /// Number of contacts of `batch` that are painted.
    painted: usize,
    /// Contacts that the head bends through while `batch` is painted.
    next: Batch,
    reached: usize,
    /// Number of sub-steps that were painted.
    done: usize,
    waiting: usize,
    /// Tiles that the head was over.
    touched: TileSet,
    /// Tiles whose surface before the stroke is noted.
    noted: TileSet,
    report: StrokeReport,
}

impl OpenStroke {
    /// `stroke`, which has no samples, on cells of `cell_mm` mm with a brush of `size_mm`. It is
    /// not yet open in a painting.
    pub(crate) fn new(
        cell_mm: f64,
        size_mm: f64,
        stroke: Stroke,
        decimals: SampleDecimals,
    ) -> Result<Self, PaintingError> {
        stroke.tool.check()?;
        Ok(Self {
            from: stroke.on,
            stroke,
            decimals,
            brush: None,
            clean: None,
            path: Path::new(cell_mm, size_mm)?,
            down: false,
            batch: Batch::empty(),
            painted: 0,
            next: Batch::empty(),
            reached: 0,
            done: 0,
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
        let tool = &painting.brushes[brush.0];
        let id = tool.id;
        let is_blade = tool.head.shape() == HeadShape::Knife;
        let sweeps = self.stroke.tool == StrokeTool::Paint && !is_blade;
        if sweeps {
            self.path.sweep();
        }
        painting.history.begin(painting.undo_state());
        let engine = &mut painting.engine;
        let opened = painting.history.save_brush(engine, id).and_then(|()| {
            if let Some(paint) = paint {
                engine.set_brush_paint(id, paint)?;
            }
            let clean = CleanHead::of(self.stroke.tool, engine, id)?;
            let head = &mut painting.brushes[brush.0].head;
            let bank_mm = if is_blade {
                let rows = head.rows_with_paint().len();
                let paint = engine.brush_paint(id)?;
                let area = head.paint_cell_area();
                TipLoad::of(&paint, rows, painting.cell_mm, area).thickness_mm()
            } else {
                0.0
            };
            head.begin(bank_mm, sweeps);
            Ok(clean)
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

    /// Brush, surface and tool, with the samples so far.
    #[must_use]
    pub fn stroke(&self) -> &Stroke {
        &self.stroke
    }

    /// Whether the stroke is open in a painting.
    pub(crate) fn is_open(&self) -> bool {
        self.brush.is_some()
    }

    /// Adds samples. [`OpenStroke::advance`] paints them. If we refuse a sample, the samples before
    /// it stay, and you can continue the stroke with others.
    ///
    /// # Errors
    /// [`StrokeError`] for an impossible sample (its index counts from the first of the
    /// stroke), and after [`OpenStroke::lift`].
    pub fn extend(&mut self, samples: &[Sample]) -> Result<(), StrokeError> {
        if self.is_lifted() {
            return Err(StrokeError::Lifted);
        }
        for sample in samples {
            self.path.push(sample)?;
            self.stroke.samples.push(*sample);
        }
        Ok(())
    }

    /// Lifts the brush: no more samples come, so that [`OpenStroke::advance`] can paint up
    /// to the last one.
    pub fn lift(&mut self) {
        self.path.finish();
    }

    /// Whether the brush was lifted.
    #[must_use]
    pub fn is_lifted(&self) -> bool {
        self.path.is_finished()
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

    /// Mean number of sub-steps that a sample has given so far.
    #[must_use]
    pub fn substeps_per_sample(&self) -> f64 {
        (self.done + self.waiting) as f64 / self.stroke.samples.len().max(1) as f64
    }

    /// Paints at most `most_substeps` sub-steps, and returns how many more are known: 0 if
    /// nothing can be painted before samples come or the brush is lifted. With
    /// `most_substeps` 0 it only counts.
    ///
    /// The paint lags one sample behind, as the path to a sample depends on the one after
    /// it. A dab is painted once the brush is lifted.
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
            let as_tool = self.stroke.tool;
            let settled = &mut TileSet::default();
            let (result, ()) = rayon::join(
                || {
                    for contact in touching.clone() {
                        let reach = contact.rect.grown(2, bounds);
                        history.save_tiles(engine, reach)?;
                        let around = contact.rect.grown(BLOCK, bounds);
                        for tile in tiles_of(around) {
                            if noted.insert_tile(tile) {
                                if engine.may_have_skin(tile) {
                                    history.save_tiles(engine, tile.rect(bounds))?;
                                    settled.insert_tile(tile);
                                }
                                engine.note_bed(tile, &motion)?;
                            }
                        }
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
            for tile in settled.iter() {
                painting.views.mark_wet_tile(tile);
            }
            for contact in touching {
                painting.views.mark_wet(contact.rect.grown(2, bounds));
                self.touched.insert(contact.rect);
                self.report.substeps += 1;
                self.report.cells += (contact.rect.width * contact.rect.height) as u64;
            }
            let idle = rest.is_empty() && self.next.count == 0;
            left -= now.len();
            self.painted += now.len();
            self.done += now.len();
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
    /// samples is no action. Its brush keeps its paint.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost. The part that was painted is closed as an
    /// action.
    ///
    /// # Panics
    /// If the stroke was begun on another painting.
    pub fn finish(self, painting: &mut Painting) -> Result<StrokeReport, PaintingError> {
        self.end(painting, true).1
    }

    /// Paints what is known of the stroke and closes it as one action, which is returned with its
    /// report. Without `lift` the brush is not lifted: the paint is as it was while the stroke was
    /// open.
    pub(crate) fn end(
        mut self,
        painting: &mut Painting,
        lift: bool,
    ) -> (Stroke, Result<StrokeReport, PaintingError>) {
        let painted = if lift {
            self.lift();
            self.advance(painting, usize::MAX).and_then(|_| self.level(painting))
        } else {
            self.advance(painting, usize::MAX).map(drop)
        };
        let wiped = self.clean.take().map(|clean| clean.finish(&mut painting.engine)).transpose();
        if self.is_open() {
            painting.stroke_brush = None;
            if self.stroke.samples.is_empty() {
                painting.history.abandon();
                self.report.undoable = true;
            } else {
                self.report.undoable = painting.history.commit() == CommitOutcome::Undoable;
            }
        }
        let report = painted.and_then(|()| {
            let taken = wiped?.unwrap_or_default();
            Ok(StrokeReport { taken, ..self.report })
        });
        (self.stroke, report)
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
        let contacts: Vec<Contact> = self
            .touched
            .iter()
            .map(|tile: Tile| {
                let rect = tile.rect(bounds);
                let touches = vec![Touch::NONE; rect.width * rect.height];
                Contact { rect, touches, ..Contact::default() }
            })
            .collect();
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

/// The tiles under `rect`.
fn tiles_of(rect: Rect) -> Vec<Tile> {
    let mut tiles = TileSet::default();
    tiles.insert(rect);
    tiles.iter().collect()
}

/// Most sub-steps that go to the backend together: enough to hide the cost of a call.
const BATCH: usize = 32;

/// Number of cells of contacts after which no more sub-steps are added to a batch, so that they
/// stay in the cache (chosen by timing).
const BATCH_CELLS: usize = 80_000;

/// If a contact has at least this many cells and there are threads for it, we draw several
/// sub-steps at once. For smaller contacts, handing the work over takes longer than it saves.
const WIDE_CELLS: usize = 6_000;

/// Maximum number of sub-steps drawn side by side.
const SIDE_BY_SIDE: usize = 4;

/// Number of sub-steps that we draw at once, with contacts of `cells` cells, on `threads` threads.
/// Some of the threads move the paint.
fn abreast(cells: usize, threads: usize) -> usize {
    if cells < WIDE_CELLS { 1 } else { (threads / 2).clamp(1, SIDE_BY_SIDE) }
}

/// Sub-steps that the head has bent through.
#[derive(Debug, Clone)]
struct Batch {
    contacts: Vec<Contact>,
    /// Number of contacts in use.
    count: usize,
    /// Number of samples that the head had reached after them.
    reached: usize,
    /// Poses of the sub-steps that are drawn next.
    poses: Vec<Pose>,
    side_by_side: SideBySide,
}

impl Batch {
    fn empty() -> Self {
        let nothing = Contact::default();
        Self {
            contacts: vec![nothing; BATCH],
            count: 0,
            reached: 0,
            poses: Vec::new(),
            side_by_side: SideBySide::default(),
        }
    }

    /// Bends `head` through the next poses of `path`, as `tool`.
    fn bend(
        &mut self,
        path: &mut Path,
        (head, tool): (&mut Head, StrokeTool),
        relief: &Relief,
        bounds: Rect,
    ) {
        self.count = 0;
        let mut cells = 0;
        let mut last = 0;
        while self.count < BATCH && cells < BATCH_CELLS {
            let rest = &mut self.contacts[self.count..];
            let count = abreast(last, rayon::current_num_threads()).min(rest.len());
            self.poses.clear();
            self.poses.extend(path.by_ref().take(count));
            match self.poses.as_slice() {
                [] => break,
                [pose] => head.advance_as(tool, pose, relief, bounds, &mut rest[0]),
                poses => self.side_by_side.advance_as((head, tool), poses, relief, bounds, rest),
            }
            let drawn = &rest[..self.poses.len()];
            cells += drawn.iter().map(|contact| contact.touches.len()).sum::<usize>();
            last = drawn.last().map_or(0, |contact| contact.touches.len());
            self.count += drawn.len();
        }
        self.reached = path.reached();
    }
}

/// Paint that a tool took off a surface: what went onto the clean head and was wiped off it. It is
/// exactly what the surface has lost. None for a stroke that paints.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TakenPaint {
    /// Quanta of each slot and, last, of the vehicle, summed over cells. See [`crate::amount`].
    pub quanta: [u64; SLOTS + 1],
}

impl TakenPaint {
    /// Volume in mm3 of each slot and, last, of the vehicle, on cells of `cell_mm` mm.
    #[must_use]
    pub fn volumes_mm3(&self, cell_mm: f64) -> [f64; SLOTS + 1] {
        let mm3 = mm_from_quanta(1, cell_mm) * cell_mm * cell_mm;
        self.quanta.map(|quanta| quanta as f64 * mm3)
    }

    /// Volume in mm3 of all of it, on cells of `cell_mm` mm.
    #[must_use]
    pub fn volume_mm3(&self, cell_mm: f64) -> f64 {
        self.volumes_mm3(cell_mm).iter().sum()
    }

    /// Adds the paint of a head.
    fn add(&mut self, paint: &Layer) {
        for (sum, more) in self.quanta.iter_mut().zip(paint.totals()) {
            *sum += more;
        }
    }
}

/// Number of sub-steps after which a head that only takes paint is emptied, so that no column of it
/// is ever full.
const EMPTIED_EVERY: usize = 128;

/// A head while it works as a tool: the paint of its brush is set aside.
#[derive(Debug)]
struct CleanHead {
    brush: BrushId,
    /// Paint of the brush, which the brush gets back at the end of the stroke.
    set_aside: Layer,
    taken: TakenPaint,
    /// Number of sub-steps since the head was emptied. `None` for a tool that lays its paint down
    /// again.
    since: Option<usize>,
}

impl CleanHead {
    /// Sets the paint of `brush` aside, if `tool` needs a clean head.
    fn of(
        tool: StrokeTool,
        engine: &mut PaintEngine,
        brush: BrushId,
    ) -> Result<Option<Self>, DeviceError> {
        let since = match tool {
            StrokeTool::Paint => return Ok(None),
            StrokeTool::Blend { .. } => None,
            StrokeTool::Scrape { .. } | StrokeTool::Erase { .. } => Some(0),
        };
        let set_aside = engine.brush_paint(brush)?;
        engine.set_brush_paint(brush, &Layer::empty(set_aside.width(), set_aside.height()))?;
        Ok(Some(Self { brush, set_aside, taken: TakenPaint::default(), since }))
    }

    /// Number of sub-steps that may be painted until [`CleanHead::painted`] takes the collected
    /// paint off the head. [`usize::MAX`] if the tool lays this paint down again.
    fn left(&self) -> usize {
        self.since.map_or(usize::MAX, |since| EMPTIED_EVERY - since)
    }

    /// Counts sub-steps, at most those of [`CleanHead::left`], and empties the head when it is
    /// time. The count does not depend on the portions of a stroke.
    fn painted(&mut self, engine: &mut PaintEngine, count: usize) -> Result<(), DeviceError> {
        let Some(since) = &mut self.since else { return Ok(()) };
        *since += count;
        if *since >= EMPTIED_EVERY {
            *since = 0;
            self.empty(engine)?;
        }
        Ok(())
    }

    fn empty(&mut self, engine: &mut PaintEngine) -> Result<(), DeviceError> {
        self.taken.add(&engine.brush_paint(self.brush)?);
        engine.set_brush_paint(
            self.brush,
            &Layer::empty(self.set_aside.width(), self.set_aside.height()),
        )
    }

    /// Wipes the head, gives the brush its paint back and returns all paint that was taken.
    fn finish(mut self, engine: &mut PaintEngine) -> Result<TakenPaint, DeviceError> {
        self.taken.add(&engine.brush_paint(self.brush)?);
        engine.set_brush_paint(self.brush, &self.set_aside)?;
        Ok(self.taken)
    }
}
