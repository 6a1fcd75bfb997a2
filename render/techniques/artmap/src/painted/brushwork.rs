//! Strokes of a swatch, from a style and a seed.
//!
//! Strokes run along y, from top to bottom. Places are those of a jittered grid, so that strokes
//! cover evenly; everything that differs from stroke to stroke is drawn from the seed alone.

use paint::Sample;
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::plan::{Layout, Style};

/// Knots of the pattern of a half-mixed brush around its head.
pub(super) const KNOTS: usize = 20;
/// Steps of ranks from column to column and from row to row: Roberts' sequence R2 (2018), whose
/// first numbers below any share lie evenly on the plane.
const RANK_STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
/// Points of a stroke's path for each width of the brush.
const POINTS: f64 = 2.0;
/// Speed of the hand in brush widths a second. Time only orders the samples.
const SPEED: f64 = 10.0;

/// A stroke of a swatch. Its paint is relative to the tone that it is painted in.
#[derive(Debug, Clone, PartialEq)]
pub struct SwatchStroke {
    /// Coat of the stroke, from 0.
    pub coat: u32,
    /// Rank among all strokes, 0 to 1: a tone of density `share` has the strokes below it.
    pub rank: f64,
    /// Poses of the brush, in mm from the corner of the canvas.
    pub samples: Vec<Sample>,
    /// L* of the stroke relative to its tone.
    pub lightness: f64,
    /// L* around the head relative to that of the stroke, at knots that are evenly spaced.
    pub streaks: Vec<f64>,
    /// Height of the paint on the head in mm.
    pub load_mm: f64,
}

/// Strokes on the canvas of a swatch with its margins, in the order in which they are painted.
#[must_use]
pub fn strokes(style: &Style, seed: u64) -> Vec<SwatchStroke> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (across, along) = style.margins();
    let side = style.canvas.side_cells;
    let mm = |cells: usize| cells as f64 * style.canvas.cell_mm;
    let size = [mm(side + 2 * across), mm(side + 2 * along)];
    let inner = [mm(along), mm(along + side)];
    let mut all = Vec::new();
    for coat in 0..style.strokes.coats {
        let mut strokes = coat_strokes(style, coat, size, &mut random);
        // A stroke that does not reach the swatch would only cost time.
        strokes.retain(|stroke| {
            stroke.samples.iter().any(|sample: &Sample| {
                let reach = style.brush.size_mm;
                (inner[0] - reach..inner[1] + reach).contains(&sample.y_mm)
            })
        });
        if style.strokes.layout == Layout::Scatter {
            strokes.shuffle(&mut random);
        }
        all.append(&mut strokes);
    }
    all
}

/// Strokes of one coat over a canvas of `width` x `height` mm, column by column.
fn coat_strokes(
    style: &Style,
    coat: u32,
    [width, height]: [f64; 2],
    random: &mut ChaCha8Rng,
) -> Vec<SwatchStroke> {
    let plan = &style.strokes;
    let columns = (width / plan.spacing_mm).ceil() as i64;
    let rows = (height / plan.advance_mm).ceil() as i64 + 1;
    // Strokes of a coat lie between those of the coat before.
    let shift = 0.5 * f64::from(coat % 2);
    let mut strokes = Vec::new();
    for column in 0..columns {
        let phase = (plan.stagger * column as f64).fract() + shift;
        for row in -1..rows {
            let x = (column as f64 + 0.5 + shift) * plan.spacing_mm;
            let y = (row as f64 + 0.5 + phase) * plan.advance_mm;
            let mut jitter = |mm: f64| plan.jitter * mm * random.random_range(-0.5..=0.5);
            let middle = [x + jitter(plan.spacing_mm), y + jitter(plan.advance_mm)];
            let [step, down] = RANK_STEPS;
            let rank = (step * column as f64 + down * (row + 1) as f64).fract();
            strokes.push(stroke(style, coat, rank, middle, random));
        }
    }
    strokes
}

/// One stroke about `middle`, in mm.
fn stroke(
    style: &Style,
    coat: u32,
    rank: f64,
    middle: [f64; 2],
    random: &mut ChaCha8Rng,
) -> SwatchStroke {
    let plan = &style.strokes;
    let paint = &style.paint;
    let mut about = |spread: f64| spread * random.random_range(-1.0..=1.0);
    let length = plan.length_mm * (1.0 + about(plan.length_spread));
    // The sum of three even numbers is nearly normal, with a standard deviation of 1.
    let angle = (0..3).map(|_| about(1.0)).sum::<f64>() * plan.angle_deg.to_radians();
    let sagitta = about(plan.bend) * length;
    let pressure = (plan.pressure * (1.0 + about(plan.pressure_spread))).clamp(0.0, 1.0);
    let lightness = about(paint.lightness_spread);
    let load_mm = paint.load_mm * (1.0 + about(paint.load_spread));
    let streaks = (0..KNOTS).map(|_| about(paint.streaks)).collect();
    let samples = samples(style, middle, [length, angle, sagitta, pressure]);
    SwatchStroke { coat, rank, samples, lightness, streaks, load_mm }
}

