//! The outline of a surface (a rectangle, or a palette with a thumb hole), and the brush head as a
//! cursor: an outline seen from above, clear inside.
//!
//! The cursor is a dark line with a light one in it, so that you see it on light and on dark
//! paint. It surrounds the whole head as it is bent now, and never covers the place that it paints.
//! The handle is a line that begins outside, with a dot of the brush's paint at its end. If a head
//! is too small for an outline, the cursor is a ring with four ticks.

use std::f64::consts::{FRAC_PI_2, TAU};

use eframe::egui::{Color32, Mesh, Painter, Pos2, Rect, Shape, Stroke, Vec2, vec2};
use session::HeadOnCanvas;

use super::canvas::draw_quads;
use super::texture::Quad;
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
        let [across, down] = [(x, width), (y, height)]
            .map(|(at, size)| (radius - at).max(at - (size - radius)).max(0.0));
        let in_corner = across.hypot(down) > radius;
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

    /// Covers the parts outside the outline with the colour of the surround, and draws the edge.
    pub(super) fn draw_edge(self, painter: &Painter, placement: &Placement, cells: (usize, usize)) {
        let edge = self.edge(cells);
        if self == Self::Rectangle {
            // An antialiased line hides the stepped edge of the picture.
            let line = edge.into_iter().map(|place| placement.point(place)).collect();
            painter.add(Shape::closed_line(line, Stroke::new(1.0, Color32::from_gray(76))));
            return;
        }
        for (quarter, arc) in edge.chunks(QUARTER + 1).enumerate() {
            let (right, low) = [(0, 0), (1, 0), (1, 1), (0, 1)][quarter];
            let tip = [(right * cells.0) as f64, (low * cells.1) as f64];
            let mut mesh = Mesh::default();
            mesh.colored_vertex(placement.point(tip), theme::SURROUND);
            for &place in arc {
                mesh.colored_vertex(placement.point(place), theme::SURROUND);
            }
            for at in 1..=QUARTER as u32 {
                mesh.add_triangle(0, at, at + 1);
            }
            painter.add(Shape::mesh(mesh));
        }
        // The corners also covered the shadow there.
        self.draw_shadow(painter, placement, cells);
        let line = edge.into_iter().map(|place| placement.point(place)).collect();
        painter.add(Shape::closed_line(line, Stroke::new(1.5, Color32::from_gray(60))));

        let (middle, radius) = hole(cells);
        let centre = placement.point(middle);
        let radius = (radius * placement.scale()) as f32;
        painter.circle(centre, radius, theme::SURROUND, Stroke::new(1.5, Color32::from_gray(60)));
        for (inset, alpha) in [(1.5, 40), (3.0, 22), (5.0, 12)] {
            let stroke = Stroke::new(2.0, Color32::from_black_alpha(alpha));
            painter.circle_stroke(centre, (radius - inset).max(0.0), stroke);
        }
    }

    /// The edge in cells, clockwise from the upper left. A palette has four arcs of `QUARTER + 1`
    /// points each.
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

/// Moves the sides of a closed convex polygon outwards by `by` points.
pub(super) fn offset_outwards(edge: &[Pos2], by: f32) -> Vec<Pos2> {
    let count = edge.len();
    let middle = edge.iter().fold(Vec2::ZERO, |sum, at| sum + at.to_vec2()) / count as f32;
    (0..count)
        .map(|at| {
            let before = edge[(at + count - 1) % count];
            let here = edge[at];
            let next = edge[(at + 1) % count];
            let [one, other] = [(before, here), (here, next)].map(|(from, to)| {
                let normal = (to - from).normalized().rot90();
                if normal.dot(from - middle.to_pos2()) < 0.0 { -normal } else { normal }
            });
            // Both sides move by `by`, so a corner moves further.
            here + (one + other) * (by / (1.0 + one.dot(other)))
        })
        .collect()
}

fn corner(cells: (usize, usize)) -> f64 {
    CORNER * cells.0.min(cells.1) as f64
}

/// Centre and radius of the thumb hole, in cells.
fn hole(cells: (usize, usize)) -> ([f64; 2], f64) {
    let side = cells.0.min(cells.1) as f64;
    ([cells.0 as f64 - HOLE.1 * side, cells.1 as f64 - HOLE.1 * side], HOLE.0 * side)
}

/// Distance from the head to the middle of its outline, in points. The line covers no part of the
/// head.
const GAP: f32 = 3.5;

/// Widths of the dark line and of the light one in it, in points.
const WIDTHS: [f32; 2] = [3.0, 1.2];

