//! Pencil strokes on a tile that repeats, and the choice of the one that fills the widest gap.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Half the width of a stroke at full pressure, in texels.
const HALF_WIDTH: f32 = 2.1;

/// How far the tone of a stroke's rim lies below that of its middle: a stroke grows from a thin
/// line to its full width while the tone falls by about as much.
pub(super) const RIM: f32 = 0.30;

/// Tone lost from the rim on, for each half width.
const BEYOND: f32 = 1.5;

/// Distance from the middle, in half widths, up to which a stroke says anything about a texel.
const REACH: f32 = 2.0;

/// Points of the hand's wobble along a stroke.
const KNOTS: usize = 6;

/// Most texels along a stroke of the finest level.
const LONGEST: f32 = 120.0;

/// Strokes that are tried for each that is drawn.
const CANDIDATES: usize = 40;

/// A stroke from left to right. Lengths are shares of the tile's side.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stroke {
    start: [f32; 2],
    length: f32,
    /// Fall from start to end.
    slope: f32,
    /// Deviation of the middle from the straight line.
    bow: f32,
    wobble: [f32; KNOTS],
    /// Loss of tone by pressure, at each knot.
    pressure: [f32; KNOTS],
    /// Shares of the length over which the stroke begins and ends.
    ends: [f32; 2],
}

impl Stroke {
    /// A random stroke, as drawn on a tile of `side` texels.
    pub(super) fn random(side: usize, random: &mut ChaCha8Rng) -> Self {
        let texel = 1.0 / side as f32;
        let longest = LONGEST.min(0.85 * side as f32);
        let mut number = |from: f32, to: f32| random.random_range(from..to);
        let length = longest * number(0.4, 1.0) * texel;
        Self {
            start: [number(0.0, 1.0), number(0.0, 1.0)],
            length,
            slope: length * number(-0.04, 0.04),
            bow: length * number(-0.02, 0.02),
            wobble: std::array::from_fn(|_| length * number(-0.007, 0.007)),
            pressure: std::array::from_fn(|_| number(0.0, 0.16)),
            ends: [number(0.05, 0.2), number(0.2, 0.6)],
        }
    }

    /// Calls `visit` with the index of each texel that the stroke touches on a tile of `side`
    /// texels, a power of two, and how far its tone lies below that of the stroke's middle.
    pub(super) fn texels(&self, side: usize, mut visit: impl FnMut(usize, f32)) {
        let texels = side as f32;
        let [left, right] = [self.start[0], self.start[0] + self.length].map(|x| x * texels);
        let mask = side as i32 - 1;
        for column in left.floor() as i32..=right.floor() as i32 {
            let along = ((column as f32 + 0.5 - left) / (right - left)).clamp(0.0, 1.0);
            let middle = self.middle(along) * texels;
            let lost = self.lost(along);
            let reach = REACH * HALF_WIDTH;
            for row in (middle - reach).floor() as i32..=(middle + reach).floor() as i32 {
                let away = (row as f32 + 0.5 - middle) / HALF_WIDTH;
                if away.abs() < REACH {
                    let at = (row & mask) * side as i32 + (column & mask);
                    visit(at as usize, lost + rim(away.abs()));
                }
            }
        }
    }

    /// The middle of the stroke, downwards, `along` 0 to 1 of its length.
    fn middle(&self, along: f32) -> f32 {
        let arc = self.bow * 4.0 * along * (1.0 - along);
        self.start[1] + self.slope * along + arc + between(&self.wobble, along)
    }

    /// Tone lost by pressure and at the ends: it starts firmly and ends in a light flick.
    fn lost(&self, along: f32) -> f32 {
        let [start, end] = self.ends;
        let from_start = (1.0 - along / start).max(0.0);
        let to_end = (1.0 - (1.0 - along) / end).max(0.0);
        let ends = 0.5 * from_start * from_start + 0.7 * to_end * to_end;
        between(&self.pressure, along) + ends
    }
}

/// Tone lost at a distance from the middle, in half widths: slowly within the stroke, fast beyond
/// its rim, so that dark tones are many strokes and not wide ones.
fn rim(away: f32) -> f32 {
    RIM * away * away + BEYOND * (away - 1.0).max(0.0)
}

