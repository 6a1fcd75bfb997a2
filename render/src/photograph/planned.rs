//! The strokes of one level: where the painting is off, in the colour wanted
//! there, along the picture's structure.
//!
//! Litwinowicz 1997 and Hertzmann 1998: from coarse to fine brushes, each level
//! against the picture blurred to its brush, and only where what has been painted
//! differs from it.

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use spectra::color::{Lab, RgbSpace};

use super::plan::{Order, Plan};
use super::trace::{Ground, cell, distance, traced};
use graphics::blurred;
use graphics::field::Field;
use graphics::orientation::OrientationField;
use graphics::picture::Picture;
use paint::layer::SLOTS;
use paint::pose::Sample;
use paint::separation::Separation;

/// Width of the blur that a brush sees by, in its sizes.
pub(super) const SIGHT: f64 = 0.2;
/// How often gaps between strokes are looked for.
const PASSES: usize = 3;
/// A stroke covers this share of its brush's width.
pub(super) const COVER: f64 = 0.8;

/// One stroke to be painted.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedStroke {
    /// Which of the plan's brushes.
    pub level: usize,
    /// Shares of the palette's pigments by slot; they sum to 1.
    pub recipe: [f64; SLOTS],
    /// The height in mm that the stroke's paint should have on the canvas.
    pub height_mm: f64,
    /// What to load: the height in mm, over a square of the brush's width, of
    /// the paint that covers the stroke to `height_mm`.
    pub amount_mm: f64,
    /// The path.
    pub samples: Vec<Sample>,
}

/// The strokes of `plan`'s brush number `level`, in the order to be laid.
///
/// `target` and `current` are what is wanted and what has been painted so far,
/// as it looks when dry; each cell is `cell_mm` wide. Differences that the palette
/// cannot mend are left. Without a difference there are no strokes. The same
/// input gives the same strokes.
///
/// # Panics
/// If the pictures differ in size, `level` is none of the plan's, or the plan
/// fails [`Plan::check`].
#[must_use]
pub fn plan_layer(
    target: &Picture,
    current: &Picture,
    separation: &Separation,
    plan: &Plan,
    level: usize,
    cell_mm: f64,
) -> Vec<PlannedStroke> {
    assert_eq!(target.bounds(), current.bounds(), "pictures of one size");
    plan.check().expect("a plan that was checked");
    let size_mm = plan.sizes_mm[level];
    let size = size_mm / cell_mm;
    let blurred_target = blurred(target, SIGHT * size);
    let wanted = perceived(&blurred_target);
    let mut off = differences(&wanted, &blurred_target, current, separation, SIGHT * size);
    let flow = OrientationField::from_lab(&wanted, SIGHT * size);
    let mut random = ChaCha8Rng::seed_from_u64(plan.seed);
    random.set_stream(level as u64);

    let mut paths: Vec<(f32, Vec<[f64; 2]>)> = Vec::new();
    for _ in 0..PASSES {
        for (square, _) in worst_first(&off, plan, size, &mut random) {
            let Some((start, mean)) = square.worst(&off) else { continue };
            if f64::from(mean) <= plan.tolerance {
                continue;
            }
            let ground = Ground { wanted: &wanted, flow: &flow, off: &off, size };
            let path = traced(&ground, plan, start);
            cover(&mut off, &path, COVER * size / 2.0);
            paths.push((mean, path));
        }
    }
    // Stable, so that equals stay in their order.
    paths.sort_by(|a, b| b.0.total_cmp(&a.0));
    paths.truncate(plan.most_strokes);
    paths.shuffle(&mut random);
    let mut strokes: Vec<(f64, PlannedStroke)> = paths
        .par_iter()
        .map(|(_, path)| {
            let color = mean_color(&blurred_target, path);
            let heights = separation.refined_heights_mm(color).map(f64::from);
            let height_mm: f64 = heights.iter().sum();
            let samples = samples(path, plan, size, cell_mm);
            let length = path.windows(2).map(|ends| between(ends[0], ends[1])).sum::<f64>() / size;
            let stroke = PlannedStroke {
                level,
                recipe: heights.map(|height| height / height_mm),
                height_mm,
                amount_mm: height_mm * (length + 1.0),
                samples,
            };
            (separation.film().lab(&heights).lightness, stroke)
        })
        .collect();
    if plan.order == Order::DarkToLight {
        strokes.sort_by_key(|(lightness, _)| (lightness / 5.0).floor() as i64);
    }
    strokes.into_iter().map(|(_, stroke)| stroke).collect()
}

/// A picture in CIELAB under sRGB's white.
fn perceived(picture: &Picture) -> Field<[f32; 3]> {
    let white = RgbSpace::Srgb.white();
    let xyz_from_rgb = RgbSpace::Srgb.xyz_from_linear();
    let lab = |rgb: &[f32; 3]| {
        let xyz = xyz_from_rgb.apply(rgb.map(f64::from)).into();
        Lab::from_xyz(xyz, white).to_array().map(|value| value as f32)
    };
    let values = picture.values().par_iter().with_min_len(1024).map(lab).collect();
    Field::from_values(picture.width(), picture.height(), values)
}

