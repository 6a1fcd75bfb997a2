//! Search over all sets of pigments.
//!
//! Each set becomes a [`Candidate`]: its pigments with the shares of the nearest recipe.

use std::collections::BTreeMap;

use documents::Steps;
use rayon::prelude::*;

use super::forward::{Forward, Scratch};
use super::limits::RecipeLimits;
use super::target::Target;
use crate::least_squares::{Bounds, Cost, UNKNOWNS, descend_within_bounds};
use crate::recipe::PigmentId;

/// A target is out of reach if the nearest recipe is further than this, in the unit of the metric. We
/// then search sets from more starting points.
const FAR: f64 = 2.0;

/// We try at most this many sets of one size, which allows all sets of four out of 30 pigments. For a
/// larger library we extend only the nearest smaller recipes.
const MOST_SETS: usize = 30_000;

/// Returns the nearest recipe of each set of pigments that we tried, nearest first. Each set is one of the
/// `steps`, about [`expected`] in all. If you cancel the search, it has not tried all sets.
pub(super) fn search(
    forward: &Forward<'_>,
    limits: &RecipeLimits,
    target: &Target,
    steps: &Steps,
) -> Vec<Candidate> {
    let strength = strengths(forward);
    let mut found: Vec<Candidate> = Vec::new();
    let mut sets = first_sets(limits);
    let mut size = sets.keys().next().map_or(0, Vec::len);
    loop {
        let tried: Vec<(Vec<PigmentId>, Option<Candidate>)> = sets
            .par_iter()
            .map_init(Scratch::default, |scratch, (set, parent)| {
                if steps.task().is_cancelled() {
                    return (set.clone(), None);
                }
                steps.step();
                let starts = starts(limits, set, parent.as_ref(), &strength);
                let ends =
                    starts.iter().filter_map(|s| descend(forward, limits, target, s, scratch));
                (set.clone(), ends.min_by(|a, b| a.distance.total_cmp(&b.distance)))
            })
            .collect();
        size += 1;
        let goes_on = size <= limits.at_most && !steps.task().is_cancelled();
        let grown = if goes_on { grown(limits, &tried) } else { BTreeMap::new() };
        found.extend(tried.into_iter().filter_map(|(_, candidate)| candidate));
        if grown.is_empty() {
            break;
        }
        sets = grown;
    }
    // Beyond the gamut the distance has several minima, many of them near one pigment.
    if found.iter().all(|candidate| candidate.distance > FAR) && !steps.task().is_cancelled() {
        found.par_iter_mut().for_each_init(Scratch::default, |scratch, candidate| {
            for corner in corners(limits, &candidate.pigments) {
                let end = descend(forward, limits, target, &corner, scratch);
                if let Some(end) = end.filter(|end| end.distance < candidate.distance) {
                    *candidate = end;
                }
            }
        });
    }
    found.sort_by(|a, b| {
        a.distance.total_cmp(&b.distance).then_with(|| a.pigments.cmp(&b.pigments))
    });
    found
}

/// Number of sets that a search will try, doubled if we also round the recipe of each set to whole parts.
pub(super) fn expected(limits: &RecipeLimits) -> usize {
    let fixed = limits.required.len();
    let free = limits.allowed.len() - fixed.min(limits.allowed.len());
    let sizes = usize::from(fixed == 0)..=limits.at_most.saturating_sub(fixed);
    sizes
        .map(|added| {
            let sets = (0..added)
                .fold(1_usize, |sets, i| sets.saturating_mul(free.saturating_sub(i)) / (i + 1));
            sets.min(MOST_SETS)
        })
        .sum::<usize>()
        * if limits.whole_parts.is_some() { 2 } else { 1 }
}

type Sets = BTreeMap<Vec<PigmentId>, Option<Candidate>>;

/// We start from these sets: all required pigments together, or every pigment by itself if you require
/// none.
fn first_sets(limits: &RecipeLimits) -> Sets {
    let mut required: Vec<PigmentId> = limits.required.iter().map(|r| r.pigment).collect();
    required.sort_unstable();
    required.dedup();
    if required.is_empty() {
        return limits.allowed.iter().map(|&pigment| (vec![pigment], None)).collect();
    }
    BTreeMap::from([(required, None)])
}

