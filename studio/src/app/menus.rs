//! The bar at the top: menus with their keys.

use eframe::egui::{Button, MenuBar, Ui};

use super::entries::ENTRIES;
use super::intent::{Intent, Menu};
use super::toolbar::tip;

/// What of the entries can be asked for now, and what is shown.
#[derive(Debug, Clone, Copy)]
pub(super) struct State {
    /// Whether there is a painting.
    pub(super) open: bool,
    /// Whether there is something to take back, and to do again.
    pub(super) history: (bool, bool),
    /// Whether panels, palette and figures are shown.
    pub(super) shown: (bool, bool, bool),
    /// Whether the view is mirrored.
    pub(super) mirror: bool,
}

/// Shows the bar, with `title` at its right; what was clicked.
pub(super) fn show(ui: &mut Ui, state: State, title: &str) -> Option<Intent> {
    let mut clicked = None;
    MenuBar::new().ui(ui, |ui| {
        for (menu, name, told) in [
            (Menu::File, "File", "Open, save, export"),
            (Menu::Edit, "Edit", "The painting and the brush"),
            (Menu::View, "View", "What is seen, and how"),
            (Menu::Tools, "Tools", "What the pen does"),
            (Menu::Help, "Help", "What the keys do"),
        ] {
            let opened = ui.menu_button(name, |ui| {
                ui.set_min_width(190.0);
                for entry in ENTRIES.iter().filter(|entry| entry.menu == menu) {
                    if begins_group(entry.intent) {
                        ui.separator();
                    }
                    let name = match checked(entry.intent, state) {
                        Some(true) => format!("\u{2713} {}", entry.name),
                        Some(false) => format!("    {}", entry.name),
                        None => entry.name.to_owned(),
                    };
                    let button = Button::new(name).shortcut_text(entry.keys_written());
                    let response = ui.add_enabled(enabled(entry.intent, state), button);
                    let response = response.on_hover_ui(|ui| tip(ui, entry));
                    if response.clicked() {
                        clicked = Some(entry.intent);
                        ui.close();
                    }
                }
            });
            opened.response.on_hover_text(told);
        }
        ui.with_layout(eframe::egui::Layout::right_to_left(eframe::egui::Align::Center), |ui| {
            ui.add_space(4.0);
            ui.weak(title);
        });
    });
    clicked
}

fn begins_group(intent: Intent) -> bool {
    matches!(
        intent,
        Intent::Save
            | Intent::Export
            | Intent::OpenReference
            | Intent::Quit
            | Intent::Dry
            | Intent::Larger
            | Intent::Preferences
            | Intent::Fit
            | Intent::TurnLeft
            | Intent::Panels
    )
}

fn enabled(intent: Intent, state: State) -> bool {
    match intent {
        Intent::Undo => state.history.0,
        Intent::Redo => state.history.1,
        Intent::Open
        | Intent::New
        | Intent::Preferences
        | Intent::Quit
        | Intent::Keys
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
        _ => None,
    }
}
