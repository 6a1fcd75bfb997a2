//! File actions that menus and panels can request.

use std::path::PathBuf;

use graphics::tile::Rect;
use session::swatches::SwatchChange;

use super::drawing::{DrawingKind, DrawnFile};
use super::swatch_format::SwatchFormat;

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
    /// Exports a timelapse of the recording; asks in which form and to which file.
    ExportTimelapse,
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
    /// Changes the list of kept mixtures.
    Swatches(SwatchChange),
    /// Adds mixtures or colours from a file that the painter is asked for.
    ImportSwatches,
    /// Writes the kept mixtures to a file that the painter is asked for.
    ExportSwatches(SwatchFormat),
    /// Crops the painting to these cells.
    Crop(Rect),
    /// Begins a new painting; asks for its canvas.
    New,
    /// Opens the sample painting.
    Sample,
    /// Takes brushes of a file over that the painter is asked for.
    ImportBrushes,
    /// Exports the set of brushes that is shown to a file that the painter is asked for.
    ExportBrushes,
    /// Shows the preferences.
    Preferences,
}
