//! A texture of thresholds: every texel holds the lightest tone at which it is inked.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::strokes::{Coverage, RIM};

/// Number of levels of detail.
pub const LEVELS: usize = 4;

/// Texels along the side of the coarsest level.
pub const COARSEST_SIDE: usize = 32;

/// Texels along the side of the finest level.
pub const FINEST_SIDE: usize = COARSEST_SIDE << (LEVELS - 1);

/// Tones at which strokes are added, from light to dark.
const STEPS: usize = 64;

/// Share of a tile that strokes cover in the end. What is left between them comes last.
const COVERED: f32 = 0.97;

/// Most tone that the grain of the paper takes from a texel.
const GRAIN: f32 = 0.30;

/// Thresholds of pencil strokes along u on a tile that repeats, in [`LEVELS`] levels of 32 to 256
/// texels a side whose strokes have one width in texels.
///
/// A texel is inked at all tones below its threshold (tone 0 is black, 1 is white), so the ink of
/// a lighter tone is part of that of every darker one. The strokes of a level are kept in all
/// finer ones. The thresholds of a level are spread evenly over 0 to 1, so the share of inked
/// texels at tone t is 1 - t.
#[derive(Debug, Clone, PartialEq)]
pub struct ThresholdTexture {
    quads: Vec<u32>,
}

impl ThresholdTexture {
    /// Draws the strokes of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let levels = raw_levels(seed);
        let quads: Vec<Vec<u32>> = levels
            .par_iter()
            .enumerate()
            .map(|(level, raw)| quads_of(&evenly_spread(raw, side_of(level), seed), side_of(level)))
            .collect();
        Self { quads: quads.concat() }
    }

    /// Threshold of a texel, in 1/255; coordinates wrap around.
    ///
    /// # Panics
    /// If `level` is not below [`LEVELS`].
    #[must_use]
    pub fn threshold(&self, level: usize, column: usize, row: usize) -> u8 {
        let side = side_of(level);
        let [own, ..] =
            self.quads[first_of(level) + (row % side) * side + column % side].to_le_bytes();
        own
    }

    /// For each texel of all levels, coarsest first and row by row: its threshold in the lowest
    /// byte, then those of the texels to the right, below, and below to the right. One number
    /// holds what an interpolated value needs.
    #[must_use]
    pub fn quads(&self) -> &[u32] {
        &self.quads
    }
}

/// Texels along the side of a level.
fn side_of(level: usize) -> usize {
    COARSEST_SIDE << level
}

/// Index of the first texel of a level among all.
fn first_of(level: usize) -> usize {
    (0..level).map(|level| side_of(level).pow(2)).sum()
}

/// Tones of all texels of each level, before they are spread evenly; greater is lighter.
fn raw_levels(seed: u64) -> [Vec<f32>; LEVELS] {
    let mut random: [ChaCha8Rng; LEVELS] = std::array::from_fn(|level| {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(level as u64);
        random
    });
    let mut raw: [Vec<f32>; LEVELS] =
        std::array::from_fn(|level| vec![f32::NEG_INFINITY; side_of(level).pow(2)]);
    for step in 1..=STEPS {
        let tone = 1.0 - step as f32 / STEPS as f32;
        for level in 0..LEVELS {
            let mut coverage = Coverage::new(side_of(level), |texel| raw[level][texel] >= tone);
            while coverage.share() < (1.0 - tone).min(COVERED) {
                let stroke = coverage.best_stroke(&mut random[level]);
                // A stroke is half as wide when it is first seen.
                let core = tone + RIM / 4.0;
                for (finer, raw) in raw.iter_mut().enumerate().skip(level) {
                    stroke.texels(side_of(finer), |texel, lost| {
                        let value = core - lost;
                        raw[texel] = raw[texel].max(value);
                        if finer == level && value >= tone {
                            coverage.ink(texel);
                        }
                    });
                }
            }
        }
    }
    raw
}

