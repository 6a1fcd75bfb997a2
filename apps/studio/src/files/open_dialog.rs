//! The dialogs that can be open.

use std::path::PathBuf;

use super::browser::Browser;
use super::drawing::{Drawing, DrawingKind};
use super::exporting::Export;
use super::new_dialog::{CanvasPicture, NewDialog};
use super::pending::PendingAction;
use super::scene_file::ScenePurpose;
use super::swatch_format::SwatchFormat;
use super::timelapse::TimelapseExport;
use session::brushes::BrushSet;

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
    /// Asks what to export of the painting that a scene makes.
    ExportOfScene(Export),
    /// Asks for the settings of a timelapse.
    Timelapse(TimelapseExport),
    /// Asks for the canvas of a new painting.
    New(Box<NewDialog>),
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
    /// Writes a timelapse of the recording to it.
    Timelapse(TimelapseExport),
    /// Saves the recording in it.
    Recording,
    /// Pins the picture in it beside the canvas.
    Reference,
    /// Gives it to the canvas of a new painting.
    Canvas(CanvasPicture),
    /// Lights the painting with the lamp measured in it.
    Lamp,
    /// Saves the drawing in it, then carries out `next`.
    SaveDrawing { drawing: Box<Drawing>, next: Option<PendingAction> },
    /// Reads a drawing from it.
    OpenDrawing(DrawingKind),
    /// Takes the brushes in it over.
    ImportBrushes,
    /// Writes a set of brushes to it.
    ExportBrushes(Box<BrushSet>),
    /// Adds the mixtures or colours in it to those that are kept.
    ImportSwatches,
    /// Writes the kept mixtures to it.
    ExportSwatches(SwatchFormat),
    /// Opens or writes a file of a scene.
    Scene(ScenePurpose),
}
