//! All menu entries, a table a menu: name, description and shortcuts.

use eframe::egui::Context;

use super::intent::{Entry, Intent};
use crate::keymap::{self, Shortcut};

mod row;
mod edit;
mod file;
mod help;
mod tools;
mod view;

/// All entries in menu order.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    [file::ENTRIES, edit::ENTRIES, view::ENTRIES, tools::ENTRIES, help::ENTRIES]
        .into_iter()
        .flatten()
}

impl Entry {
    /// Returns the entry of an intent, if it has one.
    #[must_use]
    pub fn of(intent: Intent) -> Option<&'static Self> {
        entries().find(|entry| entry.intent == intent)
    }

    /// Text of the first key in use, such as `Ctrl+Shift+S`, or of the first standard one before any
    /// are in use; empty without one.
    #[must_use]
    pub fn shortcut_text(&self, context: &Context) -> String {
        keymap::text(context, &self.intent.name())
            .unwrap_or_else(|| self.shortcuts.first().map_or_else(String::new, Shortcut::text))
    }
}
