//! Editing keys: which key is waited for, and what came of the last press.

use eframe::egui::{Context, Event, FocusDirection, Key};

use crate::keymap::{Changes, KeyRow, KeyTable, Keymap, Scope, Shortcut};
use crate::language::{tr, tr_format};

/// A key that another action has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Conflict {
    /// Action for which the key was pressed.
    name: String,
    /// Key that it replaces.
    replaced: Option<Shortcut>,
    /// The key that was pressed.
    pressed: Shortcut,
}

/// State of the window of keys.
#[derive(Debug, Default)]
pub(super) struct KeyEditor {
    /// Table that is shown.
    pub(super) scope: Scope,
    /// Word by which actions are searched.
    pub(super) find: String,
    state: State,
}

#[derive(Debug, Default)]
enum State {
    #[default]
    Idle,
    /// The next key press is for this action, instead of this key.
    Waits { name: String, replaced: Option<Shortcut> },
    /// Waits for the painter's decision.
    Conflicts(Conflict),
    /// A sentence about the last press.
    Told(String),
}

impl KeyEditor {
    /// Whether a row is waited for with this key.
    pub(super) fn waits_for(&self, name: &str, key: Option<Shortcut>) -> bool {
        matches!(&self.state, State::Waits { name: own, replaced } if own == name && *replaced == key)
    }

    /// Waits for a key for an action, instead of one of its keys or beside them.
    pub(super) fn record(&mut self, name: &str, replaced: Option<Shortcut>) {
        self.state = State::Waits { name: name.to_owned(), replaced };
    }

    /// Waits for nothing.
    pub(super) fn stop(&mut self) {
        self.state = State::Idle;
    }

    /// Whether a row fits the search.
    pub(super) fn finds(&self, row: &KeyRow) -> bool {
        let word = self.find.trim().to_lowercase();
        let keys = row.keys.iter().map(Shortcut::text);
        let mut texts = keys.chain([row.title.clone(), row.description.clone()]);
        word.is_empty() || texts.any(|text| text.to_lowercase().contains(&word))
    }

    /// A sentence about the last key press, or what is waited for.
    pub(super) fn message(&self) -> Option<&str> {
        match &self.state {
            State::Told(text) => Some(text),
            State::Waits { .. } => Some(tr("Press the key, with Ctrl or Shift if you like.")),
            _ => None,
        }
    }

    /// The key that another action has, with a sentence that names both.
    pub(super) fn conflict(&self, table: &KeyTable) -> Option<(String, Conflict)> {
        let State::Conflicts(conflict) = &self.state else { return None };
        let owner = table.owner(&conflict.pressed)?;
        let text = tr_format!(
            "{pressed} is the key of {title}.",
            pressed = conflict.pressed.text(),
            title = owner.title
        );
        Some((text, conflict.clone()))
    }

    /// Gives the key to the action for which it was pressed.
    pub(super) fn take(&mut self, conflict: &Conflict, table: &KeyTable, changes: &mut Changes) {
        let Conflict { name, replaced, pressed } = conflict;
        table.assign(name, *replaced, *pressed, changes);
        self.stop();
    }

    /// Reads the key that is waited for, and removes this frame's key events. Does nothing while no
    /// key is waited for.
    pub(super) fn read(&mut self, context: &Context, keymap: &Keymap, changes: &mut Changes) {
        let State::Waits { name, replaced } = &self.state else { return };
        let name = name.clone();
        let replaced = *replaced;
        let mut pressed = None;
        context.input_mut(|input| {
            input.events.retain(|event| match event {
                Event::Key { key, pressed: true, modifiers, .. } => {
                    pressed = pressed.or(Some((*key, *modifiers)));
                    false
                }
                Event::Text(_) => false,
                _ => true,
            });
        });
        let Some((key, modifiers)) = pressed else { return };
        if key == Key::Tab {
            context.memory_mut(|memory| memory.move_focus(FocusDirection::None));
        }
        if key == Key::Escape {
            return self.stop();
        }
        let table = keymap.table(self.scope);
        self.state = match Shortcut::of_press(key, modifiers) {
            Err(error) => State::Told(tr_format!(
                "This key cannot be changed: {error}.",
                error = tr(&error.to_string())
            )),
            Ok(pressed) => match table.owner(&pressed).filter(|owner| owner.name != name) {
                Some(_) => State::Conflicts(Conflict { name, replaced, pressed }),
                None => {
                    table.assign(&name, replaced, pressed, changes);
                    State::Idle
                }
            },
        };
    }
}
