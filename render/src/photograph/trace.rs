//! One stroke's path: along the flow both ways from where it begins.
//!
//! Hertzmann 1998: a curved stroke grows until its colour suits the picture less
//! than what is already there.

use super::plan::Plan;
use graphics::field::Field;
use graphics::orientation::OrientationField;

/// What strokes of one level are traced on, in cells.
pub(super) struct Ground<'a> {
    /// What is wanted, blurred to the brush; CIELAB.
    pub(super) wanted: &'a Field<[f32; 3]>,
    pub(super) flow: &'a OrientationField,
    /// What is still off at each cell; 0 where a stroke of this level lies.
    pub(super) off: &'a Field<f32>,
    /// The brush's width.
    pub(super) size: f64,
}

/// The path of a stroke that begins at `start`: points in cells, at most half a
/// brush apart, none farther from the canvas than that: paint runs over the edge.
pub(super) fn traced(ground: &Ground<'_>, plan: &Plan, start: [f64; 2]) -> Vec<[f64; 2]> {
    let cell = cell(ground.wanted, start);
    let color = ground.wanted[cell];
    let along = ground.flow.direction(cell.0, cell.1);
    let back = half(ground, plan, start, color, along.map(|side| -side));
    let forth = half(ground, plan, start, color, along);
    back.into_iter().rev().chain([start]).chain(forth).collect()
}

/// The points after `start` in one sense.
fn half(
    ground: &Ground<'_>,
    plan: &Plan,
    start: [f64; 2],
    color: [f32; 3],
    mut heading: [f64; 2],
) -> Vec<[f64; 2]> {
    let step = (ground.size / 4.0).max(0.5);
    let steps = |sizes: f64| (sizes * ground.size / 2.0 / step).round() as usize;
    let (least, most) = (steps(plan.shortest).max(1), steps(plan.longest).max(1));
    let mut points = Vec::new();
    let mut place = start;
    while points.len() < most {
        let (x, y) = cell(ground.wanted, place);
        let mut along = ground.flow.direction(x, y);
        if along[0] * heading[0] + along[1] * heading[1] < 0.0 {
            along = along.map(|side| -side);
        }
        let bend = plan.bending;
        let turned: [f64; 2] = std::array::from_fn(|i| bend * along[i] + (1.0 - bend) * heading[i]);
        // Never 0: the two are less than a right angle apart.
        let length = turned[0].hypot(turned[1]);
        heading = turned.map(|side| side / length);
        place = [place[0] + step * heading[0], place[1] + step * heading[1]];
        if beyond(ground, place) > ground.size / 2.0 {
            break;
        }
        let here = cell(ground.wanted, place);
        let departs = distance(ground.wanted[here], color);
        let limit = ground.off[here].min(plan.departure as f32);
        if points.len() >= least && departs >= limit {
            break;
        }
        points.push(place);
    }
    points
}

/// How far a point lies off the canvas, in cells.
fn beyond(ground: &Ground<'_>, [x, y]: [f64; 2]) -> f64 {
    let (width, height) = (ground.wanted.width() as f64, ground.wanted.height() as f64);
    (-x).max(x - width).max(-y).max(y - height)
}

/// The cell that holds a point, or the nearest to one off the canvas.
pub(super) fn cell<T>(field: &Field<T>, [x, y]: [f64; 2]) -> (usize, usize) {
    ((x as usize).min(field.width() - 1), (y as usize).min(field.height() - 1))
}

/// CIE 1976.
pub(super) fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    let [l, u, v]: [f32; 3] = std::array::from_fn(|i| a[i] - b[i]);
    (l * l + u * u + v * v).sqrt()
}
