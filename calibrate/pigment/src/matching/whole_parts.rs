//! Recipes in small whole parts.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::forward::{Forward, Scratch};
use super::request::MatchRequest;
use super::search_control::SearchControl;
use super::target::Target;

/// Most recipes of one set that are tried one by one: four pigments in up to 19 parts. It bounds
/// the time of a search and was chosen by eye.
const MOST_RECIPES: u64 = 4_000;

/// Returns the nearest recipe in whole parts, at most `most` in total, for each candidate's pigments.
/// Candidates for which the least share allows no such recipe are dropped. Once the search is cancelled, the
/// remaining candidates are dropped too.
///
/// First, for every total, the shares are rounded, and single parts are moved from pigment to pigment while
/// that brings the recipe nearer. Then all recipes are tried of those sets that could still be among the
/// `wanted` nearest. A set cannot if its recipe with free shares is already too far, since whole parts never
/// come nearer. Sets with more than 4000 recipes keep the rounded recipe.
pub(super) fn in_whole_parts(
    forward: &Forward<'_>,
    request: &MatchRequest,
    target: &Target,
    candidates: &[Candidate],
    (most, wanted): (u32, usize),
    control: &SearchControl,
) -> Vec<(Vec<u32>, Candidate)> {
    let search = |scratch: &mut Scratch, candidate: &Candidate, every: bool| {
        if control.cancelled() {
            return None;
        }
        let mut set = Set { forward, request, target, candidate, scratch };
        let parts = if every { set.nearest_of_all(most) } else { set.nearest_rounded(most) };
        parts.map(|(parts, distance)| {
            let shares = shares(&parts);
            (parts, Candidate { shares, distance, ..candidate.clone() })
        })
    };
    let rounded: Vec<Option<(Vec<u32>, Candidate)>> = candidates
        .par_iter()
        .map_init(Scratch::default, |scratch, candidate| {
            control.step();
            search(scratch, candidate, false)
        })
        .collect();
    let mut distances: Vec<f64> = rounded.iter().flatten().map(|found| found.1.distance).collect();
    distances.sort_by(f64::total_cmp);
    let enough = distances.get(wanted.max(1) - 1).copied().unwrap_or(f64::INFINITY);
    let all = candidates.par_iter().zip(rounded).map_init(
        Scratch::default,
        |scratch: &mut Scratch, (candidate, rounded): (&Candidate, _)| {
            let few = count(candidate.pigments.len() as u32, most) <= MOST_RECIPES;
            if few && candidate.distance <= enough {
                search(scratch, candidate, true)
            } else {
                rounded
            }
        },
    );
    all.flatten().collect()
}

/// Number of recipes of `pigments` pigments in up to `most` parts: the binomial coefficient.
fn count(pigments: u32, most: u32) -> u64 {
    (0..u64::from(pigments))
        .fold(1, |count: u64, i| count.saturating_mul(u64::from(most).saturating_sub(i)) / (i + 1))
}

/// One set of pigments, to be expressed in whole parts.
struct Set<'a> {
    forward: &'a Forward<'a>,
    request: &'a MatchRequest,
    target: &'a Target,
    candidate: &'a Candidate,
    scratch: &'a mut Scratch,
}

impl Set<'_> {
    fn distance(&mut self, parts: &[u32]) -> f64 {
        let Candidate { pigments, thickness, .. } = self.candidate;
        self.forward.distance(self.target, pigments, &shares(parts), *thickness, self.scratch)
    }

    fn allows(&self, parts: &[u32]) -> bool {
        let Candidate { pigments, thickness, .. } = self.candidate;
        pigments.iter().zip(shares(parts)).all(|(&pigment, share)| {
            let (least, most) = self.request.share_bounds_at(pigment, *thickness);
            (least - 1e-12..=most + 1e-12).contains(&share)
        })
    }

    fn nearest_rounded(&mut self, most: u32) -> Option<(Vec<u32>, f64)> {
        let mut best: Option<(Vec<u32>, f64)> = None;
        for total in self.candidate.pigments.len() as u32..=most {
            let mut parts = rounded(&self.candidate.shares, total);
            if !self.allows(&parts) {
                continue;
            }
            let mut here = self.distance(&parts);
            loop {
                let mut moved: Option<(Vec<u32>, f64)> = None;
                for near in neighbours(&parts) {
                    if self.allows(&near) {
                        let at = self.distance(&near);
                        if at < moved.as_ref().map_or(here, |(_, least)| *least) {
                            moved = Some((near, at));
                        }
                    }
                }
                let Some(nearer) = moved else { break };
                (parts, here) = nearer;
            }
            keep_nearer(&mut best, &parts, here);
        }
        best
    }

    fn nearest_of_all(&mut self, most: u32) -> Option<(Vec<u32>, f64)> {
        let mut best: Option<(Vec<u32>, f64)> = None;
        let pigments = self.candidate.pigments.len();
        for total in pigments as u32..=most {
            // All compositions of the total, in order of the first parts.
            let mut parts = vec![1; pigments];
            parts[pigments - 1] = total - (pigments as u32 - 1);
            loop {
                if self.allows(&parts) {
                    let here = self.distance(&parts);
                    keep_nearer(&mut best, &parts, here);
                }
                let Some(from) = (1..pigments).rev().find(|&i| parts[i] > 1) else { break };
                let rest = parts[from] - 1;
                parts[from] = 1;
                parts[from - 1] += 1;
                parts[pigments - 1] = rest;
            }
        }
        best
    }
}

