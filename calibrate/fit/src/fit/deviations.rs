//! Standard deviations of K and S.

use rayon::prelude::*;

use super::banded::{BandedCholesky, TOGETHER};
use super::curves::CurveTable;
use super::forward::{Data, Forward};
use super::objective::{Objective, RIDGE};
use super::problem::Problem;
use super::stage::{FitStage, Watch};
use pigment::Curves;
use pigment::evaluate::percentile;

/// Least K and S for the slopes of [`linear_deviations`].
const LEAST: f64 = 1e-4;

/// Standard deviations of K and S at the minimum of `objective`.
///
/// The larger of two estimates: from the normal matrix, priors included, as if all residuals were
/// independent; and from the spread of the samples' own gradients, H^-1 (sum of g g') H^-1 with g the
/// gradient of one sample over all wavelengths (Liang and Zeger 1986). The second takes into account
/// that a sample painted wrongly is wrong at every wavelength, but is 0 where the few samples of a
/// pigment are fitted exactly.
pub(super) fn standard_deviations<F: Forward>(
    objective: &Objective<'_, F>,
    unknowns: &[f64],
    curves: &CurveTable,
    watch: Watch<'_>,
) -> CurveTable {
    let layout = objective.data.layout;
    let per = layout.per_wavelength();
    // Without data only the ridge remains.
    let mut variances = vec![RIDGE.recip(); layout.len()];
    if let Some(factor) = objective.local(unknowns).matrix.cholesky() {
        let inverse = factor.inverse_band();
        let spread = spread_of_gradients(objective, unknowns, &factor, watch);
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
    CurveTable { absorption, scattering }
}

/// Sum over samples of the squared steps that their own gradients alone would make, by unknown. Samples
/// are added in their order, on any number of threads. Incomplete if the watch ends the fit.
fn spread_of_gradients<F: Forward>(
    objective: &Objective<'_, F>,
    unknowns: &[f64],
    factor: &BandedCholesky,
    watch: Watch<'_>,
) -> Vec<f64> {
    let layout = objective.data.layout;
    let linear = objective.data.linear(&layout.curves(unknowns));
    let samples: Vec<usize> = (0..objective.data.recipes.len()).collect();
    let mut spread = vec![0.0; layout.len()];
    for several in samples.chunks(TOGETHER * rayon::current_num_threads()) {
        if watch.is_cancelled() {
            break;
        }
        watch.tell(FitStage::Deviations { done: several[0], of: samples.len() });
        let steps = several.par_chunks(TOGETHER).map(|group| {
            let mut right = vec![[0.0; TOGETHER]; layout.len()];
            for (place, &index) in group.iter().enumerate() {
                for (unknown, value) in objective.gradient_of_sample(&linear, index) {
                    right[unknown][place] += value;
                }
            }
            factor.solve_together(&mut right);
            right
        });
        let steps: Vec<Vec<[f64; TOGETHER]>> = steps.collect();
        spread.par_iter_mut().enumerate().for_each(|(unknown, total)| {
            for group in &steps {
                group[unknown].iter().for_each(|pull| *total += pull * pull);
            }
        });
    }
    spread
}

/// By pigment, the fraction (0 to 1) of the information on its log S that comes from the data rather
/// than from the prior; the median over wavelength.
///
/// Compares the data's information on log S, with the pigment's own K unknown, with the ridge.
/// `objective` must have no smoothness, which would count the prior of one wavelength as data of its
/// neighbours.
pub(super) fn share_of_scattering_known<F: Forward>(
    objective: &Objective<'_, F>,
    unknowns: &[f64],
) -> Vec<f64> {
    let layout = objective.data.layout;
    let matrix = objective.local(unknowns).matrix;
    let share = |pigment: usize, at: usize| {
        let Some(place) = layout.scattering(pigment) else { return 1.0 };
        let k = at * layout.per_wavelength() + pigment;
        let s = at * layout.per_wavelength() + place;
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

/// Standard deviations of K and S for a fit that has none of its own, by pigment and wavelength.
///
/// Each wavelength is treated by itself: the variance of its residuals of measured reflectance times
/// the inverse of the normal matrix of their derivatives over K and S. A value that no mixture
/// determines gets a deviation of its own size or more; the S of the reference gets 0.
#[must_use]
pub fn linear_deviations(problem: &Problem, curves: &[Curves]) -> Vec<Curves> {
    // The program may set a pigment to 0, where the slopes are not finite.
    let curves = CurveTable::off_zero(curves, [LEAST, LEAST]);
    let data = Data::hiding(problem);
    let layout = data.layout;
    let linear = data.linear(&curves);
    let unknowns = layout.per_wavelength();
    let freedom = problem.recipes.len().saturating_sub(unknowns).max(1) as f64;
    let zeros = || vec![vec![0.0; layout.wavelengths]; layout.pigments];
    let mut deviations = CurveTable { absorption: zeros(), scattering: zeros() };
    for at in 0..layout.wavelengths {
        let mut normal = data.normal(&linear, at);
        let pairs = linear.values.iter().zip(&problem.reflectance);
        let squares: f64 = pairs.map(|(value, read)| (value[at] - read[at]).powi(2)).sum();
        let variance = squares / freedom;
        // The unknowns are logarithms. This term limits their deviations to 1, the deviation of a value that
        // no mixture determines.
        for i in 0..unknowns {
            normal[(i, i)] += variance.max(f64::MIN_POSITIVE);
        }
        let Some(inverse) = normal.cholesky().map(|factor| factor.inverse()) else { continue };
        let sd = |place: usize| (variance * inverse[(place, place)]).sqrt();
        for (pigment, curve) in deviations.absorption.iter_mut().enumerate() {
            curve[at] = curves.absorption[pigment][at] * sd(pigment);
        }
        for (pigment, curve) in deviations.scattering.iter_mut().enumerate() {
            if let Some(place) = layout.scattering(pigment) {
                curve[at] = curves.scattering[pigment][at] * sd(place);
            }
        }
    }
    deviations.into_curves(problem.grid)
}
