//! Picture of a paint tube.

use eframe::egui::{
    Align, Color32, CornerRadius, Mesh, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, TextStyle,
    Ui, pos2, vec2,
};

use crate::language::tr;
use crate::panels::controls::patch;
use crate::panels::fitted_text::text_from_top;
use crate::theme;

/// Size of a tube with its name, in points.
pub(in crate::panels) const TUBE_SIZE: eframe::egui::Vec2 = vec2(61.0, 118.0);

/// Height of the name below the tube, in points.
const NAME_HEIGHT: f32 = 34.0;

/// Factor of the size from which names have the font of buttons.
const LARGE: f32 = 1.35;

/// Shading of the metal: position from left (0) to right (1), and grey level.
const METAL: [(f32, u8); 6] =
    [(0.0, 96), (0.12, 168), (0.32, 214), (0.55, 186), (0.85, 126), (1.0, 82)];

/// Draws a tube standing on its cap, with masstone and tint (sRGB) on its label.
pub(in crate::panels) fn draw(
    ui: &Ui,
    area: Rect,
    masstone: Option<[u8; 3]>,
    tint: Option<[u8; 3]>,
    name: &str,
) {
    let painter = ui.painter_at(area);
    let body = body(area);
    crimp(&painter, body);
    tapered(&painter, body);
    let cap = Rect::from_center_size(
        pos2(body.center().x, body.bottom() + 11.0),
        vec2(body.width() * 0.42, 12.0),
    );
    shoulder(&painter, body, cap);
    painter.rect_filled(cap, 2.0, Color32::from_gray(22));
    for ridge in 1..6 {
        let x = cap.left() + cap.width() * ridge as f32 / 6.0;
        painter.vline(x, cap.y_range().shrink(2.0), Stroke::new(1.0, Color32::from_gray(52)));
    }
    let label = Rect::from_min_max(
        pos2(body.left() + 3.0, body.top() + 9.0),
        pos2(body.right() - 3.0, body.bottom() - 5.0),
    );
    let (full, light) = label.split_top_bottom_at_fraction(0.62);
    patch(&painter, light, tint);
    patch(&painter, full, masstone);
    names(ui, area, name);
}

/// Draws an empty slot.
pub(super) fn draw_empty(ui: &Ui, area: Rect) {
    let body = body(area).shrink(1.0);
    let painter = ui.painter();
    let line = Stroke::new(1.0, theme::colors(ui.ctx()).line);
    painter.rect(body, CornerRadius::same(3), Color32::TRANSPARENT, line, StrokeKind::Inside);
    let plus = Stroke::new(1.5, theme::colors(ui.ctx()).faint);
    let middle = body.center();
    painter.hline(middle.x - 6.0..=middle.x + 6.0, middle.y, plus);
    painter.vline(middle.x, middle.y - 6.0..=middle.y + 6.0, plus);
    names(ui, area, tr("empty"));
}

/// Draws the drop of paint that follows the pointer while a tube is dragged.
pub(super) fn draw_drop(painter: &Painter, at: Pos2, [red, green, blue]: [u8; 3]) {
    let drop = at + vec2(14.0, 14.0);
    painter.circle(
        drop,
        8.0,
        Color32::from_rgb(red, green, blue),
        Stroke::new(1.5, theme::colors(painter.ctx()).strong),
    );
}

fn body(area: Rect) -> Rect {
    let width = (area.width() * 0.68).min(area.height() * 0.42);
    let left = area.center().x - width / 2.0;
    Rect::from_min_max(
        pos2(left, area.top() + 5.0),
        pos2(left + width, area.bottom() - NAME_HEIGHT - 19.0),
    )
}

/// Draws the folded end.
fn crimp(painter: &Painter, body: Rect) {
    let fold = Rect::from_min_max(
        pos2(body.left() - 1.0, body.top()),
        pos2(body.right() + 1.0, body.top() + 5.0),
    );
    painter.rect_filled(fold, 1.0, Color32::from_gray(150));
    painter.hline(fold.x_range(), fold.center().y, Stroke::new(1.0, Color32::from_gray(104)));
}

/// Draws the body, slightly narrower at the cap.
fn tapered(painter: &Painter, body: Rect) {
    let mut mesh = Mesh::default();
    for (index, (place, grey)) in METAL.into_iter().enumerate() {
        let color = Color32::from_gray(grey);
        let at = |inset: f32| body.left() + inset + (body.width() - 2.0 * inset) * place;
        mesh.colored_vertex(pos2(at(0.0), body.top() + 5.0), color);
        mesh.colored_vertex(pos2(at(1.5), body.bottom()), color);
        let last = 2 * index as u32;
        if index > 0 {
            mesh.add_triangle(last - 2, last - 1, last);
            mesh.add_triangle(last - 1, last + 1, last);
        }
    }
    painter.add(Shape::mesh(mesh));
}

/// Draws the shoulder between body and cap.
fn shoulder(painter: &Painter, body: Rect, cap: Rect) {
    let points = vec![
        pos2(body.left() + 1.5, body.bottom()),
        pos2(body.right() - 1.5, body.bottom()),
        pos2(cap.right() - 2.0, cap.top()),
        pos2(cap.left() + 2.0, cap.top()),
    ];
    painter.add(Shape::convex_polygon(points, Color32::from_gray(136), Stroke::NONE));
}

/// Draws the name below the tube, in as many lines as it needs.
fn names(ui: &Ui, area: Rect, name: &str) {
    let below = Rect::from_min_max(pos2(area.left() + 1.0, area.bottom() - NAME_HEIGHT), area.max);
    let large = area.width() > LARGE * TUBE_SIZE.x;
    let style = if large { TextStyle::Body } else { TextStyle::Small };
    let color = theme::colors(ui.ctx()).text;
    text_from_top(ui, below.shrink2(vec2(1.0, 1.0)), Align::Center, style, color, name);
}
