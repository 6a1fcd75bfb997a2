//! The table of keys.

use eframe::egui::{Context, Grid, ScrollArea, Window, vec2};

use super::entries::ENTRIES;
use super::intent::Menu;

/// What is not in a menu.
const POINTER: &[(&str, &str)] = &[
    ("1 to 9", "Takes a brush of the stand in hand"),
    ("Space + drag", "Moves the view; so does the middle button"),
    ("Shift+Space + drag", "Turns the view about its middle"),
    ("Ctrl+Space + drag", "Zooms, upwards in"),
    ("Wheel", "Zooms about the pointer; two fingers on a pad move the view"),
    ("Two fingers", "Move, zoom and turn the view on a touch screen"),
    ("Alt + click", "Asks what paint lies there"),
    ("Shift + stroke", "Begins with a straight line from where the last stroke ended"),
    ("Held tool key", "Gives the tool before back when it is let go"),
];

/// Shows it while `open`.
pub(super) fn show(context: &Context, open: &mut bool) {
    let window = Window::new("Keys").open(open).resizable(false).collapsible(false);
    window.default_pos(eframe::egui::pos2(120.0, 60.0)).show(context, |ui| {
        let height = (ui.ctx().content_rect().height() - 140.0).max(120.0);
        ScrollArea::vertical().max_height(height).show(ui, |ui| {
            Grid::new("keys").num_columns(2).spacing(vec2(18.0, 4.0)).striped(true).show(
                ui,
                |ui| {
                    for (keys, told) in POINTER {
                        ui.strong(*keys);
                        ui.label(*told);
                        ui.end_row();
                    }
                    let tools = ENTRIES.iter().filter(|entry| entry.menu == Menu::Tools);
                    let others = ENTRIES.iter().filter(|entry| entry.menu != Menu::Tools);
                    for entry in tools.chain(others).filter(|entry| !entry.keys.is_empty()) {
                        let keys: Vec<String> =
                            entry.keys.iter().map(|stroke| stroke.written()).collect();
                        ui.strong(keys.join(", "));
                        ui.label(entry.told);
                        ui.end_row();
                    }
                },
            );
        });
    });
}
