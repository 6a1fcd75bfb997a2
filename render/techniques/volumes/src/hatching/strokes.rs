//! Pencil strokes on a tile that repeats. Also records which texels of a tile strokes cover, and
//! chooses the stroke that fills the widest gap.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Texels along the side of a tile.
pub const SIDE: usize = 512;

/// Width of a stroke of size 1 in texels, as you see it at middle tones.
pub(super) const WIDTH_TEXELS: f32 = 4.0;

/// Half the width of a stroke of size 1 at full pressure, as a share of the tile's side.
const HALF_WIDTH: f32 = 2.02 / SIDE as f32;

/// How far the tone of a stroke's rim lies below the tone of its middle. A stroke grows from a
/// thin line to its full width while the tone falls by about as much.
const RIM: f32 = 0.05;

/// A stroke loses this much tone per half width beyond its rim.
const BEYOND: f32 = 1.6;

/// A stroke reaches this far from its middle, in half widths. It does not affect texels beyond
/// this.
const REACH: f32 = 2.0;

/// Number of points along a stroke at which the wobble and the pressure of the hand are given.
const KNOTS: usize = 6;

/// Lengths of strokes, as shares of the tile's side.
const LENGTHS: [f32; 2] = [44.0 / SIDE as f32, 128.0 / SIDE as f32];

/// A stroke from left to right, of size 1. Lengths are shares of the tile's side.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stroke {
    pub(super) middle: [f32; 2],
    length: f32,
    slope: f32,
    /// How far the middle line bends away from the straight one.
    bow: f32,
    wobble: [f32; KNOTS],
    /// Tone that pressure takes away at each knot.
    pressure: [f32; KNOTS],
    /// Shares of the length over which the stroke begins and ends.
    ends: [f32; 2],
}

impl Stroke {
    pub(super) fn random(random: &mut ChaCha8Rng) -> Self {
        let mut number = |from: f32, to: f32| random.random_range(from..to);
        let length = number(LENGTHS[0], LENGTHS[1]);
        Self {
            middle: [number(0.0, 1.0), number(0.0, 1.0)],
            length,
            slope: length * number(-0.05, 0.05),
            bow: length * number(-0.025, 0.025),
            wobble: std::array::from_fn(|_| length * number(-0.006, 0.006)),
            pressure: std::array::from_fn(|_| number(0.0, 0.16)),
            ends: [number(0.05, 0.2), number(0.2, 0.6)],
        }
    }

    pub(super) fn at(&self, middle: [f32; 2]) -> Self {
        Self { middle, ..self.clone() }
    }

    pub(super) fn half_way(&self, other: &Self) -> Self {
        fn mean(from: f32, to: f32) -> f32 {
            0.5 * (from + to)
        }
        fn knots(from: &[f32; KNOTS], to: &[f32; KNOTS]) -> [f32; KNOTS] {
            std::array::from_fn(|knot| mean(from[knot], to[knot]))
        }
        Self {
            middle: [0, 1].map(|axis| mean(self.middle[axis], other.middle[axis])),
            length: mean(self.length, other.length),
            slope: mean(self.slope, other.slope),
            bow: mean(self.bow, other.bow),
            wobble: knots(&self.wobble, &other.wobble),
            pressure: knots(&self.pressure, &other.pressure),
            ends: [0, 1].map(|end| mean(self.ends[end], other.ends[end])),
        }
    }

    /// Calls `visit` for each texel that the stroke touches if you draw it at a `size`. It gets
    /// the index of the texel, and how far its tone lies below the tone of the stroke's middle.
    pub(super) fn texels(&self, size: f32, mut visit: impl FnMut(usize, f32)) {
        let texels = SIDE as f32;
        let [left, right] = [0.0, 1.0].map(|along| self.place(along, size)[0] * texels);
        let half_width = HALF_WIDTH * size * texels;
        let mask = SIDE as i32 - 1;
        for column in left.floor() as i32..=right.floor() as i32 {
            let along = ((column as f32 + 0.5 - left) / (right - left)).clamp(0.0, 1.0);
            let middle = self.place(along, size)[1] * texels;
            let lost = self.lost(along);
            let reach = REACH * half_width;
            for row in (middle - reach).floor() as i32..=(middle + reach).floor() as i32 {
                let away = (row as f32 + 0.5 - middle).abs() / half_width;
                if away < REACH {
                    let at = (row & mask) * SIDE as i32 + (column & mask);
                    visit(at as usize, lost + rim(away));
                }
            }
        }
    }

