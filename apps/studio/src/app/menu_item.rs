//! An entry of a menu, with a tick drawn as a shape: the fonts have no sign for it.

use eframe::egui::{Button, Response, Role, Stroke, Ui, WidgetInfo, vec2};

/// Room for the tick before a name, in spaces of the font.
const INDENT: &str = "      ";

/// Adds an entry with its shortcut. `checked` draws a tick or leaves its room free, as `indented`
/// does for an entry beside others that have a tick.
pub(super) fn show(
    ui: &mut Ui,
    name: &str,
    shortcut: &str,
    enabled: bool,
    checked: Option<bool>,
    indented: bool,
) -> Response {
    let indent = if indented || checked.is_some() { INDENT } else { "" };
    let button = Button::new(format!("{indent}{name}")).shortcut_text(shortcut);
    let response = ui.add_enabled(enabled, button);
    // The name alone, without indent and shortcut.
    response.widget_info(|| match checked {
        Some(checked) => WidgetInfo::selected(Role::CheckBox, enabled, checked, name),
        None => WidgetInfo::labeled(Role::Button, enabled, name),
    });
    if checked == Some(true) {
        let at = response.rect.left_center() + vec2(ui.spacing().button_padding.x, 0.0);
        let tick = [vec2(1.0, 0.5), vec2(4.0, 3.5), vec2(9.5, -3.5)].map(|part| at + part);
        let color = ui.style().interact(&response).text_color();
        ui.painter().line(tick.to_vec(), Stroke::new(1.5, color));
    }
    response
}
