//! Entries of the File menu.

use eframe::egui::Key;

use super::row::{CTRL, CTRL_SHIFT, entry, key};
use crate::app::intent::{Entry, Intent, Menu};

pub(super) const ENTRIES: &[Entry] = &[
    entry(Intent::New, Menu::File, "New", "Starts a new painting", &[key(CTRL, Key::N)]),
    entry(
        Intent::Open,
        Menu::File,
        "Open...",
        "Opens a painting, a pigment library or a recording of strokes",
        &[key(CTRL, Key::O)],
    ),
    entry(
        Intent::Sample,
        Menu::File,
        "Sample painting",
        "Opens a small still life to try things on: it has dry layers, glazes and wet paint",
        &[],
    ),
    entry(Intent::Save, Menu::File, "Save", "Saves the painting", &[key(CTRL, Key::S)]),
    entry(
        Intent::SaveAs,
        Menu::File,
        "Save as...",
        "Saves the painting in another file",
        &[key(CTRL_SHIFT, Key::S)],
    ),
    entry(
        Intent::KeepRevision,
        Menu::File,
        "Keep revision",
        "Keeps a numbered copy beside the painting",
        &[key(CTRL, Key::K)],
    ),
    entry(
        Intent::Export,
        Menu::File,
        "Export...",
        "Makes a picture, layers for other programs, a spectral EXR, or maps of the pigments",
        &[key(CTRL, Key::E)],
    ),
    entry(
        Intent::SaveRecording,
        Menu::File,
        "Save recording...",
        "Saves all strokes since the painting was opened, for playback",
        &[],
    ),
    entry(
        Intent::ExportTimelapse,
        Menu::File,
        "Export timelapse...",
        "Shows how the painting was made, as a GIF, an animated PNG or frames",
        &[],
    ),
    entry(
        Intent::OpenReference,
        Menu::File,
        "Pin a picture...",
        "Shows a reference picture beside the canvas, to match its colours",
        &[],
    ),
    entry(
        Intent::OpenLamp,
        Menu::File,
        "Light of a lamp...",
        "Lights the painting with a lamp measured in a file",
        &[],
    ),
    entry(
        Intent::NewScene,
        Menu::File,
        "New scene",
        "Begins a scene of paint volumes: a drawing that colour is poured over",
        &[],
    ),
    entry(
        Intent::OpenScene,
        Menu::File,
        "Open scene...",
        "Opens a model, a photograph or a script of paint volumes",
        &[],
    ),
    entry(
        Intent::ShowScene,
        Menu::File,
        "Back to the scene",
        "Shows the scene that is open; the painting stays as it is",
        &[],
    ),
    entry(Intent::Quit, Menu::File, "Quit", "Closes the program", &[key(CTRL, Key::Q)]),
];