/// Poses along an arc from top to bottom. The broad side of the brush lies across the motion;
/// pressure falls towards both ends over a brush width.
fn samples(
    style: &Style,
    [x, y]: [f64; 2],
    [length, angle, sagitta, pressure]: [f64; 4],
) -> Vec<Sample> {
    let size = style.brush.size_mm;
    let points = (POINTS * length / size).ceil().clamp(4.0, 200.0);
    let taper = size.min(length / 2.0);
    let (sin, cos) = angle.sin_cos();
    let pose = |at: usize| {
        let share = at as f64 / points;
        let along = length * (share - 0.5);
        let across = sagitta * (1.0 - (2.0 * share - 1.0).powi(2));
        let slope = -4.0 * sagitta * (2.0 * share - 1.0) / length;
        let rise = ((share.min(1.0 - share) * length) / taper).clamp(0.0, 1.0);
        let eased = rise * rise * (3.0 - 2.0 * rise);
        Sample {
            seconds: share * length / (size * SPEED),
            x_mm: x + across * cos + along * sin,
            y_mm: y + along * cos - across * sin,
            pressure: pressure * (style.strokes.lift + (1.0 - style.strokes.lift) * eased),
            tilt_x_deg: 0.0,
            tilt_y_deg: 0.0,
            // At 0 the broad side runs along x; the head turns with the heading.
            twist_deg: -(angle + slope.atan()).to_degrees(),
        }
    };
    (0..=points as usize).map(pose).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn style(name: &str) -> Style {
        let mut style = Style::named(name).unwrap();
        style.canvas.side_cells = 120;
        style
    }

    #[test]
    fn the_same_seed_gives_the_same_strokes_and_another_seed_others() {
        for name in Style::ALL {
            let style = style(name);
            assert_eq!(strokes(&style, 5), strokes(&style, 5), "{name}");
            assert_ne!(strokes(&style, 5), strokes(&style, 6), "{name}");
        }
    }

    #[test]
    fn strokes_run_down_within_their_spread_and_stay_evenly_spaced() {
        for name in Style::ALL {
            let style = style(name);
            let made = strokes(&style, 3);
            let (across, _) = style.margins();
            let mm = (120 + 2 * across) as f64 * style.canvas.cell_mm;
            for stroke in &made {
                let ends = [stroke.samples[0], stroke.samples[stroke.samples.len() - 1]];
                let way = [ends[1].x_mm - ends[0].x_mm, ends[1].y_mm - ends[0].y_mm];
                let length = way[0].hypot(way[1]) / style.strokes.length_mm;
                let spread = style.strokes.length_spread + 1e-9;
                assert!((length - 1.0).abs() <= spread, "{name}: {length}");
                let most = 3.0 * style.strokes.angle_deg.to_radians() + 1e-9;
                assert!(way[0].atan2(way[1]).abs() <= most, "{name}: {way:?}");
            }
            let columns = (mm / style.strokes.spacing_mm).ceil();
            let first = made.iter().filter(|stroke| stroke.coat == 0).count() as f64;
            assert!(first >= columns, "{name}: {first} strokes in {columns} columns");
        }
    }

    #[test]
    fn heads_turn_with_a_bent_stroke() {
        let mut style = style("oil-long");
        (style.strokes.bend, style.strokes.angle_deg) = (0.2, 0.0);
        for stroke in strokes(&style, 1) {
            for pair in stroke.samples.windows(2) {
                let way = [pair[1].x_mm - pair[0].x_mm, pair[1].y_mm - pair[0].y_mm];
                let heading = -way[0].atan2(way[1]).to_degrees();
                let twist = (pair[0].twist_deg + pair[1].twist_deg) / 2.0;
                assert!((twist - heading).abs() < 2.0, "{twist} for {heading}");
            }
        }
    }

    #[test]
    fn ranks_thin_the_strokes_out_evenly() {
        let mut style = style("hatching");
        style.canvas.side_cells = 600;
        let made = strokes(&style, 1);
        for share in [0.1, 0.35, 0.7] {
            let kept = made.iter().filter(|stroke| stroke.rank < share).count();
            let found = kept as f64 / made.len() as f64;
            assert!((found - share).abs() < 0.04, "{share}: {found}");
        }
    }
}
