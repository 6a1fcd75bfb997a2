//! Continues a session later or elsewhere: from its documents and its other state, from the brushes
//! in the file of a painting, or by playing a script.
//!
//! A session restored from its documents and a [`KeptSession`] paints the same bits as the session
//! itself would have: its brushes are the same heads with the same paint, and its recording goes
//! on. Its history is empty. In the continued recording, no undo reaches back to older actions.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::sync::Arc;

use documents::hint::Explain;

use super::history::Record;
use super::state::{KeptHead, Outcome, PaintingSession};
use crate::amount::MAX_COLUMN;
use crate::brush::Head;
use crate::mask::Mask;
use crate::painting::{Painting, PaintingError, StrokeReport, check_load};
use crate::stroke::{Path, SampleDecimals};
use crate::strokes::{Action, KeptBrush, ScriptError, StrokeScript, SurfaceId};

/// The end of a recording, from some action on.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordingTail {
    /// The recording without its actions, with all its brushes.
    pub header: StrokeScript,
    /// Number of actions before this end.
    pub from: usize,
    /// The actions from there.
    pub actions: Vec<Action>,
    /// The open stroke as far as it is painted, or the open adjustment. The recording holds it once
    /// it is finished, perhaps with more samples or other values.
    pub open: Option<Action>,
}

/// All that a session holds besides its documents and its history.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct KeptSession {
    /// All heads, in the order in which they were added.
    pub brushes: Vec<KeptHead>,
    /// The whole recording. `None` if the session records nothing.
    pub recording: Option<StrokeScript>,
    /// The mask of the canvas, if one is set.
    pub mask: Option<Arc<Mask>>,
}

impl PaintingSession {
    /// All heads with the paint on them.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn kept_heads(&mut self) -> Result<Vec<KeptHead>, PaintingError> {
        let mut heads = self.brushes.tools.clone();
        for head in &mut heads {
            if let Some(id) = head.ids[head.at] {
                let paint = self.surface_mut(head.at)?.brush_paint(id)?;
                head.paint = paint.totals().iter().any(|total| *total > 0).then_some(paint);
            }
        }
        Ok(heads)
    }

    /// The recording from action `from` on. `None` if the session records nothing or the recording
    /// ended early. If a stroke is open, first paint all its known sub-steps (see
    /// [`PaintingSession::advance`]), so that the recording agrees with the documents.
    #[must_use]
    pub fn recording_from(&self, from: usize) -> Option<RecordingTail> {
        let record = self.record.as_ref().filter(|record| record.stopped.is_none())?;
        let mut header = record.script.header();
        let open = match &self.adjusting {
            Some(adjusting) => Some(adjusting.action.clone()),
            None => self.cut_so_far(),
        };
        let stroke = self.stroke.as_ref();
        let tool = stroke.and_then(|open| self.brushes.find(&open.stroke().brush));
        if let (Some(_), Some(tool)) = (&open, tool) {
            let tool = &self.brushes.tools[tool];
            header.brushes.entry(tool.recorded.clone()).or_insert_with(|| tool.spec.clone());
        }
        let actions = record.script.actions.get(from..).unwrap_or_default().to_vec();
        let from = from.min(record.script.actions.len());
        Some(RecordingTail { header, from, actions, open })
    }

    /// Starts a session like [`PaintingSession::new`] that goes on from `kept`, which belongs to
    /// these surfaces.
    ///
    /// # Errors
    /// [`PaintingError`] if canvas, palette, brushes and mask do not go together, or if the device
    /// was lost.
    pub fn restored(
        canvas: Painting,
        palette: Option<Painting>,
        kept: KeptSession,
    ) -> Result<Self, PaintingError> {
        let mut session = Self::new(canvas, palette)?;
        if kept.mask.as_ref().is_some_and(|mask| mask.bounds() != session.canvas.bounds()) {
            return Err(PaintingError::Unlike("masks"));
        }
        session.canvas.hold_mask(kept.mask)?;
        for surface in SurfaceId::ALL {
            let mut used: Vec<(usize, &KeptHead)> = kept
                .brushes
                .iter()
                .filter_map(|brush| Some((brush.ids[surface]?.0, brush)))
                .collect();
            used.sort_by_key(|(number, _)| *number);
            for (expected, (number, brush)) in used.into_iter().enumerate() {
                if number != expected {
                    return Err(PaintingError::Unlike("brushes"));
                }
                let painting = session.surface_mut(surface)?;
                painting.add_brush(brush.spec.shape, brush.spec.size_mm)?;
            }
        }
        for brush in kept.brushes {
            session.restore_brush(brush)?;
        }
        session.record = kept.recording.map(Record::resumed);
        Ok(session)
    }

    fn restore_brush(&mut self, mut head: KeptHead) -> Result<(), PaintingError> {
        if let (Some(id), Some(paint)) = (head.ids[head.at], head.paint.take()) {
            let painting = self.surface_mut(head.at)?;
            if (paint.width(), paint.height()) != painting.head(id).paint_grid() {
                return Err(PaintingError::Unlike("brushes"));
            }
            painting.set_brush_paint(id, &paint)?;
        }
        self.brushes.restore(head);
        Ok(())
    }
}

