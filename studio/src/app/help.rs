//! The window with the table of keys.

use eframe::egui::{Context, Grid, Key, ScrollArea, Window, vec2};

use super::entries::ENTRIES;
use super::intent::Menu;

/// Keys and gestures that are not in a menu, with descriptions.
const POINTER: &[(&str, &str)] = &[
    ("1 to 9", "Selects a brush of the list"),
    ("Space + drag", "Moves the view; so does the middle button"),
    ("Shift+Space + drag", "Rotates the view about its centre"),
    ("Ctrl+Space + drag", "Zooms, upwards in"),
    ("Wheel", "Zooms about the pointer; two fingers on a pad move the view"),
    ("Two fingers", "Move, zoom and turn the view on a touch screen"),
    ("Alt + click", "Picks colour and paint"),
    ("Shift + stroke", "Starts with a straight line from the end of the last stroke"),
    ("Ctrl+Z on the reference", "Undoes the last mark or guide while the picture is drawn on"),
    ("Shift on the reference", "Marks the distance of strokes of the selected sample"),
    ("Held tool key", "Restores the previous tool on release"),
];

/// Shows the window while `open` is true; its close button and Escape clear `open`.
pub(super) fn show(context: &Context, open: &mut bool) {
    *open &= !context.input(|input| input.key_pressed(Key::Escape));
    let window = Window::new("Keys").open(open).resizable(false).collapsible(false);
    window.default_pos(eframe::egui::pos2(120.0, 60.0)).show(context, |ui| {
        let height = (ui.ctx().content_rect().height() - 140.0).max(120.0);
        ScrollArea::vertical().max_height(height).show(ui, |ui| {
            Grid::new("keys").num_columns(2).spacing(vec2(18.0, 4.0)).striped(true).show(
                ui,
                |ui| {
                    for (keys, description) in POINTER {
                        ui.strong(*keys);
                        ui.label(*description);
                        ui.end_row();
                    }
                    let tools = ENTRIES.iter().filter(|entry| entry.menu == Menu::Tools);
                    let others = ENTRIES.iter().filter(|entry| entry.menu != Menu::Tools);
                    for entry in tools.chain(others).filter(|entry| !entry.shortcuts.is_empty()) {
                        let keys: Vec<String> =
                            entry.shortcuts.iter().map(|shortcut| shortcut.text()).collect();
                        ui.strong(keys.join(", "));
                        ui.label(entry.description);
                        ui.end_row();
                    }
                },
            );
        });
    });
}
