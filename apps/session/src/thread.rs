//! Threads that work on paint, and the turns that take their place: a page in a browser has no
//! threads, so it does other work between its frames.

use std::cell::RefCell;
use std::fmt;
use std::thread::{self, JoinHandle};

use web_time::{Duration, Instant};

/// How long the worker may wait for commands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Wait {
    /// Not at all: there is work to do.
    None,
    /// Until this time at most.
    Until(Instant),
    /// Without a time limit.
    Forever,
}

impl Wait {
    /// Waits until `then`, or forever if this is `None`.
    pub(crate) fn until(then: Option<Instant>) -> Self {
        match then {
            None => Self::Forever,
            Some(then) if then <= Instant::now() => Self::None,
            Some(then) => Self::Until(then),
        }
    }
}

/// Longest time to wait for a thread to end. Reading a file may take longer, but nobody waits that
/// long for a window to close.
const LONGEST: Duration = Duration::from_secs(5);

const LOOK: Duration = Duration::from_millis(1);

/// A thread that works on paint. Drivers of graphics devices end with the process and crash if a
/// thread still uses them. So tell the thread to end before you drop this, which waits for it.
#[derive(Debug)]
pub(crate) struct Awaited(JoinHandle<()>);

impl Awaited {
    pub(crate) fn spawn(work: impl FnOnce() + Send + 'static) -> Self {
        Self(thread::spawn(work))
    }
}

impl Drop for Awaited {
    fn drop(&mut self) {
        let begun = Instant::now();
        while !self.0.is_finished() && begun.elapsed() < LONGEST {
            thread::sleep(LOOK);
        }
    }
}

/// Work that runs on a thread, or in turns.
pub(crate) enum Works<Loop> {
    /// Runs on a thread. Dropping this waits for it.
    OnThread { _thread: Awaited },
    /// Runs in the turns that the front end gives. It is `None` after the command to quit.
    InTurns(RefCell<Option<Box<Loop>>>),
}

impl<Loop> Works<Loop> {
    pub(crate) fn in_turns(work: Loop) -> Self {
        Self::InTurns(RefCell::new(Some(Box::new(work))))
    }

    /// Calls `turn` if the loop works in turns, and ends the loop if `turn` returns `None`. Returns
    /// how long the front end may wait for the next turn.
    pub(crate) fn turn(&self, turn: impl FnOnce(&mut Loop) -> Option<Wait>) -> Wait {
        let Self::InTurns(work) = self else { return Wait::Forever };
        // If a wake calls back here, the loop is borrowed already.
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

/// Starts `work` on a thread. In a page it waits until you call [`next`].
pub fn start(work: impl FnOnce() + Send + 'static) {
    #[cfg(target_arch = "wasm32")]
    waiting::WAITING.with_borrow_mut(|waiting| waiting.push_back(Box::new(work)));
    #[cfg(not(target_arch = "wasm32"))]
    thread::spawn(work);
}

/// In a page, does the work that has waited longest. Returns whether there was any. On machines
/// with threads this always returns false.
pub fn next() -> bool {
    #[cfg(target_arch = "wasm32")]
    if let Some(work) = waiting::WAITING.with_borrow_mut(std::collections::VecDeque::pop_front) {
        work();
        return true;
    }
    false
}

#[cfg(target_arch = "wasm32")]
mod waiting {
    use std::cell::RefCell;
    use std::collections::VecDeque;

    type Work = Box<dyn FnOnce()>;

    thread_local! {
        pub(super) static WAITING: RefCell<VecDeque<Work>> = const { RefCell::new(VecDeque::new()) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::{Sender, channel};

    #[test]
    fn the_thread_has_ended_when_its_owner_is_gone() {
        /// Like the workers, this thread ends when its sender is dropped.
        struct Owner {
            _inputs: Sender<()>,
            _thread: Awaited,
        }
        let (inputs, receiver) = channel::<()>();
        let (ended, is_ended) = channel();
        let thread = Awaited::spawn(move || {
            let _ = receiver.recv();
            thread::sleep(Duration::from_millis(50));
            ended.send(()).unwrap();
        });
        drop(Owner { _inputs: inputs, _thread: thread });
        assert!(is_ended.try_recv().is_ok(), "the owner did not wait");
    }
}
