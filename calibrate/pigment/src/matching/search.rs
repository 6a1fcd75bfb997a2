//! Search over all sets of pigments.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::candidate::Candidate;
use super::descent::descend;
use super::forward::{Forward, Scratch};
use super::request::MatchRequest;
use super::search_control::SearchControl;
use super::target::Target;
use crate::recipe::PigmentId;

/// Distance of the nearest recipe beyond which a target is out of reach, and sets are searched from more
/// starting points.
const FAR: f64 = 2.0;

/// Most sets of one size that are tried: all sets of four out of 30 pigments. For a larger library
/// only the nearest smaller recipes are extended.
const MOST_SETS: usize = 30_000;

/// Returns the nearest recipe of each set of pigments that was tried, nearest first. A search that
/// was cancelled has not tried all sets.
pub(super) fn search(
    forward: &Forward<'_>,
    request: &MatchRequest,
    target: &Target,
    control: &SearchControl,
) -> Vec<Candidate> {
    control.set_total(expected(request));
    let strength = strengths(forward);
    let mut found: Vec<Candidate> = Vec::new();
    let mut sets = first_sets(request);
    let mut size = sets.keys().next().map_or(0, Vec::len);
    loop {
        let nearest = |(set, parent): (&Vec<PigmentId>, &Option<Candidate>),
                       scratch: &mut Scratch| {
            if control.cancelled() {
                return None;
            }
            control.step();
            let starts = starts(request, set, parent.as_ref(), &strength);
            let ends = starts.iter().filter_map(|s| descend(forward, request, target, s, scratch));
            ends.min_by(|a, b| a.distance.total_cmp(&b.distance))
        };
        let tried: Vec<(Vec<PigmentId>, Option<Candidate>)> = sets
            .par_iter()
            .map_init(Scratch::default, |scratch, set| (set.0.clone(), nearest(set, scratch)))
            .collect();
        size += 1;
        let goes_on = size <= request.at_most && !control.cancelled();
        let grown = if goes_on { grown(request, &tried) } else { BTreeMap::new() };
        found.extend(tried.into_iter().filter_map(|(_, candidate)| candidate));
        if grown.is_empty() {
            break;
        }
        sets = grown;
    }
    // Beyond the gamut the distance has several minima, many of them near one pigment.
    if found.iter().all(|candidate| candidate.distance > FAR) && !control.cancelled() {
        found.par_iter_mut().for_each_init(Scratch::default, |scratch, candidate| {
            for corner in corners(request, &candidate.pigments) {
                let end = descend(forward, request, target, &corner, scratch);
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

/// Number of sets that will be tried, doubled where each is also rounded to whole parts.
fn expected(request: &MatchRequest) -> usize {
    let fixed = request.required.len();
    let free = request.allowed.len() - fixed.min(request.allowed.len());
    let sizes = usize::from(fixed == 0)..=request.at_most.saturating_sub(fixed);
    sizes
        .map(|added: usize| {
            let sets = (0..added)
                .fold(1_usize, |sets, i| sets.saturating_mul(free.saturating_sub(i)) / (i + 1));
            sets.min(MOST_SETS)
        })
        .sum::<usize>()
        * if request.whole_parts.is_some() { 2 } else { 1 }
}

type Sets = BTreeMap<Vec<PigmentId>, Option<Candidate>>;

/// The sets that the search starts from: all required pigments together, or every pigment by itself
/// where none is required.
fn first_sets(request: &MatchRequest) -> Sets {
    let mut required: Vec<PigmentId> = request.required.iter().map(|r| r.pigment).collect();
    required.sort_unstable();
    required.dedup();
    if required.is_empty() {
        return request.allowed.iter().map(|&pigment| (vec![pigment], None)).collect();
    }
    BTreeMap::from([(required, None)])
}

/// Every set with one pigment more, each with its nearest smaller recipe.
fn grown(request: &MatchRequest, tried: &[(Vec<PigmentId>, Option<Candidate>)]) -> Sets {
    let distance = |candidate: &Option<Candidate>| {
        candidate.as_ref().map_or(f64::INFINITY, |candidate| candidate.distance)
    };
    let mut parents: Vec<_> = tried.iter().collect();
    parents.sort_by(|a, b| distance(&a.1).total_cmp(&distance(&b.1)).then_with(|| a.0.cmp(&b.0)));
    let mut sets = BTreeMap::new();
    for (set, candidate) in parents {
        for &pigment in request.allowed.iter().filter(|pigment| !set.contains(pigment)) {
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

/// Least mean of K + S that is assumed for a pigment, so that its start share is finite.
const LEAST_STRENGTH: f64 = 1e-6;
/// Share at which a new pigment enters the recipe that it extends; chosen by eye.
const ENTRY_SHARE: f64 = 0.01;
/// Least share above its lower bound with which a pigment starts; chosen by eye.
const LEAST_START: f64 = 1e-3;

/// Mean of K + S over wavelength, by pigment: a measure of how much a share of it changes the colour.
fn strengths(forward: &Forward<'_>) -> Vec<f64> {
    forward
        .library
        .pigments
        .iter()
        .map(|pigment: &crate::library::Pigment| {
            let sum: f64 = pigment.absorption.iter().chain(&pigment.scattering).sum();
            (sum / pigment.absorption.len() as f64).max(LEAST_STRENGTH)
        })
        .collect()
}

/// Starting points for the descent of a set: the smaller recipe with a small share of the new pigment, and
/// shares inversely proportional to the pigments' strengths. Empty if the bounds allow no recipe.
fn starts(
    request: &MatchRequest,
    set: &[PigmentId],
    parent: Option<&Candidate>,
    strength: &[f64],
) -> Vec<Candidate> {
    let (thinnest, thickest) = request.thickness();
    let middle = (thinnest * thickest).sqrt();
    let even: Vec<f64> = set.iter().map(|&p| 1.0 / strength[p.index()]).collect();
    let mut starts: Vec<Candidate> = Vec::new();
    if let Some(parent) = parent {
        let wished: Vec<f64> = set.iter().map(|&p| parent.share(p).max(ENTRY_SHARE)).collect();
        starts.extend(candidate(request, set, &wished, parent.thickness));
    }
    starts.extend(candidate(request, set, &even, middle));
    starts
}

/// Starting points at which one pigment of the set has as much as the bounds allow.
fn corners(request: &MatchRequest, set: &[PigmentId]) -> Vec<Candidate> {
    let (thinnest, thickest) = request.thickness();
    set.iter()
        .filter_map(|main: &PigmentId| {
            let wished: Vec<f64> = set.iter().map(|p| f64::from(u8::from(p == main))).collect();
            candidate(request, set, &wished, (thinnest * thickest).sqrt())
        })
        .collect()
}

/// Shares within their bounds, as near to the proportions of `wished` as those allow.
fn candidate(
    request: &MatchRequest,
    set: &[PigmentId],
    wished: &[f64],
    thickness: f64,
) -> Option<Candidate> {
    let bounds: Vec<(f64, f64)> = set.iter().map(|&p| request.share_bounds(p)).collect();
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