/// Every set with one pigment more than a set of `tried`, each with the nearest recipe of such a smaller
/// set.
fn grown(limits: &RecipeLimits, tried: &[(Vec<PigmentId>, Option<Candidate>)]) -> Sets {
    let mut parents: Vec<_> = tried.iter().collect();
    parents.sort_by(|a, b| distance(&a.1).total_cmp(&distance(&b.1)).then_with(|| a.0.cmp(&b.0)));
    let mut sets = BTreeMap::new();
    for (set, candidate) in parents {
        for &pigment in limits.allowed.iter().filter(|pigment| !set.contains(pigment)) {
            if sets.len() >= MOST_SETS {
                return sets;
            }
            let mut larger = set.clone();
            larger.insert(larger.partition_point(|&p| p < pigment), pigment);
            sets.entry(larger).or_insert_with(|| candidate.clone());
        }
    }
    sets
}

fn distance(candidate: &Option<Candidate>) -> f64 {
    candidate.as_ref().map_or(f64::INFINITY, |candidate| candidate.distance)
}

/// We assume at least this mean of K + S for a pigment, so that its start share is finite.
const LEAST_STRENGTH: f64 = 1e-6;
/// A new pigment enters the recipe that it extends with this share. We chose it by eye.
const ENTRY_SHARE: f64 = 0.01;
/// A pigment starts at least this much above its lower bound. We chose it by eye.
const LEAST_START: f64 = 1e-3;

/// Mean of K + S over wavelength, by pigment: a measure of how much a share of it changes the colour.
fn strengths(forward: &Forward<'_>) -> Vec<f64> {
    forward
        .library
        .pigments
        .iter()
        .map(|pigment| {
            let sum: f64 = pigment.absorption.iter().chain(&pigment.scattering).sum();
            (sum / pigment.absorption.len() as f64).max(LEAST_STRENGTH)
        })
        .collect()
}

/// Starting points for the descent of a set: the smaller recipe with a small share of the new pigment, and
/// shares inversely proportional to the pigments' strengths. Empty if the bounds allow no recipe.
fn starts(
    limits: &RecipeLimits,
    set: &[PigmentId],
    parent: Option<&Candidate>,
    strength: &[f64],
) -> Vec<Candidate> {
    let (thinnest, thickest) = limits.thickness();
    let middle = (thinnest * thickest).sqrt();
    let even: Vec<f64> = set.iter().map(|&p| 1.0 / strength[p.index()]).collect();
    let mut starts: Vec<Candidate> = Vec::new();
    if let Some(parent) = parent {
        let wished: Vec<f64> = set.iter().map(|&p| parent.share(p).max(ENTRY_SHARE)).collect();
        starts.extend(candidate(limits, set, &wished, parent.thickness));
    }
    starts.extend(candidate(limits, set, &even, middle));
    starts
}

/// Starting points at which one pigment of the set has as much as the bounds allow.
fn corners(limits: &RecipeLimits, set: &[PigmentId]) -> Vec<Candidate> {
    let (thinnest, thickest) = limits.thickness();
    set.iter()
        .filter_map(|main| {
            let wished: Vec<f64> = set.iter().map(|p| f64::from(u8::from(p == main))).collect();
            candidate(limits, set, &wished, (thinnest * thickest).sqrt())
        })
        .collect()
}

/// Shares within their bounds, as near to the proportions of `wished` as the bounds allow.
fn candidate(
    limits: &RecipeLimits,
    set: &[PigmentId],
    wished: &[f64],
    thickness: f64,
) -> Option<Candidate> {
    let bounds: Vec<(f64, f64)> = set.iter().map(|&p| limits.share_bounds(p)).collect();
    let least: f64 = bounds.iter().map(|(least, _)| least).sum();
    let total: f64 = wished.iter().sum();
    let above: Vec<f64> = wished
        .iter()
        .zip(&bounds)
        .map(
            |(wish, (least, most))| {
                if least < most { (wish / total - least).max(LEAST_START) } else { 0.0 }
            },
        )
        .collect();
    let spread: f64 = above.iter().sum();
    let rest = 1.0 - least;
    if rest < -1e-9 || (spread == 0.0 && rest > 1e-9) {
        return None;
    }
    let scale = if spread > 0.0 { rest.max(0.0) / spread } else { 0.0 };
    let shares = above.iter().zip(&bounds).map(|(above, (least, _))| least + scale * above);
    Some(Candidate {
        pigments: set.to_vec(),
        shares: shares.collect(),
        thickness,
        distance: f64::INFINITY,
    })
}

