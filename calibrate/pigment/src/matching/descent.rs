//! The nearest recipe of one set of pigments.

use super::bounded_descent::{Cost, descend_within_bounds};
use super::bounded_step::{Bounds, UNKNOWNS};
use super::candidate::Candidate;
use super::forward::{Forward, Scratch};
use super::request::MatchRequest;
use super::target::Target;
use crate::recipe::PigmentId;

/// Most steps of a descent. Measured: one set in a hundred needs more than 20.
const STEPS: usize = 40;
/// Colour difference that counts as much as an amount beyond its limit by a factor of e; chosen by eye.
const PENALTY: f64 = 30.0;

/// First and last step of the thickness where amounts are at their limits, as a fraction; chosen by eye.
const FIRST_STEP: f64 = 0.25;
const LAST_STEP: f64 = 1e-3;
/// The step is halved where the distance stays above this fraction of the one before; chosen by eye.
const LEAST_GAIN: f64 = 0.999;

/// Returns the recipe found from `start` within the bounds; `None` if no film of the request holds
/// amounts within their limits.
pub(super) fn descend(
    forward: &Forward<'_>,
    request: &MatchRequest,
    target: &Target,
    start: &Candidate,
    scratch: &mut Scratch,
) -> Option<Candidate> {
    let (thinnest, thickest) = request.thickness();
    let (thinner, thicker) = totals(request, &start.pigments);
    let range = if thinnest < thickest {
        (thinnest.max(thinner), thickest.min(thicker))
    } else {
        (thinnest, thickest)
    };
    if range.0 > range.1 {
        return None;
    }
    let free = descend_within(forward, request, target, start, (range, false), scratch);
    let keeps = free.pigments.iter().zip(&free.shares).all(|(&pigment, share)| {
        let (least, most) = request.share_bounds_at(pigment, free.thickness);
        (least..=most).contains(share)
    });
    if keeps {
        return Some(free);
    }
    // The film is now about as thick as is best within the limits, which at one thickness are bounds of
    // shares. Nearby thicknesses are tried in halving steps.
    let mut at_thickness = |near: &Candidate, thickness: f64| {
        let start = within_limits(request, &Candidate { thickness, ..near.clone() })?;
        let range = (thickness, thickness);
        Some(descend_within(forward, request, target, &start, (range, true), scratch))
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

/// Descends with the thickness in a range: with limits of amounts as bounds of the shares if `bounds_hold`,
/// for which the thickness must be fixed, else with a penalty beyond them.
fn descend_within(
    forward: &Forward<'_>,
    request: &MatchRequest,
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
            request.share_bounds_at(pigment, thinnest)
        } else {
            request.share_bounds(pigment)
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
    let has_limits = pigments.iter().any(|&pigment| request.amount_bounds(pigment).is_some());
    let mut cost_at = |point: &[f64; UNKNOWNS]| {
        let unknowns = &point[..count];
        let thickness = thickness_at(point);
        let mut cost =
            forward.cost(target, pigments, unknowns, thickness, chooses_thickness, scratch);
        if has_limits && !bounds_hold {
            add_penalty(&mut cost, request, pigments, unknowns, thickness);
        }
        cost
    };
    let cost = descend_within_bounds(&mut cost_at, &mut point, &bounds, STEPS);
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
    request: &MatchRequest,
    pigments: &[PigmentId],
    unknowns: &[f64],
    thickness: f64,
) {
    for (at, &pigment) in pigments.iter().enumerate() {
        let Some([least, most]) = request.amount_bounds(pigment) else { continue };
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
fn totals(request: &MatchRequest, pigments: &[PigmentId]) -> (f64, f64) {
    let bounds = || pigments.iter().map(|&pigment| (pigment, request.amount_bounds(pigment)));
    let least: f64 = bounds().filter_map(|(_, limits)| Some(limits?[0])).sum();
    // Shares of a pigment without limits may be as large as they like, fixed ones are what they are.
    let taken: f64 = bounds().map(|(pigment, _)| request.share_bounds(pigment).0).sum();
    let thinnest = if least > 0.0 { least / (1.0 - taken).max(f64::MIN_POSITIVE) } else { 0.0 };
    let most = bounds().map(|(_, limits)| limits.map_or(f64::INFINITY, |[_, most]| most));
    (if pigments.len() == 1 { least } else { thinnest }, most.sum())
}

/// The recipe with its shares moved within the limits at its thickness; `None` if there are none.
pub(super) fn within_limits(request: &MatchRequest, recipe: &Candidate) -> Option<Candidate> {
    let bounds: Vec<(f64, f64)> =
        recipe.pigments.iter().map(|&p| request.share_bounds_at(p, recipe.thickness)).collect();
    let sum = |of: fn(&(f64, f64)) -> f64| bounds.iter().map(of).sum::<f64>();
    let crossed = bounds.iter().any(|(least, most)| least > most);
    if crossed || sum(|b| b.0) > 1.0 + 1e-12 || sum(|b| b.1) < 1.0 - 1e-12 {
        return None;
    }
    let mut shares: Vec<f64> =
        recipe.shares.iter().zip(&bounds).map(|(share, b)| share.clamp(b.0, b.1)).collect();
    // What is missing is shared out by the room that each share has.
    let missing = 1.0 - shares.iter().sum::<f64>();
    let room =
        |(share, b): (&f64, &(f64, f64))| if missing > 0.0 { b.1 - share } else { share - b.0 };
    let rooms: Vec<f64> = shares.iter().zip(&bounds).map(room).collect();
    let total: f64 = rooms.iter().sum();
    if total > 0.0 {
        for (share, room) in shares.iter_mut().zip(&rooms) {
            *share += missing * room / total;
        }
    }
    Some(Candidate { shares, ..recipe.clone() })
}
