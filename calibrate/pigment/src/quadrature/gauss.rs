//! Gaussian quadrature for a tabulated weight function.

use nalgebra::{DMatrix, SymmetricEigen};

/// Nodes and weights of the Gaussian rule for a discrete weight function.
///
/// The discretised Stieltjes procedure finds the three-term recurrence of the orthogonal polynomials
/// (Gautschi 1982; 2004, section 2.2.3.1). The nodes are the eigenvalues of the Jacobi matrix, and
/// the weights follow from its eigenvectors (Golub and Welsch 1969). Exact for polynomials up to
/// degree 2 n - 1 summed over the points of the weight function.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussRule {
    /// Nodes in rising order, in the unit of the points.
    pub nodes: Vec<f64>,
    /// Weight of each node, above 0; they sum to the sum of the weight function.
    pub weights: Vec<f64>,
    /// By degree k below n: values of the orthonormal polynomial of degree k at the nodes.
    at_nodes: Vec<Vec<f64>>,
    /// By degree k below n: values of that polynomial at the points of the weight function.
    at_points: Vec<Vec<f64>>,
}

impl GaussRule {
    /// Computes the rule of `count` nodes for the weight function `weight` given at `points`.
    ///
    /// Returns `None` if fewer than `count` points have a weight above 0.
    #[must_use]
    pub fn new(points: &[f64], weight: &[f64], count: usize) -> Option<Self> {
        if count == 0 || weight.iter().filter(|w| **w > 0.0).count() < count {
            return None;
        }
        // On -1..1 the polynomials stay bounded.
        let low = points[0];
        let high = points[points.len() - 1];
        let middle = f64::midpoint(low, high);
        let half = (high - low) / 2.0;
        let t: Vec<f64> = points.iter().map(|p| (p - middle) / half).collect();

        let total: f64 = weight.iter().sum();
        let mut diagonal = Vec::with_capacity(count);
        let mut beside: Vec<f64> = Vec::with_capacity(count);
        let mut at_points = vec![vec![total.sqrt().recip(); t.len()]];
        for k in 0..count {
            let p = &at_points[k];
            let center: f64 = (0..t.len()).map(|i| weight[i] * t[i] * p[i] * p[i]).sum();
            diagonal.push(center);
            if k + 1 == count {
                break;
            }
            let mut next: Vec<f64> = (0..t.len())
                .map(|i| {
                    let before = if k == 0 { 0.0 } else { beside[k - 1] * at_points[k - 1][i] };
                    (t[i] - center) * p[i] - before
                })
                .collect();
            let norm = next.iter().zip(weight).map(|(v, w)| w * v * v).sum::<f64>().sqrt();
            next.iter_mut().for_each(|v| *v /= norm);
            beside.push(norm);
            at_points.push(next);
        }

        let jacobi = DMatrix::from_fn(count, count, |i, j| match i.abs_diff(j) {
            0 => diagonal[i],
            1 => beside[i.min(j)],
            _ => 0.0,
        });
        let eigen = SymmetricEigen::new(jacobi);
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
        let weights: Vec<f64> =
            order.iter().map(|&i| total * eigen.eigenvectors[(0, i)].powi(2)).collect();
        // Column i of the eigenvectors holds the polynomials at node i, scaled to length 1; that
        // length is the root of the weight.
        let at_nodes = (0..count)
            .map(|k| {
                order
                    .iter()
                    .map(|&i: &usize| {
                        let first = eigen.eigenvectors[(0, i)];
                        eigen.eigenvectors[(k, i)] / (first * total.sqrt())
                    })
                    .collect()
            })
            .collect();
        let nodes = order.iter().map(|&i| middle + half * eigen.eigenvalues[i]).collect();
        Some(Self { nodes, weights, at_nodes, at_points })
    }

    /// Weights at the same nodes for another weight function on the same points: exact for
    /// polynomials up to degree n - 1. Weights may be negative.
    #[must_use]
    pub fn weights_from_moments(&self, weight: &[f64]) -> Vec<f64> {
        let moments: Vec<f64> =
            self.at_points.iter().map(|p| p.iter().zip(weight).map(|(p, w)| p * w).sum()).collect();
        (0..self.nodes.len())
            .map(|i| {
                let sum: f64 = moments.iter().zip(&self.at_nodes).map(|(m, p)| m * p[i]).sum();
                self.weights[i] * sum
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uneven_weight() -> (Vec<f64>, Vec<f64>) {
        let points: Vec<f64> = (0..300).map(|i| 400.0 + f64::from(i)).collect();
        let weight = points.iter().map(|p| 1.0 + (p / 37.0).sin() + (p / 90.0).cos().powi(2));
        let weight = weight.collect();
        (points, weight)
    }

    #[test]
    fn a_gauss_rule_is_exact_up_to_degree_2n_minus_1() {
        let (points, weight) = uneven_weight();
        let total: f64 = weight.iter().sum();
        for count in 1..=12 {
            let rule = GaussRule::new(&points, &weight, count).unwrap();
            let error = |degree: i32| {
                let f = |nm: f64| ((nm - 550.0) / 150.0).powi(degree);
                let exact: f64 = points.iter().zip(&weight).map(|(p, w)| w * f(*p)).sum();
                let found: f64 = rule.nodes.iter().zip(&rule.weights).map(|(n, w)| w * f(*n)).sum();
                (found - exact).abs() / total
            };
            let last = 2 * count as i32 - 1;
            for degree in 0..=last {
                assert!(error(degree) < 1e-12, "{count} nodes, degree {degree}: {}", error(degree));
            }
            assert!(error(last + 1) > 1e-9, "{count} nodes are exact beyond their degree");
        }
    }

    #[test]
    fn moment_weights_are_exact_up_to_degree_n_minus_1() {
        let (points, weight) = uneven_weight();
        let other: Vec<f64> = points.iter().map(|p| (p / 25.0).sin().powi(2)).collect();
        for count in 1..=12 {
            let rule = GaussRule::new(&points, &weight, count).unwrap();
            let weights = rule.weights_from_moments(&other);
            for degree in 0..count as i32 {
                let f = |nm: f64| ((nm - 550.0) / 150.0).powi(degree);
                let exact: f64 = points.iter().zip(&other).map(|(p, w)| w * f(*p)).sum();
                let found: f64 = rule.nodes.iter().zip(&weights).map(|(n, w)| w * f(*n)).sum();
                assert!((found - exact).abs() < 1e-9 * exact.abs().max(1.0), "{count}, {degree}");
            }
        }
    }

    #[test]
    fn a_rule_with_more_nodes_than_points_is_refused() {
        assert_eq!(GaussRule::new(&[1.0, 2.0], &[1.0, 0.0], 2), None);
    }
}
