//! Plain signs of folders and files, for entries without a picture.

use eframe::egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, pos2, vec2};

/// Draws the sign of a folder, or of a file, in the middle of `rect`.
pub(super) fn draw(painter: &Painter, rect: Rect, folder: bool, color: Color32) {
    let side = rect.width().min(rect.height()) * 0.8;
    let size = if folder { vec2(side, 0.78 * side) } else { vec2(0.72 * side, side) };
    let corner = rect.center() - 0.5 * size;
    let place = |(x, y): (f32, f32)| pos2(corner.x + x * size.x, corner.y + y * size.y);
    let stroke = Stroke::new((side / 22.0).clamp(1.0, 2.0), color);
    let lines: [&[(f32, f32)]; 2] = if folder {
        [
            &[
                (0.0, 1.0),
                (0.0, 0.0),
                (0.36, 0.0),
                (0.48, 0.16),
                (1.0, 0.16),
                (1.0, 1.0),
                (0.0, 1.0),
            ],
            &[(0.0, 0.34), (1.0, 0.34)],
        ]
    } else {
        [
            &[(0.0, 0.0), (0.62, 0.0), (1.0, 0.28), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)],
            &[(0.62, 0.0), (0.62, 0.28), (1.0, 0.28)],
        ]
    };
    for line in lines {
        let places: Vec<Pos2> = line.iter().copied().map(place).collect();
        painter.add(Shape::line(places, stroke));
    }
}
