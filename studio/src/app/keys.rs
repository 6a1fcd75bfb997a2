//! What the keyboard asks for, while no text is being typed.
//!
//! A key of a tool chooses it; held while the pointer works, it gives the tool
//! before back when it is let go, as painting programs do.

use eframe::egui::{Context, Event, FocusDirection, Key, Modifiers};

use super::entries::ENTRIES;
use super::intent::Intent;
use crate::panels::Mode;

/// Seconds after which a key of a tool counts as held.
const HELD: f64 = 0.35;

/// The keyboard.
#[derive(Debug, Clone, Copy, Default)]
pub struct Keys {
    spring: Option<Spring>,
    held: Held,
    barrel: Option<Mode>,
}

/// A tool that goes back when its key is let go.
#[derive(Debug, Clone, Copy)]
struct Spring {
    key: Key,
    before: Mode,
    since: f64,
    used: bool,
}

/// What is held down.
#[derive(Debug, Clone, Copy, Default)]
struct Held {
    space: bool,
    modifiers: Modifiers,
}

impl Keys {
    /// Takes the keys of this frame, in order.
    pub fn read(&mut self, context: &Context, mode: Mode) -> Vec<Intent> {
        let mut asked = Vec::new();
        if context.text_edit_focused() {
            *self = Self { barrel: self.barrel, ..Self::default() };
            return asked;
        }
        let focused = context.memory(|memory| memory.focused().is_some());
        let mut tabbed = false;
        context.input_mut(|input| {
            self.held.modifiers = input.modifiers;
            if let Some(spring) = &mut self.spring {
                spring.used |= input.pointer.any_down();
            }
            let now = input.time;
            let (held, spring) = (&mut self.held, &mut self.spring);
            input.events.retain(|event| {
                let Event::Key { key, pressed, repeat, modifiers, .. } = event else {
                    return true;
                };
                // A control that was reached by Tab takes these itself.
                if focused && matches!(key, Key::Tab | Key::Space | Key::Enter) {
                    return true;
                }
                if *key == Key::Space {
                    held.space = *pressed;
                    return false;
                }
                if !pressed {
                    if let Some(sprung) = spring.take_if(|spring| spring.key == *key)
                        && (sprung.used || now - sprung.since > HELD)
                    {
                        asked.push(Intent::Tool(sprung.before));
                    }
                    return true;
                }
                let Some(intent) = intent(*key, *modifiers) else { return true };
                let again = matches!(
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
                if *repeat && !again {
                    return false;
                }
                if let Intent::Tool(_) = intent {
                    *spring = Some(Spring { key: *key, before: mode, since: now, used: false });
                }
                tabbed |= *key == Key::Tab;
                asked.push(intent);
                false
            });
            if !input.focused {
                *held = Held::default();
            }
        });
        if tabbed {
            context.memory_mut(|memory| memory.move_focus(FocusDirection::None));
        }
        asked
    }

    /// What the pen does while keys are held: the tool that was chosen, unless one
    /// says otherwise.
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

    /// A button on the barrel of a pen gives a tool while it is held.
    pub fn barrel(&mut self, mode: Option<Mode>) {
        self.barrel = mode;
    }
}

/// What a key asks for.
fn intent(key: Key, modifiers: Modifiers) -> Option<Intent> {
    const NUMBERS: [Key; 9] = [
        Key::Num1,
        Key::Num2,
        Key::Num3,
        Key::Num4,
        Key::Num5,
        Key::Num6,
        Key::Num7,
        Key::Num8,
        Key::Num9,
    ];
    if modifiers.is_none()
        && let Some(number) = NUMBERS.iter().position(|number| *number == key)
    {
        return Some(Intent::Brush(number as u8 + 1));
    }
    let entry =
        ENTRIES.iter().find(|entry| entry.keys.iter().any(|stroke| stroke.is(key, modifiers)));
    entry.map(|entry| entry.intent)
}
