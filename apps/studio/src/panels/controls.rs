//! Shared controls of the panels. Each has an accessible name and a tooltip. This also has folding
//! sections, fitted text, and the order of search results.

use std::ops::RangeInclusive;
use std::sync::Arc;

use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    Align, Button, Color32, CornerRadius, EventFilter, FontId, Galley, Id, Key, Layout, Modifiers,
    Painter, Rect, Response, Role, Sense, Shape, Slider, Stroke, StrokeKind, TextStyle, Ui,
    WidgetInfo, pos2, vec2,
};

use crate::language::{tr, tr_format};
use crate::theme;

/// Width of the label at the left of a slider, in points.
pub(super) const NAME_WIDTH: f32 = 58.0;

/// Width of the number at the right of a slider, in points.
const NUMBER_WIDTH: f32 = 82.0;

const TRACK: f32 = 44.0;

/// Extra width of a number in touch mode, in points.
pub(super) fn touch_padding(ui: &Ui) -> f32 {
    if theme::is_touch(ui.ctx()) { 18.0 } else { 0.0 }
}

/// Arrow key steps to the right and up in this frame, if the control has the focus.
pub(super) fn arrow_keys(ui: &Ui, response: &Response) -> (f64, f64) {
    if !response.has_focus() {
        return (0.0, 0.0);
    }
    let arrows =
        EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    let keys = [Key::ArrowRight, Key::ArrowLeft, Key::ArrowUp, Key::ArrowDown];
    let [right, left, up, down] = keys.map(|key| ui.input(|input| input.num_presses(key)) as f64);
    (right - left, up - down)
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

/// Adds a button. If you pass a `disabled_reason`, it is disabled and its tooltip gives the reason.
/// Returns whether you clicked it.
pub(super) fn button(ui: &mut Ui, name: &str, tip: &str, disabled_reason: Option<&str>) -> bool {
    named_button(ui, name, name, tip, disabled_reason)
}

/// Like [`button`], with an accessible name that differs from the text. Use this if several buttons
/// have the same text.
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

/// Whether buttons of these names fit side by side into the remaining width.
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

/// A button as high as a line of text, or high enough for touch.
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

/// Height of a row that is `height` points high without touch.
pub(super) fn row_height(ui: &Ui, height: f32) -> f32 {
    height.max(theme::target(ui))
}

/// Adds an empty, clickable row of a list. You draw its contents into the rectangle of the
/// response.
pub(super) fn row(ui: &mut Ui, height: f32, name: &str, chosen: bool) -> Response {
    let size = vec2(ui.available_width(), row_height(ui, height));
    let (_, response) = ui.allocate_exact_size(size, Sense::click());
    button_background(ui, &response, name, chosen);
    response
}

/// Outlines the line of a list that Enter takes. If it moved, this scrolls to it.
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

/// The part of a row between `left` and `right`, in points from the left edge of the window.
pub(super) fn between(row: Rect, left: f32, right: f32) -> Rect {
    Rect::from_min_max(pos2(left, row.top()), pos2(right, row.bottom()))
}

/// Draws a patch of colour in sRGB. `None` is crossed out.
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

const HEADING: f32 = 22.0;

/// Draws a heading and, unless it is folded, `content` below it. Click the heading to fold or
/// unfold it.
pub(super) fn section(ui: &mut Ui, name: &str, content: impl FnOnce(&mut Ui)) {
    let id = Id::unique(("folded section", name));
    let mut folded = ui.data(|data| data.get_temp::<bool>(id).unwrap_or(false));
    let label =
        if folded { tr_format!("Unfold {name}", name) } else { tr_format!("Fold {name}", name) };
    let response = row(ui, HEADING, &label, false);
    let (sign, rest) = response.rect.split_left_right_at_x(response.rect.left() + 18.0);
    ui.painter().add(triangle(sign, folded, theme::colors(ui.ctx()).text));
    let strong = theme::colors(ui.ctx()).strong;
    text(ui, rest, Align::Min, TextStyle::Body, strong, name);
    if response.on_hover_text(tr("Folds and unfolds this part")).clicked() {
        folded = !folded;
        ui.data_mut(|data| data.insert_temp(id, folded));
    }
    if !folded {
        content(ui);
    }
}

/// A triangle that points right if the part is folded, else down.
fn triangle(rect: Rect, folded: bool, color: Color32) -> Shape {
    let points = match folded {
        true => [vec2(-2.0, -4.0), vec2(3.0, 0.0), vec2(-2.0, 4.0)],
        false => [vec2(-4.0, -2.0), vec2(4.0, -2.0), vec2(0.0, 3.0)],
    };
    let points = points.map(|offset| rect.center() + offset).to_vec();
    Shape::convex_polygon(points, color, Stroke::NONE)
}

const SMALLEST: f32 = 9.0;

/// Text may be higher than its rectangle by this space above and below, in points.
const OVER: f32 = 2.0;

/// Draws text within a rectangle, centred vertically. This uses one line, or as many lines as fit,
/// or a smaller font. It truncates only text that does not fit even so.
pub(super) fn text(
    ui: &Ui,
    rect: Rect,
    align: Align,
    style: TextStyle,
    color: Color32,
    words: &str,
) {
    let laid = fitted(ui, rect, align, style, color, words);
    let top = rect.center().y - laid.size().y / 2.0;
    draw(ui, rect, align, top, laid, color);
}

/// Like [`text`], from the top of the rectangle.
pub(super) fn text_from_top(
    ui: &Ui,
    rect: Rect,
    align: Align,
    style: TextStyle,
    color: Color32,
    words: &str,
) {
    let laid = fitted(ui, rect, align, style, color, words);
    draw(ui, rect, align, rect.top(), laid, color);
}

/// Whether text fits into a rectangle on one line in its own font.
pub(super) fn fits_on_a_line(ui: &Ui, rect: Rect, style: TextStyle, words: &str) -> bool {
    let font = style.resolve(ui.style());
    let laid = ui.painter().layout_no_wrap(words.to_owned(), font, Color32::PLACEHOLDER);
    laid.size().x <= rect.width()
}

fn draw(ui: &Ui, rect: Rect, align: Align, top: f32, laid: Arc<Galley>, color: Color32) {
    let x = match align {
        Align::Min => rect.left(),
        Align::Center => rect.center().x,
        Align::Max => rect.right(),
    };
    ui.painter_at(rect.expand(OVER)).galley(pos2(x, top), laid, color);
}

/// Lays text out in the largest font in which it fits.
fn fitted(
    ui: &Ui,
    rect: Rect,
    align: Align,
    style: TextStyle,
    color: Color32,
    words: &str,
) -> Arc<Galley> {
    let usual = style.resolve(ui.style());
    let mut size = usual.size;
    loop {
        let font = FontId { size, family: usual.family.clone() };
        let height = ui.fonts_mut(|fonts| fonts.row_height(&font));
        let rows = ((rect.height() + 2.0 * OVER) / height).floor().max(1.0);
        let mut job = LayoutJob::simple(words.to_owned(), font, color, rect.width());
        job.wrap = TextWrapping {
            max_width: rect.width(),
            max_rows: rows as usize,
            ..TextWrapping::default()
        };
        job.halign = align;
        let laid = ui.painter().layout_job(job);
        if is_whole(&laid) || size <= SMALLEST {
            return laid;
        }
        size = (size - 0.5).max(SMALLEST);
    }
}

/// Whether nothing is truncated, and no word is broken.
fn is_whole(laid: &Galley) -> bool {
    let rows = laid.rows.len();
    let all_but_last = laid.rows.iter().take(rows.saturating_sub(1));
    !laid.elided
        && all_but_last
            .map(|row| row.text())
            .all(|row| row.ends_with(|last: char| !last.is_alphanumeric()))
}

/// How well a name matches the typed text, the best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Match {
    /// The text is the whole name.
    Exact,
    /// The name begins with the text.
    Start,
    /// Another word of the name begins with the text.
    Word,
    /// The name contains the text.
    Inside,
    /// Another searched field contains the text.
    Elsewhere,
}

