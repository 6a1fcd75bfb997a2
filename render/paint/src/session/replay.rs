//! Playing a script on a session.

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use documents::hint::{Explain, Fault, Hint};

use super::failure::SessionError;
use super::state::{Outcome, PaintingSession};
use crate::painting::{Painting, StrokeReport};
use crate::strokes::{Action, ScriptError, StrokeScript};

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

/// Why a replay failed; `E` is the error of the function that saves.
#[derive(Debug, thiserror::Error)]
pub enum ReplayError<E: std::error::Error + 'static> {
    /// The script is invalid.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// The session refuses an action.
    #[error("action {index} ({kind})")]
    Action {
        /// Index of the action, from 0.
        index: usize,
        /// Key of the action in the file.
        kind: &'static str,
        /// Error of the session.
        #[source]
        error: Box<SessionError>,
    },
    /// A file cannot be saved.
    #[error("action {index} (save)")]
    Save {
        /// Index of the action, from 0.
        index: usize,
        /// Error of the function that saves.
        #[source]
        error: E,
    },
}

impl<E: Explain + 'static> Explain for ReplayError<E> {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::Script(error) => error.hint(),
            Self::Action { error, .. } => error.hint(),
            Self::Save { error, .. } => error.hint(),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Script(error) => error.fault(),
            Self::Action { error, .. } => error.fault(),
            Self::Save { error, .. } => error.fault(),
        }
    }
}

impl StrokeScript {
    /// Plays all actions on `session`, whose surfaces must be those of this script (see
    /// [`StrokeScript::surfaces`]). Brushes that the session has under the same name are used
    /// as they are.
    ///
    /// `save` is called with path and canvas for each action that saves a file; `step` is
    /// called after each action and can end the replay.
    ///
    /// # Errors
    /// [`ReplayError`] before the first action if the script is invalid (see
    /// [`StrokeScript::resolve`]), else at the first action that fails.
    pub fn replay<E: std::error::Error + 'static>(
        &self,
        session: &mut PaintingSession,
        mut save: impl FnMut(&str, &mut Painting) -> Result<(), E>,
        mut step: impl FnMut() -> ControlFlow<()>,
    ) -> Result<ReplayReport, ReplayError<E>> {
        self.resolve(session.canvas().library())?;
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
                save(path, canvas).map_err(|error| ReplayError::Save { index, error })?;
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
