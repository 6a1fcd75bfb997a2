//! The light of a scene: its direction, and the illuminant that pigments are seen under.

use eframe::egui::Ui;
use session::volumes::VolumeCommand;

use super::context::SceneContext;
use crate::language::tr;
use crate::panels::light::{Direction, direction_control, direction_text};

/// Side of the direction control, in points.
const SIZE: f32 = 128.0;

/// Share of the light that comes from everywhere, as the control shows it.
const AMBIENT: f64 = 0.1;

/// Draws direction and illuminant of the light.
pub(super) fn show(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let light = &cx.state.look.light;
    let mut direction =
        Direction { azimuth_deg: light.azimuth_deg, elevation_deg: light.elevation_deg };
    let before = direction;
    ui.label(tr("Direction"));
    ui.horizontal(|ui| {
        let (response, _) = direction_control(ui, SIZE, &mut direction, AMBIENT);
        response
            .on_hover_text(tr("Drag it, or use the arrow keys. The light turns with the camera"));
        ui.vertical(|ui| {
            ui.label(direction_text(before));
            ui.weak(tr("clockwise from the top"));
        });
    });
    if direction != before {
        cx.change_look(|look| {
            look.light.azimuth_deg = direction.azimuth_deg;
            look.light.elevation_deg = direction.elevation_deg;
        });
    }
    if !cx.state.tubes.is_empty() {
        ui.separator();
        if let Some(chosen) = cx.tools.illuminant.show(ui, cx.state) {
            cx.command(VolumeCommand::Illuminant(chosen));
        }
    }
}
