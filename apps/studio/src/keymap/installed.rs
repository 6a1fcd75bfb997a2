//! The tables in use, in egui's context.

use eframe::egui::{Context, Id, Key};

use super::changes::Keymap;
use super::shortcut::Shortcut;
use crate::language::tr_format;

/// Makes these the tables in use.
pub fn install(context: &Context, keymap: Keymap) {
    context.data_mut(|data| data.insert_temp(id(), keymap));
}

/// The tables in use; `None` before any were installed.
#[must_use]
pub fn installed(context: &Context) -> Option<Keymap> {
    context.data(|data| data.get_temp(id()))
}

/// Text of the first key of an action of either workspace; `None` before any tables were installed,
/// and empty if it has no key.
#[must_use]
pub fn text(context: &Context, name: &str) -> Option<String> {
    let keymap = installed(context)?;
    let row = keymap.easel.row(name).or_else(|| keymap.scenes.row(name));
    Some(row.and_then(|row| row.keys.first()).map(Shortcut::text).unwrap_or_default())
}

/// Keys of an action of either workspace, without their modifiers.
#[must_use]
pub fn keys(context: &Context, name: &str) -> Vec<Key> {
    let Some(keymap) = installed(context) else { return Vec::new() };
    let row = keymap.easel.row(name).or_else(|| keymap.scenes.row(name));
    row.map_or_else(Vec::new, |row| row.keys.iter().map(|shortcut| shortcut.key).collect())
}

/// End of a tooltip that names the key of an action, such as ` (key X)`; empty if it has none.
#[must_use]
pub fn hint(context: &Context, name: &str) -> String {
    match text(context, name) {
        Some(key) if !key.is_empty() => tr_format!(" (key {key})", key),
        _ => String::new(),
    }
}

fn id() -> Id {
    Id::unique("keymap")
}
