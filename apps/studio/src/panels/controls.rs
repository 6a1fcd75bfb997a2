//! Shared controls of the panels, each with an accessible name and a tooltip.

use std::ops::RangeInclusive;

use eframe::egui::{
    Align, Button, Color32, CornerRadius, Layout, Painter, Rect, Response, Role, Sense, Slider,
    Stroke, StrokeKind, TextStyle, Ui, WidgetInfo, vec2,
};

use crate::language::tr;
use crate::theme;

/// Width of the label at the left of a slider, in points.
pub(super) const NAME_WIDTH: f32 = 58.0;

/// Width of the number at the right of a slider, in points.
const NUMBER_WIDTH: f32 = 82.0;

/// Least width of the track of a slider, in points.
const TRACK: f32 = 44.0;

/// Extra width of a number that is to be touched, in points.
pub(super) fn touch_padding(ui: &Ui) -> f32 {
    if theme::is_touch(ui.ctx()) { 18.0 } else { 0.0 }
}

/// Adds a slider with its label and number, as wide as the panel.
pub(super) fn slider(ui: &mut Ui, name: &str, tip: &str, slider: Slider<'_>) -> Response {
    let line = ui.horizontal(|ui| {
        let size = vec2(NAME_WIDTH, ui.spacing().interact_size.y);
        let named = ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(NAME_WIDTH);
            ui.label(name)
        });
        let number = NUMBER_WIDTH + touch_padding(ui);
        ui.spacing_mut().slider_width = (ui.available_width() - number).max(TRACK);
        ui.spacing_mut().interact_size.x = number - 2.0 * ui.spacing().item_spacing.x;
        ui.add(slider).labelled_by(named.inner.id)
    });
    line.inner.on_hover_text(tip)
}

/// Adds a slider for a share of 0 to 1, shown in percent with up to one decimal.
pub(super) fn percent(
    ui: &mut Ui,
    name: &str,
    tip: &str,
    share: &mut f64,
    percents: RangeInclusive<f64>,
) -> Response {
    let shown = Slider::from_get_set(percents, |set| {
        if let Some(percent) = set {
            *share = percent / 100.0;
        }
        *share * 100.0
    });
    let shown = shown.max_decimals(1).custom_formatter(|percent, _| percent.to_string());
    slider(ui, name, tip, shown.suffix(" %"))
}

/// Adds a button. `disabled_reason` disables it and gives the reason for the tooltip. Returns
/// whether it was clicked.
pub(super) fn button(ui: &mut Ui, name: &str, tip: &str, disabled_reason: Option<&str>) -> bool {
    named_button(ui, name, name, tip, disabled_reason)
}

/// Adds a button whose accessible name differs from its text, because several buttons have
/// the same text. Returns whether it was clicked.
pub(super) fn named_button(
    ui: &mut Ui,
    shown: &str,
    name: &str,
    tip: &str,
    disabled_reason: Option<&str>,
) -> bool {
    let button = Button::new(shown).min_size(vec2(theme::target(ui), 0.0));
    let response = ui.add_enabled(disabled_reason.is_none(), button).accessible_name(name);
    response
        .on_hover_text(tip)
        .on_disabled_hover_text(disabled_reason.unwrap_or_default())
        .clicked()
}

/// Whether buttons of these names fit side by side into the width that is left.
pub(super) fn buttons_fit(ui: &Ui, names: &[&str]) -> bool {
    let font = TextStyle::Button.resolve(ui.style());
    let gaps = names.len().saturating_sub(1) as f32 * ui.spacing().item_spacing.x;
    names
        .iter()
        .map(|name: &&str| {
            let text =
                ui.painter().layout_no_wrap((*name).to_owned(), font.clone(), Color32::PLACEHOLDER);
            (text.size().x + 2.0 * ui.spacing().button_padding.x).max(theme::target(ui))
        })
        .sum::<f32>()
        + gaps
        <= ui.available_width()
}

