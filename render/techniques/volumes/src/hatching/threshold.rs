//! A texture of thresholds. Every texel holds the lightest tone at which we ink it. We also choose
//! the strokes here, for a tile at its full size and at 2^(-1/2) of it.
//!
//! You can magnify without end, because a tile at half its size is four copies of itself side by
//! side. Strokes keep their width on the screen. On the way to half the size, each stroke slides by
//! less than its length to a similar stroke of the four copies. The other strokes of the copies
//! appear in the gaps that open, some of them at 2^(-1/2).

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::strokes::{Coverage, SIDE, Stroke, WIDTH_TEXELS};

/// The grain of the paper takes at most this tone from all texels.
const GRAIN: f32 = 0.12;

/// A valley of the paper takes little lead. It begins at this height of the grain, 0 to 1.
const VALLEY: f32 = 0.6;

/// Tone that a valley takes from a texel, divided by the square of the depth of the valley.
const DEPTH: f32 = 4.0;

/// We count thresholds in this many parts of their range.
const BINS: usize = 1024;

/// We even out the values that are interpolated between texels in this many rounds.
const ROUNDS: usize = 3;

/// Thresholds of pencil strokes along u on a tile that repeats, in [`SLICES`](super::SLICES)
/// slices. These are for the tile magnified 1 and 2^(1/2) times. At 2, its four quarters are the
/// tile at 1 again.
///
/// We ink a texel at all tones below its threshold (tone 0 is black, 1 is white). So the ink of a
/// lighter tone is part of the ink of every darker one. The strokes of a slice stay in the next
/// one. They are narrower as the magnification is greater, with others in the gaps between them.
/// The thresholds of a slice are spread evenly over 0 to 1. So the share of inked texels at tone t
/// is 1 - t.
#[derive(Debug, Clone, PartialEq)]
pub struct ThresholdTexture {
    quads: Vec<u32>,
}

impl ThresholdTexture {
    /// Draws the strokes. `seed` decides where they are.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let grain = grain(seed);
        let quads: Vec<Vec<u32>> = slices(seed)
            .par_iter()
            .enumerate()
            .map(|(slice, drawn)| quads_of(&evenly_spread(&raw(slice, drawn), &grain, seed)))
            .collect();
        Self { quads: quads.concat() }
    }

    /// Threshold of a texel, in 1/255. Coordinates wrap around.
    ///
    /// # Panics
    /// If `slice` is not below [`SLICES`](super::SLICES).
    #[must_use]
    pub fn threshold(&self, slice: usize, column: usize, row: usize) -> u8 {
        let texel = (row % SIDE) * SIDE + column % SIDE;
        let [own, ..] = self.quads[slice * SIDE * SIDE + texel].to_le_bytes();
        own
    }

    /// For each texel of all slices, row by row: its threshold in the lowest byte, then the
    /// thresholds to the right, below, and below to the right. One number holds what you need to
    /// interpolate.
    #[must_use]
    pub fn quads(&self) -> &[u32] {
        &self.quads
    }
}

/// Tones of all texels, before we spread them evenly. Greater is lighter.
fn raw(slice: usize, drawn: &[Drawn]) -> Vec<f32> {
    let mut raw = vec![f32::NEG_INFINITY; SIDE * SIDE];
    for Drawn { stroke, tone } in drawn {
        stroke.texels(SIZES[slice], |texel, lost| raw[texel] = raw[texel].max(tone - lost));
    }
    raw
}

/// Tone that the grain of the paper takes from each texel. All slices have the same grain.
fn grain(seed: u64) -> Vec<f32> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(1);
    let rough: Vec<f32> = (0..SIDE * SIDE).map(|_| random.random_range(0.0..1.0)).collect();
    (0..SIDE * SIDE)
        .map(|texel: usize| {
            let x = texel % SIDE;
            let y = texel / SIDE;
            let [above, under] =
                [y, y + 1].map(|y| [rough[wrapped(x, y)], rough[wrapped(x + 1, y)]]);
            let height = (above[0] + above[1] + under[0] + under[1]) / 4.0;
            GRAIN * height + DEPTH * (height - VALLEY).max(0.0).powi(2)
        })
        .collect()
}

