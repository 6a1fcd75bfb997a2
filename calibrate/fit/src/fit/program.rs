//! The published quadratic program, plain and with rows weighted into errors of reflectance. We use the
//! solver in this file only.

use clarabel::algebra::{CscMatrix, MatrixMathMut};
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use documents::Task;
use nalgebra::{DMatrix, DVector};
use pigment::Curves;
use rayon::prelude::*;
use spectra::optics::{infinite_film_from_ratio, infinite_film_slope};

use super::problem::{CurveTable, FitError, Problem};

/// From this many unknowns on, we first try the minimum without bounds. With fewer the solver takes no
/// time.
const MANY: usize = 64;
/// If a pivot of the equations (with columns of length 1) is below this, the mixtures do not determine
/// every unknown. We then use the solver, which returns a value in the middle of all equally good ones.
const LEAST_PIVOT: f64 = 1e-4;

/// Fits K and S by the method `qp`. At each wavelength this minimises the sum over mixtures of (C K - Q C
/// S)^2 with K and S 0 and up and S = 1 for the reference (Baxter, Wendt and Lin 2004, section 5.2). We do
/// not weight rows, so dark mixtures with Q in the hundreds outweigh all others.
///
/// Returns K and S by pigment.
///
/// # Errors
/// [`FitError::Solver`] if the solver does not reach its tolerance, [`FitError::Cancelled`] if `task` was
/// cancelled.
pub fn fit_qp(problem: &Problem, task: &Task) -> Result<Vec<Curves>, FitError> {
    let rows = vec![1.0; problem.recipes.len()];
    Ok(solve_all(problem, task, |_| rows.clone())?.into_curves(problem.grid))
}

/// Solves the program at every wavelength, on all cores, with row weights from `weights`.
pub(super) fn solve_all(
    problem: &Problem,
    task: &Task,
    weights: impl Fn(usize) -> Vec<f64> + Sync,
) -> Result<CurveTable, FitError> {
    let count = problem.grid.count();
    let solved: Vec<Vec<f64>> = (0..count)
        .into_par_iter()
        .map(|at| {
            task.check()?;
            let program = Program::new(problem, at, &weights(at));
            let many = program.free.len() >= MANY;
            let free = many.then(|| program.solve_freely()).flatten();
            free.map_or_else(|| program.solve(problem.grid.nm(at)), Ok)
        })
        .collect::<Result<_, _>>()?;
    let n = problem.pigments;
    let curve = |place: usize| -> Vec<f64> { solved.iter().map(|v| v[place]).collect() };
    Ok(CurveTable {
        absorption: (0..n).map(curve).collect(),
        scattering: (n..2 * n).map(curve).collect(),
    })
}

/// The program at one wavelength. Its unknowns are K of every pigment, followed by S of all but the
/// reference. We multiply each unknown by the length of its column, because Q spans four decades.
struct Program {
    /// Indices of the unknowns in the list of K, then S, of all pigments.
    free: Vec<usize>,
    reference: usize,
    /// One over the length of each column of K and S.
    scale: Vec<f64>,
    quadratic: DMatrix<f64>,
    linear: DVector<f64>,
}

impl Program {
    fn new(problem: &Problem, at: usize, weights: &[f64]) -> Self {
        let n = problem.pigments;
        let reference = n + problem.reference.index();
        // Half the quadratic form over K and all of S. We eliminate the S of the reference below. A row has
        // twice as many entries as its mixture has pigments.
        let mut form = vec![0.0; 4 * n * n];
        let mut row: Vec<(usize, f64)> = Vec::new();
        for ((recipe, ratio), weight) in problem.recipes.iter().zip(&problem.ratio).zip(weights) {
            row.clear();
            row.extend(recipe.iter().map(|&(p, c)| (p, weight * c)));
            row.extend(recipe.iter().map(|&(p, c)| (n + p, -weight * ratio[at] * c)));
            for &(i, a) in &row {
                for &(j, b) in &row {
                    form[i * 2 * n + j] += a * b;
                }
            }
        }
        let scale: Vec<f64> = (0..2 * n)
            .map(|i| {
                let length = form[i * 2 * n + i].sqrt();
                if length > 0.0 { length.recip() } else { 1.0 }
            })
            .collect();
        let free: Vec<usize> = (0..2 * n).filter(|&i| i != reference).collect();
        let quadratic = DMatrix::from_fn(free.len(), free.len(), |row: usize, column: usize| {
            let i = free[row];
            let j = free[column];
            form[i * 2 * n + j] * scale[i] * scale[j]
        });
        let linear = free.iter().map(|&i| form[i * 2 * n + reference] * scale[i]);
        let linear = DVector::from_iterator(free.len(), linear);
        Self { free, reference, scale, quadratic, linear }
    }

