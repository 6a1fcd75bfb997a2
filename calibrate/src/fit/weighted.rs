//! The program, its rows weighted into errors of reflectance.

use super::curves::Curves;
use super::problem::{FitError, Problem};
use super::program::solve_all;
use spectra::optics::{infinite_film_from_ratio, infinite_film_slope};

/// How often the weights are set anew: on the Van Gogh oils nothing is gained
/// after the sixth.
const ROUNDS: usize = 6;

/// K and S by `weighted`: the program of [`super::fit_qp`] with each row times
/// dR/dQ (of measured reflectance, at the observed Q) over the mixture's own
/// scattering C S, so that a residual is, to first order, an error of measured
/// reflectance (after Centore 2013, who weights for reflectance too). C S comes
/// from the round before and starts at 1; since re-weighting can diverge, the
/// round with the least error of reflectance is kept, at each wavelength.
///
/// Returns absorption and scattering by pigment and wavelength.
///
/// # Errors
/// As [`super::fit_qp`].
pub fn fit_weighted(problem: &Problem) -> Result<[Vec<Vec<f64>>; 2], FitError> {
    let curves = weighted(problem)?;
    Ok([curves.absorption, curves.scattering])
}

pub(super) fn weighted(problem: &Problem) -> Result<Curves, FitError> {
    let wavelengths = problem.grid.count();
    let slope = |ratio: f64| {
        let r = infinite_film_from_ratio(ratio).min(1.0 - 1e-9);
        -infinite_film_slope(r) * problem.surface.measured_slope(r)
    };
    let slopes: Vec<Vec<f64>> =
        problem.ratio.iter().map(|row| row.iter().map(|&q| slope(q)).collect()).collect();
    let mut scattering = vec![vec![1.0f64; wavelengths]; problem.recipes.len()];
    let mut best: Option<(Vec<f64>, Curves)> = None;
    for _ in 0..ROUNDS {
        let curves = solve_all(problem, |at| {
            let pairs = slopes.iter().zip(&scattering);
            pairs.map(|(slope, s)| slope[at] / f64::max(s[at], 1e-3)).collect()
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

/// By wavelength, the sum of squared errors of measured reflectance.
fn squared_errors(problem: &Problem, curves: &Curves) -> Vec<f64> {
    let predicted = problem.predicted(curves);
    (0..problem.grid.count())
        .map(|at| {
            let pairs = predicted.iter().zip(&problem.reflectance);
            pairs.map(|(p, r)| (p[at] - r[at]).powi(2)).sum()
        })
        .collect()
}