/// The dark line. It is half transparent, so that it is soft on light paint.
const DARK: Color32 = Color32::from_black_alpha(170);

/// A head narrower than this on the screen is drawn as a ring, in points.
const SMALL: f32 = 12.0;

/// Radius of that ring, and of the ends of its ticks, in points.
const RING: (f32, f32) = (8.0, 13.0);

const DOT: f32 = 4.0;

const RING_PARTS: usize = 40;

/// Length of the handle, in half widths of the head (chosen by eye).
const HANDLE: f32 = 9.0;

/// A ring of vertices around the head: x, y and height, in cells.
type Ring = Vec<[f32; 3]>;

/// The lines of a head in the window, in points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HeadLines {
    /// Lines, and whether each is closed. Draw each dark first, then light
    /// ([`HeadLines::STROKES`]).
    pub lines: Vec<(Vec<Pos2>, bool)>,
    /// Middle and colour of the dot of paint.
    pub dot: Option<(Pos2, [u8; 3])>,
}

impl HeadLines {
    /// Widths in points and colours of the strokes of a line, in drawing order.
    pub const STROKES: [(f32, Color32); 2] = [(WIDTHS[0], DARK), (WIDTHS[1], Color32::WHITE)];

    /// Radii in points of the dark disc below the dot of paint, and of the dot.
    pub const DOT: [f32; 2] = [DOT + 1.5, DOT];

    /// The lines of a head over its surface. There are none if the vertex counts do not fit or a
    /// value is not finite.
    pub(super) fn of(placement: &Placement, head: &HeadOnCanvas, paint: Option<[u8; 3]>) -> Self {
        let Some(rings) = rings(head) else { return Self::default() };
        let screen = |place: [f32; 3]| placement.point([f64::from(place[0]), f64::from(place[1])]);
        let around = hull(rings.iter().flatten().map(|place| screen(*place)).collect());
        let size = Rect::from_points(&around).size();
        let tip = screen(mean(&rings[rings.len() - 1]));
        if around.len() < 3 || size.max_elem() < SMALL {
            return Self::ring(tip, paint);
        }
        let edge = offset_outwards(&around, GAP);
        let end = screen(handle_end(&rings));
        let root = screen(mean(&rings[0]));
        let beyond = outside(&edge, root, end);
        let corner = Rect::from_points(&edge).right_bottom();
        let dot = paint.map(|paint| (if beyond.is_some() { end } else { corner }, paint));
        let handle = beyond.map(|from| (vec![from, end], false));
        Self { lines: [(edge, true)].into_iter().chain(handle).collect(), dot }
    }

    /// A ring around a place, with ticks that point to it.
    fn ring(tip: Pos2, paint: Option<[u8; 3]>) -> Self {
        let turns =
            (0..RING_PARTS).map(|part| std::f32::consts::TAU * part as f32 / RING_PARTS as f32);
        let circle = turns.map(|turn| tip + RING.0 * Vec2::angled(turn)).collect();
        let sides = [Vec2::X, Vec2::Y, -Vec2::X, -Vec2::Y];
        let ticks = sides.map(|side| (vec![tip + RING.0 * side, tip + RING.1 * side], false));
        let dot = paint.map(|paint| (tip + vec2(1.0, 1.0) * RING.1, paint));
        Self { lines: [(circle, true)].into_iter().chain(ticks).collect(), dot }
    }

    /// Rectangle around everything that is drawn, if anything.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        let all = self.lines.iter().flat_map(|(line, _)| line);
        let all = all.chain(self.dot.as_ref().map(|(at, _)| at));
        let bounds = all.fold(Rect::NOTHING, |bounds, at| bounds.union(Rect::from_pos(*at)));
        bounds.is_finite().then(|| bounds.expand(DOT + 3.0))
    }

    /// Draws the lines.
    pub(super) fn draw(&self, painter: &Painter) {
        for (width, color) in Self::STROKES {
            for (line, closed) in &self.lines {
                let stroke = Stroke::new(width, color);
                painter.add(match closed {
                    true => Shape::closed_line(line.clone(), stroke),
                    false => Shape::line(line.clone(), stroke),
                });
            }
        }
        let Some((at, [red, green, blue])) = self.dot else { return };
        painter.circle_filled(at, Self::DOT[0], DARK);
        let edge = Stroke::new(1.0, Color32::WHITE);
        painter.circle(at, Self::DOT[1], Color32::from_rgb(red, green, blue), edge);
    }
}

