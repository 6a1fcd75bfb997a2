//! One brush in the stand, as a row.

use eframe::egui::{Align, Color32, Painter, Rect, Response, TextStyle, Ui, pos2, vec2};
use render::paint::strokes::BrushSpec;

use super::head;
use crate::panels::controls::{millimetres, row, text};
use crate::theme;
use session::{BrushState, PaintingState};

/// Height of a row, in points.
const HEIGHT: f32 = 34.0;

/// The bar is full at this height of paint, in mm.
const FULL_MM: f64 = 1.0;

/// A brush in the stand; `state` is missing until the worker told of it.
pub(super) struct Row<'a> {
    pub(super) number: usize,
    pub(super) label: &'a str,
    pub(super) spec: &'a BrushSpec,
    pub(super) state: Option<&'a BrushState>,
    pub(super) in_hand: bool,
}

impl Row<'_> {
    /// Shows it, to be clicked.
    pub(super) fn show(&self, ui: &mut Ui, easel: &PaintingState) -> Response {
        let response = row(ui, HEIGHT, self.label, self.in_hand);
        let inner = response.rect.shrink2(vec2(6.0, 3.0));
        let between = |left: f32, right: f32| {
            Rect::from_min_max(pos2(left, inner.top()), pos2(right, inner.bottom()))
        };
        let faint = if self.in_hand { theme::TEXT } else { theme::FAINT };
        if self.number <= 9 {
            let key = between(inner.left(), inner.left() + 12.0);
            let number = self.number.to_string();
            text(ui, key, Align::Center, TextStyle::Small, faint, &number);
        }
        let color = self.state.and_then(|state| state.color);
        let drawn = between(inner.left() + 18.0, inner.left() + 42.0);
        head::draw(ui.painter(), drawn, self.spec.shape, color);
        let (name, below) =
            between(inner.left() + 50.0, inner.right() - 84.0).split_top_bottom_at_fraction(0.55);
        text(ui, name, Align::Min, TextStyle::Body, theme::STRONG, self.label);
        let kind = format!("{} {}", self.spec.shape, millimetres(self.spec.size_mm));
        text(ui, below, Align::Min, TextStyle::Small, faint, &kind);
        let (amount, bar) =
            between(inner.right() - 78.0, inner.right()).split_top_bottom_at_fraction(0.6);
        let told = match self.state {
            Some(state) if state.amount_mm > 0.0 => millimetres(state.amount_mm),
            _ => "clean".to_owned(),
        };
        text(ui, amount, Align::Max, TextStyle::Small, faint, &told);
        if let Some(state) = self.state {
            paint_bar(ui.painter(), bar.shrink2(vec2(0.0, 2.5)), state);
        }
        response.on_hover_text(self.words(easel))
    }

    /// What the brush is and holds, in words.
    fn words(&self, easel: &PaintingState) -> String {
        let BrushSpec { shape, size_mm } = self.spec;
        let cells = size_mm / easel.cell_mm;
        let head = format!("{shape}, {} ({cells:.0} cells)", millimetres(*size_mm));
        match self.state {
            Some(state) if state.amount_mm > 0.0 => format!("{head}\n{}", paint(easel, state)),
            _ => format!("{head}\nclean"),
        }
    }
}

/// The paint on a brush in words: `0.30 mm, 15 % medium: 60 % Zinc White ..`.
fn paint(easel: &PaintingState, state: &BrushState) -> String {
    let mut words = millimetres(state.amount_mm);
    if state.vehicle > 0.0 {
        words += &format!(", {:.0} % medium", 100.0 * state.vehicle);
    }
    let parts = easel.slots.iter().zip(state.parts).filter_map(|(slot, part)| {
        let name = &easel.library.pigments[(*slot)?].name;
        (part >= 0.005).then(|| format!("{:.0} % {name}", 100.0 * part))
    });
    let parts: Vec<String> = parts.collect();
    if parts.is_empty() { words } else { format!("{words}: {}", parts.join(", ")) }
}

/// How much paint there is: pigment in its colour, then medium.
fn paint_bar(painter: &Painter, bar: Rect, state: &BrushState) {
    painter.rect_filled(bar, 2.0, theme::WELL);
    let filled = (state.amount_mm / FULL_MM).clamp(0.0, 1.0) as f32;
    let (paint, _) = bar.split_left_right_at_fraction(filled);
    let (pigment, medium) = paint.split_left_right_at_fraction(1.0 - state.vehicle as f32);
    painter.rect_filled(medium, 0.0, Color32::from_gray(176));
    if let Some([red, green, blue]) = state.color {
        painter.rect_filled(pigment, 0.0, Color32::from_rgb(red, green, blue));
    }
}
