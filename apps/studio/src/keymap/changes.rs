//! The painter's changes of keys, as the preferences keep them, and the tables that follow.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::shortcut::Shortcut;
use super::table::{KeyRow, KeyTable};

/// Texts of the keys of each action that has not its standard keys, by its name. Names that this
/// version does not know are kept.
pub type Changes = BTreeMap<String, Vec<String>>;

/// The workspace in which keys are pressed. Each has a table of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Scope {
    /// The easel with canvas and palette.
    #[default]
    Easel,
    /// Scenes of paint volumes.
    Scenes,
}

/// The tables of both workspaces.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Keymap {
    /// Keys of the easel.
    pub easel: Arc<KeyTable>,
    /// Keys of scenes.
    pub scenes: Arc<KeyTable>,
}

impl Keymap {
    /// The tables of these rows with the painter's changes, and what is wrong with these: unknown
    /// names, texts that are no key, and keys that two actions have, of which the first gets them.
    #[must_use]
    pub fn new(easel: Vec<KeyRow>, scenes: Vec<KeyRow>, changes: &Changes) -> (Self, Vec<String>) {
        let mut tables = [KeyTable::new(easel), KeyTable::new(scenes)];
        let mut faults = Vec::new();
        for (name, texts) in changes {
            let mut keys = Vec::new();
            for text in texts {
                match text.parse::<Shortcut>() {
                    Ok(key) => keys.push(key),
                    Err(error) => faults.push(format!("key of `{name}`: {error}")),
                }
            }
            if !tables.iter_mut().any(|table| table.set(name, keys.clone())) {
                faults.push(format!("`{name}` is nothing that a key can do; it is kept"));
            }
        }
        for table in &tables {
            for row in table.rows() {
                for key in &row.keys {
                    if let Some(first) = table.owner(key).filter(|first| first.name != row.name) {
                        let key = key.text();
                        let first = &first.title;
                        faults.push(format!("{key} of {} is the key of {first} too", row.title));
                    }
                }
            }
        }
        let [easel, scenes] = tables.map(Arc::new);
        (Self { easel, scenes }, faults)
    }

    /// The table of a workspace.
    #[must_use]
    pub fn table(&self, scope: Scope) -> &KeyTable {
        match scope {
            Scope::Easel => &self.easel,
            Scope::Scenes => &self.scenes,
        }
    }
}

impl KeyTable {
    /// Gives a shortcut to an action, instead of the one that it replaces or beside its others. It
    /// is taken from the action that has it now.
    pub fn assign(
        &self,
        name: &str,
        replaced: Option<Shortcut>,
        shortcut: Shortcut,
        changes: &mut Changes,
    ) {
        for owner in self.rows().iter().filter(|row| row.name != name) {
            if owner.keys.contains(&shortcut) {
                self.remove(&owner.name, shortcut, changes);
            }
        }
        let Some(row) = self.row(name) else { return };
        let mut keys = row.keys.clone();
        keys.retain(|own| *own != shortcut || replaced == Some(shortcut));
        match keys.iter_mut().find(|own| Some(**own) == replaced) {
            Some(own) => *own = shortcut,
            None => keys.push(shortcut),
        }
        note(row, &keys, changes);
    }

    /// Takes a shortcut from an action.
    pub fn remove(&self, name: &str, shortcut: Shortcut, changes: &mut Changes) {
        let Some(row) = self.row(name) else { return };
        let keys: Vec<Shortcut> = row.keys.iter().copied().filter(|own| *own != shortcut).collect();
        note(row, &keys, changes);
    }

    /// Gives an action its standard keys again, which are taken from those that have them now.
    pub fn restore(&self, name: &str, changes: &mut Changes) {
        let Some(row) = self.row(name) else { return };
        for other in self.rows().iter().filter(|other| other.name != name) {
            let kept: Vec<Shortcut> =
                other.keys.iter().copied().filter(|key| !row.standard.contains(key)).collect();
            if kept != other.keys {
                note(other, &kept, changes);
            }
        }
        changes.remove(name);
    }

