//! Strokes of one level: where the canvas differs from the target, in the target's colour,
//! along the structure of the picture.
//!
//! We follow Litwinowicz 1997 and Hertzmann 1998. We go from coarse to fine brushes. Each level
//! compares the canvas with the target blurred to its brush ([`LevelTarget`]), and paints only
//! where they differ. A curved stroke grows both ways from its start ([`trace_path`]) until its
//! colour fits the target less than the canvas does.

use graphics::blurred;
use graphics::encoding::lab_from_linear;
use graphics::field::Field;
use graphics::orientation::OrientationField;
use graphics::picture::Picture;
use paint::layer::SLOTS;
use paint::pose::Sample;
use paint::separation::Separation;
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::settings::{Order, Plan};

/// Number of passes that look for further strokes between those already planned.
const PASSES: usize = 3;
/// Greatest thickness of a stroke in brush widths (chosen by eye).
const THICKEST: f64 = 0.06;
/// Share of the impasto that the first coat has (chosen by eye).
const LEAN: f64 = 0.4;
/// Width that a stroke covers, relative to the width of its brush (chosen by eye).
pub(super) const COVER: f64 = 0.8;

/// A stroke to paint.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedStroke {
    /// Index of the brush in the plan.
    pub level: usize,
    /// Share of the pigment in each slot of the palette. The shares sum to 1.
    pub recipe: [f64; SLOTS],
    /// Height in mm that the paint should have on the canvas.
    pub height_mm: f64,
    /// Amount of paint that covers the stroke to `height_mm`, as a height in mm over a square
    /// as wide as the brush.
    pub amount_mm: f64,
    /// Poses of the brush along the path, without repeated passes.
    pub samples: Vec<Sample>,
}

/// Plans the strokes of the plan's brush number `level`, in the order to paint them.
///
/// `current` is the canvas so far, as it looks when dry. Each cell is `cell_mm` wide.
/// We ignore differences that the palette cannot reduce. Without a difference there are no
/// strokes. Equal input gives equal strokes.
///
/// # Panics
/// If the pictures differ in size, the plan has no brush `level`, or the plan fails
/// [`Plan::check`].
#[must_use]
pub fn plan_layer(
    target: &Picture,
    current: &Picture,
    separation: &Separation,
    plan: &Plan,
    level: usize,
    cell_mm: f64,
) -> Vec<PlannedStroke> {
    plan.check().expect("the plan is valid");
    let target = LevelTarget::new(target, separation, plan.sizes_mm[level] / cell_mm, level);
    plan_strokes(&target, current, separation, plan, cell_mm)
}

/// Plans like [`plan_layer`], for a target that is prepared.
pub(super) fn plan_strokes(
    target: &LevelTarget,
    current: &Picture,
    separation: &Separation,
    plan: &Plan,
    cell_mm: f64,
) -> Vec<PlannedStroke> {
    let LevelTarget { level, size, .. } = *target;
    let difference = target.differences(current);
    let mut random = ChaCha8Rng::seed_from_u64(plan.seed);
    random.set_stream(level as u64);

    let mut bare = difference.clone();
    let mut paths: Vec<(f32, Vec<[f64; 2]>)> = Vec::new();
    for _ in 0..PASSES {
        for (square, _) in worst_first(&bare, plan, size, &mut random) {
            let Some((start, mean)) = square.worst(&bare) else { continue };
            if f64::from(mean) <= plan.tolerance {
                continue;
            }
            let (target, flow) = (&target.lab, &target.flow);
            let input = TraceInput { target, flow, difference: &difference, bare: &bare, size };
            let path = trace_path(&input, plan, start);
            cover(&mut bare, &path, size);
            paths.push((mean, path));
        }
    }
    // The sort is stable, so that equal strokes stay in their order.
    paths.sort_by(|a, b| b.0.total_cmp(&a.0));
    paths.truncate(plan.most_strokes);
    paths.shuffle(&mut random);
    let mut strokes: Vec<(f64, PlannedStroke)> = paths
        .par_iter()
        .map(|(_, path)| {
            let color = mean_color(&target.picture, path);
            let heights = separation.refined_heights_mm(color).map(f64::from);
            let film_mm: f64 = heights.iter().sum();
            let lightness = separation.film().lab(&heights).lightness;
            let height_mm = film_mm.max(impasto_mm(plan, level, lightness));
            let samples = poses(path, plan, size, cell_mm);
            let length =
                path.windows(2).map(|ends| point_distance(ends[0], ends[1])).sum::<f64>() / size;
            let stroke = PlannedStroke {
                level,
                recipe: heights.map(|height| height / film_mm),
                height_mm,
                amount_mm: height_mm * (length + 1.0),
                samples,
            };
            (lightness, stroke)
        })
        .collect();
    if plan.order == Order::DarkToLight {
        strokes.sort_by_key(|(lightness, _)| (lightness / 5.0).floor() as i64);
    }
    strokes.into_iter().map(|(_, stroke)| stroke).collect()
}

