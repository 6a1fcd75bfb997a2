//! Runs the work of a session. The front end holds a [`Worker`]. This works on a thread of its own,
//! or in the turns that the front end gives it. If you drop a worker, it waits for its thread to
//! end. A page in a browser has no threads, so it does other work between its frames.

use std::cell::RefCell;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::{self, JoinHandle};

use documents::hint::Hint;
use graphics::gpu::BackendChoice;
use paint::painting::UNDO_BYTES;
use web_time::{Duration, Instant};

use super::backend::Backend;
use super::command::Command;
use super::event::Event;
use super::inbox::{Inbox, Input, Wait};
use super::worker::WorkerLoop;

/// Settings of a worker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WorkerOptions {
    /// Backend that computes the paint. The default is the best one available.
    pub backend: BackendChoice,
    /// Limit of the memory for undo, in bytes. The default is 512 MiB.
    pub undo_bytes: u64,
}

impl Default for WorkerOptions {
    fn default() -> Self {
        Self { backend: BackendChoice::Auto, undo_bytes: UNDO_BYTES }
    }
}

/// Handle of the worker that owns the paint. If you drop this, the thread ends, and the drop waits
/// for it for at most five seconds.
#[derive(Debug)]
pub struct Worker {
    // Dropped first, so that the thread ends.
    inputs: Sender<Input>,
    events: Receiver<Event>,
    works: Works<WorkerLoop<'static>>,
}

impl Worker {
    /// Starts the thread. There is no painting until you send [`Command::Open`]. The thread calls
    /// `wake` after each event, so that you can draw the window again.
    ///
    /// The worker sends only a few parts of pictures until you receive them with
    /// [`Worker::events`]. If you read rarely, you get the changes in between combined.
    #[must_use]
    pub fn start(options: WorkerOptions, wake: impl Fn() + Send + 'static) -> Self {
        let (inputs, receiver) = channel();
        let (sender, events) = channel();
        let thread = Awaited::spawn(move || {
            let send = move |event| {
                // Sending fails only if the front end has dropped the receiver.
                let _ = sender.send(event);
                wake();
            };
            report_panic(&send, || {
                let backend = Backend::new(options.backend);
                WorkerLoop::new(Inbox::new(receiver), backend, options.undo_bytes, &send).run();
            });
        });
        Self { inputs, events, works: Works::OnThread { _thread: thread } }
    }

    /// A worker without a thread, for a page in a browser. It works only while you call
    /// [`Worker::turn`], and calls `wake` after each event.
    #[must_use]
    pub fn in_turns(options: WorkerOptions, wake: impl Fn() + 'static) -> Self {
        let (inputs, receiver) = channel();
        let (sender, events) = channel();
        let send = move |event| {
            // Sending fails only if the front end has dropped the receiver.
            let _ = sender.send(event);
            wake();
        };
        let backend = Backend::new(options.backend);
        let work = WorkerLoop::new(Inbox::new(receiver), backend, options.undo_bytes, send);
        Self { inputs, events, works: Works::in_turns(work) }
    }

    /// Lets a worker of [`Worker::in_turns`] work until `deadline`, or until it must wait. It
    /// finishes what it has begun by then, at most a slice of 8 ms or one command. Returns how long
    /// you may wait until the next turn, where [`Wait::Forever`] means until the next command. On a
    /// worker with a thread this does nothing.
    pub fn turn(&self, deadline: Instant) -> Wait {
        self.works.turn(|work| work.turn(deadline))
    }

    /// Sends a command. This has no effect after the worker has ended.
    pub fn ask(&self, command: Command) {
        let _ = self.inputs.send(Input::Command(command));
    }

    /// Events since the last call.
    pub fn events(&self) -> impl Iterator<Item = Event> + '_ {
        let events: Vec<Event> = self.events.try_iter().collect();
        let received = events
            .iter()
            .filter(|event: &&Event| matches!(event, Event::Tiles { .. } | Event::Head(Some(_))))
            .count();
        if received > 0 {
            let _ = self.inputs.send(Input::Confirmed(received));
        }
        events.into_iter()
    }
}

/// Runs `work`, and sends a message if it panics.
fn report_panic(send: &dyn Fn(Event), work: impl FnOnce()) {
    let Err(panic) = catch_unwind(AssertUnwindSafe(work)) else { return };
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    let reason = text.unwrap_or("no reason given");
    send(Event::Message {
        text: format!("painting has stopped by a fault of the program: {reason}"),
        hint: Some(Hint::new("start it again; it takes up what was saved last")),
        failed: true,
    });
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
    use std::cell::RefCell;
    use std::sync::mpsc::{Sender, channel};

    #[test]
    fn a_panic_is_reported() {
        let events = RefCell::new(Vec::new());
        let send = |event| events.borrow_mut().push(event);
        report_panic(&send, || {});
        assert!(events.borrow().is_empty(), "nothing happened");
        let cells = 3;
        report_panic(&send, || assert!(cells > 7, "there are {cells} cells"));
        let [Event::Message { text, hint, failed: true }] = &events.borrow()[..] else {
            panic!("one message: {events:?}");
        };
        assert!(text.contains("there are 3 cells") && hint.is_some(), "{text}");
    }

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