    /// Gives all actions their standard keys again.
    pub fn restore_all(&self, changes: &mut Changes) {
        self.rows().iter().for_each(|row| {
            changes.remove(&row.name);
        });
    }
}

/// Keeps the keys of an action, if they are not the standard ones.
fn note(row: &KeyRow, keys: &[Shortcut], changes: &mut Changes) {
    if keys == row.standard {
        changes.remove(&row.name);
    } else {
        changes.insert(row.name.clone(), keys.iter().map(Shortcut::stored).collect());
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::{Key, Modifiers};

    use super::*;

    fn rows() -> Vec<KeyRow> {
        let key = |text: &str| text.parse::<Shortcut>().unwrap();
        let row = |name: &str, keys: &[&str]| {
            let keys: Vec<Shortcut> = keys.iter().map(|text| key(text)).collect();
            KeyRow::new(name.to_owned(), name, "", "Edit", &keys)
        };
        vec![row("undo", &["Ctrl+Z"]), row("redo", &["Ctrl+Shift+Z", "Ctrl+Y"]), row("dry", &["D"])]
    }

    fn table(changes: &Changes) -> Arc<KeyTable> {
        Keymap::new(rows(), Vec::new(), changes).0.easel
    }

    fn found(changes: &Changes, text: &str) -> Option<String> {
        let shortcut: Shortcut = text.parse().unwrap();
        table(changes).owner(&shortcut).map(|row| row.name.clone())
    }

    #[test]
    fn a_key_is_taken_from_the_action_that_has_it() {
        let mut changes = Changes::new();
        let taken = "Ctrl+Y".parse().unwrap();
        table(&changes).assign("dry", Some("D".parse().unwrap()), taken, &mut changes);
        assert_eq!(changes["dry"], ["Ctrl+Y"]);
        assert_eq!(changes["redo"], ["Ctrl+Shift+Z"]);
        assert_eq!(found(&changes, "Ctrl+Y").as_deref(), Some("dry"));
        assert_eq!(found(&changes, "D"), None);
        table(&changes).restore("redo", &mut changes);
        assert_eq!(changes.get("redo"), None, "both keys are back");
        assert_eq!(changes["dry"], [""; 0], "and taken from the other");
        table(&changes).restore("dry", &mut changes);
        assert_eq!(changes, Changes::new());
    }

    #[test]
    fn keys_are_added_and_removed_and_standard_ones_need_no_entry() {
        let mut changes = Changes::new();
        table(&changes).assign("undo", None, "Ctrl+Backspace".parse().unwrap(), &mut changes);
        assert_eq!(changes["undo"], ["Ctrl+Z", "Ctrl+Backspace"]);
        table(&changes).remove("undo", "Ctrl+Backspace".parse().unwrap(), &mut changes);
        assert_eq!(changes, Changes::new());
        changes.insert("of another version".to_owned(), Vec::new());
        table(&changes).assign("dry", None, "K".parse().unwrap(), &mut changes);
        table(&changes).restore_all(&mut changes);
        assert_eq!(changes.len(), 1, "unknown names are kept");
    }

    #[test]
    fn faults_of_the_preferences_are_told_and_the_rest_is_used() {
        let changes = [("dry", vec!["K", "Hyper+X"]), ("fly", vec!["F"]), ("undo", vec!["Ctrl+Y"])];
        let changes = changes.map(|(name, texts)| {
            (name.to_owned(), texts.into_iter().map(ToOwned::to_owned).collect())
        });
        let (map, faults) = Keymap::new(rows(), Vec::new(), &changes.into());
        let press = |key, modifiers| map.easel.find(key, modifiers).map(|row| row.name.as_str());
        assert_eq!(press(Key::K, Modifiers::NONE), Some("dry"));
        assert_eq!(press(Key::Y, Modifiers::COMMAND), Some("undo"), "the first gets it");
        assert_eq!(faults.len(), 3, "{faults:?}");
        for (fault, word) in faults.iter().zip(["`Hyper`", "`fly`", "Ctrl+Y of redo"]) {
            assert!(fault.contains(word), "{fault}: {word}");
        }
    }
}
