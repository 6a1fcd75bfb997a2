//! The recipes worth showing, in order.

use spectra::color::{Lab, delta_e_ciede2000};

use super::candidate::Candidate;
use super::film::FilmKind;
use super::forward::{Forward, Scratch};
use super::request::{MatchError, MatchRequest};
use super::search::search;
use super::sight::Target;
use super::watch::Watch;
use super::whole_parts::in_whole_parts;
use crate::evaluate::lab;
use crate::library::{AmountKind, PigmentLibrary};

/// A recipe for a target.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// Pigments of the library with their shares (sum 1), the greatest first.
    pub shares: Vec<(usize, f64)>,
    /// The same as whole parts, where those were asked for.
    pub parts: Option<Vec<u32>>,
    /// The film's thickness; `None` for one that hides.
    pub thickness: Option<f64>,
    /// CIEDE2000 under each sight.
    pub delta_e: Vec<f64>,
    /// Weighted root mean square over the sights of the differences in the
    /// request's metric.
    pub distance: f64,
    /// The recipe's colour under each sight.
    pub lab: Vec<Lab>,
    /// Its measured reflectance on the library's grid.
    pub reflectance: Vec<f64>,
    /// Cost of one unit of the mixture, or of absolute amounts together, where costs are known.
    pub cost: Option<f64>,
}

/// Recipes of `library` for `target`, the best first.
///
/// Recipes that are equally near (within the request's tolerance of the nearest)
/// come cheapest first where costs are known, else with the fewest pigments, then
/// with the largest smallest share. The others follow by distance. A recipe that
/// adds a pigment to one that is shown, without coming nearer by more than the
/// tolerance, is left out.
///
/// # Errors
/// [`MatchError`] if the request cannot be met.
///
/// # Panics
/// If an index of the request is no pigment of `library`, or a ground or target
/// does not fit grid and sights.
pub fn recipes(
    library: &PigmentLibrary,
    target: &Target,
    request: &MatchRequest,
) -> Result<Vec<Recipe>, MatchError> {
    Ok(recipes_watched(library, target, request, &Watch::default())?.unwrap_or_default())
}

/// As [`recipes`], while others look on; `None` if one of them stopped it.
///
/// # Errors
/// As [`recipes`].
///
/// # Panics
/// As [`recipes`].
pub fn recipes_watched(
    library: &PigmentLibrary,
    target: &Target,
    request: &MatchRequest,
    watch: &Watch,
) -> Result<Option<Vec<Recipe>>, MatchError> {
    request.check(library)?;
    let forward = Forward::new(library, request).expect("the method fits the grid");
    let candidates = search(&forward, request, target, watch);
    let found: Vec<Found> = match request.whole_parts {
        None => candidates.into_iter().map(|candidate| (None, candidate)).collect(),
        Some(most) => {
            // Some of the nearest are left out later, for adding nothing.
            let wanted = 5 * request.count;
            in_whole_parts(&forward, request, target, &candidates, (most, wanted), watch)
                .into_iter()
                .map(|(parts, candidate)| (Some(parts), candidate))
                .collect()
        }
    };
    if watch.stopped() {
        return Ok(None);
    }
    let cost = |candidate: &Candidate| cost(library, request, candidate);
    let ranked = ranked(found, request, &cost);
    let recipes = ranked.into_iter().map(|found| recipe(&forward, request, target, found, &cost));
    Ok(Some(recipes.collect()))
}

type Found = (Option<Vec<u32>>, Candidate);

fn ranked(
    mut found: Vec<Found>,
    request: &MatchRequest,
    cost: &dyn Fn(&Candidate) -> f64,
) -> Vec<Found> {
    let nearest = found.iter().map(|(_, c)| c.distance).fold(f64::INFINITY, f64::min);
    let equal = |c: &Candidate| c.distance <= nearest + request.tolerance;
    let smallest = |c: &Candidate| c.shares.iter().copied().fold(1.0, f64::min);
    found.sort_by(|(_, a), (_, b)| {
        let by_distance = || a.distance.total_cmp(&b.distance);
        let order = match (equal(a), equal(b)) {
            (true, true) => cost(a)
                .total_cmp(&cost(b))
                .then(a.pigments.len().cmp(&b.pigments.len()))
                .then(smallest(b).total_cmp(&smallest(a))),
            (true, false) => std::cmp::Ordering::Less,
            (false, true) => std::cmp::Ordering::Greater,
            (false, false) => by_distance(),
        };
        order.then_with(by_distance).then_with(|| a.pigments.cmp(&b.pigments))
    });
    let mut shown: Vec<Found> = Vec::new();
    for (parts, candidate) in found {
        if shown.len() >= request.count {
            break;
        }
        let adds_nothing = shown.iter().any(|(_, before)| {
            before.pigments.iter().all(|pigment| candidate.pigments.contains(pigment))
                && candidate.distance > before.distance - request.tolerance
        });
        if !adds_nothing {
            shown.push((parts, candidate));
        }
    }
    shown
}

/// 0 where no costs are known, so that they decide nothing.
fn cost(library: &PigmentLibrary, request: &MatchRequest, candidate: &Candidate) -> f64 {
    let parts = candidate.pigments.iter().zip(&candidate.shares);
    let of_one: f64 =
        parts.map(|(&pigment, share)| share * request.costs.get(pigment).unwrap_or(&0.0)).sum();
    match library.amounts {
        AmountKind::Relative => of_one,
        // The thickness is the sum of all amounts.
        AmountKind::Absolute => of_one * candidate.thickness,
    }
}

fn recipe(
    forward: &Forward<'_>,
    request: &MatchRequest,
    target: &Target,
    (parts, candidate): Found,
    cost: &dyn Fn(&Candidate) -> f64,
) -> Recipe {
    let Candidate { pigments, shares, thickness, distance } = &candidate;
    let mut scratch = Scratch::default();
    let reflectance = forward.reflectance(pigments, shares, *thickness, &mut scratch);
    let labs: Vec<Lab> = forward.weights.iter().map(|w| lab(w, &reflectance)).collect();
    let mut order: Vec<usize> = (0..pigments.len()).collect();
    order.sort_by(|&a, &b| shares[b].total_cmp(&shares[a]));
    Recipe {
        shares: order.iter().map(|&at| (pigments[at], shares[at])).collect(),
        parts: parts.map(|parts| order.iter().map(|&at| parts[at]).collect()),
        thickness: (request.film != FilmKind::Hiding).then_some(*thickness),
        delta_e: labs.iter().zip(&target.lab).map(|(a, b)| delta_e_ciede2000(*b, *a)).collect(),
        distance: *distance,
        lab: labs,
        reflectance,
        cost: (!request.costs.is_empty()).then(|| cost(&candidate)),
    }
}
