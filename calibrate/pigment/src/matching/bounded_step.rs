//! The best step of a quadratic model within bounds, where shares keep their sum.
//!
//! The primal active-set method (Nocedal and Wright 2006, algorithm 16.3) for at most nine unknowns,
//! which are kept on the stack.

/// Most pigments of one recipe; it sets the size of the arrays below.
pub const MAX_PIGMENTS: usize = 8;
/// Most unknowns of one descent: the shares of eight pigments, and the logarithm of the thickness.
pub const UNKNOWNS: usize = MAX_PIGMENTS + 1;

/// Bounds of each unknown. The first `shares` unknowns keep their sum.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// Number of unknowns, up to [`UNKNOWNS`].
    pub count: usize,
    /// Number of unknowns, from the first, that keep their sum.
    pub shares: usize,
    /// Lower bound of each unknown.
    pub lower: [f64; UNKNOWNS],
    /// Upper bound of each unknown.
    pub upper: [f64; UNKNOWNS],
}

/// Returns the step d from `point` that minimises g d + d H d / 2 within the bounds. `matrix` must be
/// positive definite and `point` within the bounds.
pub(super) fn bounded_step(
    matrix: &[[f64; UNKNOWNS]; UNKNOWNS],
    gradient: &[f64; UNKNOWNS],
    point: &[f64; UNKNOWNS],
    bounds: &Bounds,
) -> [f64; UNKNOWNS] {
    let count = bounds.count;
    let room = |i: usize| (bounds.lower[i] - point[i], bounds.upper[i] - point[i]);
    let mut step = [0.0; UNKNOWNS];
    let mut held = [false; UNKNOWNS];
    for (i, held) in held.iter_mut().enumerate().take(count) {
        let (down, up) = room(i);
        *held = down >= 0.0 || up <= 0.0;
    }
    // Each round fixes or frees one unknown; far more rounds than ever needed.
    for _ in 0..8 * UNKNOWNS {
        let slope: [f64; UNKNOWNS] = std::array::from_fn(|i| {
            gradient[i] + (0..count).map(|j| matrix[i][j] * step[j]).sum::<f64>()
        });
        let (toward, multiplier) = free_step(matrix, &slope, &held, bounds);
        let mut length = 1.0;
        let mut blocking = None;
        for i in (0..count).filter(|&i| !held[i] && toward[i].abs() > 1e-14) {
            let (down, up) = room(i);
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
        let Some(freed) = wrongly_held(matrix, gradient, &step, &held, multiplier, bounds, &room)
        else {
            break;
        };
        held[freed] = false;
    }
    step
}

/// Minimum over the unknowns that are not held, and Lagrange's multiplier for the sum of shares.
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
    let solve = |right: &dyn Fn(usize) -> f64| {
        let mut x = [0.0; UNKNOWNS];
        for i in 0..count {
            let known: f64 = (0..i).map(|m| factor[i][m] * x[m]).sum();
            x[i] = (right(free[i]) - known) / factor[i][i];
        }
        for i in (0..count).rev() {
            let known: f64 = (i + 1..count).map(|m| factor[m][i] * x[m]).sum();
            x[i] = (x[i] - known) / factor[i][i];
        }
        x
    };
    let is_share = |i: usize| if i < bounds.shares { 1.0 } else { 0.0 };
    let plain = solve(&|i| -slope[i]);
    let along = solve(&is_share);
    let of_shares = |x: &[f64; UNKNOWNS]| -> f64 {
        free.iter().zip(x).map(|(&i, value)| is_share(i) * value).sum()
    };
    let multiplier = (of_shares(&along) > 0.0).then(|| of_shares(&plain) / of_shares(&along));
    let mut step = [0.0; UNKNOWNS];
    for (place, &i) in free.iter().enumerate() {
        step[i] = plain[place] - multiplier.unwrap_or(0.0) * along[place];
    }
    (step, multiplier)
}

/// Index of the held unknown that would lower the model most if it were free.
fn wrongly_held(
    matrix: &[[f64; UNKNOWNS]; UNKNOWNS],
    gradient: &[f64; UNKNOWNS],
    step: &[f64; UNKNOWNS],
    held: &[bool; UNKNOWNS],
    multiplier: Option<f64>,
    bounds: &Bounds,
    room: &dyn Fn(usize) -> (f64, f64),
) -> Option<usize> {
    let slope =
        |i: usize| gradient[i] + (0..bounds.count).map(|j| matrix[i][j] * step[j]).sum::<f64>();
    // If no share is free, none can change alone, since their sum is fixed. The multiplier is then minus the
    // mean slope of all shares, and the share whose slope differs most from that mean is freed.
    let shared = multiplier.unwrap_or_else(|| {
        let shares = bounds.shares.max(1);
        -(0..bounds.shares).map(slope).sum::<f64>() / shares as f64
    });
    let mut worst = (1e-12, None);
    for i in (0..bounds.count).filter(|&i| held[i]) {
        let (down, up) = room(i);
        if up - down <= 0.0 {
            continue;
        }
        let pull = slope(i) + if i < bounds.shares { shared } else { 0.0 };
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

    /// Least value of the quadratic model over a fine grid of three shares.
    fn by_grid(matrix: [[f64; 3]; 3], gradient: [f64; 3], point: [f64; 3], least: f64) -> f64 {
        let value = |d: [f64; 3]| -> f64 {
            (0..3)
                .map(|i| {
                    gradient[i] * d[i]
                        + (0..3).map(|j| 0.5 * d[i] * matrix[i][j] * d[j]).sum::<f64>()
                })
                .sum()
        };
        let steps = 400;
        let mut best = f64::INFINITY;
        for i in 0..=steps {
            for j in 0..=steps - i {
                let k = steps - i - j;
                let share = |n: usize| least + (1.0 - 3.0 * least) * n as f64 / steps as f64;
                let shares = [share(i), share(j), share(k)];
                best = best.min(value(std::array::from_fn(|c| shares[c] - point[c])));
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