/// Thresholds in the order of the raw tones, which the grain of the paper roughens, spread evenly
/// over 0 to 1.
fn evenly_spread(raw: &[f32], side: usize, seed: u64) -> Vec<u8> {
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ raw.len() as u64);
    let grain: Vec<f32> = raw.iter().map(|_| random.random_range(0.0..GRAIN)).collect();
    let smooth = |texel: usize| {
        let (x, y) = (texel % side, texel / side);
        let at = |dx: usize, dy: usize| grain[(y + dy) % side * side + (x + dx) % side];
        (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / 4.0
    };
    // Texels that no stroke touches come last, in random order and not row by row.
    let mut order: Vec<(f32, u32, usize)> = raw
        .iter()
        .enumerate()
        .map(|(texel, tone)| (tone - smooth(texel), random.random(), texel))
        .collect();
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut thresholds = vec![0; raw.len()];
    for (rank, (_, _, texel)) in order.into_iter().enumerate() {
        thresholds[texel] = (rank * 256 / raw.len()) as u8;
    }
    thresholds
}

fn quads_of(thresholds: &[u8], side: usize) -> Vec<u32> {
    let at = |x: usize, y: usize| thresholds[(y % side) * side + x % side];
    let quad = |texel: usize| {
        let (x, y) = (texel % side, texel / side);
        u32::from_le_bytes([at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)])
    };
    (0..side * side).map(quad).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thresholds(texture: &ThresholdTexture, level: usize) -> Vec<u8> {
        let side = side_of(level);
        (0..side * side).map(|at| texture.threshold(level, at % side, at / side)).collect()
    }

    #[test]
    fn the_share_of_inked_texels_is_the_tone() {
        let texture = ThresholdTexture::new(1);
        for level in 0..LEVELS {
            let all = thresholds(&texture, level);
            for tone in 0..=64 {
                let tone = tone as f32 / 64.0;
                let inked = all.iter().filter(|&&at| f32::from(at) / 255.0 > tone).count();
                let share = inked as f32 / all.len() as f32;
                assert!((share - (1.0 - tone)).abs() < 0.01, "{level} {tone}: {share}");
            }
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_strokes_and_another_gives_others() {
        let texture = ThresholdTexture::new(4);
        assert_eq!(texture, ThresholdTexture::new(4));
        assert_ne!(texture, ThresholdTexture::new(5));
        assert_eq!(texture.quads().len(), 256 * 340);
    }

    #[test]
    fn light_strokes_of_a_level_are_in_the_finer_ones() {
        let texture = ThresholdTexture::new(2);
        for level in 0..LEVELS - 1 {
            let side = side_of(level);
            let (mut kept, mut all) = (0, 0);
            for at in 0..side * side {
                let (x, y) = (at % side, at / side);
                if texture.threshold(level, x, y) > 216 {
                    all += 1;
                    let finer = [(0, 0), (1, 0), (0, 1), (1, 1)]
                        .map(|(dx, dy)| texture.threshold(level + 1, 2 * x + dx, 2 * y + dy));
                    kept += usize::from(finer.iter().any(|&finer| finer > 190));
                }
            }
            // A finer level has strokes of half the width there; rims of the coarse are left out.
            assert!(kept * 100 > all * 70, "{level}: {kept} of {all}");
        }
    }

    #[test]
    fn strokes_are_long_and_thin_and_uneven() {
        let texture = ThresholdTexture::new(3);
        let all = thresholds(&texture, LEVELS - 1);
        let inked = |x: usize, y: usize| all[(y % 256) * 256 + x % 256] > 179;
        let runs = |across: bool| {
            let mut runs = Vec::new();
            for line in 0..256 {
                let mut run = 0;
                for at in 0..256 {
                    let inked = if across { inked(line, at) } else { inked(at, line) };
                    match inked {
                        true => run += 1,
                        false if run > 0 => runs.push(std::mem::take(&mut run)),
                        false => {}
                    }
                }
            }
            runs
        };
        let mean = |runs: &[usize]| runs.iter().sum::<usize>() as f32 / runs.len() as f32;
        let (wide, long) = (runs(true), runs(false));
        assert!((2.0..4.0).contains(&mean(&wide)), "{}", mean(&wide));
        assert!(mean(&long) > 4.0 * mean(&wide), "{}", mean(&long));
        let spread = long.iter().map(|&run| (run as f32 - mean(&long)).powi(2)).sum::<f32>();
        assert!((spread / long.len() as f32).sqrt() > 0.5 * mean(&long), "equal lengths");
        // No row is inked from end to end: these are strokes, not stripes.
        for row in 0..256 {
            let share = (0..256).filter(|&x| inked(x, row)).count();
            assert!(share < 230, "{row}: {share}");
        }
    }
}