/// A button as high as a line of text, or high enough to be touched.
pub(crate) fn small_button<'a>(ui: &Ui, shown: &'a str) -> Button<'a> {
    match theme::is_touch(ui.ctx()) {
        true => Button::new(shown),
        false => Button::new(shown).small(),
    }
}

/// Adds a button to a menu, which closes on a click.
pub(super) fn item(ui: &mut Ui, name: &str, tip: &str, disabled_reason: Option<&str>) -> bool {
    let clicked = button(ui, name, tip, disabled_reason);
    if clicked {
        ui.close();
    }
    clicked
}

/// Height of a row that is usually `height` points high.
pub(super) fn row_height(ui: &Ui, height: f32) -> f32 {
    height.max(theme::target(ui))
}

/// Adds an empty, clickable row of a list. The caller draws into the rectangle of the
/// response.
pub(super) fn row(ui: &mut Ui, height: f32, name: &str, chosen: bool) -> Response {
    let size = vec2(ui.available_width(), row_height(ui, height));
    let (_, response) = ui.allocate_exact_size(size, Sense::click());
    button_background(ui, &response, name, chosen);
    response
}

/// Outlines the line of a list that Enter takes, and scrolls to it if it moved.
pub(super) fn mark(ui: &Ui, line: &Response, moved: bool) {
    let edge = Stroke::new(1.0, theme::colors(ui.ctx()).faint);
    ui.painter().rect_stroke(line.rect, theme::CORNER_RADIUS, edge, StrokeKind::Inside);
    if moved {
        line.scroll_to_me(None);
    }
}

/// Draws the background of a clickable area and gives it the accessible name of a
/// button.
pub(super) fn button_background(ui: &Ui, response: &Response, name: &str, chosen: bool) {
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::selected(Role::Button, enabled, chosen, name));
    let fill = match (chosen, response.hovered() || response.has_focus()) {
        (true, _) => theme::colors(ui.ctx()).chosen,
        (false, true) => ui.visuals().widgets.hovered.bg_fill,
        (false, false) => Color32::TRANSPARENT,
    };
    let edge =
        if response.has_focus() { theme::colors(ui.ctx()).faint } else { Color32::TRANSPARENT };
    let edge = Stroke::new(1.0, edge);
    ui.painter().rect(response.rect, theme::CORNER_RADIUS, fill, edge, StrokeKind::Inside);
}

/// Draws a patch of colour in sRGB; `None` is crossed out.
pub(super) fn patch(painter: &Painter, rect: Rect, color: Option<[u8; 3]>) {
    let line = Stroke::new(1.0, theme::colors(painter.ctx()).well);
    let corners = CornerRadius::same(2);
    match color {
        Some([red, green, blue]) => {
            let fill = Color32::from_rgb(red, green, blue);
            painter.rect(rect, corners, fill, line, StrokeKind::Outside);
        }
        None => {
            painter.rect(
                rect,
                corners,
                theme::colors(painter.ctx()).panel,
                line,
                StrokeKind::Outside,
            );
            let diagonal = [rect.left_bottom(), rect.right_top()];
            painter.line_segment(diagonal, Stroke::new(1.0, theme::colors(painter.ctx()).line));
        }
    }
}

/// Formats a height in mm with two significant digits.
pub(super) fn millimetres(mm: f64) -> String {
    match mm {
        mm if mm >= 9.95 => format!("{mm:.0} mm"),
        mm if mm >= 0.995 => format!("{mm:.1} mm"),
        mm if mm >= 0.0995 || mm == 0.0 => format!("{mm:.2} mm"),
        mm if mm >= 0.0005 => format!("{mm:.3} mm"),
        _ => tr("below 0.001 mm").to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn millimetres_have_two_digits() {
        let found = [0.0, 0.0002, 0.0123, 0.123, 1.23, 12.3, 99.7].map(millimetres);
        let wanted =
            ["0.00 mm", "below 0.001 mm", "0.012 mm", "0.12 mm", "1.2 mm", "12 mm", "100 mm"];
        assert_eq!(found, wanted);
    }
}
