//! What a window is made of; the worker begins before there is a window.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use eframe::egui::Context;

use crate::files::{FiguresLog, Files};
use crate::pen::Pen;
use session::{Command, Worker, WorkerOptions};

/// A worker that has begun, and what wakes the window when there is one.
#[derive(Debug)]
pub struct Begun {
    pub(super) worker: Worker,
    pub(super) window: Arc<OnceLock<Context>>,
}

impl Begun {
    /// Starts the worker and asks it for `commands`.
    #[must_use]
    pub fn new(options: WorkerOptions, commands: Vec<Command>) -> Self {
        let window: Arc<OnceLock<Context>> = Arc::default();
        let wakes = Arc::clone(&window);
        let worker = Worker::start(options, move || {
            if let Some(context) = wakes.get() {
                context.request_repaint();
            }
        });
        commands.into_iter().for_each(|command| worker.ask(command));
        Self { worker, window }
    }
}

/// What a window is made of.
#[derive(Debug)]
pub struct Parts {
    /// The worker.
    pub begun: Begun,
    /// What leads the brush.
    pub pen: Pen,
    /// All about files.
    pub files: Files,
    /// What is opened first.
    pub open: Option<PathBuf>,
    /// Where figures go.
    pub log: Option<FiguresLog>,
}
