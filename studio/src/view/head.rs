//! The brush head, drawn as a shaded cursor seen from above.
//!
//! Draws the facets that face the viewer, lowest first, with Lambert shading under the
//! painting's light. They are half transparent, so that the paint below stays visible.
//! Ferrule and handle continue where the head begins.

use eframe::egui::{Color32, Mesh, Painter, Pos2, Shape, Vec2};

use render::paint::document::Lighting;

use super::transform::Placement;
use session::HeadOnCanvas;

/// Fraction of the light that is ambient (chosen by eye).
const AMBIENT: f32 = 0.35;

/// Length of the ferrule, in half widths of the head (chosen by eye).
const FERRULE: f32 = 2.6;
/// Length of the handle, in half widths of the head (chosen by eye).
const HANDLE: f32 = 9.0;

/// Light and paint with which a head is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeadLook {
    /// Unit vector towards the light: x to the right, y down the surface, z to the viewer.
    pub light: [f32; 3],
    /// sRGB of the paint on the head, if it has any.
    pub paint: Option<[u8; 3]>,
}

impl HeadLook {
    /// The appearance under the light of the painting.
    #[must_use]
    pub fn lit_by(lighting: &Lighting, paint: Option<[u8; 3]>) -> Self {
        let (azimuth, elevation) =
            (lighting.azimuth_deg.to_radians(), lighting.elevation_deg.to_radians());
        let level = elevation.cos();
        let light = [azimuth.sin() * level, -azimuth.cos() * level, elevation.sin()];
        Self { light: light.map(|part| part as f32), paint }
    }
}

/// A ring of vertices around the head: x, y and height, in cells.
type Ring = Vec<[f32; 3]>;

/// Draws a head over its surface. A head with inconsistent vertex counts or values that are
/// not finite is not drawn.
pub(super) fn draw(painter: &Painter, placement: &Placement, head: &HeadOnCanvas, look: HeadLook) {
    let Some(rings) = rings(head) else { return };
    let screen = |place: [f32; 3]| placement.point([f64::from(place[0]), f64::from(place[1])]);
    shadow(painter, &rings, look.light, screen);
    let mut facets = Vec::new();
    let hair = bristle_color(look.paint, 0.0);
    for (at, pair) in rings.windows(2).enumerate() {
        let along = (at + 1) as f32 / (rings.len() - 1) as f32;
        let color = lerp(hair, bristle_color(look.paint, 1.0), along);
        add_band(&mut facets, &pair[0], &pair[1], look.light, color, 0.62);
    }
    let [collar, wood, end] = handle(&rings);
    add_band(&mut facets, &collar, &rings[0], look.light, [196.0; 3], 0.5);
    add_band(&mut facets, &wood, &collar, look.light, [92.0; 3], 0.42);
    add_band(&mut facets, &end, &wood, look.light, [64.0; 3], 0.36);
    facets.sort_by(|a, b| a.height.total_cmp(&b.height));
    let mut mesh = Mesh::default();
    for facet in &facets {
        let first = mesh.vertices.len() as u32;
        for place in facet.corners {
            mesh.colored_vertex(screen(place), facet.color);
        }
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first, first + 2, first + 3);
    }
    painter.add(Shape::mesh(mesh));
}

/// Splits the vertices into rings from ferrule to tip; `None` if the head is inconsistent.
fn rings(head: &HeadOnCanvas) -> Option<Vec<Ring>> {
    let whole = head.around >= 3 && head.along >= 2;
    let finite = head.vertices.iter().flatten().all(|number| number.is_finite());
    let fits = head.vertices.len() == head.around * head.along;
    (whole && finite && fits)
        .then(|| head.vertices.chunks(head.around).map(<[_]>::to_vec).collect())
}

/// A quadrilateral of the head, in cells, with its mean height.
struct Facet {
    corners: [[f32; 3]; 4],
    height: f32,
    color: Color32,
}

