//! Icon of a brush head, seen from its broad side.

use eframe::egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, pos2, vec2};
use paint::brush::HeadShape;

use crate::theme;

/// Draws a head that points up, with ferrule and part of the handle. The hair has the
/// sRGB colour of its paint, or grey if clean.
pub(in crate::panels) fn draw(
    painter: &Painter,
    area: Rect,
    shape: HeadShape,
    color: Option<[u8; 3]>,
) {
    let contour = shape.contour();
    let (length, _) = contour[contour.len() - 1];
    let metal = area.height() * 0.28;
    // Fit to the height for long heads, to the width for wide ones.
    let scale = (area.width() * 0.78).min((area.height() - metal) / length);
    let foot = pos2(area.center().x, area.top() + area.height() - metal);
    let tip = foot.y - length * scale;
    let drop = (tip - area.top()) * 0.5;
    let foot = foot - vec2(0.0, drop);
    let ferrule = Rect::from_min_max(
        foot - vec2(contour[0].1 * scale, 0.0),
        foot + vec2(contour[0].1 * scale, metal * 0.62),
    );
    let handle = Rect::from_center_size(
        pos2(foot.x, ferrule.bottom() + metal * 0.19),
        vec2((ferrule.width() * 0.6).max(2.5), metal * 0.38),
    );
    painter.rect_filled(handle, 1.0, Color32::from_gray(88));
    painter.rect_filled(ferrule.expand2(vec2(0.75, 0.0)), 1.0, Color32::from_gray(150));
    let hair = match (color, shape) {
        (Some([red, green, blue]), _) => Color32::from_rgb(red, green, blue),
        (None, HeadShape::Knife) => Color32::from_gray(190),
        (None, _) => Color32::from_gray(112),
    };
    // Dark in both themes, so that light hair stands out.
    let edge = Stroke::new(1.0, theme::DARK.well);
    painter.add(Shape::convex_polygon(outline(&contour, foot, scale), hair, edge));
}

/// Outline of the head as a closed polygon, tip up.
fn outline(contour: &[(f32, f32)], foot: Pos2, scale: f32) -> Vec<Pos2> {
    let at = |side: f32, (along, half): (f32, f32)| {
        pos2(foot.x + side * half * scale, foot.y - along * scale)
    };
    let up = contour.iter().map(|&point| at(-1.0, point));
    let down = contour.iter().rev().filter(|point| point.1 > 0.0).map(|&point| at(1.0, point));
    up.chain(down).collect()
}