/// Thresholds in the order of the raw tones, spread evenly over 0 to 1. The grain of the paper
/// roughens them.
fn evenly_spread(raw: &[f32], grain: &[f32], seed: u64) -> Vec<u8> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(2);
    // Texels that no stroke touches come last, in random order and not row by row.
    let mut order: Vec<(f32, u32, usize)> = raw
        .iter()
        .zip(grain)
        .enumerate()
        .map(|(texel, (tone, grain))| (tone - grain, random.random(), texel))
        .collect();
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut thresholds = vec![0.0; raw.len()];
    for (rank, (_, _, texel)) in order.into_iter().enumerate() {
        thresholds[texel] = (rank as f32 + 0.5) / raw.len() as f32;
    }
    (0..ROUNDS).for_each(|_| spread_between(&mut thresholds));
    thresholds.into_iter().map(|threshold| (threshold * 255.0 + 0.5) as u8).collect()
}

/// Spreads thresholds so that the values interpolated between the texels are more even. You only
/// see these values, and there are fewer of them at the ends of the range.
fn spread_between(thresholds: &mut [f32]) {
    let mut below = vec![0_u32; BINS + 1];
    for (x, y) in (0..SIDE * SIDE).map(|texel| (texel % SIDE, texel / SIDE)) {
        let [above, under] =
            [y, y + 1].map(|y| [thresholds[wrapped(x, y)], thresholds[wrapped(x + 1, y)]]);
        for down in [0.25, 0.75] {
            let [left, right] = [0, 1].map(|side| above[side] + (under[side] - above[side]) * down);
            for along in [0.25, 0.75] {
                let between = left + (right - left) * along;
                below[1 + ((between * BINS as f32) as usize).min(BINS - 1)] += 1;
            }
        }
    }
    (0..BINS).for_each(|bin| below[bin + 1] += below[bin]);
    let all = below[BINS] as f32;
    for threshold in thresholds {
        let bin = ((*threshold * BINS as f32) as usize).min(BINS - 1);
        let part = *threshold * BINS as f32 - bin as f32;
        let [from, to] = [below[bin] as f32, below[bin + 1] as f32];
        *threshold = (from + (to - from) * part) / all;
    }
}

fn quads_of(thresholds: &[u8]) -> Vec<u32> {
    (0..SIDE * SIDE)
        .map(|texel: usize| {
            let x = texel % SIDE;
            let y = texel / SIDE;
            let corners = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
            u32::from_le_bytes(corners.map(|(x, y)| thresholds[wrapped(x, y)]))
        })
        .collect()
}

/// Index of a texel of the texture, which repeats.
fn wrapped(x: usize, y: usize) -> usize {
    (y % SIDE) * SIDE + x % SIDE
}

/// One texture for all tests that need any texture.
#[cfg(test)]
pub(crate) fn sample_texture() -> &'static ThresholdTexture {
    static TEXTURE: std::sync::LazyLock<ThresholdTexture> =
        std::sync::LazyLock::new(|| ThresholdTexture::new(1));
    &TEXTURE
}

/// Magnifications in an octave.
pub const SLICES: usize = 2;

/// We draw strokes until they cover this share of a tile. The texels that are left take ink last.
const COVERED: f32 = 0.95;

/// We try this many strokes for each that we draw.
const CANDIDATES: usize = 20;

/// We choose the next new stroke among at most this many of those that are left: the lightest that
/// are not lighter than the share of bare paper.
const NEXT: usize = 160;

/// A stroke slides only to a stroke with a tone that differs by at most this much.
const LIKE: f32 = 0.08;

/// We prefer to slide a stroke lengthwise by up to this many of its widths, rather than sideways by
/// one width.
const ALONG: f32 = 16.0;

/// A stroke and the tone below which we draw it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Drawn {
    pub(super) stroke: Stroke,
    pub(super) tone: f32,
}

/// Factors of the size of strokes on the tiles of the slices: 2 to the power of 0 and -1/2.
pub(super) const SIZES: [f32; SLICES] = [1.0, std::f32::consts::FRAC_1_SQRT_2];

pub(super) fn slices(seed: u64) -> [Vec<Drawn>; SLICES] {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let first = first_slice(&mut random);
    let four = four_copies(&first);
    let becomes = like_strokes(&first, &four);
    let second = second_slice(&first, &four, &becomes, &mut random);
    [first, second]
}

/// Strokes from light to dark. Each lies in the widest gap that we find.
fn first_slice(random: &mut ChaCha8Rng) -> Vec<Drawn> {
    let mut coverage = Coverage::new(1.0);
    let mut drawn = Vec::new();
    while coverage.share() < COVERED {
        let strokes = (0..CANDIDATES).map(|_| Stroke::random(random));
        let Some((_, stroke)) = coverage.best(strokes) else { break };
        let stroke = coverage.nudged(stroke);
        let tone = 1.0 - coverage.share();
        coverage.draw(&stroke);
        drawn.push(Drawn { stroke, tone });
    }
    drawn
}

