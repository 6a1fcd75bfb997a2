//! Edges that are dragged to resize what lies beside them.

use eframe::egui::{CursorIcon, Id, Key, Rect, Role, Sense, Stroke, Ui, WidgetInfo};

use crate::language::tr;
use crate::theme;

/// Change of an arrow key, in points.
const STEP: f32 = 8.0;

/// A line along which two parts of the window meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::app) enum Line {
    /// Between parts side by side.
    Upright,
    /// Between parts above each other.
    Level,
}

/// Adds an edge in `rect` that is dragged, or moved by the arrow keys. Returns how far it
/// moves in this frame, in points to the right or downwards.
pub(in crate::app) fn divider(ui: &Ui, rect: Rect, name: &str, line: Line) -> f32 {
    let response = ui.interact(rect, Id::unique(("divider", name)), Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, name));
    let (cursor, keys) = match line {
        Line::Upright => (CursorIcon::ResizeHorizontal, [Key::ArrowLeft, Key::ArrowRight]),
        Line::Level => (CursorIcon::ResizeVertical, [Key::ArrowUp, Key::ArrowDown]),
    };
    let mut moved = match line {
        Line::Upright => response.drag_delta().x,
        Line::Level => response.drag_delta().y,
    };
    if response.has_focus() {
        let [back, on] = keys.map(|key| ui.input(|input| input.num_presses(key)) as f32);
        moved += STEP * (on - back);
    }
    let used = response.hovered() || response.dragged() || response.has_focus();
    let colors = theme::colors(ui.ctx());
    let stroke =
        Stroke::new(if used { 2.0 } else { 1.0 }, if used { colors.faint } else { colors.line });
    match line {
        Line::Upright => ui.painter().vline(rect.center().x, rect.y_range(), stroke),
        Line::Level => ui.painter().hline(rect.x_range(), rect.center().y, stroke),
    };
    response.on_hover_cursor(cursor).on_hover_text(tr("Drag to resize"));
    moved
}
