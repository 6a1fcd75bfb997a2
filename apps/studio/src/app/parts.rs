//! Parts that a window is created from. The worker starts before the window exists.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use eframe::egui::Context;

use crate::files::{FiguresLog, Files};
use crate::pace;
use crate::pen::Pen;
use session::{Command, Worker, WorkerOptions};

/// A started worker, and the slot for the window that it wakes.
#[derive(Debug)]
pub struct StartedWorker {
    pub(super) worker: Worker,
    pub(super) window: Arc<OnceLock<Context>>,
}

impl StartedWorker {
    /// Starts the worker and sends it `commands`.
    #[must_use]
    pub fn new(options: WorkerOptions, commands: Vec<Command>) -> Self {
        let window: Arc<OnceLock<Context>> = Arc::default();
        let wakes = Arc::clone(&window);
        let wake = move || {
            if let Some(context) = wakes.get() {
                pace::wake(context);
            }
        };
        #[cfg(not(target_arch = "wasm32"))]
        let worker = Worker::start(options, wake);
        #[cfg(target_arch = "wasm32")]
        let worker = Worker::in_turns(options, wake);
        commands.into_iter().for_each(|command| worker.ask(command));
        Self { worker, window }
    }
}

/// Parts that a [`Studio`](super::Studio) is created from.
#[derive(Debug)]
pub struct Parts {
    /// Worker thread, already started.
    pub worker: StartedWorker,
    /// Input of pen, mouse and touch.
    pub pen: Pen,
    /// File dialogs, tasks and preferences.
    pub files: Files,
    /// File to open first.
    pub open: Option<PathBuf>,
    /// Performance log, if asked for.
    pub log: Option<FiguresLog>,
}
