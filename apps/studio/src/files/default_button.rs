//! Enter as the default button of a dialog. Enter in a field only ends the field; a second
//! Enter, or Ctrl+Enter at any time, presses the button.

use eframe::egui::{Context, Event, Key};

/// Whether a field or button has the keyboard. Ask before the dialog is drawn: a field gives
/// the keyboard back in the frame of its Enter.
pub(crate) fn keyboard_taken(ctx: &Context) -> bool {
    ctx.egui_wants_keyboard_input()
}

/// Whether the default button was pressed with the keyboard in this frame. A held key counts
/// once. `taken` is the answer of [`keyboard_taken`] before the dialog was drawn.
pub(crate) fn pressed(ctx: &Context, taken: bool) -> bool {
    ctx.input(|input| {
        input.events.iter().any(|event| match event {
            Event::Key { key: Key::Enter, pressed: true, repeat: false, modifiers, .. } => {
                modifiers.command || (!taken && modifiers.is_none())
            }
            _ => false,
        })
    })
}
