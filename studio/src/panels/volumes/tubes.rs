//! The tubes of a scene.

use eframe::egui::{RichText, Sense, Ui, vec2};
use session::volumes::SceneTool;

use super::context::SceneContext;
use crate::panels::controls::button_background;
use crate::panels::tubes::{TUBE_SIZE, draw_tube};

/// Tubes in a row.
const ROW: usize = 4;

/// Draws the tubes. A click takes one in hand.
pub(super) fn show(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let tubes = cx.state.tubes.clone();
    if tubes.is_empty() {
        ui.weak("This scene has no pigments: what is poured shows the subject's own colours.");
        return;
    }
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
        for (row, tubes) in tubes.chunks(ROW).enumerate() {
            ui.horizontal(|ui| {
                for (column, tube) in tubes.iter().enumerate() {
                    let number = row * ROW + column;
                    let (rect, response) = ui.allocate_exact_size(TUBE_SIZE, Sense::click());
                    let chosen = number == cx.tools.grip.tube;
                    button_background(ui, &response, &format!("tube of {}", tube.name), chosen);
                    draw_tube(ui, rect, tube.masstone, tube.tint, &tube.name);
                    if response.clicked() {
                        cx.tools.grip.tube = number;
                        cx.tools.grip.tool = SceneTool::Pour;
                    }
                    response.on_hover_ui(|ui| {
                        ui.horizontal(|ui| {
                            ui.strong(&tube.name);
                            ui.weak(format!("{}", number + 1));
                        });
                        ui.label("Takes this tube in hand, to pour it");
                    });
                }
            });
        }
    });
    let chosen = tubes.get(cx.tools.grip.tube).map(|tube| tube.name.as_str());
    ui.label(RichText::new(chosen.unwrap_or("no tube in hand")).strong());
}
