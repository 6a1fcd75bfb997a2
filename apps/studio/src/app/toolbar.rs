//! The toolbar at the left.

use eframe::egui::{Context, Role, ScrollArea, Sense, Stroke, Ui, WidgetInfo, vec2};

use super::icons;
use super::intent::{Entry, Intent};
use super::places::{self, Part};
use crate::language::tr;
use crate::panels::Mode;
use crate::theme;

/// Buttons of the toolbar in groups.
const GROUPS: [&[Intent]; 4] = [
    &[
        Intent::Tool(Mode::Paint),
        Intent::Tool(Mode::Blend),
        Intent::Tool(Mode::Scrape),
        Intent::Tool(Mode::Erase),
        Intent::Tool(Mode::Mask),
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

/// Program state shown by the buttons.
#[derive(Debug, Clone, Copy)]
pub(super) struct State {
    /// Tool in use.
    pub(super) mode: Mode,
    /// Whether the view is mirrored.
    pub(super) mirror: bool,
    /// Whether undo and redo are possible.
    pub(super) history: (bool, bool),
}

/// Width of the toolbar, in points.
pub(super) fn width(context: &Context) -> f32 {
    if theme::is_touch(context) { theme::TOUCH_TARGET + 8.0 } else { 42.0 }
}

/// Draws the toolbar. Returns the intent of the button that was clicked.
pub(super) fn show(ui: &mut Ui, state: State) -> Option<Intent> {
    let mut clicked = None;
    ui.spacing_mut().item_spacing = vec2(0.0, 2.0);
    // In a low window, large buttons are scrolled.
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
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
    });
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
        let (rect, response) =
            ui.allocate_exact_size(theme::at_least(ui, vec2(side, 30.0)), Sense::click());
        response
            .widget_info(|| WidgetInfo::selected(Role::Button, enabled, chosen, tr(entry.name)));
        places::note(ui.ctx(), Part::Button(intent), rect);
        let visuals = ui.style().interact(&response);
        let fill = match (chosen, response.hovered()) {
            (true, _) => theme::colors(ui.ctx()).chosen,
            (false, true) => visuals.bg_fill,
            (false, false) => theme::colors(ui.ctx()).bar,
        };
        ui.painter().rect(
            rect,
            theme::CORNER_RADIUS,
            fill,
            Stroke::NONE,
            eframe::egui::StrokeKind::Inside,
        );
        let color = if chosen { theme::colors(ui.ctx()).strong } else { visuals.fg_stroke.color };
        icons::draw(ui.painter(), rect, intent, color);
        let response = response.on_hover_ui(|ui| tip(ui, entry)).on_disabled_hover_ui(|ui| {
            tip(ui, entry);
        });
        response.clicked()
    });
    clicked.inner
}

/// Tooltip of an entry: name, shortcut and description.
pub(super) fn tip(ui: &mut Ui, entry: &Entry) {
    ui.horizontal(|ui| {
        ui.strong(tr(entry.name));
        ui.weak(entry.shortcut_text(ui.ctx()));
    });
    ui.label(tr(entry.description));
}
