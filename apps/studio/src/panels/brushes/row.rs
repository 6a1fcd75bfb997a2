//! One row of the brush list.

use eframe::egui::{Align, Color32, Painter, Rect, Response, TextStyle, Ui, pos2, vec2};
use paint::strokes::BrushSpec;

use super::head;
use crate::language::{brush_label, tr, tr_format};
use crate::panels::controls::{millimetres, row};
use crate::panels::fitted_text::{fits_on_a_line, text};
use crate::theme;
use session::{BrushState, PaintingState};

/// Height of a row, in points.
const HEIGHT: f32 = 31.0;

/// Paint height at which the bar is full, in mm.
const FULL_MM: f64 = 1.0;

/// Contents of a row; `state` is `None` until the worker has reported the brush.
pub(super) struct Row<'a> {
    pub(super) number: usize,
    pub(super) label: &'a str,
    pub(super) spec: &'a BrushSpec,
    pub(super) state: Option<&'a BrushState>,
    pub(super) is_selected: bool,
}

impl Row<'_> {
    /// Draws the row, which can be clicked.
    pub(super) fn show(&self, ui: &mut Ui, painting: &PaintingState) -> Response {
        let label = brush_label(self.label);
        let response = row(ui, HEIGHT, &label, self.is_selected);
        let inner = response.rect.shrink2(vec2(6.0, 2.0));
        let between = |left: f32, right: f32| {
            Rect::from_min_max(pos2(left, inner.top()), pos2(right, inner.bottom()))
        };
        let faint = if self.is_selected {
            theme::colors(ui.ctx()).text
        } else {
            theme::colors(ui.ctx()).faint
        };
        if self.number <= 9 {
            let key = between(inner.left(), inner.left() + 12.0);
            let number = self.number.to_string();
            text(ui, key, Align::Center, TextStyle::Small, faint, &number);
        }
        let color = self.state.and_then(|state| state.color);
        let icon_rect = between(inner.left() + 18.0, inner.left() + 42.0);
        head::draw(ui.painter(), icon_rect, self.spec.shape, color);
        let words = between(inner.left() + 50.0, inner.right() - 84.0);
        let strong = theme::colors(ui.ctx()).strong;
        let (name, below) = words.split_top_bottom_at_fraction(0.55);
        if fits_on_a_line(ui, name, TextStyle::Body, &label) {
            text(ui, name, Align::Min, TextStyle::Body, strong, &label);
            let kind = format!("{} {}", tr(self.spec.shape.name()), millimetres(self.spec.size_mm));
            text(ui, below, Align::Min, TextStyle::Small, faint, &kind);
        } else {
            // A long name takes the room of shape and size, which the tooltip tells.
            text(ui, words, Align::Min, TextStyle::Body, strong, &label);
        }
        let (amount, bar) =
            between(inner.right() - 78.0, inner.right()).split_top_bottom_at_fraction(0.6);
        let amount_text = match self.state {
            Some(state) if state.amount_mm > 0.0 => millimetres(state.tip_mm),
            _ => tr("clean").to_owned(),
        };
        text(ui, amount, Align::Max, TextStyle::Small, faint, &amount_text);
        if let Some(state) = self.state {
            paint_bar(ui.painter(), bar.shrink2(vec2(0.0, 2.5)), state);
        }
        response.on_hover_text(self.tooltip(painting))
    }

    /// Tooltip text: shape, size and paint of the brush.
    fn tooltip(&self, painting: &PaintingState) -> String {
        let BrushSpec { shape, size_mm } = self.spec;
        let cells = size_mm / painting.cell_mm;
        let head = tr_format!(
            "{shape}, {size} ({cells:.0} cells)",
            shape = tr(shape.name()),
            size = millimetres(*size_mm),
            cells
        );
        match self.state {
            Some(state) if state.amount_mm > 0.0 => format!("{head}\n{}", paint(painting, state)),
            _ => tr_format!("{head}\nclean", head),
        }
    }
}

/// Describes the paint on a brush: `0.12 mm at the tip, 0.30 mm in all, 15 % medium: ..`.
fn paint(painting: &PaintingState, state: &BrushState) -> String {
    let tip = millimetres(state.tip_mm);
    let mut words =
        tr_format!("{tip} at the tip, {amount} in all", tip, amount = millimetres(state.amount_mm));
    if state.vehicle > 0.0 {
        words += &tr_format!(", {vehicle:.0} % medium", vehicle = 100.0 * state.vehicle);
    }
    let parts = painting.slots.iter().zip(state.parts).filter_map(|(slot, part)| {
        let name = &painting.library[(*slot)?].name;
        (part >= 0.005).then(|| format!("{:.0} % {name}", 100.0 * part))
    });
    let parts: Vec<String> = parts.collect();
    if parts.is_empty() { words } else { format!("{words}: {}", parts.join(", ")) }
}

/// Draws a bar of the amount of paint at the tip: pigment in its colour, then medium in grey.
fn paint_bar(painter: &Painter, bar: Rect, state: &BrushState) {
    painter.rect_filled(bar, 2.0, theme::colors(painter.ctx()).well);
    let filled = (state.tip_mm / FULL_MM).clamp(0.0, 1.0) as f32;
    let (paint, _) = bar.split_left_right_at_fraction(filled);
    let (pigment, medium) = paint.split_left_right_at_fraction(1.0 - state.vehicle as f32);
    painter.rect_filled(medium, 0.0, Color32::from_gray(176));
    if let Some([red, green, blue]) = state.color {
        painter.rect_filled(pigment, 0.0, Color32::from_rgb(red, green, blue));
    }
}
