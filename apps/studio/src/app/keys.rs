//! Translates key presses to intents while no text field has the focus, and shows the window in
//! which you change keys.
//!
//! A tool key selects its tool. If you hold it while you use the pointer, releasing it restores
//! the previous tool, as in other painting programs.

use std::sync::Arc;

use eframe::egui::{
    Align, Button, Context, Event, FocusDirection, Grid, Key, Label, Layout, Modifiers, RichText,
    ScrollArea, TextStyle, Ui, Vec2, vec2,
};

use super::entries::{intent_named, key_rows};
use super::intent::Intent;
use super::volumes::SCENE_POINTER;
use crate::keymap::{Changes, KeyRow, KeyTable, Keymap, Scope, Shortcut, installed, text};
use crate::language::{english, tr, tr_format};
use crate::panels::{Mode, small_button};
use crate::{floating, theme};

/// A tool key counts as held after this time, in seconds.
const HOLD_SECONDS: f64 = 0.35;

/// State of the keyboard: held keys and temporary tools.
#[derive(Debug, Clone, Copy, Default)]
pub struct Keys {
    temporary: Option<TemporaryTool>,
    held: Held,
    barrel: Option<Mode>,
}

#[derive(Debug, Clone, Copy)]
struct TemporaryTool {
    key: Key,
    before: Mode,
    since: f64,
    used: bool,
}

#[derive(Debug, Clone, Copy, Default)]
struct Held {
    space: bool,
    modifiers: Modifiers,
}

impl Keys {
    /// Returns the intents of this frame's key events in order and removes those events.
    pub fn read(&mut self, context: &Context, mode: Mode) -> Vec<Intent> {
        let mut intents = Vec::new();
        if context.text_edit_focused() {
            *self = Self { barrel: self.barrel, ..Self::default() };
            return intents;
        }
        let focused = context.memory(|memory| memory.focused().is_some());
        let mut tabbed = false;
        let table = table(context);
        context.input_mut(|input| {
            self.held.modifiers = input.modifiers;
            if let Some(temporary) = &mut self.temporary {
                temporary.used |= input.pointer.any_down();
            }
            let now = input.time;
            let held = &mut self.held;
            let temporary = &mut self.temporary;
            input.events.retain(|event| {
                let Event::Key { key, pressed, repeat, modifiers, .. } = event else {
                    return true;
                };
                // A focused control handles these keys itself.
                if focused && matches!(key, Key::Tab | Key::Space | Key::Enter) {
                    return true;
                }
                if *key == Key::Space {
                    held.space = *pressed;
                    return false;
                }
                if !pressed {
                    if let Some(released) = temporary.take_if(|temporary| temporary.key == *key)
                        && (released.used || now - released.since > HOLD_SECONDS)
                    {
                        intents.push(Intent::Tool(released.before));
                    }
                    return true;
                }
                let row = table.find(*key, *modifiers);
                let Some(intent) = row.and_then(|row| intent_named(&row.name)) else {
                    return true;
                };
                let repeats = matches!(
                    intent,
                    Intent::Undo
                        | Intent::Redo
                        | Intent::Larger
                        | Intent::Smaller
                        | Intent::ZoomIn
                        | Intent::ZoomOut
                        | Intent::TurnLeft
                        | Intent::TurnRight
                        | Intent::TwistLeft
                        | Intent::TwistRight
                );
                if *repeat && !repeats {
                    return false;
                }
                if let Intent::Tool(_) = intent {
                    *temporary =
                        Some(TemporaryTool { key: *key, before: mode, since: now, used: false });
                }
                tabbed |= *key == Key::Tab;
                intents.push(intent);
                false
            });
            if !input.focused {
                *held = Held::default();
            }
        });
        if tabbed {
            context.memory_mut(|memory| memory.move_focus(FocusDirection::None));
        }
        intents
    }

