//! The tubes of a scene.

use eframe::egui::{Align, Layout, RichText, Sense, Ui, vec2};
use session::volumes::{SceneTool, VolumeCommand};

use super::chooser::TubeChoice;
use super::context::{SceneContext, SceneFileRequest};
use crate::language::{tr, tr_format};
use crate::panels::controls::{button, button_background, item};
use crate::panels::tubes::{TUBE_SIZE, draw_tube};

/// Tubes in a row.
const ROW: usize = 4;

/// Draws the tubes. A click takes one in hand.
pub(super) fn show(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let tubes = cx.state.tubes.clone();
    if tubes.is_empty() {
        ui.weak(tr("This scene has no pigments: what is poured shows the subject's own colours."));
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
                    button_background(
                        ui,
                        &response,
                        &tr_format!("tube of {name}", name = tube.name),
                        chosen,
                    );
                    draw_tube(ui, rect, tube.masstone, tube.tint, &tube.name);
                    if response.clicked() {
                        cx.tools.grip.tube = number;
                        cx.tools.grip.tool = SceneTool::Pour;
                    }
                    response.context_menu(|ui| {
                        let tip = tr("Puts another pigment of the library into this tube");
                        if item(ui, tr("Put another here..."), tip, None) {
                            cx.tools.chooser.open(number);
                        }
                        let tip = tr("Fills all tubes from another pigment library (.json)");
                        if item(ui, tr("Open a library..."), tip, None) {
                            cx.file(SceneFileRequest::Library);
                        }
                    });
                    response.on_hover_ui(|ui| {
                        ui.horizontal(|ui| {
                            ui.strong(&tube.name);
                            ui.weak(format!("{}", number + 1));
                        });
                        ui.label(tr(
                            "Takes this tube in hand, to pour it; a right click changes it",
                        ));
                    });
                }
            });
        }
    });
    let chosen = tubes.get(cx.tools.grip.tube).map(|tube| tube.name.as_str());
    ui.horizontal(|ui| {
        ui.label(RichText::new(chosen.unwrap_or(tr("no tube in hand"))).strong());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let tip = tr("Chooses the pigment of the tube in hand, or another library");
            let reason = chosen.is_none().then_some(tr("no tube is in hand"));
            if button(ui, tr("Tube..."), tip, reason) {
                cx.tools.chooser.open(cx.tools.grip.tube);
            }
        });
    });
    match cx.tools.chooser.show(ui.ctx(), cx.state) {
        Some(TubeChoice::Pigment(tube, name)) => cx.command(VolumeCommand::Tube(tube, name)),
        Some(TubeChoice::Library) => cx.file(SceneFileRequest::Library),
        None => {}
    }
}
