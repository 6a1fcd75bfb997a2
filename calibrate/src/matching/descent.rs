//! The nearest recipe of one set of pigments.

use super::bounded_step::{Bounds, bounded_step};
use super::candidate::Candidate;
use super::forward::{Cost, Forward, Scratch, UNKNOWNS};
use super::request::MatchRequest;
use super::sight::Target;

/// A cost below this is a colour difference of a ten-thousandth.
const NEAR_ENOUGH: f64 = 0.5e-8;

/// Steps tried at most; a hundredth of the sets need more than twenty.
const STEPS: usize = 40;

/// Levenberg-Marquardt from `start`, its steps kept inside the bounds (Marquardt
/// 1963, with Nielsen's damping of 1999).
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
    let mut cost = cost_at(&point);
    let mut damping = 1e-3;
    let mut growth = 2.0;
    for _ in 0..STEPS {
        if cost.value < NEAR_ENOUGH {
            break;
        }
        let step = bounded_step(&damped(&cost, damping, count), &cost.gradient, &point, &bounds);
        let moved: [f64; UNKNOWNS] = std::array::from_fn(|i| point[i] + step[i]);
        if step.iter().all(|d| d.abs() < 1e-9) {
            break;
        }
        let promised = -(0..count)
            .map(|i| {
                let curved: f64 = (0..count).map(|j| cost.matrix[i][j] * step[j]).sum();
                step[i] * (cost.gradient[i] + 0.5 * curved)
            })
            .sum::<f64>();
        let tried = cost_at(&moved);
        let gained = cost.value - tried.value;
        if gained > 0.0 {
            let ratio = gained / promised.max(1e-300);
            damping *= (1.0 - (2.0 * ratio - 1.0).powi(3)).max(1.0 / 3.0);
            growth = 2.0;
            let little = gained < 1e-6 * cost.value;
            (point, cost) = (moved, tried);
            if little {
                break;
            }
        } else {
            damping *= growth;
            growth *= 2.0;
            if damping > 1e9 {
                break;
            }
        }
    }
    Candidate {
        pigments: pigments.clone(),
        shares: point[..shares].to_vec(),
        thickness: thickness_at(&point),
        distance: (2.0 * cost.value).sqrt(),
    }
}

/// The matrix with its diagonal raised, by a share of itself and of the whole.
fn damped(cost: &Cost, damping: f64, count: usize) -> [[f64; UNKNOWNS]; UNKNOWNS] {
    let mut matrix = cost.matrix;
    let largest = (0..count).map(|i| matrix[i][i]).fold(1e-12, f64::max);
    for (i, row) in matrix.iter_mut().enumerate().take(count) {
        row[i] += damping * row[i] + 1e-9 * largest;
    }
    matrix
}
