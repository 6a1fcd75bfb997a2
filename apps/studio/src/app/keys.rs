//! Translates key presses to intents while no text field has the focus.
//!
//! A tool key selects its tool. If it is held while the pointer works, releasing it
//! restores the previous tool, as in other painting programs.

use std::sync::Arc;

use eframe::egui::{Context, Event, FocusDirection, Key, Modifiers};

use super::intent::Intent;
use super::key_rows::{intent_named, key_rows};
use crate::keymap::{KeyTable, installed};
use crate::panels::Mode;

/// Time after which a tool key counts as held, in seconds.
const HOLD_SECONDS: f64 = 0.35;

/// State of the keyboard: held keys and temporary tools.
#[derive(Debug, Clone, Copy, Default)]
pub struct Keys {
    temporary: Option<TemporaryTool>,
    held: Held,
    barrel: Option<Mode>,
}

/// A tool chosen by a held key, and the tool to restore on release.
#[derive(Debug, Clone, Copy)]
struct TemporaryTool {
    key: Key,
    before: Mode,
    since: f64,
    used: bool,
}

/// Keys held down.
#[derive(Debug, Clone, Copy, Default)]
struct Held {
    space: bool,
    modifiers: Modifiers,
}

impl Keys {
    /// Returns the intents of this frame's key events in order and removes those
    /// events.
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

    /// Tool in use: the chosen one unless held keys or a pen button select another.
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

    /// Sets the tool of the pen's barrel button, `None` when it is released.
    pub fn barrel(&mut self, mode: Option<Mode>) {
        self.barrel = mode;
    }
}

/// The keys of the easel in use.
fn table(context: &Context) -> Arc<KeyTable> {
    installed(context)
        .map_or_else(|| Arc::new(KeyTable::new(key_rows())), |keymap| keymap.easel.clone())
}
