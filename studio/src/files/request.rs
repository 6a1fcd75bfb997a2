//! What can be asked for about files.

use std::path::PathBuf;

/// Something about files, done off the window's thread.
#[derive(Debug, Clone, PartialEq)]
pub enum FileRequest {
    /// Opens a painting, a library or a recording; asks for the file if none is
    /// named. A picture is pinned beside the canvas, a lamp shines on it.
    Open(Option<PathBuf>),
    /// Saves where the painting came from, or asks.
    Save,
    /// Asks where to save.
    SaveAs,
    /// Keeps a numbered revision beside the painting.
    KeepRevision,
    /// Opens a revision as a new painting.
    OpenRevision(PathBuf),
    /// Deletes a revision, after a question.
    DeleteRevision(PathBuf),
    /// Asks what to export, and where.
    Export,
    /// Saves the recording of all strokes; asks where.
    SaveRecording,
    /// Pins a picture beside the canvas; asks for the file if none is named.
    OpenReference(Option<PathBuf>),
    /// Takes the picture beside the canvas away.
    CloseReference,
    /// Paints under a lamp measured in a file; asks for the file.
    OpenLamp,
    /// Begins a new painting.
    New,
    /// Shows the preferences.
    Preferences,
}
