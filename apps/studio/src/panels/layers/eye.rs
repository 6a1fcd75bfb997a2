//! The eye icon that shows and hides a layer.

use eframe::egui::{Pos2, Rect, Response, Sense, Shape, Stroke, Ui, pos2, vec2};

use crate::panels::controls::button_background;
use crate::theme;

/// Adds a clickable eye icon, open if the layer is `visible`.
pub(super) fn eye(ui: &mut Ui, name: &str, visible: bool) -> Response {
    let (rect, response) =
        ui.allocate_exact_size(theme::at_least(ui, vec2(24.0, 24.0)), Sense::click());
    button_background(ui, &response, name, false);
    let lens = Rect::from_center_size(rect.center(), vec2(16.0, 10.0));
    let color =
        if visible { theme::colors(ui.ctx()).strong } else { theme::colors(ui.ctx()).faint };
    let line = Stroke::new(1.5, color);
    ui.painter().add(Shape::line(lid(lens, 1.0), line));
    if visible {
        ui.painter().add(Shape::line(lid(lens, -1.0), line));
        ui.painter().circle_filled(rect.center(), 2.75, color);
    }
    response
}

/// Curve of the lower eyelid if `side` is 1, of the upper eyelid if it is -1.
fn lid(lens: Rect, side: f32) -> Vec<Pos2> {
    (0..=12)
        .map(|step: i16| {
            let along = f32::from(step) / 12.0;
            let bulge = 4.0 * along * (1.0 - along);
            pos2(
                lens.left() + lens.width() * along,
                lens.center().y + side * bulge * lens.height() / 2.0,
            )
        })
        .collect()
}
