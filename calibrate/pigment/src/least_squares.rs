//! Bounded nonlinear least squares by the Levenberg-Marquardt method.
//!
//! Marquardt 1963, with Nielsen's damping (1999). A parameter that stands at its bound while its
//! gradient points outwards is fixed for one step, and every trial point is projected into the
//! bounds (Kanzow, Yamashita and Fukushima 2004, the projected variant).

use nalgebra::{DMatrix, DVector};
use spectra::Cancellation;

/// First damping: Nielsen's choice for a start near the minimum.
const FIRST_DAMPING: f64 = 1e-3;
/// Damping stays above this, so that the matrix keeps a Cholesky factor; chosen by eye.
const LEAST_DAMPING: f64 = 1e-12;
/// The search ends beyond this damping: steps are then below rounding.
const MOST_DAMPING: f64 = 1e12;

/// Half the sum of squared residuals, its gradient and the Gauss-Newton matrix (lower triangle).
#[derive(Debug, Clone)]
pub(crate) struct NormalEquations {
    pub(crate) cost: f64,
    pub(crate) gradient: DVector<f64>,
    pub(crate) matrix: DMatrix<f64>,
}

impl NormalEquations {
    pub(crate) fn zeros(count: usize) -> Self {
        Self { cost: 0.0, gradient: DVector::zeros(count), matrix: DMatrix::zeros(count, count) }
    }

    /// Adds one residual with its derivatives over all parameters.
    pub(crate) fn add(&mut self, residual: f64, derivatives: &[f64], weight: f64) {
        self.cost += 0.5 * weight * residual * residual;
        let count = derivatives.len();
        let columns = self.matrix.as_mut_slice();
        for (j, &d) in derivatives.iter().enumerate() {
            if d == 0.0 {
                continue;
            }
            let scaled = weight * d;
            self.gradient[j] += scaled * residual;
            // Fills the lower triangle only; the solver reads no other entries.
            for (target, other) in
                columns[j * count + j..(j + 1) * count].iter_mut().zip(&derivatives[j..])
            {
                *target += scaled * other;
            }
        }
    }
}

impl NormalEquations {
    /// Adds one residual that depends only on the parameters at `places`, in rising order, with its
    /// derivatives over them.
    pub(crate) fn add_at(&mut self, residual: f64, places: &[usize], derivatives: &[f64]) {
        self.cost += 0.5 * residual * residual;
        let count = self.gradient.len();
        let columns = self.matrix.as_mut_slice();
        for (index, (&j, &d)) in places.iter().zip(derivatives).enumerate() {
            self.gradient[j] += d * residual;
            let column = &mut columns[j * count..(j + 1) * count];
            for (&i, other) in places[index..].iter().zip(&derivatives[index..]) {
                column[i] += d * other;
            }
        }
    }

    /// Removes all residuals.
    pub(crate) fn clear(&mut self) {
        self.cost = 0.0;
        self.gradient.fill(0.0);
        self.matrix.fill(0.0);
    }

    /// Adds the residuals of `other`.
    pub(crate) fn join(&mut self, other: &Self) {
        self.cost += other.cost;
        self.gradient += &other.gradient;
        let count = self.gradient.len();
        let columns = self.matrix.as_mut_slice().chunks_exact_mut(count.max(1));
        let others = other.matrix.as_slice().chunks_exact(count.max(1));
        // The lower triangle only, as in `add`.
        for (j, (column, other)) in columns.zip(others).enumerate() {
            column[j..].iter_mut().zip(&other[j..]).for_each(|(a, b)| *a += b);
        }
    }
}

/// Stopping rule of [`minimise`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stop<'a> {
    /// Largest number of steps.
    pub(crate) iterations: usize,
    /// Stops when a step lowers the cost by less than this fraction of it.
    pub(crate) relative_decrease: f64,
    /// Stops once this asks for it.
    pub(crate) cancellation: Option<&'a Cancellation>,
}

/// Point of least cost that was found, with that cost.
#[derive(Debug, Clone)]
pub(crate) struct Minimum {
    pub(crate) point: DVector<f64>,
    pub(crate) cost: f64,
}