/// Least thickness in mm of a stroke of this L* by the brush of `level`. For example, lights stand
/// out, darks are thin, and the first coat is lean.
fn impasto_mm(plan: &Plan, level: usize, lightness: f64) -> f64 {
    let light = (lightness / 100.0).clamp(0.0, 1.0).powi(2);
    let lean = if level == 0 && plan.sizes_mm.len() > 1 { LEAN } else { 1.0 };
    let height_mm = plan.darks_mm + lean * light * (plan.lights_mm - plan.darks_mm);
    height_mm.min(THICKEST * plan.sizes_mm[level])
}

/// A square in which a stroke may begin: first and end column, first and end row.
#[derive(Debug, Clone, Copy)]
struct Square {
    x: (usize, usize),
    y: (usize, usize),
}

impl Square {
    /// Centre of the cell with the largest difference, preferring cells near the centre of the
    /// square, and the mean difference of the square. `None` for an empty square.
    fn worst(&self, difference: &Field<f32>) -> Option<([f64; 2], f32)> {
        let middle = [self.x, self.y].map(|(from, to)| (from + to) as f64 / 2.0);
        let reach = point_distance([self.x.0 as f64, self.y.0 as f64], middle);
        let mut sum = 0.0;
        let mut worst = None;
        for y in self.y.0..self.y.1 {
            for x in self.x.0..self.x.1 {
                let place = [x as f64 + 0.5, y as f64 + 0.5];
                let here = difference[(x, y)];
                sum += here;
                let weighted =
                    f64::from(here) * (1.0 - 0.1 * point_distance(place, middle) / reach);
                if worst.is_none_or(|(value, _)| weighted > value) {
                    worst = Some((weighted, place));
                }
            }
        }
        let cells = (self.x.1 - self.x.0) * (self.y.1 - self.y.0);
        worst.map(|(_, place)| (place, sum / cells as f32))
    }
}

/// Squares of a grid with jittered lines, each with its mean difference, largest difference first.
fn worst_first(
    difference: &Field<f32>,
    plan: &Plan,
    size: f64,
    random: &mut ChaCha8Rng,
) -> Vec<(Square, f32)> {
    let step = (plan.spacing * size).max(1.0);
    let columns = lines(difference.width(), step, random);
    let rows = lines(difference.height(), step, random);
    let mut squares = Vec::new();
    for y in rows.windows(2) {
        for x in columns.windows(2) {
            let square = Square { x: (x[0], x[1]), y: (y[0], y[1]) };
            if let Some((_, mean)) = square.worst(difference) {
                squares.push((square, mean));
            }
        }
    }
    squares.sort_by(|a, b| b.1.total_cmp(&a.1));
    squares
}

/// Positions of grid lines about `step` cells apart, each moved at random by up to a quarter
/// of that. The first and the last are the edges.
fn lines(cells: usize, step: f64, random: &mut ChaCha8Rng) -> Vec<usize> {
    let count = (cells as f64 / step).round().max(1.0);
    let step = cells as f64 / count;
    let mut lines = vec![0];
    for line in 1..count as usize {
        let jitter = random.random_range(-0.25..0.25);
        lines.push(((line as f64 + jitter) * step).round() as usize);
    }
    lines.push(cells);
    lines
}

