//! A script played on an session.

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use super::failure::SessionError;
use super::state::{Outcome, PaintingSession};
use crate::painting::{Painting, StrokeReport};
use crate::strokes::{Action, ScriptError, StrokeScript};

/// What a replay did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ReplayReport {
    /// Actions played.
    pub actions: u64,
    /// Strokes among them.
    pub strokes: u64,
    /// Sub-steps of all strokes in which the head was over the canvas.
    pub substeps: u64,
    /// Cells of all their rectangles.
    pub cells: u64,
    /// Undo and redo that found nothing to do.
    pub idle: u64,
    /// Strokes too large for undo.
    pub not_undoable: u64,
}

/// Why a replay ended early; `E` is the saver's own error.
#[derive(Debug, thiserror::Error)]
pub enum ReplayError<E: std::error::Error + 'static> {
    /// No script that can be played.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// An action that the session refuses.
    #[error("action {index} ({kind})")]
    Action {
        /// Which action, counted from 0.
        index: usize,
        /// Its key in the file.
        kind: &'static str,
        /// Why.
        #[source]
        error: SessionError,
    },
    /// A file that could not be saved.
    #[error("action {index} (save)")]
    Save {
        /// Which action, counted from 0.
        index: usize,
        /// Why.
        #[source]
        error: E,
    },
}

impl StrokeScript {
    /// Plays all actions on `session`, which stands on the surfaces of this script
    /// (see [`StrokeScript::surfaces`]); brushes that it has already under the same name
    /// are used as they are. `save` is called for each action that saves, with
    /// its path and the canvas; `step` after each action: it may end the replay
    /// there, and the report tells after how many.
    ///
    /// # Errors
    /// [`ReplayError`] at the first action that cannot be done, and before any
    /// for scripts that nobody can play (see [`StrokeScript::resolve`]).
    pub fn replay<E: std::error::Error + 'static>(
        &self,
        session: &mut PaintingSession,
        mut save: impl FnMut(&str, &mut Painting) -> Result<(), E>,
        mut step: impl FnMut() -> ControlFlow<()>,
    ) -> Result<ReplayReport, ReplayError<E>> {
        self.resolve(session.canvas().library())?;
        session.know(&self.palette).map_err(ScriptError::from)?;
        let mut report = ReplayReport::default();
        let mut taken = BTreeSet::new();
        for (index, action) in self.actions.iter().enumerate() {
            let failed = |error| ReplayError::Action { index, kind: action.kind(), error };
            if let Action::Save { path } = action {
                session.finish_open().map_err(failed)?;
                let canvas = session.canvas_mut();
                save(path, canvas).map_err(|error| ReplayError::Save { index, error })?;
            } else {
                // A brush is taken from the jar when it is first used.
                if let Some(name) = action.brush()
                    && taken.insert(name)
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
}

impl ReplayReport {
    fn count(&mut self, action: &Action, outcome: Outcome) {
        match outcome {
            Outcome::Painted(StrokeReport { substeps, cells, undoable }) => {
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
