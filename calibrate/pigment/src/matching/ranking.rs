//! We select and order here the recipes that we return, and make recipes in small whole parts.

use documents::{Steps, Task};
use rayon::prelude::*;
use spectra::TristimulusWeights;
use spectra::color::{Lab, Xyz, delta_e_ciede2000, metamerism_index};

use super::forward::{Forward, Scratch};
use super::limits::{FilmKind, MatchError, RecipeLimits, USUAL_TOLERANCE};
use super::search::{Candidate, expected, search};
use super::target::Target;
use crate::evaluate::lab;
use crate::library::{AmountKind, PigmentLibrary};
use crate::recipe::{PigmentId, Recipe};

/// A recipe that was found for a target.
#[derive(Debug, Clone, PartialEq)]
pub struct RecipeMatch {
    /// Pigments of the library with their shares, sum 1, the greatest first.
    pub shares: Recipe,
    /// The shares as whole parts, in the same order, if the limits ask for these.
    pub parts: Option<Vec<u32>>,
    /// Thickness of the film. `None` for a film that hides.
    pub thickness: Option<f64>,
    /// CIEDE2000 from the target under each viewing condition.
    pub delta_e: Vec<f64>,
    /// Weighted root mean square of the differences in the metric of the limits, over all viewing
    /// conditions. For a search by spectrum it is over the shared wavelengths, in percent of reflectance.
    pub distance: f64,
    /// Root mean square of the differences of reflectance from a measured target, in percent: with the
    /// weights of a search by spectrum, else evenly over the shared wavelengths. `None` for a target that
    /// was not measured.
    pub rms_percent: Option<f64>,
    /// Special metamerism index (CIE 15:2018, section 9.2, in CIEDE2000) for the change from the first
    /// light to each later one. Empty if you did not measure the target. `None` for a recipe that is black
    /// under the first light.
    pub metamerism: Vec<Option<f64>>,
    /// Colour of the recipe under each viewing condition.
    pub lab: Vec<Lab>,
    /// Measured reflectance of the recipe on the library's grid.
    pub reflectance: Vec<f64>,
    /// Pigments at the least or greatest absolute amount that was measured. The search keeps to this range.
    pub at_limit: Vec<(PigmentId, AmountLimit)>,
    /// Price of one unit of the mixture, or of all absolute amounts together. `None` if you give no prices.
    pub cost: Option<f64>,
}

/// An end of the range of amounts that were measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AmountLimit {
    /// The least amount above 0.
    Least,
    /// The greatest amount.
    Greatest,
}

/// Searches recipes of `library` for `target` and returns the best first.
///
/// Some recipes are equally near (within the tolerance of the nearest). We order them by price if
/// you give prices, then by the number of pigments, then by distance in steps of [`USUAL_TOLERANCE`], then
/// by their smallest share, the greatest first. The others follow by distance. We leave out a recipe that
/// adds a pigment to another one of the list without coming nearer by more than the tolerance.
///
/// `task` counts the sets of pigments that we have tried. If you cancel it, each thread finishes its
/// current recipe.
///
/// # Errors
/// [`MatchError`] if no recipe can keep the limits, or `task` was cancelled.
///
/// # Panics
/// If a pigment of the limits is not in the library, or a ground or target does not fit its grid and
/// viewing conditions.
pub fn recipes(
    library: &PigmentLibrary,
    target: &Target,
    limits: &RecipeLimits,
    task: &Task,
) -> Result<Vec<RecipeMatch>, MatchError> {
    Ok(recipes_and_nearest(library, target, limits, task)?.0)
}

/// Recipes, and the distance of the nearest of all. You may not find that one in the list, if another is as
/// near within the tolerance.
pub(super) fn recipes_and_nearest(
    library: &PigmentLibrary,
    target: &Target,
    limits: &RecipeLimits,
    task: &Task,
) -> Result<(Vec<RecipeMatch>, f64), MatchError> {
    limits.check(library)?;
    if limits.metric.spectrum_weights().is_some() && target.spectrum.is_none() {
        return Err(MatchError::NoSpectrum(target.name.clone()));
    }
    let forward = Forward::new(library, limits).expect("the method fits the grid");
    let steps = task.steps(expected(limits));
    let candidates = search(&forward, limits, target, &steps);
    let found: Vec<Found> = match limits.whole_parts {
        None => candidates.into_iter().map(|candidate| (None, candidate)).collect(),
        Some(most) => {
            let wanted = SPARE_RECIPES * limits.count;
            in_whole_parts(&forward, limits, target, &candidates, (most, wanted), &steps)
                .into_iter()
                .map(|(parts, candidate)| (Some(parts), candidate))
                .collect()
        }
    };
    task.check()?;
    let nearest = found.iter().map(|(_, c)| c.distance).fold(f64::INFINITY, f64::min);
    let ranked = ranked(library, found, nearest, limits);
    let recipes = ranked.into_iter().map(|found| recipe(library, &forward, limits, target, found));
    Ok((recipes.collect(), nearest))
}

