//! Keys and their actions: standard keys, your changes, and the table in use.
//!
//! A text names an action, for example `undo` or `tool-paint`. Names of actions in scenes begin
//! with `scene.`. The window installs the tables in use in egui's context. Menus, tooltips and
//! panels look keys up there by these names.

use std::collections::BTreeMap;
use std::str::FromStr;
use std::sync::Arc;

use eframe::egui::{Context, Id, Key, Modifiers};
use serde::Serialize;
use serde_json::Value;

use crate::language::{english, tr_format};

/// Keys with a sign shorter than their name.
const SIGNS: [(Key, &str); 16] = [
    (Key::OpenBracket, "["),
    (Key::CloseBracket, "]"),
    (Key::Plus, "+"),
    (Key::Minus, "-"),
    (Key::Comma, ","),
    (Key::Period, "."),
    (Key::Equals, "="),
    (Key::Colon, ":"),
    (Key::Semicolon, ";"),
    (Key::Backslash, "\\"),
    (Key::Slash, "/"),
    (Key::Pipe, "|"),
    (Key::Questionmark, "?"),
    (Key::Exclamationmark, "!"),
    (Key::Backtick, "`"),
    (Key::Quote, "'"),
];

/// A keyboard shortcut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shortcut {
    /// Modifier keys. `COMMAND` is Ctrl, or the command key on a Mac.
    pub modifiers: Modifiers,
    /// Key that triggers it.
    pub key: Key,
}

/// Why a key cannot be a shortcut, or a text does not name one.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum InvalidShortcut {
    /// A word of the text is neither a key nor a modifier.
    #[error("`{0}` is not a key")]
    Unknown(String),
    /// The key has a meaning that you cannot change.
    #[error("{0}")]
    Reserved(&'static str),
}

impl Shortcut {
    /// The shortcut of a pressed key.
    ///
    /// # Errors
    /// `InvalidShortcut` if the key or a modifier has its own meaning.
    pub fn of_press(key: Key, held: Modifiers) -> Result<Self, InvalidShortcut> {
        let why = match key {
            Key::Space => english("the space bar moves the view while it is held"),
            Key::Escape => english("Escape closes windows"),
            Key::Enter => english("Enter presses the main button of a dialog"),
            Key::Copy | Key::Cut | Key::Paste => english("the system uses it for the clipboard"),
            _ if held.alt => english("Alt picks a colour while it is held"),
            _ => {
                let mut modifiers = Modifiers::NONE;
                (modifiers.command, modifiers.shift) = (held.command, held.shift);
                return Ok(Self { modifiers, key });
            }
        };
        Err(InvalidShortcut::Reserved(why))
    }

    /// Text of the shortcut as this system names it, e.g. `Ctrl+Z`.
    #[must_use]
    pub fn text(&self) -> String {
        self.words(if cfg!(target_os = "macos") { "Cmd" } else { "Ctrl" })
    }

    /// Text of the shortcut for files. It does not depend on the system.
    #[must_use]
    pub fn stored(&self) -> String {
        self.words("Ctrl")
    }

    /// Whether a pressed key with these modifiers triggers the shortcut.
    #[must_use]
    pub fn matches(&self, key: Key, modifiers: Modifiers) -> bool {
        // For plus you may need shift, which we then see as held.
        let shifted = matches!(key, Key::Plus);
        key == self.key
            && modifiers.command == self.modifiers.command
            && !modifiers.alt
            && (shifted || modifiers.shift == self.modifiers.shift)
    }

    fn words(&self, command: &'static str) -> String {
        let sign = SIGNS.iter().find(|(key, _)| *key == self.key);
        let key = sign.map_or(self.key.name(), |(_, sign)| sign);
        let modifiers = [(self.modifiers.command, command), (self.modifiers.shift, "Shift")];
        let held = modifiers.iter().filter(|(held, _)| *held).map(|(_, word)| *word);
        held.chain([key]).collect::<Vec<_>>().join("+")
    }
}

impl FromStr for Shortcut {
    type Err = InvalidShortcut;

    /// Reads a text, e.g. `Ctrl+Shift+Z`. `Cmd` is read as `Ctrl`.
    fn from_str(text: &str) -> Result<Self, InvalidShortcut> {
        let text = text.trim();
        // The key itself may be a plus.
        let (held, key) = match text.strip_suffix('+') {
            Some(held) => (held.strip_suffix('+').unwrap_or(held), "+"),
            None => text.rsplit_once('+').unwrap_or(("", text)),
        };
        let mut modifiers = Modifiers::NONE;
        for word in held.split('+').filter(|word| !word.is_empty()) {
            match word.to_ascii_lowercase().as_str() {
                "ctrl" | "cmd" => modifiers.command = true,
                "shift" => modifiers.shift = true,
                "alt" => modifiers.alt = true,
                _ => return Err(InvalidShortcut::Unknown(word.to_owned())),
            }
        }
        let key = Key::from_name(key).ok_or_else(|| InvalidShortcut::Unknown(key.to_owned()))?;
        Self::of_press(key, modifiers)
    }
}

/// Name of an action, from its serialized form: a text, a number, or an object with one key. This
/// joins the texts and numbers by hyphens, for example `tool-paint`.
#[must_use]
pub fn name_of(action: &impl Serialize) -> String {
    // An action without a JSON form has an empty name, which never occurs in preferences.
    serde_json::to_value(action).map(|value| joined(&value)).unwrap_or_default()
}

