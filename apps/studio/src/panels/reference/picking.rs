//! Picks colours of the picture.

use eframe::egui::{Color32, PointerButton, Pos2, Rect, Response, Stroke, Ui, vec2};
use spectra::color::Rgb;

use super::super::context::PanelContext;
use super::picture_view::PictureView;
use super::state::Reference;

impl Reference {
    /// Picks the colour at the pointer when the primary button is released, and shows it beside the
    /// pointer until then.
    pub(super) fn pick(
        &self,
        ui: &Ui,
        response: &Response,
        view: PictureView,
        cx: &mut PanelContext<'_>,
    ) {
        let first = ui.input(|input| {
            input.pointer.button_down(PointerButton::Primary)
                || input.pointer.button_released(PointerButton::Primary)
        });
        let (Some(pointer), Some(picture)) = (response.interact_pointer_pos(), &self.picture)
        else {
            return;
        };
        let place = view.place(response.rect, pointer);
        let Some(color) =
            picture.mean([place.x, place.y], self.radius, self.exposure).filter(|_| first)
        else {
            return;
        };
        if response.drag_stopped() || response.clicked() {
            cx.tools.reference_color = Some(color);
        } else {
            let reach = view.zoom * self.radius.max(0.5);
            loupe(ui, response.rect, pointer, reach, Rgb(color));
        }
    }
}

/// Draws the colour beside the pointer, and the disc that is averaged.
fn loupe(ui: &Ui, panel: Rect, pointer: Pos2, reach: f32, linear: Rgb) {
    let [red, green, blue] = linear.encoded().to_bytes();
    let painter = ui.painter_at(panel);
    painter.circle_stroke(pointer, reach.max(3.0), Stroke::new(1.5, Color32::WHITE));
    painter.circle_stroke(pointer, reach.max(3.0) + 1.0, Stroke::new(1.0, Color32::BLACK));
    let patch = Rect::from_center_size(pointer - vec2(0.0, 44.0), vec2(44.0, 44.0));
    painter.rect_filled(patch.expand(1.0), 0.0, Color32::BLACK);
    painter.rect_filled(patch, 0.0, Color32::from_rgb(red, green, blue));
}