/// Splits the vertices into rings from ferrule to tip; `None` if their number does not fit.
fn rings(head: &HeadOnCanvas) -> Option<Vec<Ring>> {
    let whole = head.around >= 3 && head.along >= 2;
    let finite = head.vertices.iter().flatten().all(|number| number.is_finite());
    let fits = head.vertices.len() == head.around * head.along;
    (whole && finite && fits)
        .then(|| head.vertices.chunks(head.around).map(<[_]>::to_vec).collect())
}

/// The end of the handle, which continues where the head begins.
fn handle_end(rings: &[Ring]) -> [f32; 3] {
    let root = mean(&rings[0]);
    let next = mean(&rings[1]);
    let along = subtract(root, next);
    let length = norm(along).max(1e-6);
    let half = rings[0].iter().map(|place: &[f32; 3]| norm(subtract(*place, root))).sum::<f32>()
        / rings[0].len() as f32;
    [0, 1, 2].map(|part: usize| root[part] + HANDLE * half * along[part] / length)
}

/// Point at which the line from `root` to `end` leaves a convex outline. `None` if `end` is so near
/// the outline that you would not see a handle.
fn outside(edge: &[Pos2], root: Pos2, end: Pos2) -> Option<Pos2> {
    let middle = edge.iter().fold(Vec2::ZERO, |sum, at| sum + at.to_vec2()) / edge.len() as f32;
    let is_in = |point: Pos2| {
        (0..edge.len()).all(|at| {
            let from = edge[at];
            let to = edge[(at + 1) % edge.len()];
            let normal = (to - from).rot90();
            normal.dot(point - from) * normal.dot(middle.to_pos2() - from) >= 0.0
        })
    };
    let steps = (end - root).length().ceil().max(1.0) as usize;
    let at = |step: usize| root.lerp(end, step as f32 / steps as f32);
    let from = at((0..=steps).rev().find(|&step| is_in(at(step))).map_or(0, |step| step + 1));
    ((end - from).length() > 2.0 * DOT && !is_in(end)).then_some(from)
}

/// Convex hull by Andrew's monotone chain (1979).
fn hull(mut points: Vec<Pos2>) -> Vec<Pos2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut all: Vec<Pos2> = Vec::new();
    for _ in 0..2 {
        let mut chain: Vec<Pos2> = Vec::new();
        for &c in &points {
            while let [.., a, b] = chain[..]
                && (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) <= 0.0
            {
                chain.pop();
            }
            chain.push(c);
        }
        chain.pop();
        all.extend(chain);
        // The second half goes back.
        points.reverse();
    }
    all
}

fn mean(places: &[[f32; 3]]) -> [f32; 3] {
    let share = 1.0 / places.len() as f32;
    [0, 1, 2].map(|part: usize| places.iter().map(|place| place[part]).sum::<f32>() * share)
}

fn subtract(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn norm(a: [f32; 3]) -> f32 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;

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
            let [within, beyond] = [0.999, 1.001].map(|by| {
                [0, 1].map(|axis: usize| middle[axis] + (place[axis] - middle[axis]) * by)
            });
            assert!(Outline::Palette.contains(within, CELLS), "{within:?}");
            assert!(!Outline::Palette.contains(beyond, CELLS), "{beyond:?}");
        }
    }

    #[test]
    fn the_handle_begins_where_it_leaves_the_outline() {
        let edge = [pos2(0.0, 0.0), pos2(10.0, 0.0), pos2(10.0, 10.0), pos2(0.0, 10.0)];
        let from = outside(&edge, pos2(5.0, 5.0), pos2(45.0, 5.0)).unwrap();
        assert!(from.x > 10.0 && from.x < 12.1 && from.y == 5.0, "{from}");
        assert_eq!(outside(&edge, pos2(5.0, 5.0), pos2(9.0, 6.0)), None, "it stands upright");
        assert_eq!(outside(&edge, pos2(5.0, 5.0), pos2(15.0, 5.0)), None, "it is hardly seen");
    }

    #[test]
    fn a_head_that_is_not_a_body_is_not_drawn() {
        let head = |around, along, vertices| HeadOnCanvas {
            surface: paint::strokes::SurfaceId::Canvas,
            around,
            along,
            vertices,
        };
        assert!(rings(&head(3, 2, vec![[0.0; 3]; 6])).is_some(), "a small one");
        assert!(rings(&head(3, 2, vec![[0.0; 3]; 5])).is_none(), "a vertex is missing");
        assert!(rings(&head(3, 2, vec![[f32::NAN; 3]; 6])).is_none(), "nowhere");
        assert!(rings(&head(2, 2, vec![[0.0; 3]; 4])).is_none(), "flat");
    }
}
