//! A slider behind its name.

use eframe::egui::{Label, Response, Slider, Ui, vec2};

/// Widths of a name and of the number behind a slider, in points.
const WIDE: (f32, f32) = (78.0, 54.0);

/// The same where there is little room.
const NARROW: (f32, f32) = (54.0, 39.0);

/// Shows `slider` in all the width there is, its name before it.
pub(super) fn row(ui: &mut Ui, name: &str, slider: Slider<'_>) -> Response {
    let width = ui.available_width();
    let (before, behind) = if width > 200.0 { WIDE } else { NARROW };
    let row = ui.horizontal(|ui| {
        let size = vec2(before, ui.spacing().interact_size.y);
        ui.allocate_ui(size, |ui| {
            ui.set_min_width(before);
            ui.add(Label::new(name));
        });
        let gaps = 2.0 * ui.spacing().item_spacing.x;
        ui.spacing_mut().slider_width = (width - before - behind - gaps).max(30.0);
        ui.add(slider)
    });
    row.inner
}
