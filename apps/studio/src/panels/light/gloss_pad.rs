//! Two-dimensional control of gloss: exponent to the right, strength upwards.

use eframe::egui::{
    Color32, Mesh, Pos2, Rect, Response, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, lerp, pos2,
    remap_clamp, vec2,
};
use paint::optics::Gloss;
use spectra::color::Rgb;

use super::super::pending_value::Edit;
use crate::language::tr_format;
use crate::theme;

/// Strength at the upper edge, as a share of a perfect white.
const STRONGEST: f32 = 1.0;

/// Exponents at the left and right edges; the scale is logarithmic.
const EXPONENTS: (f32, f32) = (2.0, 500.0);

/// Mesh cells of the drawn highlight along each side.
const CELLS: usize = 20;

/// Draws a pad with an accessible name and updates `gloss` from dragging.
pub(super) fn gloss_pad(
    ui: &mut Ui,
    name: &str,
    size: Vec2,
    gloss: &mut Gloss,
) -> (Response, Edit) {
    let (rect, mut response) = ui.allocate_exact_size(size, Sense::drag());
    let inner = rect.shrink(6.0);
    if let Some(pointer) = response.interact_pointer_pos() {
        let chosen = gloss_at(inner, pointer);
        if chosen != *gloss {
            *gloss = chosen;
            response.mark_changed();
        }
    }
    response.widget_info(|| {
        let mut info = WidgetInfo::slider(ui.is_enabled(), f64::from(gloss.strength), name);
        info.current_text_value = Some(gloss_text(*gloss));
        info
    });
    if ui.is_rect_visible(rect) {
        let painter = ui.painter_at(rect);
        painter.rect_filled(rect, theme::CORNER_RADIUS, theme::colors(ui.ctx()).well);
        painter.add(highlight(rect.shrink(1.0), *gloss));
        let handle = place_of(inner, *gloss);
        painter.circle(
            handle,
            4.5,
            theme::colors(ui.ctx()).strong,
            Stroke::new(1.5, theme::colors(ui.ctx()).bar),
        );
        let edge = if response.has_focus() {
            theme::colors(ui.ctx()).strong
        } else {
            theme::colors(ui.ctx()).line
        };
        let line = Stroke::new(1.0, edge);
        painter.rect_stroke(rect, theme::CORNER_RADIUS, line, eframe::egui::StrokeKind::Inside);
    }
    let edit = Edit::of(&response);
    (response, edit)
}

/// Formats a gloss: `strength 0.25, exponent 60`.
pub(super) fn gloss_text(gloss: Gloss) -> String {
    tr_format!(
        "strength {strength:.2}, exponent {exponent:.0}",
        strength = gloss.strength,
        exponent = gloss.exponent
    )
}

fn gloss_at(pad: Rect, place: Pos2) -> Gloss {
    let along = remap_clamp(place.x, pad.x_range(), 0.0..=1.0);
    let up = remap_clamp(place.y, pad.y_range(), 1.0..=0.0);
    let exponent = lerp(EXPONENTS.0.ln()..=EXPONENTS.1.ln(), along).exp();
    let strength = STRONGEST * up;
    // Rounded, because smaller differences are not visible.
    let digits = if exponent < 10.0 { 10.0 } else { 1.0 };
    Gloss {
        strength: (strength * 100.0).round() / 100.0,
        exponent: (exponent * digits).round() / digits,
    }
}

fn place_of(pad: Rect, gloss: Gloss) -> Pos2 {
    let logarithm = gloss.exponent.max(EXPONENTS.0).ln();
    let along = remap_clamp(logarithm, EXPONENTS.0.ln()..=EXPONENTS.1.ln(), 0.0..=1.0);
    let up = (gloss.strength / STRONGEST).clamp(0.0, 1.0);
    pos2(lerp(pad.left()..=pad.right(), along), lerp(pad.bottom()..=pad.top(), up))
}

/// Mesh of the highlight on a grey ball, in screen greys.
fn highlight(rect: Rect, gloss: Gloss) -> Shape {
    let mut mesh = Mesh::default();
    for row in 0..=CELLS {
        for column in 0..=CELLS {
            let u = column as f32 / CELLS as f32;
            let v = row as f32 / CELLS as f32;
            // The surface turns by 90 degrees from the upper to the lower edge: 0.785 is 45
            // degrees in radians.
            let across = (2.0 * u - 1.0) * rect.width() / rect.height();
            let away = vec2(across, 2.0 * v - 1.0).length().min(2.0);
            let shine = gloss.strength * (away * 0.785).cos().powf(gloss.exponent);
            let light = f64::from(0.02 + 0.45 * shine.min(2.0));
            let [grey, ..] = Rgb([light; 3]).encoded().to_bytes();
            let place = rect.min + vec2(u * rect.width(), v * rect.height());
            mesh.colored_vertex(place, Color32::from_gray(grey));
        }
    }
    let vertex = |row: usize, column: usize| (row * (CELLS + 1) + column) as u32;
    for row in 0..CELLS {
        for column in 0..CELLS {
            let [a, b] = [vertex(row, column), vertex(row, column + 1)];
            let [c, d] = [vertex(row + 1, column), vertex(row + 1, column + 1)];
            mesh.add_triangle(a, b, d);
            mesh.add_triangle(a, d, c);
        }
    }
    Shape::mesh(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pad_position_and_gloss_are_inverse() {
        let pad = Rect::from_min_size(pos2(10.0, 20.0), vec2(100.0, 80.0));
        for gloss in [
            Gloss { strength: 0.25, exponent: 60.0 },
            Gloss { strength: 0.06, exponent: 20.0 },
            Gloss { strength: 1.0, exponent: 500.0 },
            Gloss { strength: 0.0, exponent: 2.0 },
        ] {
            assert_eq!(gloss_at(pad, place_of(pad, gloss)), gloss);
        }
    }

    #[test]
    fn right_is_sharper_and_up_is_stronger_up_to_the_edges() {
        let pad = Rect::from_min_size(pos2(0.0, 0.0), vec2(100.0, 80.0));
        let low = gloss_at(pad, pos2(20.0, 70.0));
        let high = gloss_at(pad, pos2(80.0, 10.0));
        assert!(low.strength < high.strength && low.exponent < high.exponent, "{low:?} {high:?}");
        let beyond = gloss_at(pad, pos2(900.0, -50.0));
        assert_eq!(beyond, Gloss { strength: STRONGEST, exponent: EXPONENTS.1 });
    }
}