/// We search this many recipes in whole parts for each one that we return, because later we leave out those
/// that add pigments to a better recipe without coming nearer. We chose it by eye.
const SPARE_RECIPES: usize = 5;

/// A candidate with its whole parts, if you asked for these.
type Found = (Option<Vec<u32>>, Candidate);

fn ranked(
    library: &PigmentLibrary,
    mut found: Vec<Found>,
    nearest: f64,
    limits: &RecipeLimits,
) -> Vec<Found> {
    let tolerated = nearest + limits.tolerance;
    found.sort_by(|(_, a), (_, b)| {
        let by_distance = a.distance.total_cmp(&b.distance);
        let order = match (a.distance <= tolerated, b.distance <= tolerated) {
            (true, true) => cost(library, limits, a)
                .total_cmp(&cost(library, limits, b))
                .then(a.pigments.len().cmp(&b.pigments.len()))
                .then(steps_beyond(nearest, a).total_cmp(&steps_beyond(nearest, b)))
                .then(smallest_share(b).total_cmp(&smallest_share(a))),
            (true, false) => std::cmp::Ordering::Less,
            (false, true) => std::cmp::Ordering::Greater,
            (false, false) => by_distance,
        };
        order.then(by_distance).then_with(|| a.pigments.cmp(&b.pigments))
    });
    let mut shown: Vec<Found> = Vec::new();
    for (parts, candidate) in found {
        if shown.len() >= limits.count {
            break;
        }
        let adds_nothing = shown.iter().any(|(_, before)| {
            before.pigments.iter().all(|pigment| candidate.pigments.contains(pigment))
                && candidate.distance > before.distance - limits.tolerance
        });
        if !adds_nothing {
            shown.push((parts, candidate));
        }
    }
    shown
}

fn steps_beyond(nearest: f64, c: &Candidate) -> f64 {
    ((c.distance - nearest) / USUAL_TOLERANCE).floor()
}

fn smallest_share(c: &Candidate) -> f64 {
    c.shares.iter().copied().fold(1.0, f64::min)
}

/// Price of a candidate. If you give no prices, it is 0 for all, which leaves their order unchanged.
fn cost(library: &PigmentLibrary, limits: &RecipeLimits, candidate: &Candidate) -> f64 {
    let parts = candidate.pigments.iter().zip(&candidate.shares);
    let of_one: f64 =
        parts.map(|(p, share)| share * limits.costs.get(p.index()).unwrap_or(&0.0)).sum();
    match library.amounts {
        AmountKind::Relative => of_one,
        // The thickness is the sum of all amounts.
        AmountKind::Absolute => of_one * candidate.thickness,
    }
}

fn recipe(
    library: &PigmentLibrary,
    forward: &Forward<'_>,
    limits: &RecipeLimits,
    target: &Target,
    (parts, candidate): Found,
) -> RecipeMatch {
    let Candidate { pigments, shares, thickness, distance } = &candidate;
    let mut scratch = Scratch::default();
    let reflectance = forward.reflectance(pigments, shares, *thickness, &mut scratch);
    let labs: Vec<Lab> = forward.weights.iter().map(|w| lab(w, &reflectance)).collect();
    let mut order: Vec<usize> = (0..pigments.len()).collect();
    order.sort_by(|&a, &b| shares[b].total_cmp(&shares[a]));
    let spectrum = target.spectrum.as_ref();
    RecipeMatch {
        rms_percent: spectrum.map(|spectrum| spectrum.rms_percent(&reflectance)),
        metamerism: spectrum.map_or_else(Vec::new, |_| metamerism(forward, target, &labs)),
        shares: order.iter().map(|&at| (pigments[at], shares[at])).collect(),
        parts: parts.map(|parts| order.iter().map(|&at| parts[at]).collect()),
        thickness: (limits.film != FilmKind::Hiding).then_some(*thickness),
        delta_e: labs.iter().zip(&target.lab).map(|(a, b)| delta_e_ciede2000(*b, *a)).collect(),
        distance: *distance,
        lab: labs,
        reflectance,
        at_limit: order.iter().filter_map(|&at| at_limit(limits, &candidate, at)).collect(),
        cost: (!limits.costs.is_empty()).then(|| cost(library, limits, &candidate)),
    }
}

