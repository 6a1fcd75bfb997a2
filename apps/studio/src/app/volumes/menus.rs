//! The menu bar of the workspace of scenes.

use eframe::egui::{Align, Layout, MenuBar, Ui};
use session::volumes::{SceneState, Show};

use super::entries::{SCENE_ENTRIES, tip};
use super::intent::{SceneIntent, SceneMenu};
use crate::app::menu_item;
use crate::app::menus::menu_button;
use crate::language::tr;
use crate::theme;

/// Shows the bar with `title` at its right. Returns the entry that was clicked.
pub(super) fn show(ui: &mut Ui, state: Option<&SceneState>, title: &str) -> Option<SceneIntent> {
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
                let own = || SCENE_ENTRIES.iter().filter(move |entry| entry.menu == menu);
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
    let some = |fits: &dyn Fn(&SceneState) -> bool| state.is_some_and(fits);
    match intent {
        SceneIntent::New
        | SceneIntent::Open
        | SceneIntent::Easel
        | SceneIntent::Quit
        | SceneIntent::Preferences
        | SceneIntent::Panels
        | SceneIntent::FullScreen
        | SceneIntent::Keys => true,
        SceneIntent::Undo => some(&|state| !state.events.is_empty()),
        SceneIntent::Inside => some(&|state| !state.tubes.is_empty()),
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
