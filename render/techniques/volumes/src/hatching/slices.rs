//! Strokes for a tile at its whole size, and half-way to half of it.
//!
//! Over the octave from one size to half of it a tile has to become four copies of itself, so
//! that magnification has no end. Strokes keep their width on the screen: each slides by less
//! than its length to a stroke of the four copies like it, and into the gaps that open the other
//! strokes of the copies are born, one part of them half-way.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::coverage::Coverage;
use super::strokes::{SIDE, Stroke, WIDTH_TEXELS};

/// Magnifications in an octave.
pub const SLICES: usize = 2;

/// Share of a tile that strokes cover in the end. What is left between them comes last.
const COVERED: f32 = 0.95;

/// Strokes that are tried for each that is drawn.
const CANDIDATES: usize = 20;

/// Strokes not yet born, next by tone, of which one is chosen.
const NEXT: usize = 160;

/// Most difference in tone between a stroke and that which it becomes.
const LIKE: f32 = 0.08;

/// Length, in its widths, by which a stroke would rather slide along than by one width across.
const ALONG: f32 = 16.0;

/// A stroke, and the tone below which it is drawn.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Drawn {
    pub(super) stroke: Stroke,
    pub(super) tone: f32,
}

/// Factors of the size of strokes on the tiles of the slices: 2 to the power of minus 0 and 1/2.
pub(super) const SIZES: [f32; SLICES] = [1.0, std::f32::consts::FRAC_1_SQRT_2];

/// The strokes of every slice, from a seed.
pub(super) fn slices(seed: u64) -> [Vec<Drawn>; SLICES] {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let first = first_slice(&mut random);
    let four = four_copies(&first);
    let becomes = like_strokes(&first, &four);
    let second = second_slice(&first, &four, &becomes, &mut random);
    [first, second]
}

/// Strokes from light to dark, each in the widest gap that is found.
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

/// The strokes of the first slice half-way to those they become, and as many others of the four
/// copies as fill the gaps between them, all falling by tone.
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
        // Lighter ones wait, so that there are some of every tone for the rest of the octave.
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

/// The strokes of four tiles of half the size side by side, falling by tone as those of one.
fn four_copies(first: &[Drawn]) -> Vec<Drawn> {
    let copies = |own: &Drawn| {
        let stroke = own.stroke.clone();
        let tone = own.tone;
        [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|tile| {
            let [x, y] = stroke.middle.map(|at| at - at.floor());
            let middle = [0.5 * (x + tile[0]), 0.5 * (y + tile[1])];
            Drawn { stroke: stroke.at(middle), tone }
        })
    };
    first.iter().flat_map(copies).collect()
}

/// For each stroke the one of the copies that it becomes: the nearest of about its tone that is
/// not taken by a lighter one.
fn like_strokes(first: &[Drawn], four: &[Drawn]) -> Vec<Option<usize>> {
    let mut taken = vec![false; four.len()];
    let across = WIDTH_TEXELS / SIDE as f32;
    let choose = |own: &Drawn| {
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
    };
    first.iter().map(choose).collect()
}

/// The stroke of `other` with its middle where the repeating tile brings it nearest to `own`.
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