/// Metamerism index for the change from the first light to each later one.
fn metamerism(forward: &Forward<'_>, target: &Target, found: &[Lab]) -> Vec<Option<f64>> {
    let whites: Vec<Xyz> = forward.weights.iter().map(TristimulusWeights::white).collect();
    (1..whites.len())
        .map(|at| {
            metamerism_index(
                xyz_pair(&whites, &target.lab, at),
                xyz_pair(&whites, found, at),
                whites[at],
            )
            .ok()
        })
        .collect()
}

fn xyz_pair(whites: &[Xyz], labs: &[Lab], at: usize) -> [Xyz; 2] {
    [0, at].map(|at| labs[at].to_xyz(whites[at]))
}

/// The limit of amounts that one pigment of a recipe has reached, if any.
fn at_limit(
    limits: &RecipeLimits,
    candidate: &Candidate,
    place: usize,
) -> Option<(PigmentId, AmountLimit)> {
    let pigment = candidate.pigments[place];
    let amount = candidate.shares[place] * candidate.thickness;
    let [least, most] = limits.amount_bounds(pigment)?;
    if amount <= least * (1.0 + AT_LIMIT) {
        Some((pigment, AmountLimit::Least))
    } else if amount >= most * (1.0 - AT_LIMIT) {
        Some((pigment, AmountLimit::Greatest))
    } else {
        None
    }
}

/// An amount counts as at its limit if its relative distance from the limit is at most this.
const AT_LIMIT: f64 = 1e-6;

/// We try all recipes of one set only if there are at most this many, for example four pigments in up to 19
/// parts. It bounds the time of a search. We chose it by eye.
const MOST_RECIPES: u64 = 4_000;

/// Returns the nearest recipe in whole parts, at most `most` in total, for each candidate's pigments. We
/// drop a candidate if the least share allows no such recipe. If you cancel the search, we drop the
/// remaining candidates too.
///
/// First, for every total, we round the shares, and move single parts from pigment to pigment while this
/// brings the recipe nearer. Then we try all recipes of those sets that could still be among the `wanted`
/// nearest. A set cannot if its recipe with free shares is already too far, because whole parts never come
/// nearer. A set with more than 4000 recipes keeps the rounded recipe.
pub(super) fn in_whole_parts(
    forward: &Forward<'_>,
    limits: &RecipeLimits,
    target: &Target,
    candidates: &[Candidate],
    (most, wanted): (u32, usize),
    steps: &Steps,
) -> Vec<(Vec<u32>, Candidate)> {
    let search = |scratch: &mut Scratch, candidate: &Candidate, every: bool| {
        if steps.task().is_cancelled() {
            return None;
        }
        let mut set = Set { forward, limits, target, candidate, scratch };
        let parts = if every { set.nearest_of_all(most) } else { set.nearest_rounded(most) };
        parts.map(|(parts, distance)| {
            let shares = shares(&parts);
            (parts, Candidate { shares, distance, ..candidate.clone() })
        })
    };
    let rounded: Vec<Option<(Vec<u32>, Candidate)>> = candidates
        .par_iter()
        .map_init(Scratch::default, |scratch, candidate| {
            steps.step();
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
    limits: &'a RecipeLimits,
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
            let (least, most) = self.limits.share_bounds_at(pigment, *thickness);
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
            // We try all compositions of the total, in order of the first parts.
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
/// sum) for which no share is off by more than `tolerance` of the whole. `None` if there are none.
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

    while parts.iter().sum::<u32>() != total {
        let short = parts.iter().sum::<u32>() < total;
        let places = (0..parts.len()).filter(|&i| short || parts[i] > 1);
        let place = places.map(|i| (wished[i] - f64::from(parts[i]), i));
        let place = if short {
            place.max_by(|a, b| a.0.total_cmp(&b.0))
        } else {
            place.min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let Some((_, place)) = place else { break };
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
