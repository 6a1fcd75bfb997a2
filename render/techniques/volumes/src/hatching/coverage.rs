//! What strokes cover of a tile, and the choice of the one that fills the widest gap.

use super::strokes::{SIDE, Stroke};

/// Sides of the windows through which the tile is seen, as powers of two.
const WINDOWS: usize = 7;

/// Loss of tone up to which a texel of a stroke counts as covered.
const COUNTS_TO: f32 = 0.4;

/// Most texels by which a stroke is moved into the middle of its gap.
const NUDGE: i32 = 8;

/// Texels to either side of a stroke that ought to be free.
const FREE: i32 = 7;

/// Share of a tile that is covered, seen through windows of rising size.
#[derive(Debug)]
pub(super) struct Coverage {
    /// Size at which strokes are drawn.
    size: f32,
    covered: Vec<bool>,
    count: usize,
    /// Covered texels of each window of 1, 2, 4, ... texels a side.
    windows: Vec<Vec<u16>>,
}

impl Coverage {
    /// An empty tile for strokes of one size.
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

    /// The first of the strokes with the least covered around it, and its index.
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

    /// Mean share of what is covered around the middle of a stroke, over windows of all sizes.
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

    /// The stroke moved across, by a few texels at most, into the middle of the gap it lies in.
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
    fn the_best_stroke_lies_in_the_gap_and_is_moved_to_its_middle() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        // All but the rows 192 to 320 are covered.
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
        // Nothing but rows 250 to 262 is free.
        for row in (192..250).chain(262..320) {
            (0..SIDE).for_each(|column| coverage.cover(row * SIDE + column));
        }
        let stroke = Stroke::random(&mut random).at([0.5, 250.0 / SIDE as f32]);
        let middle = coverage.nudged(stroke).middle[1] * SIDE as f32;
        assert!((254.0..258.5).contains(&middle), "{middle}");
    }
}
