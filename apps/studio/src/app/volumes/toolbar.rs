//! The toolbar of the workspace of scenes.

use eframe::egui::{Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2};
use session::volumes::{SceneState, SceneTool, Show};

use super::entries::tip;
use super::icons;
use super::intent::{SceneEntry, SceneIntent};
use super::menus::enabled;
use crate::language::tr;
use crate::theme;

/// Buttons in groups.
const GROUPS: [&[SceneIntent]; 3] = [
    &[
        SceneIntent::Tool(SceneTool::Pour),
        SceneIntent::Tool(SceneTool::Push),
        SceneIntent::Tool(SceneTool::Lift),
        SceneIntent::Tool(SceneTool::Dry),
    ],
    &[SceneIntent::Undo],
    &[SceneIntent::Volumes, SceneIntent::Hatching, SceneIntent::Frame],
];

/// Draws the toolbar. Returns the intent of the button that was clicked.
pub(super) fn show(
    ui: &mut Ui,
    tool: SceneTool,
    state: Option<&SceneState>,
) -> Option<SceneIntent> {
    let mut clicked = None;
    ui.spacing_mut().item_spacing = vec2(0.0, 2.0);
    for (at, group) in GROUPS.into_iter().enumerate() {
        if at > 0 {
            ui.add_space(3.0);
            ui.separator();
            ui.add_space(3.0);
        }
        for &intent in group {
            let chosen = match intent {
                SceneIntent::Tool(one) => one == tool,
                SceneIntent::Volumes => state.is_some_and(|state| state.look.show == Show::Volumes),
                SceneIntent::Hatching => state.is_some_and(|state| state.look.hatching),
                _ => false,
            };
            if button(ui, intent, chosen, enabled(intent, state)) {
                clicked = Some(intent);
            }
        }
    }
    clicked
}

fn button(ui: &mut Ui, intent: SceneIntent, chosen: bool, enabled: bool) -> bool {
    let Some(entry) = SceneEntry::of(intent) else { return false };
    let clicked = ui.add_enabled_ui(enabled, |ui| {
        let side = ui.available_width();
        let (rect, response) =
            ui.allocate_exact_size(theme::at_least(ui, vec2(side, 30.0)), Sense::click());
        response
            .widget_info(|| WidgetInfo::selected(Role::Button, enabled, chosen, tr(entry.name)));
        let visuals = ui.style().interact(&response);
        let fill = match (chosen, response.hovered()) {
            (true, _) => theme::colors(ui.ctx()).chosen,
            (false, true) => visuals.bg_fill,
            (false, false) => theme::colors(ui.ctx()).bar,
        };
        let corner = theme::CORNER_RADIUS;
        ui.painter().rect(rect, corner, fill, Stroke::NONE, StrokeKind::Inside);
        let color = if chosen { theme::colors(ui.ctx()).strong } else { visuals.fg_stroke.color };
        icons::draw(ui.painter(), rect, intent, color);
        let response = response.on_hover_ui(|ui| tip(ui, entry));
        response.on_disabled_hover_ui(|ui| tip(ui, entry)).clicked()
    });
    clicked.inner
}
