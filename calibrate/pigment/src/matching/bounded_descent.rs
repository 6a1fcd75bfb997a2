//! Least squares over shares that keep their sum, inside bounds.

use super::bounded_step::{Bounds, UNKNOWNS, bounded_step};

/// A cost below this is a colour difference of a ten-thousandth.
const NEAR_ENOUGH: f64 = 0.5e-8;

/// Half a sum of squares at one point, its gradient over the unknowns and the
/// Gauss-Newton matrix.
#[derive(Debug, Clone, Copy)]
pub struct Cost {
    /// Half the sum of squares.
    pub value: f64,
    /// Its slope over each unknown.
    pub gradient: [f64; UNKNOWNS],
    /// The products of the residuals' slopes; symmetric.
    pub matrix: [[f64; UNKNOWNS]; UNKNOWNS],
}

/// Levenberg-Marquardt from `point`, its steps kept inside the bounds (Marquardt
/// 1963, with Nielsen's damping of 1999), in at most `steps` steps. Moves
/// `point` to the least cost found and gives that.
///
/// `point` must lie inside the bounds.
pub fn descend_inside(
    mut cost_at: impl FnMut(&[f64; UNKNOWNS]) -> Cost,
    point: &mut [f64; UNKNOWNS],
    bounds: &Bounds,
    steps: usize,
) -> Cost {
    let count = bounds.count;
    let mut cost = cost_at(point);
    let mut damping = 1e-3;
    let mut growth = 2.0;
    for _ in 0..steps {
        if cost.value < NEAR_ENOUGH {
            break;
        }
        let step = bounded_step(&damped(&cost, damping, count), &cost.gradient, point, bounds);
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
            (*point, cost) = (moved, tried);
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
    cost
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
