//! Actions that wait until no unsaved changes would be lost.

use std::path::PathBuf;
use std::sync::Arc;

use super::reference_change::ReferenceChange;
use session::{Command, LostSession};

/// An action that would lose unsaved changes, kept until they are saved or given up.
#[derive(Debug)]
pub(super) enum PendingAction {
    /// Closes the window.
    Close {
        /// Whether the painter gave up drawings that are in no file.
        drawings_given_up: bool,
    },
    /// Opens another painting in place of the current one.
    Replace(Replacement),
    /// Changes the picture beside the canvas or the lines on it.
    Reference(ReferenceChange),
}

/// Another painting, to be opened in place of the current one.
#[derive(Debug)]
pub(super) struct Replacement {
    /// Commands that make the worker open it.
    pub(super) commands: Vec<Command>,
    /// The files that belong to it.
    pub(super) origin: FileOrigin,
}

/// The files that belong to a painting that the worker is opening.
#[derive(Debug, Default)]
pub(super) struct FileOrigin {
    /// The file in which it can be saved again, if it was read from one.
    pub(super) path: Option<PathBuf>,
    /// The lost session that it was recovered from, if it was.
    pub(super) lost: Option<LostSession>,
    /// Content of the file that it was read from. A recording of what is painted on it
    /// needs this as its start.
    pub(super) start: Option<Arc<Vec<u8>>>,
    /// Whether it is the sample painting.
    pub(super) sample: bool,
    /// Whether it has changes that are in no file.
    pub(super) changed: bool,
}