/// How far the painting is from what is wanted or, where that cannot be had,
/// from the nearest that can.
fn differences(
    wanted: &Field<[f32; 3]>,
    blurred_target: &Picture,
    current: &Picture,
    separation: &Separation,
    sigma: f64,
) -> Field<f32> {
    let painted = perceived(&blurred(current, sigma));
    let reached = blurred_target.values().par_iter().with_min_len(1024);
    let reached = reached.map(|&rgb| separation.film().rgb(&separation.heights_mm(rgb))).collect();
    let reached = perceived(&Field::from_values(wanted.width(), wanted.height(), reached));
    let all = wanted.values().iter().zip(reached.values()).zip(painted.values());
    let off = all.map(|((&wanted, &reached), &painted)| {
        distance(wanted, painted).min(distance(reached, painted))
    });
    Field::from_values(wanted.width(), wanted.height(), off.collect())
}

/// A square in which a stroke may begin.
#[derive(Debug, Clone, Copy)]
struct Square {
    x: (usize, usize),
    y: (usize, usize),
}

impl Square {
    /// Its worst point, in cells, the nearest to its middle among nearly equal
    /// ones, and its mean difference; none for an empty square.
    fn worst(&self, off: &Field<f32>) -> Option<([f64; 2], f32)> {
        let middle = [self.x, self.y].map(|(from, to)| (from + to) as f64 / 2.0);
        let reach = between([self.x.0 as f64, self.y.0 as f64], middle);
        let mut sum = 0.0;
        let mut worst = None;
        for y in self.y.0..self.y.1 {
            for x in self.x.0..self.x.1 {
                let place = [x as f64 + 0.5, y as f64 + 0.5];
                let here = off[(x, y)];
                sum += here;
                let counts = f64::from(here) * (1.0 - 0.1 * between(place, middle) / reach);
                if worst.is_none_or(|(value, _)| counts > value) {
                    worst = Some((counts, place));
                }
            }
        }
        let cells = (self.x.1 - self.x.0) * (self.y.1 - self.y.0);
        worst.map(|(_, place)| (place, sum / cells as f32))
    }
}

/// The squares of a grid with jittered lines, the most different first.
fn worst_first(
    off: &Field<f32>,
    plan: &Plan,
    size: f64,
    random: &mut ChaCha8Rng,
) -> Vec<(Square, f32)> {
    let step = (plan.spacing * size).max(1.0);
    let columns = lines(off.width(), step, random);
    let rows = lines(off.height(), step, random);
    let mut squares = Vec::new();
    for y in rows.windows(2) {
        for x in columns.windows(2) {
            let square = Square { x: (x[0], x[1]), y: (y[0], y[1]) };
            if let Some((_, mean)) = square.worst(off) {
                squares.push((square, mean));
            }
        }
    }
    squares.sort_by(|a, b| b.1.total_cmp(&a.1));
    squares
}

/// Lines some `step` apart, each moved by up to a quarter of that; the first
/// and the last are the edges.
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

/// Takes out of `off` what a stroke covers: of each level one coat will do, and
/// what it leaves is for the next.
fn cover(off: &mut Field<f32>, path: &[[f64; 2]], radius: f64) {
    for &[x, y] in path {
        let span = |middle: f64, cells: usize| {
            let from = (middle - radius).max(0.0) as usize;
            from..((middle + radius).ceil() as usize).min(cells)
        };
        for row in span(y, off.height()) {
            for column in span(x, off.width()) {
                let place = [column as f64 + 0.5, row as f64 + 0.5];
                if between(place, [x, y]) <= radius.max(0.5) {
                    off[(column, row)] = 0.0;
                }
            }
        }
    }
}

/// The mean of a picture along a path.
fn mean_color(picture: &Picture, path: &[[f64; 2]]) -> [f32; 3] {
    let mut sum = [0.0; 3];
    for &place in path {
        let color = picture[cell(picture, place)];
        sum.iter_mut().zip(color).for_each(|(sum, value)| *sum += f64::from(value));
    }
    sum.map(|value| (value / path.len() as f64) as f32)
}

/// The pose of the brush along a path, its broad side across the motion, its
/// pressure rising over the first brush size and falling over the last.
pub(super) fn samples(path: &[[f64; 2]], plan: &Plan, size: f64, cell_mm: f64) -> Vec<Sample> {
    let mut walked = vec![0.0];
    for ends in path.windows(2) {
        walked.push(walked[walked.len() - 1] + between(ends[0], ends[1]));
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
            // The nearest of the equal turns, so that the brush never spins.
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

fn between(a: [f64; 2], b: [f64; 2]) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}
