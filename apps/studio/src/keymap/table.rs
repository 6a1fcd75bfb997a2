//! A table of actions and their keys.

use eframe::egui::{Key, Modifiers};

use super::shortcut::Shortcut;

/// An action and its keys.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeyRow {
    /// Name in the preferences.
    pub name: String,
    /// Name shown to the painter.
    pub title: String,
    /// Tells what it does.
    pub description: String,
    /// Heading under which it stands.
    pub group: &'static str,
    /// Keys that it has unless the painter changes them.
    pub standard: Vec<Shortcut>,
    /// Keys in use.
    pub keys: Vec<Shortcut>,
}

impl KeyRow {
    /// A row with its standard keys in use.
    #[must_use]
    pub fn new(
        name: String,
        title: impl Into<String>,
        description: impl Into<String>,
        group: &'static str,
        standard: &[Shortcut],
    ) -> Self {
        let title = title.into();
        let description = description.into();
        let keys = standard.to_vec();
        Self { name, title, description, group, standard: keys.clone(), keys }
    }
}

/// Actions in the order of menus, with their keys.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct KeyTable {
    rows: Vec<KeyRow>,
}

impl KeyTable {
    /// A table of these rows.
    #[must_use]
    pub fn new(rows: Vec<KeyRow>) -> Self {
        Self { rows }
    }

    /// The rows in order.
    #[must_use]
    pub fn rows(&self) -> &[KeyRow] {
        &self.rows
    }

    /// The row of this name, if there is one.
    #[must_use]
    pub fn row(&self, name: &str) -> Option<&KeyRow> {
        self.rows.iter().find(|row| row.name == name)
    }

    /// The row that a pressed key belongs to, if it belongs to one; the first of several.
    #[must_use]
    pub fn find(&self, key: Key, modifiers: Modifiers) -> Option<&KeyRow> {
        self.rows
            .iter()
            .find(|row: &&KeyRow| row.keys.iter().any(|own| own.matches(key, modifiers)))
    }

    /// The row that has a shortcut, if one has.
    #[must_use]
    pub fn owner(&self, shortcut: &Shortcut) -> Option<&KeyRow> {
        self.find(shortcut.key, shortcut.modifiers)
    }

    /// Replaces the keys of a row. Returns whether it is there.
    pub(super) fn set(&mut self, name: &str, keys: Vec<Shortcut>) -> bool {
        match self.rows.iter_mut().find(|row| row.name == name) {
            Some(row) => {
                row.keys = keys;
                true
            }
            None => false,
        }
    }
}