/// Keeps the first of equally near recipes: it has the fewest parts.
fn keep_nearer(best: &mut Option<(Vec<u32>, f64)>, parts: &[u32], distance: f64) {
    if best.as_ref().is_none_or(|(_, least)| distance < least - 1e-9) {
        *best = Some((parts.to_vec(), distance));
    }
}

fn shares(parts: &[u32]) -> Vec<f64> {
    let total = f64::from(parts.iter().sum::<u32>());
    parts.iter().map(|part| f64::from(*part) / total).collect()
}

/// Returns the fewest whole parts, together at most `most`, in proportion to `shares` (above 0, any
/// sum) for which no share is off by more than `tolerance` of the whole; `None` if there are none.
#[must_use]
pub fn few_parts(shares: &[f64], most: u32, tolerance: f64) -> Option<Vec<u32>> {
    let sum: f64 = shares.iter().sum();
    let wished: Vec<f64> = shares.iter().map(|share| share / sum).collect();
    (shares.len() as u32..=most).map(|total| rounded(&wished, total)).find(|parts| {
        self::shares(parts)
            .into_iter()
            .zip(&wished)
            .all(|(found, wished): (f64, &f64)| (found - wished).abs() <= tolerance)
    })
}

/// `total` parts in proportion to `shares`, at least one each, by the largest-remainder method
/// (Hamilton).
fn rounded(shares: &[f64], total: u32) -> Vec<u32> {
    let wished: Vec<f64> = shares.iter().map(|share| share * f64::from(total)).collect();
    let mut parts: Vec<u32> = wished.iter().map(|w| (w.floor() as u32).max(1)).collect();
    let lack = |parts: &[u32], i: usize| wished[i] - f64::from(parts[i]);
    while parts.iter().sum::<u32>() != total {
        let short = parts.iter().sum::<u32>() < total;
        let places = (0..parts.len()).filter(|&i| short || parts[i] > 1);
        let by_lack = |a: &usize, b: &usize| lack(&parts, *a).total_cmp(&lack(&parts, *b));
        let place = if short { places.max_by(by_lack) } else { places.min_by(by_lack) };
        let Some(place) = place else { break };
        parts[place] = if short { parts[place] + 1 } else { parts[place] - 1 };
    }
    parts
}

/// Recipes with one part moved from one pigment to another.
fn neighbours(parts: &[u32]) -> impl Iterator<Item = Vec<u32>> {
    let count = parts.len();
    let pairs = (0..count).flat_map(move |from| (0..count).map(move |to| (from, to)));
    pairs.filter(|(from, to)| from != to && parts[*from] > 1).map(|(from, to)| {
        let mut moved = parts.to_vec();
        (moved[from], moved[to]) = (moved[from] - 1, moved[to] + 1);
        moved
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_recipes_is_the_binomial_coefficient() {
        assert_eq!((count(1, 9), count(2, 9), count(4, 12), count(4, 3)), (9, 36, 495, 0));
    }

    #[test]
    fn few_parts_are_the_fewest_within_the_tolerance() {
        assert_eq!(few_parts(&[0.6, 0.3, 0.1], 20, 1e-9), Some(vec![6, 3, 1]));
        assert_eq!(few_parts(&[3.0, 1.0], 20, 1e-9), Some(vec![3, 1]), "of any sum");
        assert_eq!(few_parts(&[0.334, 0.666], 20, 0.002), Some(vec![1, 2]));
        assert_eq!(few_parts(&[0.334, 0.666], 20, 1e-4), None);
        assert_eq!(few_parts(&[1.0], 20, 1e-9), Some(vec![1]));
    }

    #[test]
    fn rounded_parts_keep_their_sum() {
        assert_eq!(rounded(&[0.5, 0.3, 0.2], 10), [5, 3, 2]);
        assert_eq!(rounded(&[0.98, 0.01, 0.01], 4), [2, 1, 1]);
        assert_eq!(rounded(&[0.22, 0.29, 0.49], 10), [2, 3, 5], "the largest remainders first");
        assert_eq!(rounded(&[0.4, 0.6], 2), [1, 1]);
        assert_eq!(rounded(&[1.0], 7), [7]);
    }
}
