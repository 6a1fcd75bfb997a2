//! File actions that menus and panels can request.

use std::path::PathBuf;

use super::drawing::{DrawingKind, DrawnFile};

/// A file action. Long work runs in the background.
#[derive(Debug, Clone, PartialEq)]
pub enum FileRequest {
    /// Opens a painting, a library or a recording; asks for the file if none is given. A
    /// picture is pinned beside the canvas, a lamp lights the painting.
    Open(Option<PathBuf>),
    /// Saves to the painting's file, or asks for one.
    Save,
    /// Saves to a file that the painter is asked for.
    SaveAs,
    /// Keeps a numbered revision beside the painting's file.
    KeepRevision,
    /// Opens a revision as a new painting.
    OpenRevision(PathBuf),
    /// Deletes a revision after asking.
    DeleteRevision(PathBuf),
    /// Exports; asks in which form and to which file.
    Export,
    /// Saves the recording of all strokes to a file that the painter is asked for.
    SaveRecording,
    /// Pins a picture beside the canvas; asks for the file if none is given.
    OpenReference(Option<PathBuf>),
    /// Removes the picture beside the canvas.
    CloseReference,
    /// Saves lines drawn on that picture to a file that the painter is asked for.
    SaveDrawing(DrawnFile),
    /// Opens lines for the picture in this file; asks for theirs.
    OpenDrawing(DrawingKind, PathBuf),
    /// Lights the painting with a lamp measured in a file that the painter is asked for.
    OpenLamp,
    /// Begins a new painting; asks for its canvas.
    New,
    /// Shows the preferences.
    Preferences,
}