    /// Solves for K and S of all pigments with the solver. Errors name the wavelength `nm`.
    fn solve(&self, nm: f64) -> Result<Vec<f64>, FitError> {
        let unknowns = self.free.len();
        let mut column_starts = vec![0];
        let mut row_indices = Vec::new();
        let mut values = Vec::new();
        for column in 0..unknowns {
            for row in 0..=column {
                let value = self.quadratic[(row, column)];
                if value != 0.0 {
                    row_indices.push(row);
                    values.push(value);
                }
            }
            column_starts.push(row_indices.len());
        }
        let quadratic = CscMatrix::new(unknowns, unknowns, column_starts, row_indices, values);
        let mut not_below_zero = CscMatrix::identity(unknowns);
        not_below_zero.negate();
        let settings = DefaultSettings { verbose: false, ..DefaultSettings::default() };
        let mut solver = DefaultSolver::new(
            &quadratic,
            self.linear.as_slice(),
            &not_below_zero,
            &vec![0.0; unknowns],
            &[NonnegativeConeT(unknowns)],
            settings,
        )
        .map_err(|error| FitError::Solver { nm, status: error.to_string() })?;
        solver.solve();
        // Almost solved means 1e-4 of the objective, far below the noise of any reading.
        if !matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved) {
            return Err(FitError::Solver { nm, status: format!("{:?}", solver.solution.status) });
        }
        Ok(self.unscaled(&solver.solution.x))
    }

    /// K and S of all pigments at the minimum without bounds. If all are above 0, this is the solution.
    /// Otherwise, and if the mixtures do not determine every unknown, you get `None`.
    fn solve_freely(&self) -> Option<Vec<f64>> {
        let factor = self.quadratic.clone().cholesky()?;
        let open = factor.l_dirty().diagonal().iter().any(|&pivot| pivot < LEAST_PIVOT);
        let solution = self.unscaled(factor.solve(&-&self.linear).as_slice());
        (!open && solution.iter().all(|&value| value > 0.0)).then_some(solution)
    }

    fn unscaled(&self, x: &[f64]) -> Vec<f64> {
        let mut solution = vec![0.0; self.free.len() + 1];
        solution[self.reference] = 1.0;
        for (&i, &value) in self.free.iter().zip(x) {
            solution[i] = (value * self.scale[i]).max(0.0);
        }
        solution
    }
}

/// We compute the weights this many times. On the Van Gogh oils more than six gain nothing.
const ROUNDS: usize = 6;
/// We assume at least this scattering of a mixture in its weight, so that weights stay finite.
const LEAST_SCATTERING: f64 = 1e-3;

/// Fits K and S by the method `weighted`. It is the program of [`super::fit_qp`], but we multiply each row
/// by dR/dQ (of measured reflectance, at the observed Q) and divide it by the mixture's own scattering C S.
/// A residual is then, to first order, an error of measured reflectance (Centore 2013 weights for
/// reflectance too). We take C S from the round before. It starts at 1. Re-weighting can diverge, so at
/// each wavelength we return the round with the least error of reflectance.
///
/// Returns K and S by pigment.
///
/// # Errors
/// [`FitError::Solver`] if the solver does not reach its tolerance, [`FitError::Cancelled`] if `task` was
/// cancelled.
pub fn fit_weighted(problem: &Problem, task: &Task) -> Result<Vec<Curves>, FitError> {
    Ok(weighted(problem, task)?.into_curves(problem.grid))
}

pub(super) fn weighted(problem: &Problem, task: &Task) -> Result<CurveTable, FitError> {
    let wavelengths = problem.grid.count();
    let slopes = problem.ratio.iter().map(|row| {
        let films = row.iter().map(|&ratio| infinite_film_from_ratio(ratio).min(1.0 - 1e-9));
        films.map(|r| -infinite_film_slope(r) * problem.surface.measured_slope(r)).collect()
    });
    let slopes: Vec<Vec<f64>> = slopes.collect();
    let mut scattering = vec![vec![1.0f64; wavelengths]; problem.recipes.len()];
    let mut best: Option<(Vec<f64>, CurveTable)> = None;
    for round in 1..=ROUNDS {
        task.check()?;
        task.stage(format_args!("quadratic programs, round {round} of {ROUNDS}"));
        let curves = solve_all(problem, task, |at| {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::SyntheticMixtures;
    use pigment::PigmentId;

    #[test]
    fn a_minimum_above_zero_is_the_solvers_solution() {
        let made = SyntheticMixtures::paper_size(1, 0.0001);
        let problem = Problem::new(made.grid, made.surface, &made.observations, PigmentId(0));
        let problem = problem.unwrap();
        let weights = vec![1.0; problem.recipes.len()];
        let mut compared = 0;
        for at in 0..problem.grid.count() {
            let program = Program::new(&problem, at, &weights);
            let Some(free) = program.solve_freely() else { continue };
            let solved = program.solve(problem.grid.nm(at)).unwrap();
            let [free, solved] = [free, solved].map(|values: Vec<f64>| {
                let scaled = program.free.iter().map(|&i| values[i] / program.scale[i]);
                let x = DVector::from_iterator(program.free.len(), scaled);
                0.5 * x.dot(&(&program.quadratic * &x)) + program.linear.dot(&x)
            });
            assert!(
                (free - 1e-9..free + 1e-6).contains(&solved),
                "wavelength {at}: {free} {solved}"
            );
            compared += 1;
        }
        assert!(compared > 10, "{compared} wavelengths have all K and S above 0");
    }
}
