//! The dialogs that can be open.

use std::path::PathBuf;

use pigment::library::PigmentLibrary;
use render::paint::strokes::PaletteSpec;

use super::browser::Browser;
use super::dialogs::NewPainting;
use super::drawing::{Drawing, DrawingKind};
use super::exporting::Export;
use super::pending::PendingAction;
use super::scene_file::ScenePurpose;

/// A dialog that asks the user.
#[derive(Debug)]
pub(super) enum OpenDialog {
    /// Asks for a file.
    Browser(Box<Browser>, FilePurpose),
    /// Asks if unsaved changes should be saved before the action is carried out.
    Unsaved(PendingAction),
    /// Asks if drawings should be saved before the action is carried out.
    UnsavedDrawings(PendingAction),
    /// Asks if the revision in this file should be deleted.
    DeleteRevision(PathBuf),
    /// Asks what to export.
    Export(Export),
    /// Asks for the canvas of a new painting; holds the current palette and library.
    New(NewPainting, Box<PaletteSpec>, Box<PigmentLibrary>),
    /// Shows the preferences.
    Preferences,
}

/// The purpose of a file that the painter is asked for.
#[derive(Debug)]
pub(super) enum FilePurpose {
    /// Opens the dialog.
    Open,
    /// Saves the painting in it, keeps a revision if `keep_revision` is set, then carries
    /// out `next`.
    Save { next: Option<PendingAction>, keep_revision: bool },
    /// Exports to it.
    Export(Export),
    /// Saves the recording in it.
    Recording,
    /// Pins the picture in it beside the canvas.
    Reference,
    /// Lights the painting with the lamp measured in it.
    Lamp,
    /// Saves the drawing in it, then carries out `next`.
    SaveDrawing { drawing: Box<Drawing>, next: Option<PendingAction> },
    /// Reads a drawing from it.
    OpenDrawing(DrawingKind),
    /// Opens or writes a file of a scene.
    Scene(ScenePurpose),
}
