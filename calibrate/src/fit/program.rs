//! The published quadratic program; the only file that uses the solver.

use clarabel::algebra::{CscMatrix, MatrixMathMut};
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use rayon::prelude::*;

use super::curves::CurveTable;
use super::problem::{FitError, Problem};
use pigment::Curves;

/// Fits K and S by the method `qp`: per wavelength, minimises the sum over mixtures of (C K - Q C S)^2
/// with K and S 0 and up and S = 1 for the reference (Baxter, Wendt and Lin 2004, section 5.2). Rows
/// are not weighted, so dark mixtures, whose Q is in the hundreds, outweigh all others.
///
/// Returns K and S by pigment.
///
/// # Errors
/// [`FitError::Solver`] if the solver does not reach its tolerance.
pub fn fit_qp(problem: &Problem) -> Result<Vec<Curves>, FitError> {
    let rows = vec![1.0; problem.recipes.len()];
    Ok(solve_all(problem, |_| rows.clone())?.into_curves(problem.grid))
}

/// Solves the program at every wavelength, on all cores, with row weights from `weights`.
pub(super) fn solve_all(
    problem: &Problem,
    weights: impl Fn(usize) -> Vec<f64> + Sync,
) -> Result<CurveTable, FitError> {
    let count = problem.grid.count();
    let solved: Vec<Vec<f64>> = (0..count)
        .into_par_iter()
        .map(|at| solve(problem, at, &weights(at)))
        .collect::<Result<_, _>>()?;
    let n = problem.pigments;
    let curve = |place: usize| -> Vec<f64> { solved.iter().map(|v| v[place]).collect() };
    Ok(CurveTable {
        absorption: (0..n).map(curve).collect(),
        scattering: (n..2 * n).map(curve).collect(),
    })
}

/// K of every pigment at one wavelength, followed by S.
fn solve(problem: &Problem, at: usize, weights: &[f64]) -> Result<Vec<f64>, FitError> {
    let n = problem.pigments;
    let reference = n + problem.reference.index();
    // Half the quadratic form over K and all of S; the S of the reference is eliminated below. A row
    // has twice as many entries as its mixture has pigments.
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
    // Columns are scaled to length 1, since Q spans four decades.
    let scale: Vec<f64> = (0..2 * n)
        .map(|i| {
            let length = form[i * 2 * n + i].sqrt();
            if length > 0.0 { length.recip() } else { 1.0 }
        })
        .collect();
    let free: Vec<usize> = (0..2 * n).filter(|&i| i != reference).collect();
    let mut column_starts = vec![0];
    let mut row_indices = Vec::new();
    let mut values = Vec::new();
    for (column, &j) in free.iter().enumerate() {
        for (row, &i) in free[..=column].iter().enumerate() {
            let value = form[i * 2 * n + j] * scale[i] * scale[j];
            if value != 0.0 {
                row_indices.push(row);
                values.push(value);
            }
        }
        column_starts.push(row_indices.len());
    }
    let unknowns = free.len();
    let quadratic = CscMatrix::new(unknowns, unknowns, column_starts, row_indices, values);
    let linear: Vec<f64> = free.iter().map(|&i| form[i * 2 * n + reference] * scale[i]).collect();
    let mut not_below_zero = CscMatrix::identity(unknowns);
    not_below_zero.negate();
    let settings = DefaultSettings { verbose: false, ..DefaultSettings::default() };
    let failed = |status: String| FitError::Solver { nm: problem.grid.nm(at), status };
    let mut solver = DefaultSolver::new(
        &quadratic,
        &linear,
        &not_below_zero,
        &vec![0.0; unknowns],
        &[NonnegativeConeT(unknowns)],
        settings,
    )
    .map_err(|error| failed(error.to_string()))?;
    solver.solve();
    // Almost solved means 1e-4 of the objective, far below the noise of any reading.
    if !matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved) {
        return Err(failed(format!("{:?}", solver.solution.status)));
    }
    let mut solution = vec![0.0; 2 * n];
    solution[reference] = 1.0;
    for (&i, &value) in free.iter().zip(&solver.solution.x) {
        solution[i] = (value * scale[i]).max(0.0);
    }
    Ok(solution)
}
