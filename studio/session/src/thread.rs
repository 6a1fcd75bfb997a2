//! The worker, seen from the window.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use render::gpu::BackendChoice;
use render::paint::painting::UNDO_BYTES;
use spectra::hint::Hint;

use super::backend::Backend;
use super::command::Command;
use super::event::Event;
use super::inbox::{Inbox, Input};
use super::worker::WorkerLoop;

/// What a worker is told once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WorkerOptions {
    /// What computes.
    pub backend: BackendChoice,
    /// Bytes that undo may keep at first.
    pub undo_bytes: u64,
}

impl Default for WorkerOptions {
    fn default() -> Self {
        Self { backend: BackendChoice::Auto, undo_bytes: UNDO_BYTES }
    }
}

/// The thread that owns the paint.
#[derive(Debug)]
pub struct Worker {
    said: Sender<Input>,
    events: Receiver<Event>,
}

impl Worker {
    /// Starts the thread; it has no painting until it is asked to open one.
    /// `wake` is called from it after every event, so that the window draws
    /// again.
    ///
    /// Only a few parts of the picture are told before the window takes them
    /// with [`Worker::events`]; a window that draws rarely gets what changed in
    /// between at once.
    #[must_use]
    pub fn start(options: WorkerOptions, wake: impl Fn() + Send + 'static) -> Self {
        let (said, heard) = channel();
        let (told, events) = channel();
        thread::spawn(move || {
            let tell = move |event| {
                // A window that is gone hears nothing.
                let _ = told.send(event);
                wake();
            };
            watched(&tell, || {
                let backend = Backend::new(options.backend);
                WorkerLoop::new(Inbox::new(heard), backend, options.undo_bytes, &tell).run();
            });
        });
        Self { said, events }
    }

    /// Asks for something. A worker that ended takes no more.
    pub fn ask(&self, command: Command) {
        let _ = self.said.send(Input::Command(command));
    }

    /// What was told since the last call.
    pub fn events(&self) -> impl Iterator<Item = Event> + '_ {
        let events: Vec<Event> = self.events.try_iter().collect();
        let paced = |event: &&Event| matches!(event, Event::Tiles { .. } | Event::Head(Some(_)));
        let taken = events.iter().filter(paced).count();
        if taken > 0 {
            let _ = self.said.send(Input::Taken(taken));
        }
        events.into_iter()
    }
}

/// Works, and tells if that ends in a panic.
fn watched(tell: &dyn Fn(Event), work: impl FnOnce()) {
    let Err(panic) = catch_unwind(AssertUnwindSafe(work)) else { return };
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    let reason = text.unwrap_or("no reason given");
    tell(Event::Message {
        text: format!("painting has stopped by a fault of the program: {reason}"),
        hint: Some(Hint::new("start it again; it takes up what was saved last")),
        failed: true,
    });
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;

    #[test]
    fn a_panic_is_told() {
        let told = RefCell::new(Vec::new());
        let tell = |event| told.borrow_mut().push(event);
        watched(&tell, || {});
        assert!(told.borrow().is_empty(), "nothing happened");
        let cells = 3;
        watched(&tell, || assert!(cells > 7, "there are {cells} cells"));
        let [Event::Message { text, hint, failed: true }] = &told.borrow()[..] else {
            panic!("one message: {told:?}");
        };
        assert!(text.contains("there are 3 cells") && hint.is_some(), "{text}");
    }
}
