//! Standard deviations of K and S.

use super::curves::Curves;
use super::forward::{Data, Forward};
use super::objective::{Objective, RIDGE};
use super::problem::Problem;
use pigment::evaluate::percentile;

/// Standard deviations of K and S at the minimum of `objective`.
///
/// The larger of two: from the normal matrix, priors included, as if every
/// residual were independent; and from the spread of the samples' own pulls,
/// H^-1 (sum of g g') H^-1 with g a sample's gradient over all wavelengths
/// (Liang and Zeger 1986), which knows that a sample painted wrongly is wrong
/// everywhere, but sees nothing where a pigment's few samples are fitted exactly.
pub(super) fn deviations<F: Forward>(
    objective: &Objective<'_, F>,
    unknowns: &[f64],
    curves: &Curves,
) -> [Vec<Vec<f64>>; 2] {
    let layout = objective.data.layout;
    let per = layout.per_wavelength();
    // Without data the ridge alone is left.
    let mut variances = vec![RIDGE.recip(); layout.len()];
    if let Some(factor) = objective.local(unknowns).matrix.cholesky() {
        let inverse = factor.inverse_band();
        let mut spread = vec![0.0; layout.len()];
        for gradient in objective.gradients_by_sample(unknowns) {
            for (total, pull) in spread.iter_mut().zip(factor.solve(&gradient)) {
                *total += pull * pull;
            }
        }
        for (i, variance) in variances.iter_mut().enumerate() {
            *variance = f64::max(inverse.at(i, i), spread[i]);
        }
    }
    let of_logs = |place: usize, curve: &[f64]| -> Vec<f64> {
        let sd = |at: usize| variances[at * per + place].sqrt();
        curve.iter().enumerate().map(|(at, value)| value * sd(at)).collect()
    };
    let absorption =
        curves.absorption.iter().enumerate().map(|(p, curve)| of_logs(p, curve)).collect();
    let scattering = curves
        .scattering
        .iter()
        .enumerate()
        .map(|(p, curve)| match layout.scattering(p) {
            Some(place) => of_logs(place, curve),
            None => vec![0.0; curve.len()],
        })
        .collect();
    [absorption, scattering]
}

/// By pigment, the share of what is known of its log S that comes from the data
/// rather than from the prior, 0 to 1; the median over wavelength.
///
/// The data's information on log S, with the pigment's own K unknown, against
/// the ridge. `objective` must have no smoothness, which would count one
/// wavelength's prior as its neighbours' data.
pub(super) fn share_of_scattering_known<F: Forward>(
    objective: &Objective<'_, F>,
    unknowns: &[f64],
) -> Vec<f64> {
    let layout = objective.data.layout;
    let matrix = objective.local(unknowns).matrix;
    let share = |pigment: usize, at: usize| {
        let Some(place) = layout.scattering(pigment) else { return 1.0 };
        let (k, s) = (at * layout.per_wavelength() + pigment, at * layout.per_wavelength() + place);
        let of_k = (matrix.diagonal(k) - objective.ridge(k)).max(f64::MIN_POSITIVE);
        let of_s = matrix.diagonal(s) - objective.ridge(s);
        let information = (of_s - matrix.at(s, k).powi(2) / of_k).max(0.0);
        information / (information + objective.ridge(s))
    };
    (0..layout.pigments)
        .map(|pigment| {
            let shares: Vec<f64> = (0..layout.wavelengths).map(|at| share(pigment, at)).collect();
            percentile(&shares, 50.0)
        })
        .collect()
}

/// Standard deviations of K and S after a fit that has none of its own, by
/// pigment and wavelength.
///
/// Each wavelength by itself: the variance of its residuals of measured
/// reflectance times the inverse of the normal matrix of their derivatives over
/// K and S. What no mixture determines gets a deviation of its own size or
/// more; the reference's S, which is given, gets 0.
#[must_use]
pub fn linear_deviations(
    problem: &Problem,
    absorption: &[Vec<f64>],
    scattering: &[Vec<f64>],
) -> [Vec<Vec<f64>>; 2] {
    // A program may put a pigment at 0, where the slopes are not finite.
    let off_zero = |curves: &[Vec<f64>]| -> Vec<Vec<f64>> {
        curves.iter().map(|curve| curve.iter().map(|v| v.max(1e-4)).collect()).collect()
    };
    let curves = Curves { absorption: off_zero(absorption), scattering: off_zero(scattering) };
    let data = Data::hiding(problem);
    let (layout, linear) = (data.layout, data.linear(&curves));
    let unknowns = layout.per_wavelength();
    let freedom = problem.recipes.len().saturating_sub(unknowns).max(1) as f64;
    let mut deviations =
        [absorption, scattering].map(|c| vec![vec![0.0; layout.wavelengths]; c.len()]);
    for at in 0..layout.wavelengths {
        let mut normal = data.normal(&linear, at);
        let pairs = linear.values.iter().zip(&problem.reflectance);
        let squares: f64 = pairs.map(|(value, read)| (value[at] - read[at]).powi(2)).sum();
        let variance = squares / freedom;
        // In logarithms, so that a deviation of 1 is as much as nothing known.
        for i in 0..unknowns {
            normal[(i, i)] += variance.max(f64::MIN_POSITIVE);
        }
        let Some(inverse) = normal.cholesky().map(|factor| factor.inverse()) else { continue };
        let sd = |place: usize| (variance * inverse[(place, place)]).sqrt();
        let [of_absorption, of_scattering] = &mut deviations;
        for (pigment, curve) in of_absorption.iter_mut().enumerate() {
            curve[at] = curves.absorption[pigment][at] * sd(pigment);
        }
        for (pigment, curve) in of_scattering.iter_mut().enumerate() {
            if let Some(place) = layout.scattering(pigment) {
                curve[at] = curves.scattering[pigment][at] * sd(place);
            }
        }
    }
    deviations
}