/// The strokes of the first slice, half-way to the strokes of the copies to which they slide. We
/// fill the gaps between them with other strokes of the four copies. All are in order of falling
/// tone.
fn second_slice(
    first: &[Drawn],
    four: &[Drawn],
    becomes: &[Option<usize>],
    random: &mut ChaCha8Rng,
) -> Vec<Drawn> {
    let older = first.iter().zip(becomes).filter_map(|(own, &other)| {
        let stroke = own.stroke.half_way(&nearest_copy(own, &four[other?]));
        Some(Drawn { stroke, tone: own.tone })
    });
    let mut is_new = vec![true; four.len()];
    becomes.iter().flatten().for_each(|&index| is_new[index] = false);
    let mut unborn: Vec<usize> = (0..four.len()).filter(|&index| is_new[index]).collect();
    let mut coverage = Coverage::new(SIZES[1]);
    let mut drawn = Vec::new();
    let mut older = older.peekable();
    while coverage.share() < COVERED {
        let tone = 1.0 - coverage.share();
        // Lighter ones wait, so that some of every tone are left for the rest of the octave.
        let from = unborn.partition_point(|&index| four[index].tone > tone);
        let to = (from + NEXT).min(unborn.len());
        let next = match older.next_if(|older| older.tone >= tone || from == to) {
            Some(next) => next,
            None if from == to => break,
            None => {
                let tried: Vec<usize> =
                    (0..CANDIDATES).map(|_| random.random_range(from..to)).collect();
                let strokes = tried.iter().map(|&at| four[unborn[at]].stroke.clone());
                let Some((best, stroke)) = coverage.best(strokes) else { break };
                unborn.remove(tried[best]);
                Drawn { stroke, tone }
            }
        };
        coverage.draw(&next.stroke);
        drawn.push(next);
    }
    drawn
}

/// The strokes of four tiles of half the size side by side, in order of falling tone.
fn four_copies(first: &[Drawn]) -> Vec<Drawn> {
    first
        .iter()
        .flat_map(|own: &Drawn| {
            let stroke = own.stroke.clone();
            let tone = own.tone;
            [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|tile| {
                let [x, y] = stroke.middle.map(|at| at - at.floor());
                let middle = [0.5 * (x + tile[0]), 0.5 * (y + tile[1])];
                Drawn { stroke: stroke.at(middle), tone }
            })
        })
        .collect()
}

/// For each stroke, the index of the stroke of the copies to which it slides. This is the nearest
/// with about the same tone that no lighter stroke has taken.
fn like_strokes(first: &[Drawn], four: &[Drawn]) -> Vec<Option<usize>> {
    let mut taken = vec![false; four.len()];
    let across = WIDTH_TEXELS / SIDE as f32;
    first
        .iter()
        .map(|own: &Drawn| {
            let from = four.partition_point(|other| other.tone > own.tone + LIKE);
            let to = four.partition_point(|other| other.tone >= own.tone - LIKE);
            let mut nearest = None;
            let mut least = f32::INFINITY;
            for index in (from..to).filter(|&index| !taken[index]) {
                let [x, y] = [0, 1].map(|axis| {
                    let way = four[index].stroke.middle[axis] - own.stroke.middle[axis];
                    (way - way.round()) / across
                });
                let far = (x / ALONG).powi(2) + y * y;
                if far < least {
                    (nearest, least) = (Some(index), far);
                }
            }
            nearest.inspect(|&index| taken[index] = true)
        })
        .collect()
}

