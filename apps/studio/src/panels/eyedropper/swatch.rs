//! Draws swatches of one or more colours.

use eframe::egui::{
    Color32, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo,
};
use spectra::color::Rgb;

use crate::theme;

/// Rounds and clips encoded sRGB to a screen colour.
pub(super) fn on_screen(rgb: Rgb) -> Color32 {
    let [red, green, blue] = rgb.to_bytes();
    Color32::from_rgb(red, green, blue)
}

/// Draws a clickable patch with an accessible name. Several colours lie side by side
/// without a gap for comparison.
pub(in crate::panels) fn swatch(ui: &mut Ui, name: &str, size: Vec2, colors: &[Rgb]) -> Response {
    let size = theme::at_least(ui, size);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
    let width = rect.width() / colors.len().max(1) as f32;
    for (at, &rgb) in colors.iter().enumerate() {
        let left = rect.left() + at as f32 * width;
        let part = Rect::from_x_y_ranges(left..=left + width, rect.y_range());
        ui.painter().rect_filled(part, 0.0, on_screen(rgb));
    }
    ui.painter().rect_stroke(
        rect,
        0.0,
        Stroke::new(1.0, theme::colors(ui.ctx()).well),
        StrokeKind::Outside,
    );
    response
}
