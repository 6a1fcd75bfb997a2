//! The menu bar with its shortcuts.

use eframe::egui::{InnerResponse, MenuBar, ScrollArea, Ui};

use super::entries::entries;
use super::intent::{Intent, Menu};
use super::menu_item;
use super::toolbar::tip;
use crate::language::tr;
use crate::panels::Mode;
use crate::pen::{DrawingAids, GuideKind};
use crate::theme::{self, Look, ThemeChoice};

/// Program state that enables and checks menu entries.
#[derive(Debug, Clone, Copy)]
pub(super) struct State {
    /// Whether a painting is open.
    pub(super) open: bool,
    /// Whether a scene is open.
    pub(super) scene: bool,
    /// Whether undo and redo are possible.
    pub(super) history: (bool, bool),
    /// Whether panels, palette and performance figures are shown.
    pub(super) shown: (bool, bool, bool),
    /// Whether the view is mirrored.
    pub(super) mirror: bool,
    /// Ruler, perspective and symmetry.
    pub(super) aids: DrawingAids,
    /// Theme, and size of what is touched.
    pub(super) look: Look,
}

/// Shows the bar with `title` at its right. Returns the entry that was clicked.
pub(super) fn show(ui: &mut Ui, state: State, title: &str) -> Option<Intent> {
    let mut clicked = None;
    MenuBar::new().ui(ui, |ui| {
        if theme::is_touch(ui.ctx()) {
            ui.spacing_mut().button_padding.x = 13.0;
        }
        for (menu, name, description) in [
            (Menu::File, tr("File"), tr("Open, save, export")),
            (Menu::Edit, tr("Edit"), tr("The painting and the brush")),
            (Menu::View, tr("View"), tr("Zoom, rotation and visible parts")),
            (Menu::Tools, tr("Tools"), tr("Tools of the pen")),
            (Menu::Help, tr("Help"), tr("Keys, first steps and a guided tour")),
        ] {
            let opened = menu_button(ui, name, |ui| {
                let own = || entries().filter(move |entry| entry.menu == menu);
                let ticks = own().any(|entry| checked(entry.intent, state).is_some());
                for entry in own() {
                    if begins_group(entry.intent) {
                        ui.separator();
                    }
                    let enabled = enabled(entry.intent, state);
                    let checked = checked(entry.intent, state);
                    let keys = entry.shortcut_text(ui.ctx());
                    let response =
                        menu_item::show(ui, tr(entry.name), &keys, enabled, checked, ticks);
                    let response = response.on_hover_ui(|ui| tip(ui, entry));
                    if response.clicked() {
                        clicked = Some(entry.intent);
                        ui.close();
                    }
                }
            });
            opened.response.on_hover_text(description);
        }
        ui.with_layout(eframe::egui::Layout::right_to_left(eframe::egui::Align::Center), |ui| {
            ui.add_space(4.0);
            if !theme::is_narrow(ui.ctx()) {
                ui.weak(title);
            } else if ui.selectable_label(state.shown.0, tr("Panels")).clicked() {
                clicked = Some(Intent::Panels);
            }
        });
    });
    clicked
}

/// Adds a button that opens a menu. A menu that is higher than the window is scrolled.
pub(super) fn menu_button(
    ui: &mut Ui,
    name: &str,
    content: impl FnOnce(&mut Ui),
) -> InnerResponse<Option<()>> {
    ui.menu_button(name, |ui| {
        ui.set_min_width(190.0);
        if !theme::is_touch(ui.ctx()) {
            return content(ui);
        }
        let most = ui.ctx().content_rect().height() - 2.0 * theme::TOUCH_TARGET;
        ui.set_min_width(290.0);
        let area = ScrollArea::vertical().max_height(most).min_scrolled_height(most);
        area.show(ui, content);
    })
}

fn begins_group(intent: Intent) -> bool {
    matches!(
        intent,
        Intent::Save
            | Intent::Export
            | Intent::OpenReference
            | Intent::NewScene
            | Intent::Quit
            | Intent::Dry
            | Intent::Larger
            | Intent::Pen
            | Intent::Fit
            | Intent::TurnLeft
            | Intent::Panels
            | Intent::Tool(Mode::Squeeze)
            | Intent::Tool(Mode::Pan)
            | Intent::DrawingAids
            | Intent::StandardLayout
            | Intent::Theme(ThemeChoice::Dark)
            | Intent::TouchTargets
    )
}

fn enabled(intent: Intent, state: State) -> bool {
    match intent {
        Intent::Undo => state.history.0,
        Intent::Redo => state.history.1,
        Intent::ShowScene => state.scene,
        Intent::Open
        | Intent::New
        | Intent::NewScene
        | Intent::OpenScene
        | Intent::Preferences
        | Intent::Pen
        | Intent::Quit
        | Intent::Keys
        | Intent::Theme(_)
        | Intent::TouchTargets
        | Intent::LargerInterface
        | Intent::SmallerInterface
        | Intent::StandardLayout
        | Intent::FullScreen => true,
        _ => state.open,
    }
}

fn checked(intent: Intent, state: State) -> Option<bool> {
    match intent {
        Intent::Panels => Some(state.shown.0),
        Intent::Palette => Some(state.shown.1),
        Intent::Figures => Some(state.shown.2),
        Intent::Mirror => Some(state.mirror),
        Intent::Ruler => Some(state.aids.guide == Some(GuideKind::Ruler)),
        Intent::Perspective => Some(state.aids.guide == Some(GuideKind::Perspective)),
        Intent::Snapping => Some(state.aids.snaps),
        Intent::Symmetry => Some(state.aids.symmetry.on),
        Intent::Theme(theme) => Some(state.look.theme == theme),
        Intent::TouchTargets => Some(state.look.touch),
        _ => None,
    }
}
