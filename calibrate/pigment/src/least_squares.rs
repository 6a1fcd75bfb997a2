//! Nonlinear least squares within bounds, by the Levenberg-Marquardt method.
//!
//! [`minimise`] fits many parameters (Marquardt 1963, with Nielsen's damping, 1999). If a parameter is at
//! its bound and its gradient points outwards, we fix it for one step. We project every trial point into
//! the bounds (Kanzow, Yamashita and Fukushima 2004, the projected variant).
//!
//! [`descend_within_bounds`] fits the shares of a recipe, which keep their sum. Its quadratic step comes
//! from the primal active-set method (Nocedal and Wright 2006, algorithm 16.3) for at most nine unknowns,
//! which we hold on the stack.

use std::ops::Range;

use documents::Task;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// We begin with this damping. It is Nielsen's choice for a start near the minimum.
const FIRST_DAMPING: f64 = 1e-3;
/// Damping stays above this, so that the matrix keeps a Cholesky factor. We chose it by eye.
const LEAST_DAMPING: f64 = 1e-12;
/// We end the search beyond this damping, because steps are then below rounding.
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

    /// Adds one residual. Pass its derivatives with respect to all parameters.
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
            // Fills the lower triangle only. The solver reads no other entries.
            for (target, other) in
                columns[j * count + j..(j + 1) * count].iter_mut().zip(&derivatives[j..])
            {
                *target += scaled * other;
            }
        }
    }
}

/// Groups of three residuals. Each group depends on few parameters, which we store as ranges of indices.
#[derive(Debug, Clone, Default)]
pub(crate) struct SparseRows {
    groups: Vec<Group>,
    runs: Vec<Range<usize>>,
    /// Derivatives of the three residuals, parameter by parameter.
    derivatives: Vec<[f64; 3]>,
}

#[derive(Debug, Clone)]
struct Group {
    residuals: [f64; 3],
    runs: Range<usize>,
    first: usize,
}

impl SparseRows {
    /// Adds three residuals with their derivatives with respect to the parameters of `runs`, ranges of
    /// indices in rising order.
    pub(crate) fn push(
        &mut self,
        residuals: [f64; 3],
        runs: &[Range<usize>],
        derivatives: &[[f64; 3]],
    ) {
        let before = self.runs.len();
        let first = self.derivatives.len();
        self.runs.extend_from_slice(runs);
        self.derivatives.extend_from_slice(derivatives);
        self.groups.push(Group { residuals, runs: before..self.runs.len(), first });
    }

    fn groups(&self) -> impl Iterator<Item = ([f64; 3], &[Range<usize>], &[[f64; 3]])> {
        self.groups.iter().map(|group| {
            let derivatives = &self.derivatives[group.first..];
            (group.residuals, &self.runs[group.runs.clone()], derivatives)
        })
    }
}

impl NormalEquations {
    /// Equations of `count` parameters. We add up each column of the matrix in the order of the rows, so
    /// you get the same bits for any number of threads.
    pub(crate) fn of_rows(count: usize, parts: &[SparseRows]) -> Self {
        let mut equations = Self::zeros(count);
        // Products that each column takes.
        let mut work = vec![0; count];
        for (residuals, runs, derivatives) in parts.iter().flat_map(SparseRows::groups) {
            equations.cost += 0.5 * dot(residuals, residuals);
            let mut left: usize = runs.iter().map(|run| run.len()).sum();
            for (place, &slopes) in runs.iter().cloned().flatten().zip(derivatives) {
                equations.gradient[place] += dot(slopes, residuals);
                work[place] += left;
                left -= 1;
            }
        }
        let mut columns = equations.matrix.as_mut_slice();
        let mut tasks = Vec::new();
        for range in even_parts(&work, rayon::current_num_threads()) {
            let (part, rest) = columns.split_at_mut(range.len() * count);
            columns = rest;
            tasks.push((range, part));
        }
        tasks.into_par_iter().for_each(|(range, columns)| {
            for (_, runs, derivatives) in parts.iter().flat_map(SparseRows::groups) {
                add_columns(&range, columns, count, runs, derivatives);
            }
        });
        equations
    }
}

