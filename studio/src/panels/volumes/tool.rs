//! Settings of the tool in hand.

use eframe::egui::{RichText, Slider, Ui};
use session::volumes::{SceneTool, VolumeCommand};

use super::context::SceneContext;
use crate::keymap::hint;
use crate::panels::controls::{button, percent, slider};

/// Draws the settings of the tool in hand.
pub(super) fn show(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let grip = &mut cx.tools.grip;
    ui.horizontal(|ui| {
        ui.label(RichText::new(grip.tool.name()).strong());
        ui.weak(about(grip.tool));
    });
    if grip.tool == SceneTool::Pour {
        let rate = Slider::new(&mut grip.rate_mm3_s, 1.0..=1000.0).logarithmic(true);
        let keys = ["scene.less", "scene.more"].map(|name| hint(ui.ctx(), name)).concat();
        let tip = format!("Paint poured in a second, in cubic millimetres, at full pressure{keys}");
        slider(ui, "Rate", &tip, rate.fixed_decimals(0).suffix(" mm3/s"));
        return;
    }
    let radius = Slider::new(&mut grip.radius_mm, 1.0..=100.0).logarithmic(true);
    slider(ui, "Radius", "How far the tool reaches, in mm", radius.fixed_decimals(0).suffix(" mm"));
    if grip.tool == SceneTool::Dry {
        let tip = format!("Dries all paint and its shape{}", hint(ui.ctx(), "scene.dry-all"));
        if button(ui, "Dry all paint", &tip, None) {
            cx.command(VolumeCommand::DryAll);
        }
        return;
    }
    let tip = match grip.tool {
        SceneTool::Lift => "How much paint the sponge takes up at each place",
        _ => "How strongly the air blows",
    };
    percent(ui, "Strength", tip, &mut grip.strength, 1.0..=100.0);
}

/// Effect of a tool in a few words.
fn about(tool: SceneTool) -> &'static str {
    match tool {
        SceneTool::Pour => "the tube in hand, where the pen is held",
        SceneTool::Push => "paint along the drag, as air does",
        SceneTool::Lift => "paint, as a sponge does",
        SceneTool::Dry => "paint below the pen, and its shape",
    }
}