/// If a cell of a saved brush has more paint than this, in quanta, we do not restore the paint.
/// This is half of what a cell can hold, so that the paint still fits into a cell of the canvas.
const MOST: u32 = MAX_COLUMN / 2;

impl PaintingSession {
    /// All brushes in the order of their names, with the paint that they hold.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub fn kept_brushes(&mut self) -> Result<Vec<KeptBrush>, PaintingError> {
        let mut heads = self.kept_heads()?;
        heads.retain(|head| head.named);
        heads.sort_by(|a, b| a.name.cmp(&b.name));
        let kept = heads.into_iter().map(|KeptHead { name, spec, at, paint, .. }| KeptBrush {
            name,
            spec,
            at,
            paint,
        });
        Ok(kept.collect())
    }

    /// Adds saved brushes with their paint, under the pigments of this session. Call this before
    /// you do anything else in the session. Returns the names of the brushes that stay clean,
    /// because their heads have other cells than in the version of the program that saved them, or
    /// because they hold too much paint.
    ///
    /// History and recording do not hold this. To replay the recording of such a session, take up
    /// the same brushes first.
    ///
    /// # Errors
    /// [`PaintingError`] for a head that cannot be made on cells of this width, or if the device was
    /// lost.
    pub fn take_up(&mut self, brushes: &[KeptBrush]) -> Result<Vec<String>, PaintingError> {
        let mut left = Vec::new();
        for KeptBrush { name, spec, at, paint } in brushes {
            self.set_brush(name, spec)?;
            let (Some(tool), Some(paint)) = (self.brushes.find(name), paint) else { continue };
            let at = if self.palette.is_some() { *at } else { SurfaceId::Canvas };
            let id = self.brush_id(tool, at)?;
            let painting = self.surface_mut(at)?;
            let fits = painting.head(id).paint_grid() == (paint.width(), paint.height());
            let cells = 0..paint.vehicle.values().len();
            let most = cells.map(|index| paint.cell(index).volume()).max().unwrap_or(0);
            if fits && most <= MOST {
                painting.set_brush_paint(id, paint)?;
                self.brushes.tools[tool].at = at;
            } else {
                left.push(name.clone());
            }
        }
        Ok(left)
    }
}

/// Counts of a replay.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ReplayReport {
    /// Number of actions played.
    pub actions: u64,
    /// Number of strokes among them.
    pub strokes: u64,
    /// Number of sub-steps of all strokes in which the head was over the canvas.
    pub substeps: u64,
    /// Number of cells of the rectangles of these sub-steps.
    pub cells: u64,
    /// Number of undo and redo actions without anything to undo or redo.
    pub idle: u64,
    /// Number of strokes too large for undo.
    pub not_undoable: u64,
}

/// Why a replay failed. `E` is the error of the function that saves.
#[derive(Debug, thiserror::Error, Explain)]
pub enum ReplayError<E: std::error::Error + 'static> {
    /// The script is invalid.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// The session refuses an action.
    #[error("action {} ({kind})", .index + 1)]
    #[hint(inner)]
    Action {
        /// Index of the action, from 0.
        index: usize,
        /// Key of the action in the file.
        kind: &'static str,
        /// Error of the session.
        #[source]
        error: Box<PaintingError>,
    },
    /// A file cannot be saved.
    #[error("action {} (save)", .0 + 1)]
    #[hint(inner = 1)]
    Save(usize, #[source] E),
}

