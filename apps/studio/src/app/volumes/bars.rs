//! Menu bar and toolbar of the workspace of scenes.

use eframe::egui::{
    Align, Color32, Layout, MenuBar, Painter, Rect, Role, Sense, Stroke, StrokeKind, Ui,
    WidgetInfo, vec2,
};
use session::volumes::{SceneState, SceneTool, Show};

use super::intent::{SCENE_ENTRIES, SceneEntry, SceneIntent, SceneMenu, tip};
use crate::app::bars;
use crate::app::bars::Mark::{self, Arc, Filled, Line};
use crate::app::bars::{draw_marks, menu_button};
use crate::app::intent::Intent;
use crate::language::tr;
use crate::theme;

/// Shows the bar with `title` at its right. Returns the clicked entry.
pub(super) fn show_menus(
    ui: &mut Ui,
    state: Option<&SceneState>,
    title: &str,
) -> Option<SceneIntent> {
    let mut clicked = None;
    MenuBar::new().ui(ui, |ui| {
        if theme::is_touch(ui.ctx()) {
            ui.spacing_mut().button_padding.x = 13.0;
        }
        for (menu, name, description) in [
            (SceneMenu::File, tr("File"), tr("Open and save scenes, back to the easel")),
            (SceneMenu::Edit, tr("Edit"), tr("Events, time and pouring")),
            (SceneMenu::View, tr("View"), tr("What is shown")),
            (SceneMenu::Tools, tr("Tools"), tr("Tools of the pen")),
            (SceneMenu::Help, tr("Help"), tr("The table of keys")),
        ] {
            let opened = menu_button(ui, name, |ui| {
                let own: Vec<_> = SCENE_ENTRIES.iter().filter(|entry| entry.menu == menu).collect();
                let ticks = own.iter().any(|entry| checked(entry.intent, state).is_some());
                for entry in own {
                    if begins_group(entry.intent) {
                        ui.separator();
                    }
                    let enabled = enabled(entry.intent, state);
                    let checked = checked(entry.intent, state);
                    let keys = entry.shortcut_text(ui.ctx());
                    let response =
                        bars::show_item(ui, tr(entry.name), &keys, enabled, checked, ticks);
                    if response.on_hover_ui(|ui| tip(ui, entry)).clicked() {
                        clicked = Some(entry.intent);
                        ui.close();
                    }
                }
            });
            opened.response.on_hover_text(description);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(4.0);
            ui.weak(title);
        });
    });
    clicked
}

fn begins_group(intent: SceneIntent) -> bool {
    matches!(
        intent,
        SceneIntent::Save
            | SceneIntent::Library
            | SceneIntent::Easel
            | SceneIntent::Quit
            | SceneIntent::DryAll
            | SceneIntent::Play
            | SceneIntent::More
            | SceneIntent::Preferences
            | SceneIntent::Frame
            | SceneIntent::Panels
    )
}

/// Whether an intent has an effect.
pub(super) fn enabled(intent: SceneIntent, state: Option<&SceneState>) -> bool {
    match intent {
        SceneIntent::New
        | SceneIntent::Open
        | SceneIntent::Easel
        | SceneIntent::Quit
        | SceneIntent::Preferences
        | SceneIntent::Panels
        | SceneIntent::FullScreen
        | SceneIntent::Keys => true,
        SceneIntent::Undo => state.is_some_and(|state| !state.events.is_empty()),
        SceneIntent::Inside => state.is_some_and(|state| !state.tubes.is_empty()),
        _ => state.is_some(),
    }
}

fn checked(intent: SceneIntent, state: Option<&SceneState>) -> Option<bool> {
    match intent {
        SceneIntent::Volumes => Some(state.is_some_and(|state| state.look.show == Show::Volumes)),
        SceneIntent::Hatching => Some(state.is_some_and(|state| state.look.hatching)),
        _ => None,
    }
}

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

/// Draws the toolbar. Returns the intent of the clicked button.
pub(super) fn show_toolbar(
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
        draw(ui.painter(), rect, intent, color);
        let response = response.on_hover_ui(|ui| tip(ui, entry));
        response.on_disabled_hover_ui(|ui| tip(ui, entry)).clicked()
    });
    clicked.inner
}

pub(super) fn draw(painter: &Painter, button: Rect, intent: SceneIntent, color: Color32) {
    draw_marks(painter, button, marks(intent), color);
}

fn marks(intent: SceneIntent) -> &'static [Mark] {
    match intent {
        // A tube with a drop below it.
        SceneIntent::Tool(SceneTool::Pour) => &[
            Line(&[(3.0, 2.0), (15.0, 2.0)]),
            Line(&[(4.5, 2.0), (6.8, 9.0), (11.2, 9.0), (13.5, 2.0)]),
            Filled(&[(9.0, 10.0), (11.4, 14.0), (10.4, 16.4), (7.6, 16.4), (6.6, 14.0)]),
        ],
        // Wind.
        SceneIntent::Tool(SceneTool::Push) => &[
            Line(&[(1.5, 6.5), (11.0, 6.5)]),
            Arc((11.0, 4.2), 2.3, 90.0, -150.0),
            Line(&[(1.5, 9.5), (15.0, 9.5)]),
            Line(&[(1.5, 12.5), (9.0, 12.5)]),
            Arc((9.0, 14.6), 2.1, -90.0, 140.0),
        ],
        // A sponge with an arrow upwards.
        SceneIntent::Tool(SceneTool::Lift) => &[
            Line(&[(2.5, 11.0), (15.5, 11.0), (15.5, 16.0), (2.5, 16.0), (2.5, 11.0)]),
            Filled(&[(5.0, 13.0), (6.5, 13.0), (6.5, 14.5), (5.0, 14.5)]),
            Filled(&[(10.5, 12.6), (12.0, 12.6), (12.0, 14.1), (10.5, 14.1)]),
            Line(&[(9.0, 9.0), (9.0, 1.8)]),
            Line(&[(6.0, 4.8), (9.0, 1.8), (12.0, 4.8)]),
        ],
        SceneIntent::Tool(SceneTool::Dry) => bars::marks(Intent::Dry),
        SceneIntent::Undo => bars::marks(Intent::Undo),
        SceneIntent::Frame => bars::marks(Intent::Fit),
        // A ball.
        SceneIntent::Volumes => {
            &[Arc((9.0, 9.0), 6.5, 0.0, 360.0), Arc((9.0, 3.5), 8.0, 48.0, 132.0)]
        }
        SceneIntent::Hatching => &[
            Line(&[(2.0, 8.0), (8.0, 2.0)]),
            Line(&[(2.0, 13.0), (13.0, 2.0)]),
            Line(&[(4.0, 16.0), (16.0, 4.0)]),
            Line(&[(9.0, 16.0), (16.0, 9.0)]),
        ],
        _ => &[],
    }
}
