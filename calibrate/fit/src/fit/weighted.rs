//! The quadratic program with rows weighted into errors of reflectance.

use super::curves::CurveTable;
use super::problem::{FitError, Problem};
use super::program::solve_all;
use super::stage::{FitStage, Watch};
use pigment::Curves;
use spectra::optics::{infinite_film_from_ratio, infinite_film_slope};

/// Number of times that the weights are computed; on the Van Gogh oils more than six gain nothing.
const ROUNDS: usize = 6;
/// Least scattering of a mixture in its weight, so that weights stay finite.
const LEAST_SCATTERING: f64 = 1e-3;

/// Fits K and S by the method `weighted`: the program of [`super::fit_qp`] with each row times dR/dQ (of
/// measured reflectance, at the observed Q) over the mixture's own scattering C S. A residual is then,
/// to first order, an error of measured reflectance (Centore 2013 weights for reflectance too). C S
/// comes from the round before and starts at 1. Since re-weighting can diverge, the round with the
/// least error of reflectance is kept at each wavelength.
///
/// Returns K and S by pigment.
///
/// # Errors
/// [`FitError::Solver`] if the solver does not reach its tolerance.
pub fn fit_weighted(problem: &Problem) -> Result<Vec<Curves>, FitError> {
    fit_weighted_watched(problem, Watch::default())
}

/// Fits like [`fit_weighted`], and tells `watch` the rounds.
pub(crate) fn fit_weighted_watched(
    problem: &Problem,
    watch: Watch<'_>,
) -> Result<Vec<Curves>, FitError> {
    Ok(weighted(problem, watch)?.into_curves(problem.grid))
}

pub(super) fn weighted(problem: &Problem, watch: Watch<'_>) -> Result<CurveTable, FitError> {
    let wavelengths = problem.grid.count();
    let slope = |ratio: f64| {
        let r = infinite_film_from_ratio(ratio).min(1.0 - 1e-9);
        -infinite_film_slope(r) * problem.surface.measured_slope(r)
    };
    let slopes: Vec<Vec<f64>> =
        problem.ratio.iter().map(|row| row.iter().map(|&q| slope(q)).collect()).collect();
    let mut scattering = vec![vec![1.0f64; wavelengths]; problem.recipes.len()];
    let mut best: Option<(Vec<f64>, CurveTable)> = None;
    for round in 1..=ROUNDS {
        watch.check()?;
        watch.tell(FitStage::Programs { round, of: ROUNDS });
        let curves = solve_all(problem, watch, |at| {
            let pairs = slopes.iter().zip(&scattering);
            pairs.map(|(slope, s)| slope[at] / f64::max(s[at], LEAST_SCATTERING)).collect()
        })?;
        let errors = squared_errors(problem, &curves);
        for (index, row) in scattering.iter_mut().enumerate() {
            for (at, s) in row.iter_mut().enumerate() {
                *s = problem.mixed(&curves, index, at).1;
            }
        }
        match &mut best {
            None => best = Some((errors, curves)),
            Some((least, kept)) => {
                for at in 0..wavelengths {
                    if errors[at] >= least[at] {
                        continue;
                    }
                    least[at] = errors[at];
                    for pigment in 0..problem.pigments {
                        kept.absorption[pigment][at] = curves.absorption[pigment][at];
                        kept.scattering[pigment][at] = curves.scattering[pigment][at];
                    }
                }
            }
        }
    }
    Ok(best.expect("there is at least one round").1)
}

/// Sum of squared errors of measured reflectance by wavelength.
fn squared_errors(problem: &Problem, curves: &CurveTable) -> Vec<f64> {
    let predicted = problem.predicted(curves);
    (0..problem.grid.count())
        .map(|at| {
            let pairs = predicted.iter().zip(&problem.reflectance);
            pairs.map(|(p, r)| (p[at] - r[at]).powi(2)).sum()
        })
        .collect()
}