/// Adds the facets between two rings that face the viewer.
fn add_band(
    facets: &mut Vec<Facet>,
    upper: &Ring,
    lower: &Ring,
    light: [f32; 3],
    color: [f32; 3],
    alpha: f32,
) {
    let middle = mean(lower);
    for at in 0..upper.len() {
        let next = (at + 1) % upper.len();
        let corners = [upper[at], upper[next], lower[next], lower[at]];
        let centre = mean(&corners);
        let mut normal = cross(subtract(corners[2], corners[0]), subtract(corners[3], corners[1]));
        // Points the normal outwards, whatever the direction of the rings.
        if dot(normal, subtract(centre, mean(&[middle, mean(upper)]))) < 0.0 {
            normal = normal.map(|part| -part);
        }
        let length = dot(normal, normal).sqrt();
        if length == 0.0 || normal[2] <= 0.0 {
            continue;
        }
        let shine = dot(normal, light).max(0.0) / length;
        let bright = AMBIENT + (1.0 - AMBIENT) * shine;
        let [red, green, blue] = color.map(|part| (part * bright).clamp(0.0, 255.0) as u8);
        let opaque = (alpha * 255.0) as u8;
        let color = Color32::from_rgba_unmultiplied(red, green, blue, opaque);
        facets.push(Facet { corners, height: centre[2], color });
    }
}

/// Rings at the end of the ferrule, at the thickest part of the handle, and at its end.
fn handle(rings: &[Ring]) -> [Ring; 3] {
    let (root, next) = (mean(&rings[0]), mean(&rings[1]));
    let along = subtract(root, next);
    let length = dot(along, along).sqrt().max(1e-6);
    let axis = along.map(|part| part / length);
    let radius = |place: &[f32; 3]| {
        let away = subtract(*place, root);
        dot(away, away).sqrt()
    };
    let half = rings[0].iter().map(radius).sum::<f32>() / rings[0].len() as f32;
    let ring = |from: f32, wide: f32| -> Ring {
        let place = |place: &[f32; 3]| {
            let away = subtract(*place, root);
            [0, 1, 2].map(|part: usize| root[part] + wide * away[part] + from * half * axis[part])
        };
        rings[0].iter().map(place).collect()
    };
    [ring(FERRULE, 0.8), ring(0.45 * HANDLE, 1.0), ring(HANDLE, 0.55)]
}

/// Draws a soft shadow on the surface, on the side away from the light.
fn shadow(painter: &Painter, rings: &[Ring], light: [f32; 3], screen: impl Fn([f32; 3]) -> Pos2) {
    let slope = [0, 1].map(|part: usize| light[part] / light[2].max(0.3));
    let cast = |place: &[f32; 3]| {
        let height = place[2].max(0.0);
        screen([place[0] - slope[0] * height, place[1] - slope[1] * height, 0.0])
    };
    let around = hull(rings.iter().flatten().map(cast).collect());
    let Some(first) = around.first() else { return };
    let middle = around.iter().fold(Vec2::ZERO, |sum, point| sum + (*point - *first));
    let middle = *first + middle / around.len() as f32;
    for grown in [0.0_f32, 2.0, 4.0, 6.0] {
        let grow = |point: &Pos2| *point + (*point - middle).normalized() * grown;
        let shape = around.iter().map(grow).collect();
        painter.add(Shape::convex_polygon(
            shape,
            Color32::from_black_alpha(18),
            (0.0, Color32::BLACK),
        ));
    }
}

/// Convex hull by Andrew's monotone chain (1979).
fn hull(mut points: Vec<Pos2>) -> Vec<Pos2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let turn = |a: Pos2, b: Pos2, c: Pos2| (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    let half = |points: &mut dyn Iterator<Item = &Pos2>| {
        let mut chain: Vec<Pos2> = Vec::new();
        for &point in points {
            while chain.len() > 1
                && turn(chain[chain.len() - 2], chain[chain.len() - 1], point) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut lower = half(&mut points.iter());
    lower.extend(half(&mut points.iter().rev()));
    lower
}

/// Colour of the bristles: bare at the ferrule (`along` = 0), painted at the tip (1).
fn bristle_color(paint: Option<[u8; 3]>, along: f32) -> [f32; 3] {
    let bristle = [172.0; 3];
    paint.map_or(bristle, |paint| lerp(bristle, paint.map(f32::from), along))
}

fn lerp(from: [f32; 3], to: [f32; 3], share: f32) -> [f32; 3] {
    [0, 1, 2].map(|part: usize| from[part] + (to[part] - from[part]) * share)
}

fn mean(places: &[[f32; 3]]) -> [f32; 3] {
    let share = 1.0 / places.len() as f32;
    [0, 1, 2].map(|part: usize| places.iter().map(|place| place[part]).sum::<f32>() * share)
}

fn subtract(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