/// Sets the difference to 0 where a stroke covers the canvas. One coat per level is enough, and the
/// next level paints the rest. This does not apply to the ends of a stroke, where the brush comes
/// down and leaves.
fn cover(difference: &mut Field<f32>, path: &[[f64; 2]], size: f64) {
    let radius = COVER * size / 2.0;
    let apart = path.windows(2).map(|ends| point_distance(ends[0], ends[1])).fold(1e-9, f64::max);
    let end = ((size / 4.0 / apart) as usize).min((path.len() - 1) / 2);
    for &[x, y] in &path[end..path.len() - end] {
        let middles = [(y, difference.height()), (x, difference.width())];
        let [rows, columns] = middles.map(|(middle, cells): (f64, usize)| {
            let from = (middle - radius).max(0.0) as usize;
            from..((middle + radius).ceil().max(0.0) as usize).min(cells)
        });
        for row in rows {
            for column in columns.clone() {
                let place = [column as f64 + 0.5, row as f64 + 0.5];
                if point_distance(place, [x, y]) <= radius.max(0.5) {
                    difference[(column, row)] = 0.0;
                }
            }
        }
    }
}

/// Mean colour of a picture along a path.
fn mean_color(picture: &Picture, path: &[[f64; 2]]) -> [f32; 3] {
    let mut sum = [0.0; 3];
    for &place in path {
        let color = picture[cell(picture, place)];
        sum.iter_mut().zip(color).for_each(|(sum, value)| *sum += f64::from(value));
    }
    sum.map(|value| (value / path.len() as f64) as f32)
}

/// Poses of the brush along a path of points in cells. The broad side lies across the motion.
/// Pressure rises over the first brush width and falls over the last.
pub(super) fn poses(path: &[[f64; 2]], plan: &Plan, size: f64, cell_mm: f64) -> Vec<Sample> {
    let mut walked = vec![0.0];
    for ends in path.windows(2) {
        walked.push(walked[walked.len() - 1] + point_distance(ends[0], ends[1]));
    }
    let length = walked[walked.len() - 1];
    let taper = size.min(length / 2.0).max(1e-9);
    let mut twist_deg = 0.0;
    path.iter()
        .zip(&walked)
        .enumerate()
        .map(|(at, (&[x, y], &so_far))| {
            let before = path[at.saturating_sub(1)];
            let after = path[(at + 1).min(path.len() - 1)];
            let heading = (after[1] - before[1]).atan2(after[0] - before[0]).to_degrees() + 90.0;
            // The nearest of the equivalent angles, so that the brush never spins.
            twist_deg = heading + 180.0 * ((twist_deg - heading) / 180.0_f64).round();
            let rise = (so_far.min(length - so_far) / taper).clamp(0.0, 1.0);
            let eased = rise * rise * (3.0 - 2.0 * rise);
            Sample {
                seconds: so_far / (size * plan.speed),
                x_mm: x * cell_mm,
                y_mm: y * cell_mm,
                pressure: plan.pressure * (plan.ends + (1.0 - plan.ends) * eased),
                tilt_x_deg: 0.0,
                tilt_y_deg: 0.0,
                twist_deg,
            }
        })
        .collect()
}

fn point_distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// Standard deviation of the blur at which pictures are compared, in brush widths (chosen by
/// eye).
pub(super) const BLUR_SIZES: f64 = 0.2;
/// If the target changes by this much in CIELAB over the width of a brush, it counts as detail
/// there (chosen by eye).
const DETAIL: f32 = 16.0;
/// Factor on differences where the target does not change at all (chosen by eye).
const SMOOTH: f32 = 0.5;

/// Everything about the target that the strokes of a level need. It stays the same while the canvas
/// changes.
#[derive(Debug)]
pub(super) struct LevelTarget {
    /// Index of the brush in the plan.
    pub(super) level: usize,
    /// Width of the brush in cells.
    pub(super) size: f64,
    /// Standard deviation in cells of the blur at which pictures are compared.
    pub(super) blur_cells: f64,
    /// The target, blurred.
    pub(super) picture: Picture,
    pub(super) lab: Field<[f32; 3]>,
    /// Directions of its structure.
    pub(super) flow: OrientationField,
    /// CIELAB of the nearest colours that the palette reaches.
    reached: Field<[f32; 3]>,
}