/// A recipe during the search.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Candidate {
    /// Pigments of the library, in rising order.
    pub(super) pigments: Vec<PigmentId>,
    /// Share of each pigment, sum 1.
    pub(super) shares: Vec<f64>,
    /// Thickness of the film in the library's unit.
    pub(super) thickness: f64,
    /// Weighted root mean square of the differences in the metric of the limits.
    pub(super) distance: f64,
}

impl Candidate {
    /// Share of `pigment`, 0 if it is not in the recipe.
    pub(super) fn share(&self, pigment: PigmentId) -> f64 {
        self.pigments.iter().position(|&p| p == pigment).map_or(0.0, |at| self.shares[at])
    }
}

/// A descent has at most this many steps. We measured that one set in a hundred needs more than 20.
const STEPS: usize = 40;
/// If an amount is beyond its limit by a factor of e, this counts as much as this colour difference. We
/// chose it by eye.
const PENALTY: f64 = 30.0;

/// First and last step of the thickness where amounts are at their limits, as a fraction. We chose them by
/// eye.
const FIRST_STEP: f64 = 0.25;
const LAST_STEP: f64 = 1e-3;
/// We halve the step if the distance stays above this fraction of the one before. We chose it by eye.
const LEAST_GAIN: f64 = 0.999;

/// Returns the recipe found from `start` within the bounds. `None` if no film within them holds
/// amounts within their limits.
pub(super) fn descend(
    forward: &Forward<'_>,
    limits: &RecipeLimits,
    target: &Target,
    start: &Candidate,
    scratch: &mut Scratch,
) -> Option<Candidate> {
    let (thinnest, thickest) = limits.thickness();
    let (thinner, thicker) = totals(limits, &start.pigments);
    let range = if thinnest < thickest {
        (thinnest.max(thinner), thickest.min(thicker))
    } else {
        (thinnest, thickest)
    };
    if range.0 > range.1 {
        return None;
    }
    let free = descend_within(forward, limits, target, start, (range, false), scratch);
    let keeps = free.pigments.iter().zip(&free.shares).all(|(&pigment, share)| {
        let (least, most) = limits.share_bounds_at(pigment, free.thickness);
        (least..=most).contains(share)
    });
    if keeps {
        return Some(free);
    }
    // The film is now about as thick as is best within the limits, which at one thickness are bounds of
    // shares. We try nearby thicknesses in halving steps.
    let mut at_thickness = |near: &Candidate, thickness: f64| {
        let start = within_limits(limits, &Candidate { thickness, ..near.clone() })?;
        let range = (thickness, thickness);
        Some(descend_within(forward, limits, target, &start, (range, true), scratch))
    };
    let mut best = at_thickness(&free, free.thickness)?;
    let mut step = if range.0 < range.1 { FIRST_STEP } else { 0.0 };
    while step > LAST_STEP {
        let before = best.distance;
        for thickness in [best.thickness * (1.0 + step), best.thickness / (1.0 + step)] {
            let tried = at_thickness(&best, thickness.clamp(range.0, range.1));
            best = tried.filter(|tried| tried.distance < best.distance).unwrap_or(best);
        }
        if best.distance > LEAST_GAIN * before {
            step /= 2.0;
        }
    }
    Some(best)
}

/// Descends with the thickness in a range. If `bounds_hold`, the limits of amounts are bounds of the
/// shares, and you must fix the thickness. Otherwise there is a penalty beyond the limits.
fn descend_within(
    forward: &Forward<'_>,
    limits: &RecipeLimits,
    target: &Target,
    start: &Candidate,
    ((thinnest, thickest), bounds_hold): ((f64, f64), bool),
    scratch: &mut Scratch,
) -> Candidate {
    let pigments = &start.pigments;
    let shares = pigments.len();
    let chooses_thickness = thinnest < thickest;
    let count = shares + usize::from(chooses_thickness);
    let mut bounds = Bounds { count, shares, lower: [0.0; UNKNOWNS], upper: [0.0; UNKNOWNS] };
    let mut point = [0.0; UNKNOWNS];
    for (at, (&pigment, &share)) in pigments.iter().zip(&start.shares).enumerate() {
        (bounds.lower[at], bounds.upper[at]) = if bounds_hold {
            limits.share_bounds_at(pigment, thinnest)
        } else {
            limits.share_bounds(pigment)
        };
        point[at] = share;
    }
    if chooses_thickness {
        (bounds.lower[shares], bounds.upper[shares]) = (thinnest.ln(), thickest.ln());
        point[shares] = start.thickness.clamp(thinnest, thickest).ln();
    }
    let thickness_at = |point: &[f64; UNKNOWNS]| {
        if chooses_thickness { point[shares].exp().clamp(thinnest, thickest) } else { thinnest }
    };
    let has_limits = pigments.iter().any(|&pigment| limits.amount_bounds(pigment).is_some());
    let cost = descend_within_bounds(
        |point: &[f64; UNKNOWNS]| {
            let unknowns = &point[..count];
            let thickness = thickness_at(point);
            let mut cost =
                forward.cost(target, pigments, unknowns, thickness, chooses_thickness, scratch);
            if has_limits && !bounds_hold {
                add_penalty(&mut cost, limits, pigments, unknowns, thickness);
            }
            cost
        },
        &mut point,
        &bounds,
        STEPS,
    );
    let shares = point[..shares].to_vec();
    let thickness = thickness_at(&point);
    let distance = if has_limits {
        forward.distance(target, pigments, &shares, thickness, scratch)
    } else {
        (2.0 * cost.value).sqrt()
    };
    Candidate { pigments: pigments.clone(), shares, thickness, distance }
}

