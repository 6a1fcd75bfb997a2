//! The field on which the pen is tried.

use web_time::Instant;

use eframe::egui::{
    Align2, Rect, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, WidgetInfo, vec2,
};

use super::curve_editor::SIDE;
use crate::language::tr;
use crate::pen::{Pen, TestField, TestPoint};
use crate::theme;

/// Width of a line at full pressure, in points.
const WIDEST: f32 = 26.0;

/// Draws the field, and on it what the pen draws there.
pub(super) fn test_field(ui: &mut Ui, field: &mut TestField, pen: &Pen) {
    // Sensing drags keeps the window in its place while the pen draws.
    let (rect, response) = ui.allocate_exact_size(vec2(SIDE, SIDE), Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, tr("Test field")));
    let layer = ui.layer_id();
    let pressed = ui.input(|input| input.pointer.latest_pos());
    let reachable =
        pressed.is_none_or(|at| ui.ctx().layer_id_at(at).is_none_or(|above| above == layer));
    field.update(pen, rect, reachable, Instant::now());
    let colors = theme::colors(ui.ctx());
    let edge = Stroke::new(1.0, colors.line);
    ui.painter().rect(rect, theme::CORNER_RADIUS, colors.well, edge, StrokeKind::Inside);
    if field.strokes().is_empty() {
        let font = TextStyle::Body.resolve(ui.style());
        ui.painter().text(
            rect.center(),
            Align2::CENTER_CENTER,
            tr("Draw here"),
            font,
            colors.faint,
        );
    }
    let painter = ui.painter_at(rect.shrink(1.0));
    for stroke in field.strokes() {
        draw_stroke(&painter, rect, stroke);
    }
    if field.is_drawing() {
        ui.ctx().request_repaint();
    }
    response.on_hover_text(tr(
        "Draws a line as wide as the brush would press, with the settings shown",
    ));
}

fn draw_stroke(painter: &eframe::egui::Painter, rect: Rect, stroke: &[TestPoint]) {
    let color = theme::colors(painter.ctx()).strong;
    let width = |point: &TestPoint| WIDEST * point.pressure as f32;
    let place = |point: &TestPoint| rect.min + point.at.to_vec2();
    for point in stroke {
        painter.circle_filled(place(point), 0.5 * width(point), color);
    }
    for pair in stroke.windows(2) {
        let width = 0.5 * (width(&pair[0]) + width(&pair[1]));
        painter.line_segment([place(&pair[0]), place(&pair[1])], Stroke::new(width, color));
    }
}