    /// The point on the middle line of the stroke at `along`, 0 to 1 of its length, if the stroke
    /// is drawn at this `size`.
    pub(super) fn place(&self, along: f32, size: f32) -> [f32; 2] {
        let arc = self.bow * (4.0 * along * (1.0 - along) - 0.67);
        let down = self.slope * (along - 0.5) + arc + interpolated(&self.wobble, along);
        [self.middle[0] + size * self.length * (along - 0.5), self.middle[1] + size * down]
    }

    /// Points along the stroke of a `size`, about three texels apart.
    pub(super) fn points(&self, size: f32) -> impl Iterator<Item = [i32; 2]> + '_ {
        let steps = ((self.length * size * SIDE as f32 / 3.0) as usize).max(4);
        (0..steps).map(move |step| {
            let along = (step as f32 + 0.5) / steps as f32;
            self.place(along, size).map(|at| (at * SIDE as f32).floor() as i32)
        })
    }

    /// Tone lost by pressure and at the ends. The stroke starts firmly and ends in a light flick.
    fn lost(&self, along: f32) -> f32 {
        let [start, end] = self.ends;
        let from_start = (1.0 - along / start).max(0.0);
        let to_end = (1.0 - (1.0 - along) / end).max(0.0);
        let ends = 0.4 * from_start * from_start + 0.6 * to_end * to_end;
        interpolated(&self.pressure, along) + ends
    }
}

/// Tone lost at a distance from the middle, in half widths. It falls slowly within the stroke and
/// fast beyond its rim. This makes dark tones many strokes instead of wide ones.
fn rim(away: f32) -> f32 {
    if away < 1.0 { RIM * away * away } else { RIM + BEYOND * (away - 1.0) }
}

fn interpolated(knots: &[f32; KNOTS], along: f32) -> f32 {
    let at = along * (KNOTS - 1) as f32;
    let below = (at as usize).min(KNOTS - 2);
    let share = at - below as f32;
    let smooth = share * share * (3.0 - 2.0 * share);
    knots[below] + (knots[below + 1] - knots[below]) * smooth
}

/// Number of sizes of the windows in which we count covered texels. Their sides are 1, 2, 4 .. 64
/// texels.
const WINDOWS: usize = 7;

/// A stroke covers a texel if its tone there is less than this below the stroke's own tone.
const COUNTS_TO: f32 = 0.4;

/// We move a stroke by at most this many texels into the middle of its gap.
const NUDGE: i32 = 8;

/// We want this many texels free to either side of a stroke.
const FREE: i32 = 7;

/// The texels of a tile that strokes cover, counted in windows of several sizes.
#[derive(Debug)]
pub(super) struct Coverage {
    size: f32,
    covered: Vec<bool>,
    count: usize,
    /// Covered texels of each window of 1, 2, 4, ... texels per side.
    windows: Vec<Vec<u16>>,
}

impl Coverage {
    pub(super) fn new(size: f32) -> Self {
        let windows = (0..WINDOWS).map(|size| vec![0; (SIDE >> size) * (SIDE >> size)]).collect();
        Self { size, covered: vec![false; SIDE * SIDE], count: 0, windows }
    }

    pub(super) fn draw(&mut self, stroke: &Stroke) {
        stroke.texels(self.size, |texel, lost| {
            if lost < COUNTS_TO {
                self.cover(texel);
            }
        });
    }

    fn cover(&mut self, texel: usize) {
        if std::mem::replace(&mut self.covered[texel], true) {
            return;
        }
        self.count += 1;
        let x = texel % SIDE;
        let y = texel / SIDE;
        for (size, window) in self.windows.iter_mut().enumerate() {
            window[(y >> size) * (SIDE >> size) + (x >> size)] += 1;
        }
    }

    /// Share of the tile that is covered.
    pub(super) fn share(&self) -> f32 {
        self.count as f32 / self.covered.len() as f32
    }

    /// The stroke around which the least is covered, and its index. If there are several, this is
    /// the first.
    pub(super) fn best(&self, strokes: impl Iterator<Item = Stroke>) -> Option<(usize, Stroke)> {
        let mut best = None;
        let mut least = f32::INFINITY;
        for (index, stroke) in strokes.enumerate() {
            let found = self.around(&stroke);
            if found < least {
                (best, least) = (Some((index, stroke)), found);
            }
        }
        best
    }