/// Values at equal steps, joined smoothly.
fn between(knots: &[f32; KNOTS], along: f32) -> f32 {
    let at = along * (KNOTS - 1) as f32;
    let below = (at as usize).min(KNOTS - 2);
    let share = at - below as f32;
    let smooth = share * share * (3.0 - 2.0 * share);
    knots[below] + (knots[below + 1] - knots[below]) * smooth
}

/// Share of a tile that is inked, seen through windows of rising size.
#[derive(Debug)]
pub(super) struct Coverage {
    side: usize,
    inked: Vec<bool>,
    count: usize,
    /// Inked texels of each window of 1, 2, 4, ... texels a side.
    windows: Vec<Vec<u16>>,
}

/// Sides of the windows, as powers of two.
const WINDOWS: usize = 6;

impl Coverage {
    /// The coverage of a tile of `side` texels, a power of two of at least 32, by the texels
    /// that `inked` names.
    pub(super) fn new(side: usize, inked: impl Fn(usize) -> bool) -> Self {
        let windows = (0..WINDOWS).map(|size| vec![0; (side >> size) * (side >> size)]).collect();
        let mut coverage = Self { side, inked: vec![false; side * side], count: 0, windows };
        (0..side * side).filter(|&texel| inked(texel)).for_each(|texel| coverage.ink(texel));
        coverage
    }

    /// Inks a texel.
    pub(super) fn ink(&mut self, texel: usize) {
        if std::mem::replace(&mut self.inked[texel], true) {
            return;
        }
        self.count += 1;
        let (x, y) = (texel % self.side, texel / self.side);
        for (size, window) in self.windows.iter_mut().enumerate() {
            window[(y >> size) * (self.side >> size) + (x >> size)] += 1;
        }
    }

    /// Share of the tile that is inked.
    pub(super) fn share(&self) -> f32 {
        self.count as f32 / self.inked.len() as f32
    }

    /// Mean share of ink around the middle of a stroke, over windows of all sizes.
    fn around(&self, stroke: &Stroke) -> f32 {
        let texels = self.side as f32;
        let mask = self.side as i32 - 1;
        let steps = ((stroke.length * texels / 3.0) as usize).max(4);
        let mut sum = 0.0;
        for step in 0..steps {
            let along = (step as f32 + 0.5) / steps as f32;
            let x = ((stroke.start[0] + stroke.length * along) * texels).floor() as i32 & mask;
            let y = (stroke.middle(along) * texels).floor() as i32 & mask;
            for (size, window) in self.windows.iter().enumerate() {
                let at = (y as usize >> size) * (self.side >> size) + (x as usize >> size);
                sum += f32::from(window[at]) / (1_u32 << (2 * size)) as f32;
            }
        }
        sum / steps as f32
    }

    /// The one of several random strokes with the least ink around it.
    pub(super) fn best_stroke(&self, random: &mut ChaCha8Rng) -> Stroke {
        let mut best = Stroke::random(self.side, random);
        let mut least = self.around(&best);
        for _ in 1..CANDIDATES {
            let stroke = Stroke::random(self.side, random);
            let found = self.around(&stroke);
            if found < least {
                (best, least) = (stroke, found);
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    #[test]
    fn a_stroke_runs_along_u_and_repeats_across_the_border() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        for side in [32, 256] {
            let mut stroke = Stroke::random(side, &mut random);
            stroke.start = [1.0 - 0.5 * stroke.length, 0.999];
            let mut columns = vec![false; side];
            let mut rows = vec![false; side];
            stroke.texels(side, |texel, lost| {
                assert!(lost >= 0.0, "{lost}");
                columns[texel % side] = true;
                rows[texel / side] = true;
            });
            assert!(columns[0] && columns[side - 1] && rows[0] && rows[side - 1], "{side}");
            let [wide, high] = [columns, rows].map(|seen| seen.iter().filter(|&&at| at).count());
            assert!(wide as f32 >= stroke.length * side as f32 && high < 20, "{wide} {high}");
        }
    }

    #[test]
    fn the_best_stroke_lies_in_the_gap() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        // All but the rows 96 to 160 are inked.
        let coverage = Coverage::new(256, |texel| !(96..160).contains(&(texel / 256)));
        assert!((coverage.share() - 0.75).abs() < 1e-6);
        for _ in 0..10 {
            let stroke = coverage.best_stroke(&mut random);
            let middle = stroke.middle(0.5) * 256.0;
            assert!((92.0..164.0).contains(&middle), "{middle}");
        }
    }
}
