//! The nearest recipe of one set of pigments.

use super::bounded_descent::descend_within_bounds;
use super::bounded_step::{Bounds, UNKNOWNS};
use super::candidate::Candidate;
use super::forward::{Forward, Scratch};
use super::request::MatchRequest;
use super::target::Target;

/// Most steps of a descent. Measured: one set in a hundred needs more than 20.
const STEPS: usize = 40;

/// Returns the recipe found from `start` within the bounds.
pub(super) fn descend(
    forward: &Forward<'_>,
    request: &MatchRequest,
    target: &Target,
    start: &Candidate,
    scratch: &mut Scratch,
) -> Candidate {
    let pigments = &start.pigments;
    let shares = pigments.len();
    let (thinnest, thickest) = request.thickness();
    let chooses_thickness = thinnest < thickest;
    let count = shares + usize::from(chooses_thickness);
    let mut bounds = Bounds { count, shares, lower: [0.0; UNKNOWNS], upper: [0.0; UNKNOWNS] };
    let mut point = [0.0; UNKNOWNS];
    for (at, (&pigment, &share)) in pigments.iter().zip(&start.shares).enumerate() {
        (bounds.lower[at], bounds.upper[at]) = request.share_bounds(pigment);
        point[at] = share;
    }
    if chooses_thickness {
        (bounds.lower[shares], bounds.upper[shares]) = (thinnest.ln(), thickest.ln());
        point[shares] = start.thickness.ln();
    }
    let thickness_at = |point: &[f64; UNKNOWNS]| {
        if chooses_thickness { point[shares].exp().clamp(thinnest, thickest) } else { thinnest }
    };
    let mut cost_at = |point: &[f64; UNKNOWNS]| {
        let unknowns = &point[..count];
        forward.cost(target, pigments, unknowns, thickness_at(point), chooses_thickness, scratch)
    };
    let cost = descend_within_bounds(&mut cost_at, &mut point, &bounds, STEPS);
    Candidate {
        pigments: pigments.clone(),
        shares: point[..shares].to_vec(),
        thickness: thickness_at(&point),
        distance: (2.0 * cost.value).sqrt(),
    }
}