    /// Mean share that is covered around the middle line of a stroke, over windows of all sizes.
    fn around(&self, stroke: &Stroke) -> f32 {
        let mask = SIDE as i32 - 1;
        let mut sum = 0.0;
        let mut points = 0.0;
        for [x, y] in stroke.points(self.size) {
            let x = (x & mask) as usize;
            let y = (y & mask) as usize;
            for (size, window) in self.windows.iter().enumerate() {
                let at = (y >> size) * (SIDE >> size) + (x >> size);
                sum += f32::from(window[at]) / (1_u32 << (2 * size)) as f32;
            }
            points += 1.0;
        }
        sum / points
    }

    /// Moves the stroke across, by a few texels at most, into the middle of its gap.
    pub(super) fn nudged(&self, stroke: Stroke) -> Stroke {
        let mask = SIDE as i32 - 1;
        // Covered texels at every distance across.
        let mut across = [0_u32; (2 * (NUDGE + FREE) + 1) as usize];
        for [x, y] in stroke.points(self.size) {
            for (offset, count) in (-NUDGE - FREE..).zip(&mut across) {
                let texel = ((y + offset) & mask) * SIDE as i32 + (x & mask);
                *count += u32::from(self.covered[texel as usize]);
            }
        }
        let crowd = |by: i32| -> f32 {
            (-FREE..=FREE)
                .map(|offset| {
                    let covered = across[(by + offset + NUDGE + FREE) as usize] as f32;
                    covered / (2 + offset.abs()) as f32
                })
                .sum()
        };
        let mut by = 0;
        for distance in 1..=NUDGE {
            for other in [distance, -distance] {
                by = if crowd(other) < crowd(by) { other } else { by };
            }
        }
        let [x, y] = stroke.middle;
        stroke.at([x, y + by as f32 / SIDE as f32])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn a_stroke_runs_along_u_and_repeats_across_the_border() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        for size in [1.0, 0.6] {
            let stroke = Stroke::random(&mut random).at([1.0, 0.999]);
            let mut columns = vec![false; SIDE];
            let mut rows = vec![false; SIDE];
            stroke.texels(size, |texel, lost| {
                assert!(lost >= 0.0, "{lost}");
                columns[texel % SIDE] = true;
                rows[texel / SIDE] = true;
            });
            assert!(columns[0] && columns[SIDE - 1] && rows[0] && rows[SIDE - 1], "{size}");
            let [wide, high] = [columns, rows].map(|seen| seen.iter().filter(|&&at| at).count());
            let length = stroke.length * size * SIDE as f32;
            assert!((wide as f32 - length).abs() < 2.0 && high < 20, "{wide} {length} {high}");
        }
    }

    #[test]
    fn a_stroke_passes_into_another() {
        let mut random = ChaCha8Rng::seed_from_u64(9);
        let [from, to] = [0, 1].map(|_| Stroke::random(&mut random));
        assert_eq!(from.half_way(&from), from);
        let half = from.half_way(&to);
        for along in [0.0, 0.3, 1.0] {
            let [a, b, between] = [&from, &to, &half].map(|stroke| stroke.place(along, 0.7));
            for axis in 0..2 {
                assert!((between[axis] - 0.5 * (a[axis] + b[axis])).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn the_best_stroke_lies_in_the_gap_and_is_moved_to_its_middle() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        // All rows are covered except 192 to 320.
        let mut coverage = Coverage::new(1.0);
        (0..SIDE * SIDE)
            .filter(|texel| !(192..320).contains(&(texel / SIDE)))
            .for_each(|texel| coverage.cover(texel));
        assert!((coverage.share() - 0.75).abs() < 1e-6);
        for _ in 0..10 {
            let strokes = (0..40).map(|_| Stroke::random(&mut random));
            let (_, best) = coverage.best(strokes).unwrap();
            let middle = best.middle[1] * SIDE as f32;
            assert!((190.0..322.0).contains(&middle), "{middle}");
        }
        // Only rows 250 to 262 are free.
        for row in (192..250).chain(262..320) {
            (0..SIDE).for_each(|column| coverage.cover(row * SIDE + column));
        }
        let stroke = Stroke::random(&mut random).at([0.5, 250.0 / SIDE as f32]);
        let middle = coverage.nudged(stroke).middle[1] * SIDE as f32;
        assert!((254.0..258.5).contains(&middle), "{middle}");
    }
}
