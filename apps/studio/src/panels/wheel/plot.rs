//! Draws a colour wheel: reach, mixing lines, tints, tubes and marks.

use eframe::egui::{
    Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2,
};
use pigment::palette::{Appearance, Boundary, ColorWheel};
use spectra::color::{Lab, Rgb};

use super::plane::{Plane, RING};
use crate::language::tr;
use crate::theme;

/// Points around which a mark is drawn.
const MARK: f32 = 6.0;

/// A colour that is marked in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mark {
    /// Place of the mark.
    pub(super) lab: Lab,
    /// Colour of the mark, encoded sRGB.
    pub(super) srgb: [u8; 3],
    /// Whether it is the colour that is wanted, drawn as a square; else the brush, drawn as a ring.
    pub(super) wanted: bool,
}

/// Draws rings of chroma and the axes.
pub(super) fn frame(painter: &Painter, plane: &Plane) {
    let colors = theme::colors(painter.ctx());
    painter.rect_filled(plane.rect, theme::CORNER_RADIUS, colors.well);
    let line = Stroke::new(1.0, colors.line);
    let middle = plane.rect.center();
    let rect = plane.rect;
    painter.hline(rect.x_range(), middle.y, line);
    painter.vline(middle.x, rect.y_range(), line);
    let rings = (plane.reach / RING) as usize;
    let radius = |ring: usize| plane.point([ring as f64 * RING, 0.0]).x - middle.x;
    for ring in 1..=rings {
        painter.circle_stroke(middle, radius(ring), line);
    }
    let font = FontId::proportional(10.0);
    let names = [
        (rect.right_center(), Align2::RIGHT_BOTTOM, tr("+a* red")),
        (rect.left_center(), Align2::LEFT_BOTTOM, tr("green")),
        (rect.center_top(), Align2::LEFT_TOP, tr(" +b* yellow")),
        (rect.center_bottom(), Align2::LEFT_BOTTOM, tr(" blue")),
    ];
    for (at, align, name) in names {
        painter.text(at, align, name, font.clone(), colors.faint);
    }
}

/// Fills what the tubes reach, in the colours of the outermost mixtures and of their mean lightness
/// in the middle, and draws its outline.
pub(super) fn region(painter: &Painter, plane: &Plane, wheel: &ColorWheel, region: &Boundary) {
    let held: Vec<(Pos2, &Appearance)> = region
        .sectors
        .iter()
        .flatten()
        .map(|(place, index)| (plane.point(*place), &wheel.gamut.samples[*index].color))
        .collect();
    if held.len() < 2 {
        return;
    }
    let lightness =
        held.iter().map(|(_, color)| color.lab.lightness).sum::<f64>() / held.len() as f64;
    // Grey of this L*: its Y by CIELAB, encoded.
    let grey = Rgb([((lightness + 16.0) / 116.0).powi(3).clamp(0.0, 1.0); 3]).encoded();
    let mut mesh = Mesh::default();
    mesh.colored_vertex(plane.rect.center(), screen(grey));
    for (point, color) in &held {
        mesh.colored_vertex(*point, screen(color.srgb));
    }
    let outline: Vec<Pos2> = region.polygon().into_iter().map(|place| plane.point(place)).collect();
    let middle = plane.rect.center();
    let count = held.len() as u32;
    for at in 0..count {
        let next = (at + 1) % count;
        let [from, to] = [held[at as usize].0, held[next as usize].0].map(|point| point - middle);
        // Fans over wide gaps would fill what is not reached.
        if from.normalized().dot(to.normalized()) > 0.9 {
            mesh.add_triangle(0, 1 + at, 1 + next);
        }
    }
    painter.add(Shape::mesh(mesh));
    let line = Stroke::new(1.0, theme::colors(painter.ctx()).text);
    painter.add(Shape::closed_line(outline, line));
}

/// Draws the mixing lines of all pairs and the tints, each piece in its own colour.
pub(super) fn lines(painter: &Painter, plane: &Plane, wheel: &ColorWheel) {
    let at = |color: &Appearance| plane.point([color.lab.a, color.lab.b]);
    for line in &wheel.lines {
        for two in line.colors.windows(2) {
            let ends = [at(&two[0].1), at(&two[1].1)];
            painter.line_segment(ends, Stroke::new(2.5, Color32::from_black_alpha(90)));
            painter.line_segment(ends, Stroke::new(1.5, screen(two[0].1.srgb)));
        }
    }
    for color in wheel.tints.iter().flat_map(|ladder| ladder.colors.iter().skip(1)) {
        let edge = Stroke::new(0.5, Color32::from_black_alpha(160));
        painter.circle(at(color), 2.2, screen(color.srgb), edge);
    }
}

/// Draws the tubes.
pub(super) fn tubes(painter: &Painter, plane: &Plane, wheel: &ColorWheel) {
    let edge = Stroke::new(1.5, theme::colors(painter.ctx()).strong);
    for (_, color) in &wheel.masstones {
        let point = plane.point([color.lab.a, color.lab.b]);
        painter.circle(point, 5.0, screen(color.srgb), edge);
    }
}

/// Draws what the brush holds, or the colour that is wanted.
pub(super) fn mark(painter: &Painter, plane: &Plane, mark: Mark) {
    let [r, g, b] = mark.srgb;
    let fill = Color32::from_rgb(r, g, b);
    let point = plane.rect.shrink(MARK).clamp(plane.point([mark.lab.a, mark.lab.b]));
    // White over black, so that it is seen on any colour.
    for stroke in [Stroke::new(3.0, Color32::BLACK), Stroke::new(1.5, Color32::WHITE)] {
        if mark.wanted {
            let square = Rect::from_center_size(point, Vec2::splat(2.0 * MARK));
            painter.rect(square, 0.0, fill, stroke, StrokeKind::Middle);
        } else {
            painter.circle(point, MARK, fill, stroke);
        }
    }
}

/// Screen colour of an encoded colour, moved into the gamut of the screen.
pub(super) fn screen(srgb: Rgb) -> Color32 {
    let [r, g, b] = srgb.linear().mapped_into_gamut().encoded().to_bytes();
    Color32::from_rgb(r, g, b)
}