impl StrokeScript {
    /// Plays all actions on `session`, which must have the surfaces of this script (see
    /// [`StrokeScript::surfaces`]). Brushes that the session has under the same name are used
    /// as they are.
    ///
    /// `save` is called with path and canvas for each action that saves a file. `step` is
    /// called after each action and can end the replay.
    ///
    /// # Errors
    /// [`ReplayError`] before the first action if the script is invalid (see
    /// [`StrokeScript::resolve`]) or asks for more than cells of this width allow: a larger brush, a longer
    /// stroke, more paint in one load. Else at the first action that fails.
    pub fn replay<E: std::error::Error + 'static>(
        &self,
        session: &mut PaintingSession,
        mut save: impl FnMut(&str, &mut Painting) -> Result<(), E>,
        mut step: impl FnMut() -> ControlFlow<()>,
    ) -> Result<ReplayReport, ReplayError<E>> {
        self.resolve(session.canvas().library())?;
        self.check_cells(session.canvas().cell_mm())?;
        session.add_names_of(&self.palette).map_err(ScriptError::from)?;
        let mut report = ReplayReport::default();
        let mut used = BTreeSet::new();
        for (index, action) in self.actions.iter().enumerate() {
            let failed = |error| {
                let error = Box::new(error);
                ReplayError::Action { index, kind: action.kind(), error }
            };
            if let Action::Save { path } = action {
                session.finish_open().map_err(failed)?;
                let canvas = session.canvas_mut();
                save(path, canvas).map_err(|error| ReplayError::Save(index, error))?;
            } else {
                // Brushes are added when they are first used.
                if let Some(name) = action.brush()
                    && used.insert(name)
                {
                    session.set_brush(name, &self.brushes[name]).map_err(failed)?;
                }
                report.count(action, session.apply(action).map_err(failed)?);
            }
            report.actions += 1;
            if step().is_break() {
                break;
            }
        }
        Ok(report)
    }

    /// Checks all that depends on the width of the cells, so that no replay fails in the middle for it.
    fn check_cells<E: std::error::Error + 'static>(
        &self,
        cell_mm: f64,
    ) -> Result<(), ReplayError<E>> {
        let mut heads = BTreeMap::new();
        for (index, action) in self.actions.iter().enumerate() {
            self.check_action(action, cell_mm, &mut heads).map_err(|error| {
                let error = Box::new(error);
                ReplayError::Action { index, kind: action.kind(), error }
            })?;
        }
        Ok(())
    }

    /// Checks an action on cells of this width. `heads` holds the heads of the brushes so far.
    fn check_action<'a>(
        &'a self,
        action: &'a Action,
        cell_mm: f64,
        heads: &mut BTreeMap<&'a str, Head>,
    ) -> Result<(), PaintingError> {
        let Some((name, spec)) = action.brush().and_then(|name| self.brushes.get_key_value(name))
        else {
            return Ok(());
        };
        if !heads.contains_key(name.as_str()) {
            heads.insert(name, Head::new(spec.shape, spec.size_mm, cell_mm)?);
        }
        if let Action::Load(load) = action {
            check_load(&heads[name.as_str()], cell_mm, load.amount_mm)?;
        }
        if let Some(stroke) = action.stroke() {
            let mut path = Path::new(cell_mm, spec.size_mm)?;
            for sample in &stroke.samples {
                path.push(&SampleDecimals::RECORDING.round(sample))?;
            }
        }
        Ok(())
    }
}

impl ReplayReport {
    fn count(&mut self, action: &Action, outcome: Outcome) {
        match outcome {
            Outcome::Painted(StrokeReport { substeps, cells, undoable, .. }) => {
                self.strokes += 1;
                self.substeps += substeps;
                self.cells += cells;
                self.not_undoable += u64::from(!undoable);
            }
            Outcome::Nothing if matches!(action, Action::Undo {} | Action::Redo {}) => {
                self.idle += 1;
            }
            Outcome::Nothing | Outcome::Done => {}
        }
    }
}
