//! A slider with its label at the left.

use eframe::egui::{Label, Response, Slider, Ui, vec2};

use super::super::controls::touch_padding;

/// Widths of label and number in a wide panel, in points.
const WIDE: (f32, f32) = (78.0, 54.0);

/// Widths of label and number in a narrow panel, in points.
const NARROW: (f32, f32) = (54.0, 39.0);

/// Adds `slider` over the available width, with its label.
pub(super) fn labelled_slider(ui: &mut Ui, name: &str, slider: Slider<'_>) -> Response {
    let width = ui.available_width();
    let (before, behind) = if width > 200.0 { WIDE } else { NARROW };
    let behind = behind + touch_padding(ui);
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
