//! Settings of the tool in hand.

use eframe::egui::{RichText, Slider, Ui};
use session::volumes::{SceneTool, VolumeCommand};

use super::context::SceneContext;
use crate::keymap::hint;
use crate::language::tr;
use crate::panels::controls::{button, percent, slider};

/// Draws the settings of the tool in hand.
pub(super) fn show(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let grip = &mut cx.tools.grip;
    ui.horizontal(|ui| {
        ui.label(RichText::new(tr(grip.tool.name())).strong());
        ui.weak(about(grip.tool));
    });
    if grip.tool == SceneTool::Pour {
        let rate = Slider::new(&mut grip.rate_mm3_s, 1.0..=1000.0).logarithmic(true);
        let keys = ["scene.less", "scene.more"].map(|name| hint(ui.ctx(), name)).concat();
        let tip = tr("Paint poured in a second, in cubic millimetres, at full pressure");
        let tip = format!("{tip}{keys}");
        slider(ui, tr("Rate"), &tip, rate.fixed_decimals(0).suffix(" mm3/s"));
        return;
    }
    let radius = Slider::new(&mut grip.radius_mm, 1.0..=100.0).logarithmic(true);
    slider(
        ui,
        tr("Radius"),
        tr("How far the tool reaches, in mm"),
        radius.fixed_decimals(0).suffix(" mm"),
    );
    if grip.tool == SceneTool::Dry {
        let key = hint(ui.ctx(), "scene.dry-all");
        let tip = format!("{}{key}", tr("Dries all paint and its shape"));
        if button(ui, tr("Dry all paint"), &tip, None) {
            cx.command(VolumeCommand::DryAll);
        }
        return;
    }
    let tip = match grip.tool {
        SceneTool::Lift => tr("How much paint the sponge takes up at each place"),
        _ => tr("How strongly the air blows"),
    };
    percent(ui, tr("Strength"), tip, &mut grip.strength, 1.0..=100.0);
}

/// Effect of a tool in a few words.
fn about(tool: SceneTool) -> &'static str {
    match tool {
        SceneTool::Pour => tr("the tube in hand, where the pen is held"),
        SceneTool::Push => tr("paint along the drag, as air does"),
        SceneTool::Lift => tr("paint, as a sponge does"),
        SceneTool::Dry => tr("paint below the pen, and its shape"),
    }
}
