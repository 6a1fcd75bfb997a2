//! Lets the quads' shader fill the large opaque areas that egui's widgets draw.
//!
//! egui's shader is some twenty times as expensive with a software driver, see the module of the
//! quads; the trays and cards of the window took more than half of a frame.

use eframe::egui::epaint::{ClippedShape, RectShape, WHITE_UV};
use eframe::egui::layers::ShapeIdx;
use eframe::egui::{
    Color32, Context, CornerRadius, LayerId, Mesh, Rect, Shape, StrokeKind, TextureId, Vec2, pos2,
    vec2,
};

use super::canvas::{Drawing, QuadCanvas};
use super::quad::Quad;

/// Least area that is worth the change of the shader, in pixels.
const LEAST: f32 = 2500.0;

/// Replaces the large opaque fills of this frame. To be called when all of it is drawn.
pub fn quicken(context: &Context) {
    let canvas = QuadCanvas::of(context);
    if canvas.drawing == Drawing::Egui {
        return;
    }
    let moved = |layer: &LayerId| context.layer_transform_to_global(*layer).is_some();
    let mut layers: Vec<LayerId> = context.memory(|memory| memory.layer_ids().collect());
    if !layers.contains(&LayerId::background()) {
        layers.push(LayerId::background());
    }
    layers.retain(|layer| !moved(layer));
    context.graphics_mut(|graphics| {
        for layer in layers {
            let Some(list) = graphics.get_mut(layer) else { continue };
            for index in 0..list.next_idx().0 {
                list.mutate_shape(ShapeIdx(index), |clipped| quicken_shape(clipped, &canvas));
            }
        }
    });
}

fn quicken_shape(clipped: &mut ClippedShape, canvas: &QuadCanvas) {
    let area = |rect: Rect| {
        let seen = rect.intersect(clipped.clip_rect).intersect(canvas.visible);
        if seen.is_positive() { seen.area() * canvas.density * canvas.density } else { 0.0 }
    };
    let quick = match &clipped.shape {
        Shape::Rect(rect) if is_plain(rect) && area(rect.rect) >= LEAST => {
            Some(Shape::Vec(rectangle(rect, canvas)))
        }
        Shape::Mesh(mesh) if area(mesh.calc_bounds()) >= LEAST && is_opaque(mesh) => {
            Some(canvas.shape(triangles(mesh)))
        }
        _ => None,
    };
    if let Some(quick) = quick {
        clipped.shape = quick;
    }
}

/// Whether a rectangle is opaque, upright and sharp.
fn is_plain(shape: &RectShape) -> bool {
    shape.fill.is_opaque()
        && shape.brush.is_none()
        && shape.blur_width == 0.0
        && shape.angle == 0.0
        && shape.round_to_pixels != Some(false)
        && (shape.stroke.is_empty() || shape.stroke_kind != StrokeKind::Middle)
}

/// The fill without its corners as quads, rounded corners and the outline as egui draws them.
fn rectangle(shape: &RectShape, canvas: &QuadCanvas) -> Vec<Shape> {
    let rect = canvas.rounded(shape.rect);
    let CornerRadius { nw, ne, sw, se } = shape.corner_radius;
    let radius = f32::from(nw.max(ne).max(sw).max(se));
    let line = if shape.stroke.is_empty() { Vec::new() } else { outline(shape) };
    // Beyond a half of the side egui makes the radius smaller.
    let corner = canvas.rounded_up(radius);
    if 2.0 * corner >= rect.size().min_elem() {
        return vec![shape.clone().into()];
    }
    let inner = rect.shrink2(vec2(corner, 0.0));
    let mut parts = vec![inner];
    if corner > 0.0 {
        let [left, right] = [(rect.left(), inner.left()), (inner.right(), rect.right())];
        let top = rect.top() + corner;
        let bottom = rect.bottom() - corner;
        let side = |(from, to)| Rect::from_min_max(pos2(from, top), pos2(to, bottom));
        parts.extend([side(left), side(right)]);
    }
    let quads = parts.into_iter().map(|part| filled(part, shape.fill)).collect();
    let mut all = vec![canvas.shape(quads)];
    if corner > 0.0 {
        all.extend(corners(rect, corner, shape));
    }
    all.extend(line);
    all
}

/// Small rectangles with the four corners, which reach into the quads.
fn corners(rect: Rect, corner: f32, shape: &RectShape) -> impl Iterator<Item = Shape> {
    let size = Vec2::splat(2.0 * corner);
    let fill = shape.fill;
    let radius = shape.corner_radius;
    let at = [
        rect.min,
        pos2(rect.right() - size.x, rect.top()),
        pos2(rect.left(), rect.bottom() - size.y),
        rect.max - size,
    ];
    // Each has one of the four radii; the others would leave gaps.
    let only = [
        CornerRadius { nw: radius.nw, ..CornerRadius::ZERO },
        CornerRadius { ne: radius.ne, ..CornerRadius::ZERO },
        CornerRadius { sw: radius.sw, ..CornerRadius::ZERO },
        CornerRadius { se: radius.se, ..CornerRadius::ZERO },
    ];
    at.into_iter().zip(only).map(move |(min, radius)| {
        RectShape::filled(Rect::from_min_size(min, size), radius, fill).into()
    })
}

fn outline(shape: &RectShape) -> Vec<Shape> {
    vec![RectShape { fill: Color32::TRANSPARENT, ..shape.clone() }.into()]
}

fn filled(rect: Rect, color: Color32) -> Quad {
    let corners = [rect.left_top(), rect.right_top(), rect.right_bottom(), rect.left_bottom()];
    Quad::colored(corners.map(|corner| (corner, color)))
}

/// Whether a mesh has no texture and covers what lies below.
fn is_opaque(mesh: &Mesh) -> bool {
    mesh.texture_id == TextureId::default()
        && mesh.vertices.iter().all(|vertex: &eframe::egui::epaint::Vertex| {
            vertex.color.is_opaque() && vertex.uv == WHITE_UV
        })
}

/// The triangles of a mesh, each as a quad whose last side has no length.
fn triangles(mesh: &Mesh) -> Vec<Quad> {
    let three = mesh.indices.chunks_exact(3);
    three
        .map(|at| {
            Quad::colored([at[0], at[1], at[2], at[2]].map(|index: u32| {
                let vertex = &mesh.vertices[index as usize];
                (vertex.pos, vertex.color)
            }))
        })
        .collect()
}