/// Adds the products of one group to the columns in `range`: the lower triangle only.
fn add_columns(
    range: &Range<usize>,
    columns: &mut [f64],
    count: usize,
    runs: &[Range<usize>],
    derivatives: &[[f64; 3]],
) {
    let mut first = 0;
    for (index, run) in runs.iter().enumerate() {
        for j in run.start.max(range.start)..run.end.min(range.end) {
            let column = &mut columns[(j - range.start) * count..][..count];
            let mut others = &derivatives[first + j - run.start..];
            let slopes = others[0];
            for to in std::iter::once(j..run.end).chain(runs[index + 1..].iter().cloned()) {
                let (here, rest) = others.split_at(to.len());
                others = rest;
                for (sum, &other) in column[to].iter_mut().zip(here) {
                    *sum += dot(slopes, other);
                }
            }
        }
        first += run.len();
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Divides the indices of `work` into at most `count` ranges with about equal sums.
fn even_parts(work: &[usize], count: usize) -> Vec<Range<usize>> {
    let all: usize = work.iter().sum();
    let mut parts = Vec::new();
    let mut begin = 0;
    let mut done = 0;
    for (place, more) in work.iter().enumerate() {
        done += more;
        let last = place + 1 == work.len();
        if last || done * count >= all * (parts.len() + 1) {
            parts.push(begin..place + 1);
            begin = place + 1;
        }
    }
    parts
}

/// Stopping rule of [`minimise`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stop {
    pub(crate) iterations: usize,
    /// Stops when a step lowers the cost by less than this fraction of it.
    pub(crate) relative_decrease: f64,
}

#[derive(Debug, Clone)]
pub(crate) struct Minimum {
    pub(crate) point: DVector<f64>,
    pub(crate) cost: f64,
}

/// Minimises from `start` within `lower..=upper`. Pass `build`, which returns the normal equations at a
/// point, and `cost`, which returns the cost alone. If you cancel `task`, this ends early and returns the
/// point that it has reached.
pub(crate) fn minimise(
    start: DVector<f64>,
    (lower, upper): (&DVector<f64>, &DVector<f64>),
    stop: Stop,
    task: &Task,
    mut build: impl FnMut(&DVector<f64>) -> NormalEquations,
    mut cost: impl FnMut(&DVector<f64>) -> f64,
) -> Minimum {
    let mut point = start.zip_zip_map(lower, upper, f64::clamp);
    let mut equations = build(&point);
    let largest = equations.matrix.diagonal().max();
    let mut damping = FIRST_DAMPING;
    let mut growth = 2.0;
    for _ in 0..stop.iterations {
        if task.is_cancelled() {
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
            if decrease <= stop.relative_decrease * equations.cost {
                return Minimum { point, cost: trial_cost };
            }
            equations = build(&point);
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

/// Solves (A + damping D) step = -gradient for the parameters that are not `held` at a bound. D is the
/// diagonal of A, and we keep it away from zero.
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

/// We stop below this cost. It is half the square of a colour difference of 1e-4.
const NEAR_ENOUGH: f64 = 0.5e-8;
/// We end the descent beyond this damping, because steps are then below rounding.
const MOST_DAMPING_OF_SHARES: f64 = 1e9;
/// We end the descent where a step is shorter than this in every unknown. We chose it by eye.
const LEAST_STEP: f64 = 1e-9;
/// We end the descent where a step lowers the cost by less than this fraction. We chose it by eye.
const LEAST_DECREASE: f64 = 1e-6;

/// Half a sum of squares at one point, with its gradient and the Gauss-Newton matrix.
#[derive(Debug, Clone, Copy)]
pub struct Cost {
    /// Half the sum of squared residuals.
    pub value: f64,
    /// Derivative of `value` with respect to each unknown.
    pub gradient: [f64; UNKNOWNS],
    /// Sums of products of the residuals' derivatives. Symmetric.
    pub matrix: [[f64; UNKNOWNS]; UNKNOWNS],
}

/// Minimises a sum of squares from `point` by the Levenberg-Marquardt method with steps that stay within
/// `bounds` (Marquardt 1963, with Nielsen's damping of 1999). Makes at most `steps` steps, moves `point` to
/// the least cost found, and returns this cost.
///
/// You must pass a `point` within the bounds.
pub fn descend_within_bounds(
    mut cost_at: impl FnMut(&[f64; UNKNOWNS]) -> Cost,
    point: &mut [f64; UNKNOWNS],
    bounds: &Bounds,
    steps: usize,
) -> Cost {
    let count = bounds.count;
    let mut cost = cost_at(point);
    let mut damping = FIRST_DAMPING;
    let mut growth = 2.0;
    for _ in 0..steps {
        if cost.value < NEAR_ENOUGH {
            break;
        }
        let step = bounded_step(&damped(&cost, damping, count), &cost.gradient, point, bounds);
        let moved: [f64; UNKNOWNS] = std::array::from_fn(|i| point[i] + step[i]);
        if step.iter().all(|d| d.abs() < LEAST_STEP) {
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
            let little = gained < LEAST_DECREASE * cost.value;
            (*point, cost) = (moved, tried);
            if little {
                break;
            }
        } else {
            damping *= growth;
            growth *= 2.0;
            if damping > MOST_DAMPING_OF_SHARES {
                break;
            }
        }
    }
    cost
}

/// Copy of the matrix with its diagonal raised by a fraction of itself and of its largest entry.
fn damped(cost: &Cost, damping: f64, count: usize) -> [[f64; UNKNOWNS]; UNKNOWNS] {
    let mut matrix = cost.matrix;
    let largest = (0..count).map(|i| matrix[i][i]).fold(1e-12, f64::max);
    for (i, row) in matrix.iter_mut().enumerate().take(count) {
        row[i] += damping * row[i] + 1e-9 * largest;
    }
    matrix
}

/// A recipe has at most this many pigments. This sets the size of the arrays below.
pub const MAX_PIGMENTS: usize = 8;
/// A descent has at most this many unknowns: the shares of eight pigments, and the logarithm of the
/// thickness.
pub const UNKNOWNS: usize = MAX_PIGMENTS + 1;

/// Bounds of each unknown. The sum of the first `shares` unknowns is constant.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// Number of unknowns, up to [`UNKNOWNS`].
    pub count: usize,
    /// Number of unknowns at the beginning that have a constant sum.
    pub shares: usize,
    /// Lower bound of each unknown.
    pub lower: [f64; UNKNOWNS],
    /// Upper bound of each unknown.
    pub upper: [f64; UNKNOWNS],
}

impl Bounds {
    /// How far unknown `i` can fall and rise from `point`.
    fn room(&self, point: &[f64; UNKNOWNS], i: usize) -> (f64, f64) {
        (self.lower[i] - point[i], self.upper[i] - point[i])
    }
}

/// Returns the step d from `point` that minimises g d + d H d / 2 within the bounds. You must pass a
/// positive definite `matrix`, and a `point` within the bounds.
pub(super) fn bounded_step(
    matrix: &[[f64; UNKNOWNS]; UNKNOWNS],
    gradient: &[f64; UNKNOWNS],
    point: &[f64; UNKNOWNS],
    bounds: &Bounds,
) -> [f64; UNKNOWNS] {
    let count = bounds.count;
    let mut step = [0.0; UNKNOWNS];
    let mut held = [false; UNKNOWNS];
    for (i, held) in held.iter_mut().enumerate().take(count) {
        let (down, up) = bounds.room(point, i);
        *held = down >= 0.0 || up <= 0.0;
    }
    // Each round fixes or frees one unknown. We allow far more rounds than we ever need.
    for _ in 0..8 * UNKNOWNS {
        let slope: [f64; UNKNOWNS] =
            std::array::from_fn(|i| slope_at(matrix, gradient, &step, count, i));
        let (toward, multiplier) = free_step(matrix, &slope, &held, bounds);
        let mut length = 1.0;
        let mut blocking = None;
        for i in (0..count).filter(|&i| !held[i] && toward[i].abs() > 1e-14) {
            let (down, up) = bounds.room(point, i);
            let limit = if toward[i] < 0.0 { down } else { up };
            let to_limit = ((limit - step[i]) / toward[i]).max(0.0);
            if to_limit < length {
                (length, blocking) = (to_limit, Some((i, limit)));
            }
        }
        for i in (0..count).filter(|&i| !held[i]) {
            step[i] += length * toward[i];
        }
        if let Some((i, limit)) = blocking {
            (step[i], held[i]) = (limit, true);
            continue;
        }
        let Some(freed) = wrongly_held(matrix, gradient, &step, &held, multiplier, bounds, point)
        else {
            break;
        };
        held[freed] = false;
    }
    step
}

/// Slope of the model with respect to unknown `i`, after a step.
fn slope_at(
    matrix: &[[f64; UNKNOWNS]; UNKNOWNS],
    gradient: &[f64; UNKNOWNS],
    step: &[f64; UNKNOWNS],
    count: usize,
    i: usize,
) -> f64 {
    gradient[i] + (0..count).map(|j| matrix[i][j] * step[j]).sum::<f64>()
}

/// Step to the minimum over the unknowns that are not `held` at a bound, and Lagrange's multiplier for the
/// sum of shares.
fn free_step(
    matrix: &[[f64; UNKNOWNS]; UNKNOWNS],
    slope: &[f64; UNKNOWNS],
    held: &[bool; UNKNOWNS],
    bounds: &Bounds,
) -> ([f64; UNKNOWNS], Option<f64>) {
    let mut free = [0; UNKNOWNS];
    let mut count = 0;
    for i in (0..bounds.count).filter(|&i| !held[i]) {
        free[count] = i;
        count += 1;
    }
    let free = &free[..count];
    let mut factor = [[0.0; UNKNOWNS]; UNKNOWNS];
    for i in 0..count {
        for j in 0..=i {
            let known: f64 = (0..j).map(|m| factor[i][m] * factor[j][m]).sum();
            let rest = matrix[free[i]][free[j]] - known;
            factor[i][j] = if i == j { rest.max(1e-300).sqrt() } else { rest / factor[j][j] };
        }
    }
    let is_share: [f64; UNKNOWNS] =
        std::array::from_fn(|i| if i < bounds.shares { 1.0 } else { 0.0 });
    let [plain, along] = [slope.map(|slope| -slope), is_share].map(|right| {
        let mut x = [0.0; UNKNOWNS];
        for i in 0..count {
            let known: f64 = (0..i).map(|m| factor[i][m] * x[m]).sum();
            x[i] = (right[free[i]] - known) / factor[i][i];
        }
        for i in (0..count).rev() {
            let known: f64 = (i + 1..count).map(|m| factor[m][i] * x[m]).sum();
            x[i] = (x[i] - known) / factor[i][i];
        }
        x
    });
    let [of_plain, of_along] = [&plain, &along].map(|x: &[f64; UNKNOWNS]| -> f64 {
        free.iter().zip(x).map(|(&i, value)| is_share[i] * value).sum()
    });
    let multiplier = (of_along > 0.0).then(|| of_plain / of_along);
    let mut step = [0.0; UNKNOWNS];
    for (place, &i) in free.iter().enumerate() {
        step[i] = plain[place] - multiplier.unwrap_or(0.0) * along[place];
    }
    (step, multiplier)
}

/// Index of the unknown at a bound that would lower the quadratic model most if we freed it.
fn wrongly_held(
    matrix: &[[f64; UNKNOWNS]; UNKNOWNS],
    gradient: &[f64; UNKNOWNS],
    step: &[f64; UNKNOWNS],
    held: &[bool; UNKNOWNS],
    multiplier: Option<f64>,
    bounds: &Bounds,
    point: &[f64; UNKNOWNS],
) -> Option<usize> {
    let count = bounds.count;
    // If no share is free, none can change alone, because their sum is fixed. The multiplier is then minus
    // the mean slope of all shares, and we free the share with the slope farthest from this mean.
    let shared = multiplier.unwrap_or_else(|| {
        let shares = bounds.shares.max(1);
        let slopes = (0..bounds.shares).map(|i| slope_at(matrix, gradient, step, count, i));
        -slopes.sum::<f64>() / shares as f64
    });
    let mut worst = (1e-12, None);
    for i in (0..count).filter(|&i| held[i]) {
        let (down, up) = bounds.room(point, i);
        if up - down <= 0.0 {
            continue;
        }
        let slope = slope_at(matrix, gradient, step, count, i);
        let pull = slope + if i < bounds.shares { shared } else { 0.0 };
        // Moving inwards lowers the model where the slope is negative at the lower bound, or positive at the
        // upper bound.
        let gain = if step[i] <= down { -pull } else { pull };
        if gain > worst.0 {
            worst = (gain, Some(i));
        }
    }
    worst.1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rosenbrock(upper: f64) -> Minimum {
        let bounds = (DVector::from_element(2, -2.0), DVector::from_element(2, upper));
        minimise(
            DVector::from_vec(vec![-1.2, 0.4]),
            (&bounds.0, &bounds.1),
            Stop { iterations: 500, relative_decrease: 1e-15 },
            &Task::default(),
            |p| {
                let [r1, r2] = rosenbrock_residuals(p);
                let mut equations = NormalEquations::zeros(2);
                equations.add(r1, &[-20.0 * p[0], 10.0], 1.0);
                equations.add(r2, &[-1.0, 0.0], 1.0);
                equations
            },
            |p| rosenbrock_residuals(p).iter().map(|r| 0.5 * r * r).sum(),
        )
    }

    fn rosenbrock_residuals(p: &DVector<f64>) -> [f64; 2] {
        [10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]]
    }

    #[test]
    fn sparse_rows_give_the_equations_of_full_ones() {
        let count = 53;
        let mut parts = vec![SparseRows::default(); 3];
        let mut wanted = NormalEquations::zeros(count);
        for number in 0..40_usize {
            let runs = [0..5, 7 + number % 4..12 + number % 3, 20 + number % 30..53 - number % 3];
            let places: Vec<usize> = runs.iter().cloned().flatten().collect();
            let derivatives: Vec<[f64; 3]> = places.iter().map(|&place| slopes_at(place)).collect();
            let residuals = [0.1, 0.2, 0.3].map(|c| (c * number as f64).cos());
            // Groups in the order of the parts.
            parts[number / 14].push(residuals, &runs, &derivatives);
            for (row, residual) in residuals.into_iter().enumerate() {
                let mut full = vec![0.0; count];
                places.iter().for_each(|&place| full[place] = slopes_at(place)[row]);
                wanted.add(residual, &full, 1.0);
            }
        }
        let found = NormalEquations::of_rows(count, &parts);
        assert!((found.cost - wanted.cost).abs() < 1e-12, "{}", found.cost);
        assert!((&found.gradient - wanted.gradient).amax() < 1e-12, "gradient");
        assert!((&found.matrix - wanted.matrix).amax() < 1e-12, "matrix");
        let pool = rayon::ThreadPoolBuilder::new().num_threads(5).build().unwrap();
        let on_five = pool.install(|| NormalEquations::of_rows(count, &parts));
        assert_eq!(on_five.matrix, found.matrix, "bits do not depend on the number of threads");
    }

    fn slopes_at(place: usize) -> [f64; 3] {
        [1.0, 2.0, 3.0].map(|c| (c * place as f64 + c).sin())
    }

    #[test]
    fn parts_cover_all_places_and_share_the_work() {
        assert_eq!(even_parts(&[8, 1, 1, 2, 2, 2], 2), [0..1, 1..6]);
        assert_eq!(even_parts(&[1; 6], 3), [0..2, 2..4, 4..6]);
        assert_eq!(even_parts(&[0, 0], 4), [0..1, 1..2]);
        assert_eq!(even_parts(&[], 4), []);
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

    /// Least value of the quadratic model over a fine grid of three shares.
    fn by_grid(matrix: [[f64; 3]; 3], gradient: [f64; 3], point: [f64; 3], least: f64) -> f64 {
        let steps = 400;
        let mut best = f64::INFINITY;
        for i in 0..=steps {
            for j in 0..=steps - i {
                let k = steps - i - j;
                let shares =
                    [i, j, k].map(|n| least + (1.0 - 3.0 * least) * n as f64 / steps as f64);
                let d: [f64; 3] = std::array::from_fn(|c| shares[c] - point[c]);
                let of_unknown = (0..3).map(|i: usize| {
                    gradient[i] * d[i]
                        + (0..3).map(|j| 0.5 * d[i] * matrix[i][j] * d[j]).sum::<f64>()
                });
                best = best.min(of_unknown.sum());
            }
        }
        best
    }

    #[test]
    fn the_step_is_as_good_as_the_best_of_a_fine_grid() {
        let point = [0.02, 0.3, 0.68];
        let least = 0.02;
        let cases = [
            ([[2.0, 0.3, 0.1], [0.3, 1.0, 0.2], [0.1, 0.2, 3.0]], [0.5, -1.0, 0.2]),
            ([[2.0, 0.3, 0.1], [0.3, 1.0, 0.2], [0.1, 0.2, 3.0]], [-5.0, 1.0, 4.0]),
            ([[9.0, 2.0, 0.0], [2.0, 5.0, 1.0], [0.0, 1.0, 1.0]], [1.0, 1.0, -3.0]),
            ([[1e-3, 0.0, 0.0], [0.0, 1e-3, 0.0], [0.0, 0.0, 1e-3]], [3.0, 2.0, 2.5]),
        ];
        for (small, slope) in cases {
            let mut matrix = [[0.0; UNKNOWNS]; UNKNOWNS];
            let mut gradient = [0.0; UNKNOWNS];
            let mut start = [0.0; UNKNOWNS];
            for i in 0..3 {
                matrix[i][..3].copy_from_slice(&small[i]);
                (gradient[i], start[i]) = (slope[i], point[i]);
            }
            let bounds =
                Bounds { count: 3, shares: 3, lower: [least; UNKNOWNS], upper: [1.0; UNKNOWNS] };
            let step = bounded_step(&matrix, &gradient, &start, &bounds);
            let value: f64 = (0..3)
                .map(|i| {
                    slope[i] * step[i]
                        + (0..3).map(|j| 0.5 * step[i] * small[i][j] * step[j]).sum::<f64>()
                })
                .sum();
            assert!(step.iter().sum::<f64>().abs() < 1e-12, "the shares' sum stays: {step:?}");
            for i in 0..3 {
                assert!(point[i] + step[i] >= least - 1e-12, "{step:?}");
            }
            let wanted = by_grid(small, slope, point, least);
            assert!(value <= wanted + 1e-9, "{value} for {wanted}: {step:?}");
        }
    }

    #[test]
    fn an_upper_bound_is_kept() {
        let mut matrix = [[0.0; UNKNOWNS]; UNKNOWNS];
        (matrix[0][0], matrix[1][1]) = (1.0, 2.0);
        let mut gradient = [0.0; UNKNOWNS];
        gradient[1] = -30.0;
        let mut upper = [1.0; UNKNOWNS];
        upper[1] = 9.0;
        let bounds = Bounds { count: 2, shares: 1, lower: [0.0; UNKNOWNS], upper };
        let mut point = [0.0; UNKNOWNS];
        point[0] = 1.0;
        let step = bounded_step(&matrix, &gradient, &point, &bounds);
        assert_eq!(step[..2], [0.0, 9.0]);
    }

    #[test]
    fn an_unknown_that_is_no_share_moves_independently() {
        let mut matrix = [[0.0; UNKNOWNS]; UNKNOWNS];
        (matrix[0][0], matrix[1][1]) = (1.0, 2.0);
        let mut gradient = [0.0; UNKNOWNS];
        (gradient[0], gradient[1]) = (5.0, -3.0);
        let mut bounds =
            Bounds { count: 2, shares: 1, lower: [0.0; UNKNOWNS], upper: [1.0; UNKNOWNS] };
        bounds.upper[1] = 9.0;
        let mut point = [0.0; UNKNOWNS];
        point[0] = 1.0;
        let step = bounded_step(&matrix, &gradient, &point, &bounds);
        assert!(step[0] == 0.0 && (step[1] - 1.5).abs() < 1e-12, "{step:?}");
    }
}