impl LevelTarget {
    /// Prepares `target` for the brush number `level`, which is `size` cells wide.
    pub(super) fn new(target: &Picture, separation: &Separation, size: f64, level: usize) -> Self {
        let blur_cells = BLUR_SIZES * size;
        let picture = blurred(target, blur_cells);
        let lab = lab_from_linear(&picture);
        let flow = OrientationField::from_lab(&lab, blur_cells);
        let colors = picture.values().par_iter().with_min_len(1024);
        let reached = colors.map(|&rgb| separation.film().rgb(&separation.heights_mm(rgb)));
        let reached =
            Field::from_values(picture.width(), picture.height(), reached.collect::<Vec<_>>());
        let reached = lab_from_linear(&reached);
        Self { level, size, blur_cells, picture, lab, flow, reached }
    }

    /// CIELAB difference (CIE 1976) of the canvas from the target or from the nearest colour that
    /// the palette reaches, whichever is less. From the third brush on it counts less where the
    /// target is smooth.
    ///
    /// # Panics
    /// If the pictures differ in size.
    pub(super) fn differences(&self, current: &Picture) -> Field<f32> {
        assert_eq!(self.picture.bounds(), current.bounds(), "pictures differ in size");
        let painted = lab_from_linear(&blurred(current, self.blur_cells));
        let all = self.lab.values().iter().zip(self.reached.values()).zip(painted.values());
        let differences = all.map(|((&target, &reached), &painted)| {
            distance(target, painted).min(distance(reached, painted))
        });
        let width = painted.width();
        let height = painted.height();
        let mut differences = Field::from_values(width, height, differences.collect());
        if self.level > 1 {
            leave_smooth_alone(&mut differences, &self.lab, self.size);
        }
        differences
    }
}

/// Reduces the difference where the target is smooth at the scale of a brush `size` cells wide:
/// there the strokes of broader brushes may stay as they are.
fn leave_smooth_alone(difference: &mut Field<f32>, target_lab: &Field<[f32; 3]>, size: f64) {
    let width = target_lab.width();
    let height = target_lab.height();
    let reach = (size / 2.0).ceil() as usize;
    let changes = (0..width * height).into_par_iter().map(|at: usize| {
        let x = at % width;
        let y = at / width;
        let left = x.saturating_sub(reach);
        let right = (x + reach).min(width - 1);
        let above = y.saturating_sub(reach);
        let below = (y + reach).min(height - 1);
        let across = distance(target_lab[(left, y)], target_lab[(right, y)]);
        let down = distance(target_lab[(x, above)], target_lab[(x, below)]);
        [across.max(down)]
    });
    let changes = blurred(&Field::from_values(width, height, changes.collect()), size / 4.0);
    for (difference, [change]) in difference.values_mut().iter_mut().zip(changes.values()) {
        *difference *= SMOOTH + (1.0 - SMOOTH) * (change / DETAIL).min(1.0);
    }
}

/// Number of brush widths by which a stroke may run over other strokes of its level.
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

/// Path of a stroke from `start`, as points in cells that lie at most half a brush apart. A path
/// that reaches the edge goes on up to a whole brush beyond the canvas, so that the brush lifts off
/// outside.
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
    let [least, most] = [plan.shortest, plan.longest]
        .map(|sizes: f64| ((sizes * input.size / 2.0 / step).round() as usize).max(1));
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

/// Column and row of the cell that holds a point, or of the nearest one for a point off the canvas.
pub(super) fn cell<T>(field: &Field<T>, [x, y]: [f64; 2]) -> (usize, usize) {
    ((x as usize).min(field.width() - 1), (y as usize).min(field.height() - 1))
}

/// Colour difference CIE 1976 of two colours in CIELAB.
pub(super) fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    let [l, u, v]: [f32; 3] = std::array::from_fn(|i| a[i] - b[i]);
    (l * l + u * u + v * v).sqrt()
}
