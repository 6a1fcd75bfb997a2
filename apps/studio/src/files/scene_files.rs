//! State of the files of scenes.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};
use web_time::Instant;

use super::scene_file::SceneAnswer;
use session::{Autosave, LostSession};

/// Files of scenes.
#[derive(Debug)]
pub(super) struct SceneFiles {
    /// Scenes of programs that ended without saving.
    pub(super) lost: Vec<LostSession>,
    /// Choices of the painter, the oldest first.
    pub(super) answers: VecDeque<SceneAnswer>,
    pub(super) autosave: Arc<Mutex<Option<Autosave>>>,
    /// Title and counter of changes of the open scene; `None` without one.
    pub(super) open: Option<(String, u64)>,
    /// Counter of changes that is in a file.
    pub(super) saved: u64,
    /// Counter of changes that the autosave has, or that it is being written with.
    pub(super) autosaved: u64,
    pub(super) last_autosave: Instant,
    /// Whether a recording was asked for and has not arrived.
    pub(super) awaited: bool,
    /// The scene that the open one was recovered from, until it is autosaved again.
    pub(super) recovered: Option<LostSession>,
    /// That scene, until the worker has opened it.
    pub(super) opening: Option<LostSession>,
}

impl SceneFiles {
    /// Without an open scene; `lost` are those of other programs.
    pub(super) fn new(lost: Vec<LostSession>) -> Self {
        Self {
            lost,
            answers: VecDeque::new(),
            autosave: Arc::default(),
            open: None,
            saved: 0,
            autosaved: 0,
            last_autosave: Instant::now(),
            awaited: false,
            recovered: None,
            opening: None,
        }
    }

    /// Whether the open scene has changes that are in no file.
    pub(super) fn is_changed(&self) -> bool {
        self.open.as_ref().is_some_and(|(_, revision)| *revision != self.saved)
    }

    /// Ends the autosave, which stays on the disk if the scene has changes that are in no file.
    pub(super) fn end(&mut self) {
        let changed = self.is_changed();
        let mut autosave = self.autosave.lock().unwrap_or_else(PoisonError::into_inner);
        match autosave.take() {
            Some(autosave) if !changed => autosave.end(),
            _ => {}
        }
        drop(autosave);
        if let Some(lost) = self.recovered.take().filter(|_| !changed) {
            lost.discard();
        }
    }
}
