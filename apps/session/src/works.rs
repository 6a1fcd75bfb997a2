//! The place where the work of a session is done: a thread, or the turns that a front end gives.

use std::cell::RefCell;
use std::fmt;

use super::awaited::Awaited;
use super::inbox::Wait;

/// The thread of a loop, or the loop itself.
pub(crate) enum Works<Loop> {
    /// On a thread, which is waited for.
    OnThread { _thread: Awaited },
    /// In the turns that the front end gives; nothing after the command to quit.
    InTurns(RefCell<Option<Box<Loop>>>),
}

impl<Loop> Works<Loop> {
    /// A loop that works in turns.
    pub(crate) fn in_turns(work: Loop) -> Self {
        Self::InTurns(RefCell::new(Some(Box::new(work))))
    }

    /// Calls `turn` of a loop that works in turns, and ends the loop if it returns `None`. Returns how long
    /// it may wait for the next turn.
    pub(crate) fn turn(&self, turn: impl FnOnce(&mut Loop) -> Option<Wait>) -> Wait {
        let Self::InTurns(work) = self else { return Wait::Forever };
        // A wake that calls back finds the loop at work.
        let Ok(mut work) = work.try_borrow_mut() else { return Wait::Forever };
        let wait = work.as_mut().and_then(|work| turn(work));
        if wait.is_none() {
            *work = None;
        }
        wait.unwrap_or(Wait::Forever)
    }
}

impl<Loop> fmt::Debug for Works<Loop> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::OnThread { .. } => "OnThread",
            Self::InTurns(_) => "InTurns",
        })
    }
}