fn joined(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Object(keys) => {
            let parts = keys.iter().map(|(key, value)| format!("{key}-{}", joined(value)));
            parts.collect::<Vec<_>>().join("-")
        }
        other => other.to_string(),
    }
}

/// An action and its keys.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeyRow {
    /// Name in the preferences.
    pub name: String,
    /// Name that you see.
    pub title: String,
    /// Explains what it does.
    pub description: String,
    /// Heading of the action.
    pub group: &'static str,
    /// Its standard keys, in use unless you change them.
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

    /// The first row with a shortcut that this pressed key triggers.
    #[must_use]
    pub fn find(&self, key: Key, modifiers: Modifiers) -> Option<&KeyRow> {
        self.rows
            .iter()
            .find(|row: &&KeyRow| row.keys.iter().any(|own| own.matches(key, modifiers)))
    }

    /// The row with this shortcut.
    #[must_use]
    pub fn owner(&self, shortcut: &Shortcut) -> Option<&KeyRow> {
        self.find(shortcut.key, shortcut.modifiers)
    }

    /// Replaces the keys of a row. Returns whether it exists.
    fn set(&mut self, name: &str, keys: Vec<Shortcut>) -> bool {
        match self.rows.iter_mut().find(|row| row.name == name) {
            Some(row) => {
                row.keys = keys;
                true
            }
            None => false,
        }
    }

    /// Gives a shortcut to an action. It replaces the given one, or is added. If another action has
    /// the shortcut, that one loses it.
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

    /// Removes a shortcut from an action.
    pub fn remove(&self, name: &str, shortcut: Shortcut, changes: &mut Changes) {
        let Some(row) = self.row(name) else { return };
        let keys: Vec<Shortcut> = row.keys.iter().copied().filter(|own| *own != shortcut).collect();
        note(row, &keys, changes);
    }

    /// Gives an action its standard keys again. Other actions lose these.
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

/// The keys of each action that does not have its standard keys, by the name of the action. Each
/// key is a text, e.g. `Ctrl+Z`. We keep names that this version does not know.
pub type Changes = BTreeMap<String, Vec<String>>;

/// The workspace that a key is pressed in. Each has its own table.
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
    /// Tables of these rows with your changes. The second value lists the faults in the changes:
    /// unknown names, texts that are not a key, and keys of two actions, which go to the first.
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

/// Keeps the keys of an action, if they are not the standard ones.
fn note(row: &KeyRow, keys: &[Shortcut], changes: &mut Changes) {
    if keys == row.standard {
        changes.remove(&row.name);
    } else {
        changes.insert(row.name.clone(), keys.iter().map(Shortcut::stored).collect());
    }
}

/// Makes these the tables in use.
pub fn install(context: &Context, keymap: Keymap) {
    context.data_mut(|data| data.insert_temp(id(), keymap));
}

/// The tables in use; `None` before you install any.
#[must_use]
pub fn installed(context: &Context) -> Option<Keymap> {
    context.data(|data| data.get_temp(id()))
}

/// Text of the first key of an action of either workspace. `None` before you install tables, and
/// empty if it has no key.
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

/// End of a tooltip that names the key of an action, e.g. ` (key X)`; empty if it has none.
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

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{Key, Modifiers};

    #[test]
    fn every_key_survives_its_text() {
        let mut tried = 0;
        for &key in Key::ALL {
            for command in [false, true] {
                for shift in [false, true] {
                    let held = Modifiers { command, shift, ..Modifiers::NONE };
                    let Ok(shortcut) = Shortcut::of_press(key, held) else { continue };
                    let text = shortcut.stored();
                    assert_eq!(text.parse(), Ok(shortcut), "{text}");
                    tried += 1;
                }
            }
        }
        assert!(tried > 300, "{tried} shortcuts");
        let command = Shortcut { modifiers: Modifiers::COMMAND, key: Key::Plus };
        assert_eq!(command.stored(), "Ctrl++");
        assert_eq!("cmd+shift+z".parse::<Shortcut>().unwrap().stored(), "Ctrl+Shift+Z");
    }

    #[test]
    fn keys_with_a_meaning_of_their_own_are_refused() {
        for text in ["Space", "Escape", "Ctrl+Enter", "Alt+K", "Ctrl+", "", "Hyper+K", "Ctrl+Kk"] {
            let read = text.parse::<Shortcut>();
            assert!(read.is_err() || text == "Ctrl+", "{text}: {read:?}");
        }
        assert_eq!("+".parse::<Shortcut>().unwrap().key, Key::Plus);
    }

    fn rows() -> Vec<KeyRow> {
        fn row(name: &str, keys: &[&str]) -> KeyRow {
            let keys: Vec<Shortcut> =
                keys.iter().map(|text| text.parse::<Shortcut>().unwrap()).collect();
            KeyRow::new(name.to_owned(), name, "", "Edit", &keys)
        }
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
        let found = [(Key::K, Modifiers::NONE), (Key::Y, Modifiers::COMMAND)]
            .map(|(key, modifiers)| map.easel.find(key, modifiers).map(|row| row.name.as_str()));
        assert_eq!(found, [Some("dry"), Some("undo")], "the first gets it");
        assert_eq!(faults.len(), 3, "{faults:?}");
        for (fault, word) in faults.iter().zip(["`Hyper`", "`fly`", "Ctrl+Y of redo"]) {
            assert!(fault.contains(word), "{fault}: {word}");
        }
    }
}