/// Minimises from `start` within `lower..=upper`. `build` returns the normal equations at a point,
/// `cost` the cost alone.
pub(crate) fn minimise(
    start: DVector<f64>,
    (lower, upper): (&DVector<f64>, &DVector<f64>),
    stop: Stop<'_>,
    mut build: impl FnMut(&DVector<f64>) -> NormalEquations,
    mut cost: impl FnMut(&DVector<f64>) -> f64,
) -> Minimum {
    let mut point = start.zip_zip_map(lower, upper, f64::clamp);
    let mut equations = build(&point);
    let largest = equations.matrix.diagonal().max();
    let mut damping = FIRST_DAMPING;
    let mut growth = 2.0;
    for _ in 0..stop.iterations {
        if stop.cancellation.is_some_and(Cancellation::is_cancelled) {
            break;
        }
        let held: Vec<bool> = (0..point.len())
            .map(|i| {
                (point[i] <= lower[i] && equations.gradient[i] > 0.0)
                    || (point[i] >= upper[i] && equations.gradient[i] < 0.0)
            })
            .collect();
        let Some(step) = damped_step(&equations, &held, damping, largest) else {
            damping *= growth;
            growth *= 2.0;
            continue;
        };
        let trial = (&point + &step).zip_zip_map(lower, upper, f64::clamp);
        let taken = &trial - &point;
        let trial_cost = cost(&trial);
        let decrease = equations.cost - trial_cost;
        let quadratic = lower_product(&equations.matrix, &taken);
        let promised = -(equations.gradient.dot(&taken) + 0.5 * quadratic);
        if trial_cost.is_finite() && decrease > 0.0 {
            let ratio = if promised > 0.0 { decrease / promised } else { 1.0 };
            damping *= (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0);
            damping = damping.max(LEAST_DAMPING);
            growth = 2.0;
            point = trial;
            let done = decrease <= stop.relative_decrease * equations.cost;
            equations = build(&point);
            if done {
                break;
            }
        } else {
            damping *= growth;
            growth *= 2.0;
            if damping > MOST_DAMPING {
                break;
            }
        }
    }
    Minimum { point, cost: equations.cost }
}

/// Solves (A + damping D) step = -gradient for the parameters that are not held, where D is the
/// diagonal of A kept away from zero.
fn damped_step(
    equations: &NormalEquations,
    held: &[bool],
    damping: f64,
    largest: f64,
) -> Option<DVector<f64>> {
    let mut matrix = equations.matrix.clone();
    let mut right = -&equations.gradient;
    for i in 0..right.len() {
        let diagonal = matrix[(i, i)];
        matrix[(i, i)] += damping * diagonal.max(1e-12 * largest).max(f64::MIN_POSITIVE);
    }
    for (i, _) in held.iter().enumerate().filter(|(_, held)| **held) {
        for j in 0..i {
            matrix[(i, j)] = 0.0;
        }
        for j in i + 1..right.len() {
            matrix[(j, i)] = 0.0;
        }
        matrix[(i, i)] = 1.0;
        right[i] = 0.0;
    }
    // Cholesky reads the lower triangle alone.
    Some(matrix.cholesky()?.solve(&right))
}

/// v' A v of a symmetric matrix A stored as its lower triangle.
fn lower_product(matrix: &DMatrix<f64>, vector: &DVector<f64>) -> f64 {
    let mut total = 0.0;
    for j in 0..vector.len() {
        total += matrix[(j, j)] * vector[j] * vector[j];
        for i in j + 1..vector.len() {
            total += 2.0 * matrix[(i, j)] * vector[i] * vector[j];
        }
    }
    total
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rosenbrock(upper: f64) -> Minimum {
        let bounds = (DVector::from_element(2, -2.0), DVector::from_element(2, upper));
        let residuals = |p: &DVector<f64>| [10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]];
        minimise(
            DVector::from_vec(vec![-1.2, 0.4]),
            (&bounds.0, &bounds.1),
            Stop { iterations: 500, relative_decrease: 1e-15, cancellation: None },
            |p| {
                let [r1, r2] = residuals(p);
                let mut equations = NormalEquations::zeros(2);
                equations.add(r1, &[-20.0 * p[0], 10.0], 1.0);
                equations.add(r2, &[-1.0, 0.0], 1.0);
                equations
            },
            |p| residuals(p).iter().map(|r| 0.5 * r * r).sum(),
        )
    }

    #[test]
    fn the_minimum_of_rosenbrocks_function_is_found() {
        let minimum = rosenbrock(2.0);
        assert!(minimum.cost < 1e-20, "{minimum:?}");
    }

    #[test]
    fn the_minimum_on_a_bound_is_found() {
        let minimum = rosenbrock(0.5);
        assert!(minimum.point.max() <= 0.5, "{minimum:?}");
        // With x and y limited to 0.5 or less, the minimum of 100 (y - x^2)^2 + (1 - x)^2 on the
        // edge y = 0.5 is at the corner x = 0.5.
        assert!((minimum.point[0] - 0.5).abs() < 1e-6, "{minimum:?}");
    }
}
