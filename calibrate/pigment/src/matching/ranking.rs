//! Selection and order of the recipes that are returned.

use spectra::TristimulusWeights;
use spectra::color::{Lab, Xyz, delta_e_ciede2000, metamerism_index};

use super::candidate::Candidate;
use super::error::MatchError;
use super::film::FilmKind;
use super::forward::{Forward, Scratch};
use super::request::{MatchRequest, USUAL_TOLERANCE};
use super::search::search;
use super::search_control::SearchControl;
use super::target::Target;
use super::whole_parts::in_whole_parts;
use crate::evaluate::lab;
use crate::library::{AmountKind, PigmentLibrary};
use crate::recipe::{PigmentId, Recipe};

/// A recipe that was found for a target.
#[derive(Debug, Clone, PartialEq)]
pub struct RecipeMatch {
    /// Pigments of the library with their shares, sum 1, the greatest first.
    pub shares: Recipe,
    /// The shares as whole parts, in the same order, if the request asks for these.
    pub parts: Option<Vec<u32>>,
    /// Thickness of the film; `None` for a film that hides.
    pub thickness: Option<f64>,
    /// CIEDE2000 from the target under each viewing condition.
    pub delta_e: Vec<f64>,
    /// Weighted root mean square over all viewing conditions of the differences in the request's metric, or
    /// over the shared wavelengths, in percent of reflectance, for a search by spectrum.
    pub distance: f64,
    /// Root mean square of the differences of reflectance from a measured target, in percent: with the
    /// weights of a search by spectrum, else evenly over the shared wavelengths. `None` for a target that
    /// was not measured.
    pub rms_percent: Option<f64>,
    /// Special metamerism index (CIE 15:2018, section 9.2, in CIEDE2000) for the change from the first light
    /// to each later one. Empty for a target that was not measured; `None` for a recipe that is black under
    /// the first light.
    pub metamerism: Vec<Option<f64>>,
    /// Colour of the recipe under each viewing condition.
    pub lab: Vec<Lab>,
    /// Measured reflectance of the recipe on the library's grid.
    pub reflectance: Vec<f64>,
    /// Pigments whose absolute amount is the least or the greatest that was measured, because the search
    /// keeps to that range.
    pub at_limit: Vec<(PigmentId, AmountLimit)>,
    /// Price of one unit of the mixture, or of all absolute amounts together; `None` if prices are
    /// unknown.
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
/// Recipes that are equally near (within the request's tolerance of the nearest) are ordered by price
/// where prices are known, then by the number of pigments, then by distance in steps of
/// [`USUAL_TOLERANCE`], then by their smallest share, the greatest first. The others follow by distance.
/// A recipe that adds a pigment to another one of the list without coming nearer by more than the
/// tolerance is left out.
///
/// # Errors
/// [`MatchError`] if the request cannot be met.
///
/// # Panics
/// If a pigment of the request is not in the library, or a ground or target does not fit its grid and
/// viewing conditions.
pub fn recipes(
    library: &PigmentLibrary,
    target: &Target,
    request: &MatchRequest,
) -> Result<Vec<RecipeMatch>, MatchError> {
    Ok(recipes_with_control(library, target, request, &SearchControl::default())?
        .unwrap_or_default())
}

/// Searches recipes like [`recipes`], under the control of another thread. Returns `None` if the search
/// was cancelled.
///
/// # Errors
/// [`MatchError`] if the request cannot be met.
///
/// # Panics
/// If a pigment of the request is not in the library, or a ground or target does not fit its grid and
/// viewing conditions.
pub fn recipes_with_control(
    library: &PigmentLibrary,
    target: &Target,
    request: &MatchRequest,
    control: &SearchControl,
) -> Result<Option<Vec<RecipeMatch>>, MatchError> {
    Ok(recipes_and_nearest(library, target, request, control)?.map(|(recipes, _)| recipes))
}

/// Recipes, and the distance of the nearest of all, which the list may leave out because another is as near
/// within the tolerance. `None` if the search was cancelled.
pub(super) fn recipes_and_nearest(
    library: &PigmentLibrary,
    target: &Target,
    request: &MatchRequest,
    control: &SearchControl,
) -> Result<Option<(Vec<RecipeMatch>, f64)>, MatchError> {
    request.check(library)?;
    if request.metric.spectrum_weights().is_some() && target.spectrum.is_none() {
        return Err(MatchError::NoSpectrum { name: target.name.clone() });
    }
    let forward = Forward::new(library, request).expect("the method fits the grid");
    let candidates = search(&forward, request, target, control);
    let found: Vec<Found> = match request.whole_parts {
        None => candidates.into_iter().map(|candidate| (None, candidate)).collect(),
        Some(most) => {
            let wanted = SPARE_RECIPES * request.count;
            in_whole_parts(&forward, request, target, &candidates, (most, wanted), control)
                .into_iter()
                .map(|(parts, candidate)| (Some(parts), candidate))
                .collect()
        }
    };
    if control.cancelled() {
        return Ok(None);
    }
    let cost = |candidate: &Candidate| cost(library, request, candidate);
    let nearest = found.iter().map(|(_, c)| c.distance).fold(f64::INFINITY, f64::min);
    let ranked = ranked(found, nearest, request, &cost);
    let recipes = ranked.into_iter().map(|found| recipe(&forward, request, target, found, &cost));
    Ok(Some((recipes.collect(), nearest)))
}

/// Number of recipes in whole parts searched for each one returned. More are searched because those that add
/// pigments to a better recipe without coming nearer are left out later. Chosen by eye.
const SPARE_RECIPES: usize = 5;

/// A candidate with its whole parts, if these were asked for.
type Found = (Option<Vec<u32>>, Candidate);

fn ranked(
    mut found: Vec<Found>,
    nearest: f64,
    request: &MatchRequest,
    cost: &dyn Fn(&Candidate) -> f64,
) -> Vec<Found> {
    let equal = |c: &Candidate| c.distance <= nearest + request.tolerance;
    let smallest = |c: &Candidate| c.shares.iter().copied().fold(1.0, f64::min);
    let steps = |c: &Candidate| ((c.distance - nearest) / USUAL_TOLERANCE).floor();
    found.sort_by(|(_, a), (_, b)| {
        let by_distance = || a.distance.total_cmp(&b.distance);
        let order = match (equal(a), equal(b)) {
            (true, true) => cost(a)
                .total_cmp(&cost(b))
                .then(a.pigments.len().cmp(&b.pigments.len()))
                .then(steps(a).total_cmp(&steps(b)))
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

/// Price of a candidate. Without prices it is 0 for all, which leaves their order unchanged.
fn cost(library: &PigmentLibrary, request: &MatchRequest, candidate: &Candidate) -> f64 {
    let parts = candidate.pigments.iter().zip(&candidate.shares);
    let of_one: f64 =
        parts.map(|(p, share)| share * request.costs.get(p.index()).unwrap_or(&0.0)).sum();
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
        thickness: (request.film != FilmKind::Hiding).then_some(*thickness),
        delta_e: labs.iter().zip(&target.lab).map(|(a, b)| delta_e_ciede2000(*b, *a)).collect(),
        distance: *distance,
        lab: labs,
        reflectance,
        at_limit: order.iter().filter_map(|&at| at_limit(request, &candidate, at)).collect(),
        cost: (!request.costs.is_empty()).then(|| cost(&candidate)),
    }
}

/// Metamerism index for the change from the first light to each later one.
fn metamerism(forward: &Forward<'_>, target: &Target, found: &[Lab]) -> Vec<Option<f64>> {
    let whites: Vec<Xyz> = forward.weights.iter().map(TristimulusWeights::white).collect();
    let pair = |labs: &[Lab], at: usize| [0, at].map(|at| labs[at].to_xyz(whites[at]));
    (1..whites.len())
        .map(|at: usize| metamerism_index(pair(&target.lab, at), pair(found, at), whites[at]).ok())
        .collect()
}

/// The limit of amounts at which the pigment at one place of a recipe lies.
fn at_limit(
    request: &MatchRequest,
    candidate: &Candidate,
    place: usize,
) -> Option<(PigmentId, AmountLimit)> {
    let pigment = candidate.pigments[place];
    let amount = candidate.shares[place] * candidate.thickness;
    let [least, most] = request.amount_bounds(pigment)?;
    if amount <= least * (1.0 + AT_LIMIT) {
        Some((pigment, AmountLimit::Least))
    } else if amount >= most * (1.0 - AT_LIMIT) {
        Some((pigment, AmountLimit::Greatest))
    } else {
        None
    }
}

/// Relative distance from a limit below which an amount lies at it.
const AT_LIMIT: f64 = 1e-6;
