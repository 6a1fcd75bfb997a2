//! The outline of a surface: a rectangle, or a palette with a thumb hole.

use std::f64::consts::{FRAC_PI_2, TAU};

use eframe::egui::{Color32, Mesh, Painter, Pos2, Shape, Stroke, Vec2};

use super::canvas::draw_quads;
use super::quad::Quad;
use super::transform::Placement;
use crate::theme;

/// Segments per quarter circle.
const QUARTER: usize = 20;

/// Radius of a palette's corners, as a fraction of its shorter side.
const CORNER: f64 = 0.2;

/// Radius of the thumb hole, and the distance of its centre from the right and lower edges,
/// as fractions of the shorter side.
const HOLE: (f64, f64) = (0.085, 0.24);

/// Width of a surface's shadow, in points.
pub(super) const SHADOW: f32 = 6.0;

/// Colour of the shadow at the surface's edge.
pub(super) const SHADE: Color32 = Color32::from_gray(88);

/// The outline of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outline {
    /// A rectangle that contains all cells.
    Rectangle,
    /// A palette with round corners and a thumb hole at the lower right.
    Palette,
}

impl Outline {
    /// Whether a position, in cells, is on the surface.
    #[must_use]
    pub fn contains(self, [x, y]: [f64; 2], cells: (usize, usize)) -> bool {
        let width = cells.0 as f64;
        let height = cells.1 as f64;
        if !(0.0..width).contains(&x) || !(0.0..height).contains(&y) {
            return false;
        }
        if self == Self::Rectangle {
            return true;
        }
        let radius = corner(cells);
        let beyond = |at: f64, size: f64| (radius - at).max(at - (size - radius)).max(0.0);
        let in_corner = beyond(x, width).hypot(beyond(y, height)) > radius;
        let (middle, hole) = hole(cells);
        !in_corner && (x - middle[0]).hypot(y - middle[1]) > hole
    }

    /// Draws the shadow below the surface, fading into the surround.
    pub(super) fn draw_shadow(
        self,
        painter: &Painter,
        placement: &Placement,
        cells: (usize, usize),
    ) {
        let edge: Vec<Pos2> =
            self.edge(cells).into_iter().map(|place| placement.point(place)).collect();
        let outer = offset_outwards(&edge, SHADOW);
        let strip = (0..edge.len()).map(|at| {
            let next = (at + 1) % edge.len();
            Quad::colored([
                (edge[at], SHADE),
                (edge[next], SHADE),
                (outer[next], theme::SURROUND),
                (outer[at], theme::SURROUND),
            ])
        });
        draw_quads(painter, strip.collect());
    }

    /// Covers the parts outside the outline with the colour of the surround and draws the
    /// edge.
    pub(super) fn draw_edge(self, painter: &Painter, placement: &Placement, cells: (usize, usize)) {
        let edge = self.edge(cells);
        let point = |place: [f64; 2]| placement.point(place);
        if self == Self::Rectangle {
            // An antialiased line hides the stepped edge of the picture.
            let line = edge.into_iter().map(point).collect();
            painter.add(Shape::closed_line(line, Stroke::new(1.0, Color32::from_gray(76))));
            return;
        }
        for (quarter, arc) in edge.chunks(QUARTER + 1).enumerate() {
            let (right, low) = [(0, 0), (1, 0), (1, 1), (0, 1)][quarter];
            let tip = [(right * cells.0) as f64, (low * cells.1) as f64];
            let mut mesh = Mesh::default();
            mesh.colored_vertex(point(tip), theme::SURROUND);
            for &place in arc {
                mesh.colored_vertex(point(place), theme::SURROUND);
            }
            for at in 1..=QUARTER as u32 {
                mesh.add_triangle(0, at, at + 1);
            }
            painter.add(Shape::mesh(mesh));
        }
        // The corners also covered the shadow there.
        self.draw_shadow(painter, placement, cells);
        let line: Vec<Pos2> = edge.into_iter().map(point).collect();
        painter.add(Shape::closed_line(line, Stroke::new(1.5, Color32::from_gray(60))));

        let (middle, radius) = hole(cells);
        let centre = point(middle);
        let radius = (radius * placement.scale()) as f32;
        painter.circle(centre, radius, theme::SURROUND, Stroke::new(1.5, Color32::from_gray(60)));
        for (inset, alpha) in [(1.5, 40), (3.0, 22), (5.0, 12)] {
            let stroke = Stroke::new(2.0, Color32::from_black_alpha(alpha));
            painter.circle_stroke(centre, (radius - inset).max(0.0), stroke);
        }
    }

