//! The worker, seen from the window.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use render::gpu::BackendChoice;
use render::paint::painting::UNDO_BYTES;

use super::backend::Backend;
use super::command::Command;
use super::event::Event;
use super::inbox::{Inbox, Said};
use super::workshop::Workshop;

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
    said: Sender<Said>,
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
            let work = || {
                let backend = Backend::new(options.backend);
                Workshop::new(Inbox::new(heard), backend, options.undo_bytes, &tell).run();
            };
            if let Err(panic) = catch_unwind(AssertUnwindSafe(work)) {
                tell(Event::Message {
                    text: format!(
                        "painting has stopped by a fault of the program: {}",
                        words(&*panic)
                    ),
                    hint: Some("start it again; it takes up what was saved last".to_owned()),
                    failed: true,
                });
            }
        });
        Self { said, events }
    }

    /// Asks for something. A worker that ended takes no more.
    pub fn ask(&self, command: Command) {
        let _ = self.said.send(Said::Command(command));
    }

    /// What was told since the last call.
    pub fn events(&self) -> impl Iterator<Item = Event> + '_ {
        let events: Vec<Event> = self.events.try_iter().collect();
        let paced = |event: &&Event| matches!(event, Event::Tiles { .. } | Event::Head(Some(_)));
        let taken = events.iter().filter(paced).count();
        if taken > 0 {
            let _ = self.said.send(Said::Taken(taken));
        }
        events.into_iter()
    }
}

/// What a panic said.
fn words(panic: &(dyn std::any::Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given")
}