impl Match {
    /// How well `name` matches `wanted`, ignoring case.
    pub(super) fn of(name: &str, wanted: &str) -> Self {
        let name = name.to_lowercase();
        let wanted = wanted.trim().to_lowercase();
        if name == wanted {
            Self::Exact
        } else if name.starts_with(&wanted) {
            Self::Start
        } else if name.match_indices(&wanted).any(|(at, _): (usize, &str)| {
            name[..at].chars().next_back().is_some_and(|before| !before.is_alphanumeric())
        }) {
            Self::Word
        } else if name.contains(&wanted) {
            Self::Inside
        } else {
            Self::Elsewhere
        }
    }
}

/// Sorts search results, the best matches first. Equal ones keep their order.
pub(super) fn sort<'a, T>(found: &mut [T], wanted: &str, name: impl Fn(&T) -> &'a str) {
    if !wanted.trim().is_empty() {
        found.sort_by_key(|one| Match::of(name(one), wanted));
    }
}

/// The line of a list that Enter takes. You move it with the arrow keys.
#[derive(Debug, Clone, Default)]
pub(super) struct Highlight {
    line: usize,
    search: String,
    /// Whether the list must scroll to the line.
    pub(super) moved: bool,
}

impl Highlight {
    /// Takes the arrow keys while the search field has the keyboard. Call this before you draw the
    /// field, because the field would move its cursor with them.
    pub(super) fn read_arrows(&mut self, ui: &Ui, focused: bool) {
        if !focused {
            return;
        }
        let [down, up] = [Key::ArrowDown, Key::ArrowUp]
            .map(|key| ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key)));
        self.line = (self.line + down).saturating_sub(up);
        self.moved |= down + up > 0;
    }

    /// Index of the highlighted line, of the `count` lines that `search` found. After you change
    /// the search, this is the first line.
    pub(super) fn among(&mut self, search: &str, count: usize) -> usize {
        if self.search != search {
            (self.line, self.moved) = (0, true);
            search.clone_into(&mut self.search);
        }
        self.line = self.line.min(count.saturating_sub(1));
        self.line
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

    #[test]
    fn the_whole_name_comes_before_its_beginning_and_that_before_the_rest() {
        let mut names = vec!["Cobalt", "Lead-Tin Red", "Minium red", "Predella", "Red Lead", "red"];
        sort(&mut names, "RED ", |name| name);
        let wanted = ["red", "Red Lead", "Lead-Tin Red", "Minium red", "Predella", "Cobalt"];
        assert_eq!(names, wanted);
        let mut lights = vec!["D65", "B", "A", "ID65"];
        sort(&mut lights, "a", |name| name);
        assert_eq!(lights[0], "A");
        sort(&mut lights, "", |name| name);
        assert_eq!(lights[0], "A", "no search, no order");
    }

    #[test]
    fn another_search_begins_at_the_first_line() {
        let mut highlight = Highlight { line: 4, ..Highlight::default() };
        assert_eq!(highlight.among("a", 9), 0);
        highlight.line = 7;
        assert_eq!((highlight.among("a", 9), highlight.among("a", 3)), (7, 2));
        assert_eq!(highlight.among("ab", 3), 0);
        assert_eq!(highlight.among("abc", 0), 0, "nothing was found");
    }
}
