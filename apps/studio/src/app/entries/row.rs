//! Constants and functions that shorten the tables of menu entries.

use eframe::egui::{Key, Modifiers};

use crate::app::intent::{Entry, Intent, Menu};
use crate::keymap::Shortcut;

pub(super) const NONE: Modifiers = Modifiers::NONE;
pub(super) const SHIFT: Modifiers = Modifiers::SHIFT;
pub(super) const CTRL: Modifiers = Modifiers::COMMAND;
pub(super) const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

pub(super) const fn key(modifiers: Modifiers, key: Key) -> Shortcut {
    Shortcut { modifiers, key }
}

pub(super) const fn entry(
    intent: Intent,
    menu: Menu,
    name: &'static str,
    description: &'static str,
    shortcuts: &'static [Shortcut],
) -> Entry {
    Entry { intent, menu, name, description, shortcuts }
}
