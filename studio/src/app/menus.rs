//! The menu bar with its shortcuts.

use eframe::egui::{Button, MenuBar, Ui};

use super::entries::ENTRIES;
use super::intent::{Intent, Menu};
use super::toolbar::tip;

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
}

/// Shows the bar with `title` at its right. Returns the entry that was clicked.
pub(super) fn show(ui: &mut Ui, state: State, title: &str) -> Option<Intent> {
    let mut clicked = None;
    MenuBar::new().ui(ui, |ui| {
        for (menu, name, description) in [
            (Menu::File, "File", "Open, save, export"),
            (Menu::Edit, "Edit", "The painting and the brush"),
            (Menu::View, "View", "Zoom, rotation and visible parts"),
            (Menu::Tools, "Tools", "Tools of the pen"),
            (Menu::Help, "Help", "The table of keys"),
        ] {
            let opened = ui.menu_button(name, |ui| {
                ui.set_min_width(190.0);
                for entry in ENTRIES.iter().filter(|entry| entry.menu == menu) {
                    if begins_group(entry.intent) {
                        ui.separator();
                    }
                    let name = match checked(entry.intent, state) {
                        Some(true) => format!("\u{2714} {}", entry.name),
                        Some(false) => format!("    {}", entry.name),
                        None => entry.name.to_owned(),
                    };
                    let button = Button::new(name).shortcut_text(entry.shortcut_text());
                    let response = ui.add_enabled(enabled(entry.intent, state), button);
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
            | Intent::NewScene
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
        Intent::ShowScene => state.scene,
        Intent::Open
        | Intent::New
        | Intent::NewScene
        | Intent::OpenScene
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
