//! Parts of a panel that fold.

use eframe::egui::{Align, Color32, Id, Rect, Shape, Stroke, TextStyle, Ui, vec2};

use super::controls::row;
use super::fitted_text::text;
use crate::language::{tr, tr_format};
use crate::theme;

/// Height of a heading, in points.
const HEADING: f32 = 22.0;

/// Draws a heading and, unless it is folded, `content` below it. A click on the heading folds
/// and unfolds it.
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
