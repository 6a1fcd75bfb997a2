//! Path of one stroke: along the structure of the picture, both ways from its start.
//!
//! After Hertzmann 1998: a curved stroke grows until its colour fits the target less than the
//! canvas does.

use super::plan::Plan;
use graphics::field::Field;
use graphics::orientation::OrientationField;

/// Brush widths that a stroke runs on over others of its level.
const OVERLAP: f64 = 1.0;

/// Greatest turn of a stroke in radians over a brush width: in tighter bends the outer side of the
/// brush would skip cells.
const TIGHTEST: f64 = 1.0;

/// Pictures that the strokes of one level are traced on. Lengths are in cells.
pub(super) struct TraceInput<'a> {
    /// Target in CIELAB, blurred to the scale of the brush.
    pub(super) target: &'a Field<[f32; 3]>,
    /// Structure of the target.
    pub(super) flow: &'a OrientationField,
    /// CIELAB difference of the canvas from the target, before this level.
    pub(super) difference: &'a Field<f32>,
    /// That difference, but 0 where a stroke of this level lies.
    pub(super) bare: &'a Field<f32>,
    /// Width of the brush in cells.
    pub(super) size: f64,
}

/// Path of a stroke from `start`, as points in cells that lie at most half a brush apart.
/// Points lie up to a whole brush beyond the canvas, so that the brush leaves only there.
pub(super) fn trace_path(input: &TraceInput<'_>, plan: &Plan, start: [f64; 2]) -> Vec<[f64; 2]> {
    let cell = cell(input.target, start);
    let color = input.target[cell];
    let along = input.flow.direction(cell.0, cell.1);
    let back = half_path(input, plan, start, color, along.map(|side| -side));
    let forth = half_path(input, plan, start, color, along);
    back.into_iter().rev().chain([start]).chain(forth).collect()
}

/// Points after `start` in one of the two directions.
fn half_path(
    input: &TraceInput<'_>,
    plan: &Plan,
    start: [f64; 2],
    color: [f32; 3],
    mut heading: [f64; 2],
) -> Vec<[f64; 2]> {
    let step = (input.size / 4.0).max(0.5);
    let steps = |sizes: f64| (sizes * input.size / 2.0 / step).round() as usize;
    let least = steps(plan.shortest).max(1);
    let most = steps(plan.longest).max(1);
    let mut painted = 0.0;
    let mut points = Vec::new();
    let mut place = start;
    while points.len() < most {
        let (x, y) = cell(input.target, place);
        let mut along = input.flow.direction(x, y);
        if along[0] * heading[0] + along[1] * heading[1] < 0.0 {
            along = along.map(|side| -side);
        }
        let bend = plan.bending;
        let turned: [f64; 2] = std::array::from_fn(|i| bend * along[i] + (1.0 - bend) * heading[i]);
        heading = turned_to(heading, turned, TIGHTEST * step / input.size);
        place = [place[0] + step * heading[0], place[1] + step * heading[1]];
        if beyond(input, place) > input.size {
            break;
        }
        let here = cell(input.target, place);
        let departs = distance(input.target[here], color);
        let limit = input.difference[here].min(plan.departure as f32);
        painted = if input.bare[here] > 0.0 { 0.0 } else { painted + step };
        let again = painted > OVERLAP * input.size;
        if points.len() >= least && (departs >= limit || again) {
            break;
        }
        points.push(place);
    }
    points
}

/// Unit vector `heading`, turned towards the direction of `to` by at most `most` radians.
fn turned_to(heading: [f64; 2], to: [f64; 2], most: f64) -> [f64; 2] {
    let across = heading[0] * to[1] - heading[1] * to[0];
    let along = heading[0] * to[0] + heading[1] * to[1];
    let (sin, cos) = across.atan2(along).clamp(-most, most).sin_cos();
    [heading[0] * cos - heading[1] * sin, heading[0] * sin + heading[1] * cos]
}

/// Distance of a point from the canvas in cells, 0 or less within it.
fn beyond(input: &TraceInput<'_>, [x, y]: [f64; 2]) -> f64 {
    let width = input.target.width() as f64;
    let height = input.target.height() as f64;
    (-x).max(x - width).max(-y).max(y - height)
}

/// Column and row of the cell that holds a point; for a point off the canvas, the nearest.
pub(super) fn cell<T>(field: &Field<T>, [x, y]: [f64; 2]) -> (usize, usize) {
    ((x as usize).min(field.width() - 1), (y as usize).min(field.height() - 1))
}

/// Colour difference CIE 1976 of two colours in CIELAB.
pub(super) fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    let [l, u, v]: [f32; 3] = std::array::from_fn(|i| a[i] - b[i]);
    (l * l + u * u + v * v).sqrt()
}