    /// The chosen tool, unless held keys or a pen button select another one.
    #[must_use]
    pub fn mode(&self, chosen: Mode) -> Mode {
        let Held { space, modifiers } = self.held;
        match (space, modifiers) {
            (true, Modifiers { shift: true, .. }) => Mode::Rotate,
            (true, Modifiers { command: true, .. }) => Mode::Zoom,
            (true, _) => Mode::Pan,
            (false, Modifiers { alt: true, .. }) => Mode::Pick,
            _ => self.barrel.unwrap_or(chosen),
        }
    }

    /// Sets the tool of the pen's barrel button. Pass `None` when you release it.
    pub fn barrel(&mut self, mode: Option<Mode>) {
        self.barrel = mode;
    }
}

fn table(context: &Context) -> Arc<KeyTable> {
    installed(context)
        .map_or_else(|| Arc::new(KeyTable::new(key_rows())), |keymap| keymap.easel.clone())
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Conflict {
    /// Action that you pressed the key for.
    name: String,
    /// Key of the action that the new one replaces.
    replaced: Option<Shortcut>,
    pressed: Shortcut,
}

#[derive(Debug, Default)]
pub(super) struct KeyEditor {
    pub(super) scope: Scope,
    /// Search word.
    pub(super) find: String,
    state: State,
}

#[derive(Debug, Default)]
enum State {
    #[default]
    Idle,
    /// Waits for the next key press, which becomes a key of this action. It takes the place of
    /// `replaced` if there is one.
    Waits { name: String, replaced: Option<Shortcut> },
    /// Waits for your decision.
    Conflicts(Conflict),
    /// A sentence about the last press.
    Message(String),
}

impl KeyEditor {
    /// Whether this row and key wait for a key press.
    pub(super) fn waits_for(&self, name: &str, key: Option<Shortcut>) -> bool {
        matches!(&self.state, State::Waits { name: own, replaced } if own == name && *replaced == key)
    }

    /// Waits for a key press that becomes a key of the action `name`. The new key takes the place
    /// of `replaced`, or is added.
    pub(super) fn record(&mut self, name: &str, replaced: Option<Shortcut>) {
        self.state = State::Waits { name: name.to_owned(), replaced };
    }

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

    /// A sentence about the last key press, or about the press that we wait for.
    pub(super) fn message(&self) -> Option<&str> {
        match &self.state {
            State::Message(text) => Some(text),
            State::Waits { .. } => Some(tr("Press the key, with Ctrl or Shift if you like.")),
            _ => None,
        }
    }

    /// The key that you pressed although another action has it, with a sentence that names this
    /// action.
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

    pub(super) fn take(&mut self, conflict: &Conflict, table: &KeyTable, changes: &mut Changes) {
        let Conflict { name, replaced, pressed } = conflict;
        table.assign(name, *replaced, *pressed, changes);
        self.stop();
    }

    /// If we wait for a key, this reads it and removes this frame's key events.
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
            Err(error) => State::Message(tr_format!(
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

const WIDTH: f32 = 760.0;

const TITLE: f32 = 124.0;

const KEYS: f32 = 250.0;

const KEYS_TOUCH: f32 = 344.0;

/// Gestures of the pointer and keys that you hold, with descriptions. You cannot change these.
const POINTER: &[(&str, &str)] = &[
    (english("Space + drag"), english("Moves the view; so does the middle button")),
    (english("Shift+Space + drag"), english("Rotates the view about its centre")),
    (english("Ctrl+Space + drag"), english("Zooms, upwards in")),
    (
        english("pointer|Wheel"),
        english("Zooms about the pointer; two fingers on a pad move the view"),
    ),
    (english("Two fingers"), english("Move, zoom and turn the view on a touch screen")),
    (english("Tap of two fingers"), english("Undoes; a tap of three fingers redoes")),
    (english("Alt + click"), english("Picks colour and paint")),
    (
        english("Shift + stroke"),
        english("Starts with a straight line from the end of the last stroke"),
    ),
    (
        english("Shift on the reference"),
        english("Marks the distance of strokes of the selected sample"),
    ),
    (english("Held tool key"), english("Restores the previous tool on release")),
];

/// Shows the window while `open` is true. The close button and Escape clear `open`. Changes of keys
/// go to `changes`.
pub(super) fn show(
    context: &Context,
    open: &mut bool,
    editor: &mut KeyEditor,
    keymap: &Keymap,
    changes: &mut Changes,
) {
    let shown = floating::show(context, tr("Keys"), "keys", open, |ui| {
        ui.set_width(WIDTH);
        let table = keymap.table(editor.scope);
        head(ui, editor, table, changes);
        notice(ui, editor, table, changes);
        ui.separator();
        let head = ui.min_rect().height() + ui.spacing().item_spacing.y;
        let height = floating::height_of_contents(ui.ctx()) - head;
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            ui.set_width(WIDTH - 16.0);
            let mut group = "";
            for row in table.rows() {
                if !editor.finds(row) {
                    continue;
                }
                if std::mem::replace(&mut group, row.group) != row.group {
                    ui.add_space(4.0);
                    ui.weak(row.group);
                }
                key_row(ui, row, editor, table, changes);
            }
            if editor.find.is_empty() {
                pointer(ui, editor.scope);
            }
        });
    });
    if shown.is_none() {
        editor.stop();
    }
}

/// Shows the choice of the workspace, the search field, and the button that restores all standard
/// keys.
fn head(ui: &mut Ui, editor: &mut KeyEditor, table: &KeyTable, changes: &mut Changes) {
    ui.horizontal(|ui| {
        for (scope, name, tip) in [
            (Scope::Easel, tr("Easel"), tr("Keys while a painting is shown")),
            (Scope::Scenes, tr("Scenes"), tr("Keys while a scene of paint volumes is shown")),
        ] {
            if ui.selectable_label(editor.scope == scope, name).on_hover_text(tip).clicked() {
                editor.stop();
                editor.scope = scope;
            }
        }
        let find = theme::text_field(&mut editor.find).hint_text(tr("find")).desired_width(180.0);
        ui.add(find)
            .accessible_name(tr("Find an action"))
            .on_hover_text(tr("Shows only what has this word"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let changed = table.rows().iter().any(|row| row.keys != row.standard);
            let button = ui.add_enabled(changed, Button::new(tr("All to standard")));
            let tip = tr("Gives all actions of this table their standard keys");
            if button.on_hover_text(tip).clicked() {
                editor.stop();
                table.restore_all(changes);
            }
        });
    });
}

/// Explains that a pressed key belongs to another action, or cannot be used.
fn notice(ui: &mut Ui, editor: &mut KeyEditor, table: &KeyTable, changes: &mut Changes) {
    ui.horizontal(|ui| {
        ui.set_min_height(24.0);
        if let Some((text, conflict)) = editor.conflict(table) {
            ui.strong(text);
            if ui.button(tr("Take it")).on_hover_text(tr("Takes the key from the other")).clicked()
            {
                editor.take(&conflict, table, changes);
            }
            if ui.button(tr("Cancel")).on_hover_text(tr("Leaves the key where it is")).clicked() {
                editor.stop();
            }
        } else if let Some(text) = editor.message() {
            ui.strong(text);
        } else {
            ui.weak(tr("Click a key to press another one for it."));
        }
    });
}

fn key_row(
    ui: &mut Ui,
    row: &KeyRow,
    editor: &mut KeyEditor,
    table: &KeyTable,
    changes: &mut Changes,
) {
    ui.horizontal_top(|ui| {
        column(ui, TITLE, |ui| ui.strong(&row.title));
        let keys = if theme::is_touch(ui.ctx()) { KEYS_TOUCH } else { KEYS };
        column(ui, keys, |ui| keys_of_row(ui, row, editor, table, changes));
        description(ui, &row.description);
    });
}

/// Draws a description in the remaining room: its first line beside the keys, others below.
fn description(ui: &mut Ui, text: &str) {
    let above = 0.5 * (ui.spacing().interact_size.y - ui.text_style_height(&TextStyle::Body));
    ui.vertical(|ui| {
        ui.add_space(above.max(0.0));
        ui.add(Label::new(RichText::new(text).weak()).wrap());
    });
}

/// Shows the keys of a row. Each has a button that removes it.
fn keys_of_row(
    ui: &mut Ui,
    row: &KeyRow,
    editor: &mut KeyEditor,
    table: &KeyTable,
    changes: &mut Changes,
) {
    ui.spacing_mut().item_spacing.x = 3.0;
    let touched = Vec2::splat(theme::target(ui));
    for &key in &row.keys {
        chip(ui, row, Some(key), editor);
        let name = tr_format!("remove {key} of {title}", key = key.text(), title = row.title);
        let cross = small_button(ui, "\u{d7}").frame(false).min_size(touched);
        let cross = ui.add(cross).accessible_name(&name);
        if cross.on_hover_text(tr("Removes this key")).clicked() {
            editor.stop();
            table.remove(&row.name, key, changes);
        }
    }
    chip(ui, row, None, editor);
    if row.keys != row.standard {
        let name = tr_format!("standard keys of {title}", title = row.title);
        let back = ui.add(small_button(ui, tr("standard"))).accessible_name(&name);
        let keys: Vec<String> = row.standard.iter().map(Shortcut::text).collect();
        let keys = if keys.is_empty() { tr("none").to_owned() } else { keys.join(", ") };
        if back.on_hover_text(tr_format!("Back to the standard: {keys}", keys)).clicked() {
            editor.stop();
            table.restore(&row.name, changes);
        }
    }
}

fn column<T>(ui: &mut Ui, width: f32, content: impl FnOnce(&mut Ui) -> T) {
    let size = vec2(width, ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_width(width);
        content(ui);
    });
}

/// Button of a key, or without one the button that adds a key. If you click it, it waits for a key
/// press.
fn chip(ui: &mut Ui, row: &KeyRow, key: Option<Shortcut>, editor: &mut KeyEditor) {
    let waits = editor.waits_for(&row.name, key);
    let shown = match (waits, key) {
        (true, _) => tr("press a key").to_owned(),
        (false, Some(key)) => key.text(),
        (false, None) => "+".to_owned(),
    };
    let (name, tip) = match key {
        Some(key) => (
            tr_format!("change {key} of {title}", key = key.text(), title = row.title),
            tr("Click and press the key that is to do this instead; Escape leaves it"),
        ),
        None => (
            tr_format!("add a key to {title}", title = row.title),
            tr("Click and press one more key for this; Escape leaves it"),
        ),
    };
    let mut button = small_button(ui, &shown).min_size(Vec2::splat(theme::target(ui)));
    if waits {
        button = button.fill(theme::colors(ui.ctx()).chosen);
    }
    if ui.add(button).accessible_name(&name).on_hover_text(tip).clicked() {
        editor.record(&row.name, key);
    }
}

/// Shows gestures and held keys.
fn pointer(ui: &mut Ui, scope: Scope) {
    ui.add_space(6.0);
    ui.weak(tr("Pointer and held keys"));
    Grid::new("pointer").num_columns(2).spacing(vec2(14.0, 4.0)).striped(true).show(ui, |ui| {
        let rows = match scope {
            Scope::Easel => POINTER,
            Scope::Scenes => SCENE_POINTER,
        };
        for (keys, description) in rows {
            ui.strong(tr(keys));
            ui.weak(tr(description));
            ui.end_row();
        }
        if let (Scope::Easel, Some(undo)) = (scope, text(ui.ctx(), "undo")) {
            ui.strong(tr_format!("{undo} on the reference", undo));
            ui.weak(tr("Undoes the last mark or guide while the picture is drawn on"));
            ui.end_row();
        }
    });
}
