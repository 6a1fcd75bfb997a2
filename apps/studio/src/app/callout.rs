//! Lines of text on a plate over the picture, and an outline around what they speak of.

use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, vec2};

use crate::theme;

/// Room around the text, in points.
const MARGIN: f32 = 9.0;

/// Half width and height of the arrow, in points.
const ARROW: f32 = 8.0;

/// Side of a plate at which it points to its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Arrow {
    /// It points nowhere.
    None,
    /// Down, from the middle of the lower edge.
    Down,
}

/// Draws lines on a plate, at most `width` points wide. `at` is the middle of its upper edge, or
/// the tip of its arrow. Returns the rectangle of the plate.
pub(super) fn plate(
    painter: &Painter,
    at: Pos2,
    arrow: Arrow,
    width: f32,
    lines: &[String],
) -> Rect {
    let colors = theme::colors(painter.ctx());
    let mut job = LayoutJob::default();
    for (index, line) in lines.iter().enumerate() {
        let format = TextFormat::simple(FontId::proportional(13.0), colors.strong);
        let spacing = if index > 0 { "\n" } else { "" };
        job.append(&format!("{spacing}{line}"), 0.0, format);
    }
    job.wrap.max_width = width - 2.0 * MARGIN;
    let laid = painter.layout_job(job);
    let size = laid.size() + vec2(2.0, 2.0) * MARGIN;
    let top = match arrow {
        Arrow::None => at.y,
        Arrow::Down => at.y - ARROW - size.y,
    };
    let plate = Rect::from_min_size(Pos2::new(at.x - 0.5 * size.x, top).round(), size);
    // Nearly opaque, so that it is read over any picture.
    let fill = colors.panel.gamma_multiply(0.94);
    painter.rect(plate, 6, fill, Stroke::new(1.0, colors.line), StrokeKind::Inside);
    if arrow == Arrow::Down {
        let tip = [vec2(-ARROW, -ARROW), vec2(ARROW, -ARROW), vec2(0.0, 0.0)].map(|part| at + part);
        painter.add(Shape::convex_polygon(tip.to_vec(), fill, Stroke::NONE));
    }
    painter.galley(plate.min + vec2(MARGIN, MARGIN), laid, colors.strong);
    plate
}

/// Draws an outline around a part of the window, seen on light and on dark.
pub(super) fn outline(painter: &Painter, part: Rect) {
    for (width, color) in [(5.0, Color32::from_black_alpha(150)), (2.0, Color32::WHITE)] {
        painter.rect_stroke(part, 6, Stroke::new(width, color), StrokeKind::Middle);
    }
}
