//! The choice of the picture that is shown of a scene.

use eframe::egui::{Button, Ui, vec2};
use session::volumes::{Inside, Show};

use super::context::SceneContext;
use crate::keymap::hint;
use crate::language::tr;
use crate::panels::controls::row_height;

/// Choices in a row.
const ROW: usize = 3;

/// Draws the choice of the picture, the hatching, and what volumes show inside.
pub(super) fn show(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let look = cx.state.look;
    ui.label(tr("Picture"));
    for row in Show::ALL.chunks(ROW) {
        let choices = row.iter().map(|&one| {
            let key =
                if one == Show::Volumes { hint(ui.ctx(), "scene.volumes") } else { String::new() };
            (one, show_name(one), format!("{}{key}", show_tip(one)))
        });
        let choices = choices.collect();
        if let Some(show) = choose(ui, choices, look.show) {
            cx.change_look(|look| look.show = show);
        }
    }
    ui.add_space(4.0);
    ui.label(tr("Inside of the volumes"));
    let key = hint(ui.ctx(), "scene.inside");
    let has_tubes = !cx.state.tubes.is_empty();
    for row in Inside::choices(cx.state.by_region).chunks(ROW) {
        let tip = |one| format!("{}{key}", inside_tip(one));
        let choices = row.iter().map(|&one| (one, inside_name(one), tip(one))).collect();
        let chosen = ui.add_enabled_ui(has_tubes, |ui| choose(ui, choices, look.inside));
        if let Some(inside) = chosen.inner {
            cx.change_look(|look| look.inside = inside);
        }
    }
    ui.add_space(4.0);
    let mut hatching = look.hatching;
    let key = hint(ui.ctx(), "scene.hatching");
    let tip = format!("{}{key}", tr("Pencil strokes that show how the light falls"));
    if ui.checkbox(&mut hatching, tr("Hatching")).on_hover_text(tip).changed() {
        cx.change_look(|look| look.hatching = hatching);
    }
}

/// Draws a row of choices of equal width. Returns the one that was clicked.
fn choose<T: Copy + PartialEq>(
    ui: &mut Ui,
    choices: Vec<(T, &'static str, String)>,
    chosen: T,
) -> Option<T> {
    let mut clicked = None;
    ui.horizontal(|ui| {
        let gap = ui.spacing().item_spacing.x;
        let width = (ui.available_width() - (ROW - 1) as f32 * gap) / ROW as f32;
        for (one, name, tip) in choices {
            let button = Button::new(name).selected(one == chosen);
            if ui.add_sized(vec2(width, row_height(ui, 24.0)), button).on_hover_text(tip).clicked()
            {
                clicked = Some(one);
            }
        }
    });
    clicked
}

fn show_name(show: Show) -> &'static str {
    match show {
        Show::Final => tr("Final"),
        Show::Volumes => tr("Volumes"),
        Show::Mask => tr("Mask"),
        Show::Grey => tr("Grey"),
        Show::Color => tr("Colour"),
        Show::Hatching => tr("Strokes"),
    }
}

fn show_tip(show: Show) -> &'static str {
    match show {
        Show::Final => tr("The drawing, with colour inside of the volumes"),
        Show::Volumes => tr("The volumes themselves over the grey drawing"),
        Show::Mask => tr("White inside of the volumes, black outside"),
        Show::Grey => tr("The grey drawing alone"),
        Show::Color => tr("Colour everywhere"),
        Show::Hatching => tr("The pencil strokes alone"),
    }
}

fn inside_name(inside: Inside) -> &'static str {
    match inside {
        Inside::OwnColours => tr("Own"),
        Inside::Glaze => tr("Glaze"),
        Inside::Both => tr("Both"),
        Inside::ByRegion => tr("By region"),
    }
}

fn inside_tip(inside: Inside) -> &'static str {
    match inside {
        Inside::OwnColours => tr("The subject's own colours"),
        Inside::Glaze => tr("A film of the poured pigments over the grey drawing"),
        Inside::Both => tr("A film of the poured pigments over the subject's own colours"),
        Inside::ByRegion => tr("What the script names for each of its regions"),
    }
}