/// The stroke of `other`, moved to where the repeating tile brings its middle nearest to `own`.
fn nearest_copy(own: &Drawn, other: &Drawn) -> Stroke {
    let middle = [0, 1].map(|axis| {
        let from = own.stroke.middle[axis];
        let to = other.stroke.middle[axis];
        to - (to - from).round()
    });
    other.stroke.at(middle)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thresholds(texture: &ThresholdTexture, slice: usize) -> Vec<u8> {
        (0..SIDE * SIDE).map(|at| texture.threshold(slice, at % SIDE, at / SIDE)).collect()
    }

    #[test]
    fn the_share_of_inked_places_is_the_tone() {
        let texture = sample_texture();
        for slice in 0..SLICES {
            // Places between the texels. Each is nearest to another of their corners.
            let mut all: Vec<f32> = (0..SIDE * SIDE)
                .flat_map(|texel: usize| {
                    let quad = texture.quads()[slice * SIDE * SIDE + texel].to_le_bytes();
                    let [a, b, c, d] = quad.map(|at| f32::from(at) / 255.0 / 16.0);
                    [(a, b, c, d), (b, a, d, c), (c, a, d, b), (d, b, c, a)]
                        .map(|(own, next, other, far)| 9.0 * own + 3.0 * (next + other) + far)
                })
                .collect();
            all.sort_unstable_by(f32::total_cmp);
            for tone in 0..=64 {
                let tone = tone as f32 / 64.0;
                let inked = all.len() - all.partition_point(|&at| at <= tone);
                let share = inked as f32 / all.len() as f32;
                assert!((share - (1.0 - tone)).abs() < 0.02, "{slice} {tone}: {share}");
            }
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_strokes_and_another_gives_others() {
        let texture = ThresholdTexture::new(1);
        assert_eq!(&texture, sample_texture());
        assert_ne!(texture, ThresholdTexture::new(2));
        assert_eq!(texture.quads().len(), SLICES * SIDE * SIDE);
    }

    #[test]
    fn light_strokes_of_a_slice_are_in_the_next() {
        let texture = sample_texture();
        for slice in 0..SLICES {
            let mut kept = 0;
            let mut all = 0;
            for at in 0..SIDE * SIDE {
                let x = at % SIDE;
                let y = at / SIDE;
                if texture.threshold(slice, x, y) > 204 {
                    all += 1;
                    // After the last comes the first, at half the size.
                    let next = match slice + 1 {
                        SLICES => texture.threshold(0, 2 * x, 2 * y),
                        next => texture.threshold(next, x, y),
                    };
                    kept += usize::from(next > 180);
                }
            }
            // The next one is narrower and shorter by 2^(1/2) and slides by a part of its length.
            // A quarter of the texels would agree by chance.
            assert!(kept * 100 > all * 45, "{slice}: {kept} of {all}");
        }
    }

    #[test]
    fn strokes_are_long_and_thin_and_uneven() {
        let all = thresholds(sample_texture(), SLICES - 1);
        let [wide, long] = [true, false].map(|across| {
            let mut runs = Vec::new();
            for line in 0..SIDE {
                let mut run = 0;
                for at in 0..SIDE {
                    let texel = if across { wrapped(line, at) } else { wrapped(at, line) };
                    match all[texel] > 204 {
                        true => run += 1,
                        false if run > 0 => runs.push(std::mem::take(&mut run)),
                        false => {}
                    }
                }
            }
            runs
        });
        fn mean(runs: &[usize]) -> f32 {
            runs.iter().sum::<usize>() as f32 / runs.len() as f32
        }
        assert!((1.2..3.5).contains(&mean(&wide)), "{}", mean(&wide));
        assert!(mean(&long) > 3.0 * mean(&wide), "{}", mean(&long));
        let spread = long.iter().map(|&run| (run as f32 - mean(&long)).powi(2)).sum::<f32>();
        assert!((spread / long.len() as f32).sqrt() > 0.5 * mean(&long), "equal lengths");
        // No row is inked from end to end, so these are strokes and not stripes.
        for row in 0..SIDE {
            let share = (0..SIDE).filter(|&x| all[wrapped(x, row)] > 204).count();
            assert!(share < 430, "{row}: {share}");
        }
    }

    #[test]
    fn strokes_slide_by_less_than_their_length_until_the_tile_is_four() {
        let [first, _] = slices(1);
        let four = four_copies(&first);
        assert_eq!(four.len(), 4 * first.len());
        let becomes = like_strokes(&first, &four);
        let mut taken: Vec<usize> = becomes.iter().flatten().copied().collect();
        assert_eq!(taken.len(), first.len());
        taken.sort_unstable();
        taken.dedup();
        assert_eq!(taken.len(), first.len(), "two strokes become one");
        let mut far = [0.0; 2];
        for (own, other) in first.iter().zip(&becomes) {
            let to = nearest_copy(own, &four[other.unwrap()]).middle;
            for axis in 0..2 {
                far[axis] += (to[axis] - own.stroke.middle[axis]).abs() * SIDE as f32;
            }
        }
        let [along, across] = far.map(|sum| sum / first.len() as f32);
        assert!(along < 44.0 && across < 2.0 * WIDTH_TEXELS, "{along} {across}");
    }

    #[test]
    fn the_second_slice_has_twice_the_strokes() {
        let [first, second] = slices(2);
        for tone in [0.0, 0.4, 0.7] {
            let [first, second] = [&first, &second]
                .map(|drawn| drawn.iter().filter(|drawn| drawn.tone > tone).count() as f32);
            // Strokes are smaller by 2^(1/2) both ways, and lie closer where they fill gaps.
            let more = second / first;
            assert!((1.8..2.5).contains(&more), "{tone}: {more}");
        }
    }
}
