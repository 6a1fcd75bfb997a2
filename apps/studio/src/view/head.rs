//! The brush head as a cursor: an outline seen from above, clear inside.
//!
//! A dark line with a light one in it, so that it is seen on light and on dark paint. It runs
//! around the whole head, as far as it is bent now, and never over the place that it paints. The
//! handle is a line that begins outside; a dot of the paint on the brush is at its end. A head too
//! small for an outline is a ring with four ticks.

use std::f32::consts::TAU;

use eframe::egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, Vec2, vec2};

use super::outline::offset_outwards;
use super::transform::Placement;
use session::HeadOnCanvas;

/// Distance from the head to the middle of its outline, in points: the line covers no part of it.
const GAP: f32 = 3.5;

/// Widths of the dark line and of the light one in it, in points.
const WIDTHS: [f32; 2] = [3.0, 1.2];

/// The dark line: half transparent, so that it is soft on light paint.
const DARK: Color32 = Color32::from_black_alpha(170);

/// Width of a head on the screen below which it is a ring, in points.
const SMALL: f32 = 12.0;

/// Radius of that ring, and of the ends of its ticks, in points.
const RING: (f32, f32) = (8.0, 13.0);

/// Radius of the dot of paint, in points.
const DOT: f32 = 4.0;

/// Sides of the ring as a polygon.
const RING_PARTS: usize = 40;

/// Length of the handle, in half widths of the head (chosen by eye).
const HANDLE: f32 = 9.0;

/// A ring of vertices around the head: x, y and height, in cells.
type Ring = Vec<[f32; 3]>;

/// The lines of a head in the window, in points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HeadLines {
    /// Lines, and whether each is closed. Each is drawn dark, then light ([`HeadLines::STROKES`]).
    pub lines: Vec<(Vec<Pos2>, bool)>,
    /// Middle and colour of the dot of paint.
    pub dot: Option<(Pos2, [u8; 3])>,
}

impl HeadLines {
    /// Widths in points and colours of the strokes of a line, in the order in which they are drawn.
    pub const STROKES: [(f32, Color32); 2] = [(WIDTHS[0], DARK), (WIDTHS[1], Color32::WHITE)];

    /// Radii in points of the dark disc below the dot of paint, and of the dot.
    pub const DOT: [f32; 2] = [DOT + 1.5, DOT];

    /// The lines of a head over its surface. A head with inconsistent vertex counts or values that
    /// are not finite has none.
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
        let turn = |part: usize| Vec2::angled(TAU * part as f32 / RING_PARTS as f32);
        let circle = (0..RING_PARTS).map(|part| tip + RING.0 * turn(part)).collect();
        let sides = [Vec2::X, Vec2::Y, -Vec2::X, -Vec2::Y];
        let ticks = sides.map(|side| (vec![tip + RING.0 * side, tip + RING.1 * side], false));
        let dot = paint.map(|paint| (tip + vec2(1.0, 1.0) * RING.1, paint));
        Self { lines: [(circle, true)].into_iter().chain(ticks).collect(), dot }
    }

    /// Rectangle of all that is drawn; `None` if there is nothing.
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

/// Splits the vertices into rings from ferrule to tip; `None` if the head is inconsistent.
fn rings(head: &HeadOnCanvas) -> Option<Vec<Ring>> {
    let whole = head.around >= 3 && head.along >= 2;
    let finite = head.vertices.iter().flatten().all(|number| number.is_finite());
    let fits = head.vertices.len() == head.around * head.along;
    (whole && finite && fits)
        .then(|| head.vertices.chunks(head.around).map(<[_]>::to_vec).collect())
}

/// The end of the handle, which goes on where the head begins.
fn handle_end(rings: &[Ring]) -> [f32; 3] {
    let root = mean(&rings[0]);
    let next = mean(&rings[1]);
    let along = subtract(root, next);
    let length = norm(along).max(1e-6);
    let half = rings[0].iter().map(|place: &[f32; 3]| norm(subtract(*place, root))).sum::<f32>()
        / rings[0].len() as f32;
    [0, 1, 2].map(|part: usize| root[part] + HANDLE * half * along[part] / length)
}

/// Where the line from `root` to `end` leaves a convex outline; `None` if `end` is too near to it
/// for a handle to be seen.
fn outside(edge: &[Pos2], root: Pos2, end: Pos2) -> Option<Pos2> {
    let middle = edge.iter().fold(Vec2::ZERO, |sum, at| sum + at.to_vec2()) / edge.len() as f32;
    let is_in = |point: Pos2| {
        (0..edge.len()).all(|at| {
            let from = edge[at];
            let to = edge[(at + 1) % edge.len()];
            let side = |point: Pos2| (to - from).rot90().dot(point - from);
            side(point) * side(middle.to_pos2()) >= 0.0
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
    use eframe::egui::pos2;

    use super::*;

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