    /// The edge in cells, clockwise from the upper left. For a palette, four arcs of
    /// `QUARTER + 1` points each.
    fn edge(self, cells: (usize, usize)) -> Vec<[f64; 2]> {
        let width = cells.0 as f64;
        let height = cells.1 as f64;
        if self == Self::Rectangle {
            return vec![[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
        }
        let radius = corner(cells);
        let far = width - radius;
        let low = height - radius;
        let middles = [[radius, radius], [far, radius], [far, low], [radius, low]];
        let mut edge = Vec::with_capacity(4 * (QUARTER + 1));
        for (quarter, [x, y]) in middles.into_iter().enumerate() {
            for step in 0..=QUARTER {
                let along = quarter as f64 + step as f64 / QUARTER as f64;
                let (sin, cos) = (0.5 * TAU + along * FRAC_PI_2).sin_cos();
                edge.push([x + radius * cos, y + radius * sin]);
            }
        }
        edge
    }
}

/// Offsets a closed convex polygon outwards by `by` points, vertex by vertex.
pub(super) fn offset_outwards(edge: &[Pos2], by: f32) -> Vec<Pos2> {
    let count = edge.len();
    let middle = edge.iter().fold(Vec2::ZERO, |sum, at| sum + at.to_vec2()) / count as f32;
    let outwards = |from: Pos2, to: Pos2| {
        let normal = (to - from).normalized().rot90();
        if normal.dot(from - middle.to_pos2()) < 0.0 { -normal } else { normal }
    };
    let moved = |at: usize| {
        let before = edge[(at + count - 1) % count];
        let here = edge[at];
        let next = edge[(at + 1) % count];
        let one = outwards(before, here);
        let other = outwards(here, next);
        // Both adjacent sides move by `by`, so a corner moves further than that.
        here + (one + other) * (by / (1.0 + one.dot(other)))
    };
    (0..count).map(moved).collect()
}

fn corner(cells: (usize, usize)) -> f64 {
    CORNER * cells.0.min(cells.1) as f64
}

/// Centre and radius of the thumb hole, in cells.
fn hole(cells: (usize, usize)) -> ([f64; 2], f64) {
    let side = cells.0.min(cells.1) as f64;
    ([cells.0 as f64 - HOLE.1 * side, cells.1 as f64 - HOLE.1 * side], HOLE.0 * side)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CELLS: (usize, usize) = (600, 400);

    #[test]
    fn a_rectangle_ends_at_its_edges() {
        for (place, inside) in [
            ([0.0, 0.0], true),
            ([599.9, 399.9], true),
            ([600.0, 10.0], false),
            ([-0.1, 5.0], false),
        ] {
            assert_eq!(Outline::Rectangle.contains(place, CELLS), inside, "{place:?}");
        }
    }

    #[test]
    fn corners_and_hole_are_not_on_the_palette() {
        let on = |place| Outline::Palette.contains(place, CELLS);
        assert!(on([300.0, 200.0]) && on([0.5, 200.0]) && on([300.0, 399.5]), "the middle");
        assert!(!on([2.0, 2.0]) && !on([598.0, 2.0]) && !on([598.0, 398.0]), "the corners");
        let (middle, radius) = hole(CELLS);
        assert!(!on(middle) && !on([middle[0] + 0.9 * radius, middle[1]]), "the hole");
        assert!(on([middle[0] - 1.1 * radius, middle[1]]), "beside the hole");
    }

    #[test]
    fn the_drawn_edge_bounds_the_surface() {
        let middle = [300.0, 200.0];
        for place in Outline::Palette.edge(CELLS) {
            let towards = |by: f64| {
                [0, 1].map(|axis: usize| middle[axis] + (place[axis] - middle[axis]) * by)
            };
            let within = towards(0.999);
            let beyond = towards(1.001);
            assert!(Outline::Palette.contains(within, CELLS), "{within:?}");
            assert!(!Outline::Palette.contains(beyond, CELLS), "{beyond:?}");
        }
    }
}
