//! Least squares over shares with a constant sum, within bounds.

use super::bounded_step::{Bounds, UNKNOWNS, bounded_step};

/// A cost below this is good enough: it is half the square of a colour difference of 1e-4.
const NEAR_ENOUGH: f64 = 0.5e-8;
/// First damping: Nielsen's choice for a start near the minimum.
const FIRST_DAMPING: f64 = 1e-3;
/// The descent ends beyond this damping: steps are then below rounding.
const MOST_DAMPING: f64 = 1e9;
/// The descent ends where a step is shorter than this in every unknown; chosen by eye.
const LEAST_STEP: f64 = 1e-9;
/// The descent ends where a step lowers the cost by less than this fraction; chosen by eye.
const LEAST_DECREASE: f64 = 1e-6;

/// Half a sum of squares at one point, with its gradient over the unknowns and the Gauss-Newton
/// matrix.
#[derive(Debug, Clone, Copy)]
pub struct Cost {
    /// Half the sum of squared residuals.
    pub value: f64,
    /// Derivative of `value` with respect to each unknown.
    pub gradient: [f64; UNKNOWNS],
    /// Sums of products of the residuals' derivatives; symmetric.
    pub matrix: [[f64; UNKNOWNS]; UNKNOWNS],
}

/// Minimises a sum of squares from `point` by the Levenberg-Marquardt method with steps that stay
/// within `bounds` (Marquardt 1963, with Nielsen's damping of 1999), in at most `steps` steps. Moves
/// `point` to the least cost found and returns that cost.
///
/// `point` must lie within the bounds.
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
            if damping > MOST_DAMPING {
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
