//! The switch that shows a whole surface under the first or the second light.
//!
//! A line between the lights would show each heap of a palette under one of them only; mixing
//! needs to see the same heap under both.

use eframe::egui::{Button, Frame, Margin, Rect, Ui, UiBuilder, vec2};

use super::surface::SurfaceView;
use crate::language::{tr, tr_format};
use crate::theme;

/// Largest width of a light's name, in points.
const NAME_WIDTH: f32 = 84.0;

impl SurfaceView {
    /// Shows the switch in the upper left corner of the surface. `lights` are the names of the
    /// first and the second light.
    pub fn show_light_switch(&mut self, ui: &mut Ui, lights: [&str; 2]) {
        let corner = self.rect().min + vec2(6.0, 6.0);
        let room = Rect::from_min_size(corner, self.rect().size());
        let mut ui = ui.new_child(UiBuilder::new().max_rect(room));
        let fill = theme::colors(ui.ctx()).panel;
        let frame = Frame::new().fill(fill).corner_radius(4).inner_margin(Margin::same(2));
        let shown = frame.show(&mut ui, |ui| {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0;
                for (light, second) in lights.into_iter().zip([false, true]) {
                    ui.scope(|ui| {
                        ui.set_max_width(NAME_WIDTH);
                        let chosen = self.under_second == second;
                        let button = Button::selectable(chosen, light).truncate().small();
                        let name = if second { tr("second") } else { tr("first") };
                        let tip = tr_format!(
                            "Shows the palette under the {name} light, {light}",
                            name,
                            light
                        );
                        let button = ui.add(button).on_hover_text(&tip);
                        if button.accessible_name(&tip).clicked() {
                            self.under_second = second;
                        }
                    });
                }
            });
        });
        self.light_switch = Some(shown.response.rect);
    }

    /// Whether the whole surface is shown under the second light.
    #[must_use]
    pub fn is_under_second(&self) -> bool {
        self.under_second && self.picture(true).is_some()
    }

    /// Rectangle of the switch between the lights, if it is shown.
    #[must_use]
    pub fn light_switch(&self) -> Option<Rect> {
        self.light_switch
    }
}