/// Adds a residual for each amount beyond its limits: the logarithm of the ratio of both, times
/// [`PENALTY`].
fn add_penalty(
    cost: &mut Cost,
    limits: &RecipeLimits,
    pigments: &[PigmentId],
    unknowns: &[f64],
    thickness: f64,
) {
    for (at, &pigment) in pigments.iter().enumerate() {
        let Some([least, most]) = limits.amount_bounds(pigment) else { continue };
        let share = unknowns[at].max(f64::MIN_POSITIVE);
        let amount = share * thickness;
        let residual = PENALTY * (amount / amount.clamp(least, most)).ln();
        if residual == 0.0 {
            continue;
        }
        let mut slopes = [0.0; UNKNOWNS];
        slopes[at] = PENALTY / share;
        if unknowns.len() > pigments.len() {
            slopes[pigments.len()] = PENALTY;
        }
        cost.value += 0.5 * residual * residual;
        for i in 0..unknowns.len() {
            cost.gradient[i] += residual * slopes[i];
            for j in 0..unknowns.len() {
                cost.matrix[i][j] += slopes[i] * slopes[j];
            }
        }
    }
}

/// Least and greatest sum of all amounts that the limits of a set of pigments allow.
fn totals(limits: &RecipeLimits, pigments: &[PigmentId]) -> (f64, f64) {
    let bounds = pigments.iter().map(|&pigment| limits.amount_bounds(pigment));
    let least: f64 = bounds.clone().filter_map(|bounds| Some(bounds?[0])).sum();
    // Shares of a pigment without limits may have any size, and fixed shares stay fixed.
    let taken: f64 = pigments.iter().map(|&pigment| limits.share_bounds(pigment).0).sum();
    let thinnest = if least > 0.0 { least / (1.0 - taken).max(f64::MIN_POSITIVE) } else { 0.0 };
    let most = bounds.map(|bounds| bounds.map_or(f64::INFINITY, |[_, most]| most));
    (if pigments.len() == 1 { least } else { thinnest }, most.sum())
}

/// The recipe with its shares moved within the limits at its thickness. `None` if no shares satisfy them.
pub(super) fn within_limits(limits: &RecipeLimits, recipe: &Candidate) -> Option<Candidate> {
    let bounds: Vec<(f64, f64)> =
        recipe.pigments.iter().map(|&p| limits.share_bounds_at(p, recipe.thickness)).collect();
    let least: f64 = bounds.iter().map(|b| b.0).sum();
    let most: f64 = bounds.iter().map(|b| b.1).sum();
    let crossed = bounds.iter().any(|(least, most)| least > most);
    if crossed || least > 1.0 + 1e-12 || most < 1.0 - 1e-12 {
        return None;
    }
    let mut shares: Vec<f64> =
        recipe.shares.iter().zip(&bounds).map(|(share, b)| share.clamp(b.0, b.1)).collect();
    // We divide the missing amount in proportion to the room that each share has.
    let missing = 1.0 - shares.iter().sum::<f64>();
    let rooms: Vec<f64> = (shares.iter().zip(&bounds))
        .map(|(share, b)| if missing > 0.0 { b.1 - share } else { share - b.0 })
        .collect();
    let total: f64 = rooms.iter().sum();
    if total > 0.0 {
        for (share, room) in shares.iter_mut().zip(&rooms) {
            *share += missing * room / total;
        }
    }
    Some(Candidate { shares, ..recipe.clone() })
}
