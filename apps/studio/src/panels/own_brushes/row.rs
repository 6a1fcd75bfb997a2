//! One row of the list of own brushes.

use eframe::egui::{Align, Rect, Response, TextStyle, Ui, pos2, vec2};
use session::brushes::{BrushOptions, BrushPreset};

use crate::language::{tr, tr_format};
use crate::panels::brushes::head;
use crate::panels::controls::{millimetres, row};
use crate::panels::fitted_text::text;
use crate::theme;

/// Height of a row, in points.
const HEIGHT: f32 = 34.0;

/// Draws a kept brush, which can be clicked.
pub(super) fn preset_row(ui: &mut Ui, preset: &BrushPreset, chosen: bool) -> Response {
    let response = row(ui, HEIGHT, &tr_format!("own brush {name}", name = preset.name), chosen);
    let inner = response.rect.shrink2(vec2(6.0, 3.0));
    let between = |left: f32, right: f32| {
        Rect::from_min_max(pos2(left, inner.top()), pos2(right, inner.bottom()))
    };
    head::draw(ui.painter(), between(inner.left(), inner.left() + 24.0), preset.brush.shape, None);
    let colors = theme::colors(ui.ctx());
    let (name, below) =
        between(inner.left() + 32.0, inner.right()).split_top_bottom_at_fraction(0.55);
    text(ui, name, Align::Min, TextStyle::Body, colors.strong, &preset.name);
    let faint = if chosen { colors.text } else { colors.faint };
    text(ui, below, Align::Min, TextStyle::Small, faint, &summary(preset));
    response
}

/// Head, options and paint of a brush in a few words.
fn summary(preset: &BrushPreset) -> String {
    let mut words = vec![preset.brush.shape.to_string(), millimetres(preset.brush.size_mm)];
    let plain = BrushOptions::default();
    let options = &preset.options;
    for (differs, word) in [
        (options.curve.is_some(), tr("own curve")),
        (options.stabiliser.is_some(), tr("own stabiliser")),
        (options.tilt != plain.tilt, tr("own tilt")),
        (options.twist != plain.twist, tr("own twist")),
        (options.range != plain.range, tr("own pressure")),
    ] {
        if differs {
            words.push(word.to_owned());
        }
    }
    if let Some(load) = &preset.load {
        let pigments: Vec<&str> = load.recipe.keys().map(String::as_str).collect();
        let paint =
            if pigments.is_empty() { tr("a load set").to_owned() } else { pigments.join(" + ") };
        words.push(paint);
    }
    words.join(", ")
}
