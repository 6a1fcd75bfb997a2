//! Windows that float over canvas and panels, e.g. tables of keys and choosers of pigments.
//!
//! Escape closes the topmost one. They appear beside the canvas's upper left corner, never over
//! the menu bar. If you open a window, the open menu closes.

use eframe::egui::{Context, Id, Key, LayerId, Modifiers, Order, Popup, Rect, Ui, Window, vec2};

/// Distance of a new window from the corner of its room, in points.
const MARGIN: f32 = 14.0;

/// Height of a window's title and edges, in points.
const FRAME: f32 = 56.0;

#[derive(Debug, Clone, Copy)]
struct FrameFacts {
    /// Whether Escape may close a window. An open menu or dialog closes first, and a text field may
    /// take the key.
    escape: bool,
    /// The part of the window that floating windows stay in.
    room: Rect,
}

/// Begins a frame of the whole window, before anything is drawn.
pub(crate) fn begin_frame(context: &Context) {
    let taken =
        Popup::is_any_open(context) || context.memory(|memory| memory.top_modal_layer().is_some());
    let facts = FrameFacts { escape: !taken, ..facts(context) };
    context.data_mut(|data| data.insert_temp(facts_id(), facts));
}

/// Sets the part of the window that floating windows stay in.
pub(crate) fn set_room(context: &Context, room: Rect) {
    let facts = FrameFacts { room, ..facts(context) };
    context.data_mut(|data| data.insert_temp(facts_id(), facts));
}

/// The part of the window that floating windows stay in.
pub(crate) fn room(context: &Context) -> Rect {
    facts(context).room
}

/// Height that the contents of a floating window can have, in points.
pub(crate) fn height_of_contents(context: &Context) -> f32 {
    (room(context).height() - FRAME - 2.0 * MARGIN).max(120.0)
}

/// Draws the window `title` while `open` is true. The close button and Escape clear `open`. Returns
/// the answer of `contents`.
pub(crate) fn show<R>(
    context: &Context,
    title: &str,
    id: &str,
    open: &mut bool,
    contents: impl FnOnce(&mut Ui) -> R,
) -> Option<R> {
    if !*open {
        return None;
    }
    let id = Id::unique(("floating", id));
    let layer = LayerId::new(Order::Middle, id);
    let FrameFacts { escape, room } = facts(context);
    if escape && topmost(context) == Some(layer) {
        // We consume the key, so that no window below closes too.
        *open &= !context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
        if !*open {
            return None;
        }
    }
    if !context.memory(|memory| memory.areas().visible_last_frame(&layer)) {
        Popup::close_all(context);
    }
    let window = Window::new(title).id(id).open(open).resizable(false).collapsible(false);
    let window = window.default_pos(room.min + vec2(MARGIN, MARGIN)).constrain_to(room);
    window.show(context, contents).and_then(|shown| shown.inner)
}

/// Leaves Escape to a text field in a window until the next frame. Call this before you draw the
/// window.
pub(crate) fn leave_escape(context: &Context) {
    let facts = FrameFacts { escape: false, ..facts(context) };
    context.data_mut(|data| data.insert_temp(facts_id(), facts));
}

/// Whether you pressed Escape and nothing else takes it, e.g. a menu, dialog or floating window.
pub(crate) fn take_escape(context: &Context) -> bool {
    let free = facts(context).escape && topmost(context).is_none();
    free && context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape))
}

/// The topmost floating window of the last frame.
fn topmost(context: &Context) -> Option<LayerId> {
    context.memory(|memory| {
        let areas = memory.areas();
        memory
            .layer_ids()
            .filter(|layer: &LayerId| layer.order == Order::Middle && areas.is_visible(layer))
            .last()
    })
}

fn facts(context: &Context) -> FrameFacts {
    let kept = context.data(|data| data.get_temp(facts_id()));
    kept.unwrap_or_else(|| FrameFacts { escape: true, room: context.content_rect() })
}

fn facts_id() -> Id {
    Id::unique("facts of floating windows")
}
