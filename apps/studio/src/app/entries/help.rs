//! Entries of the Help menu.

use eframe::egui::Key;

use super::row::{NONE, entry, key};
use crate::app::intent::{Entry, Intent, Menu};

pub(super) const ENTRIES: &[Entry] = &[
    entry(Intent::Keys, Menu::Help, "Keys", "Shows and changes keys", &[key(NONE, Key::F1)]),
    entry(
        Intent::FirstSteps,
        Menu::Help,
        "First steps",
        "Shows a few lines over canvas, palette and tubes until the next stroke",
        &[],
    ),
    entry(
        Intent::Tour,
        Menu::Help,
        "Guided tour",
        "Six steps to try: load, paint, mix, dry, glaze and relight; goes on where it was left",
        &[],
    ),
];
