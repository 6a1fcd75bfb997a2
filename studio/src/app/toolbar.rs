//! The column of tools at the left.

use eframe::egui::{Role, Sense, Stroke, Ui, WidgetInfo, vec2};

use super::icons;
use super::intent::{Entry, Intent};
use crate::panels::Mode;
use crate::theme;

/// The tools, and what is done most, in groups.
const GROUPS: [&[Intent]; 4] = [
    &[
        Intent::Tool(Mode::Paint),
        Intent::Tool(Mode::Squeeze),
        Intent::Tool(Mode::Pick),
        Intent::Tool(Mode::Pan),
        Intent::Tool(Mode::Rotate),
        Intent::Tool(Mode::Zoom),
    ],
    &[Intent::Undo, Intent::Redo],
    &[Intent::Wash, Intent::Wipe, Intent::Dry],
    &[Intent::Mirror, Intent::Fit],
];

/// What the buttons show.
#[derive(Debug, Clone, Copy)]
pub(super) struct State {
    /// What the pen does now.
    pub(super) mode: Mode,
    /// Whether left and right are exchanged.
    pub(super) mirror: bool,
    /// Whether there is something to take back, and to do again.
    pub(super) history: (bool, bool),
}

/// Shows it; what was clicked.
pub(super) fn show(ui: &mut Ui, state: State) -> Option<Intent> {
    let mut clicked = None;
    ui.spacing_mut().item_spacing = vec2(0.0, 2.0);
    for (at, group) in GROUPS.into_iter().enumerate() {
        if at > 0 {
            ui.add_space(3.0);
            ui.separator();
            ui.add_space(3.0);
        }
        for &intent in group {
            if button(ui, intent, state) {
                clicked = Some(intent);
            }
        }
    }
    clicked
}

fn button(ui: &mut Ui, intent: Intent, state: State) -> bool {
    let Some(entry) = Entry::of(intent) else { return false };
    let chosen = match intent {
        Intent::Tool(mode) => mode == state.mode,
        Intent::Mirror => state.mirror,
        _ => false,
    };
    let enabled = match intent {
        Intent::Undo => state.history.0,
        Intent::Redo => state.history.1,
        _ => true,
    };
    let clicked = ui.add_enabled_ui(enabled, |ui| {
        let side = ui.available_width();
        let (rect, response) = ui.allocate_exact_size(vec2(side, 30.0), Sense::click());
        response.widget_info(|| WidgetInfo::selected(Role::Button, enabled, chosen, entry.name));
        let look = ui.style().interact(&response);
        let fill = match (chosen, response.hovered()) {
            (true, _) => theme::CHOSEN,
            (false, true) => look.bg_fill,
            (false, false) => theme::BAR,
        };
        ui.painter().rect(rect, theme::ROUND, fill, Stroke::NONE, eframe::egui::StrokeKind::Inside);
        let color = if chosen { theme::STRONG } else { look.fg_stroke.color };
        icons::draw(ui.painter(), rect, intent, color);
        let response = response.on_hover_ui(|ui| tip(ui, entry)).on_disabled_hover_ui(|ui| {
            tip(ui, entry);
        });
        response.clicked()
    });
    clicked.inner
}

/// The words of an entry: its name, its key, what it does.
pub(super) fn tip(ui: &mut Ui, entry: &Entry) {
    ui.horizontal(|ui| {
        ui.strong(entry.name);
        ui.weak(entry.keys_written());
    });
    ui.label(entry.told);
}
