//! Cost of the refinement, and the steps of the Levenberg-Marquardt method that minimise it.

use rayon::prelude::*;

use super::banded::{Banded, BandedCholesky, ColumnsMut, Spare};
use super::color_term::{ColorResidual, ColorTerm};
use super::curves::{LOWER, UPPER};
use super::forward::{Data, Forward, Linear};
use super::stage::Watch;

/// Strength of the pull of every unknown towards its start, in 1 / (log unit)^2: a standard deviation of 10.
/// It only keeps unknowns that no sample determines from diverging.
pub(super) const RIDGE: f64 = 0.01;
/// First damping of a descent; chosen by eye.
const FIRST_DAMPING: f64 = 1e-2;
/// Damping stays above this, so that the matrix keeps a Cholesky factor.
const LEAST_DAMPING: f64 = 1e-8;
/// Factor by which damping falls after a step that lowers the cost; chosen by eye.
const DAMPING_FALL: f64 = 5.0;
/// Factor by which damping rises after a step that does not; chosen by eye.
const DAMPING_RISE: f64 = 6.0;
/// Most dampings tried for one step.
const TRIALS: usize = 8;
/// Longest step of one unknown, in log units; chosen by eye.
const LONGEST_STEP: f64 = 2.0;
/// Added to the diagonal, so that unknowns without data have a finite step.
const DIAGONAL_FLOOR: f64 = 1e-9;
/// Squared relative residual at which conjugate gradients stop: a thousandth of the start.
const GRADIENT_TOLERANCE: f64 = 1e-6;
/// Most steps of conjugate gradients; the preconditioner needs about ten. Chosen by eye.
const GRADIENT_STEPS: usize = 60;

/// Cost of a fit, in units of the residual's variance. It is the sum of
///
/// - spectral: rho(w (cbrt R - cbrt R_measured)), with the knee at 3 standard deviations;
/// - roughness: smoothness / 2 (second difference over wavelength)^2 of each log K and log S;
/// - ridge: [`RIDGE`] / 2 (log - start)^2, with a strength of its own for log S;
/// - colour: strength x rho(CIEDE2000) of each sample;
///
/// where rho(r) = c^2 (sqrt(1 + (r/c)^2) - 1) is half a square near 0 and straight beyond the knee c.
pub(super) struct Objective<'a, F> {
    pub(super) data: &'a Data<'a, F>,
    /// Weight w by sample and wavelength: one over the residual's standard deviation.
    pub(super) weights: Vec<Vec<f64>>,
    pub(super) knee: f64,
    pub(super) smoothness: f64,
    pub(super) start: &'a [f64],
    /// Strength of the pull of log S towards its start; that of log K is [`RIDGE`].
    pub(super) scattering_ridge: f64,
    pub(super) color: Option<ColorPart<'a>>,
    pub(super) spare: Spare,
    /// Ends a descent before its time.
    pub(super) watch: Watch<'a>,
}

/// Colour term of the cost.
pub(super) struct ColorPart<'a> {
    pub(super) term: &'a ColorTerm<'a>,
    pub(super) strength: f64,
    pub(super) knee: f64,
}

/// The cost near a point: its value, gradient and Gauss-Newton matrix.
pub(super) struct Local {
    pub(super) cost: f64,
    gradient: Vec<f64>,
    /// Gauss-Newton matrix of all terms but the colour.
    pub(super) matrix: Banded,
    /// Diagonal of the Gauss-Newton matrix, colour included.
    diagonal: Vec<f64>,
    /// Rows of the colour term by sample, with their weights.
    color: Vec<(ColorResidual, f64)>,
    slopes: Vec<Vec<f64>>,
}

/// Robust loss rho and its weight rho'(r) / r.
pub(super) fn robust(squared: f64, knee: f64) -> (f64, f64) {
    let root = (1.0 + squared / (knee * knee)).sqrt();
    (knee * knee * (root - 1.0), root.recip())
}

impl<F: Forward> Objective<'_, F> {
    pub(super) fn cost(&self, unknowns: &[f64]) -> f64 {
        let values = self.data.values(&self.data.layout.curves(unknowns));
        let of_sample = |(index, row): (usize, &Vec<f64>)| {
            let pairs = row.iter().zip(&self.data.roots[index]).zip(&self.weights[index]);
            let spectral = pairs.map(|((value, root), weight)| {
                let residual = weight * (value.cbrt() - root);
                robust(residual * residual, self.knee).0
            });
            let color = self.color.as_ref().map(|color| {
                let difference = color.term.difference(index, row);
                color.strength * robust(difference * difference, color.knee).0
            });
            spectral.chain(color).collect::<Vec<f64>>()
        };
        let terms: Vec<Vec<f64>> = values.par_iter().enumerate().map(of_sample).collect();
        terms.iter().flatten().fold(self.prior_cost(unknowns), |cost, term| cost + term)
    }

    pub(super) fn local(&self, unknowns: &[f64]) -> Local {
        let layout = self.data.layout;
        let per = layout.per_wavelength();
        let linear = self.data.linear(&layout.curves(unknowns));
        let reach = if self.smoothness > 0.0 { 2 * per } else { per - 1 };
        let reach = reach.min(layout.len() - 1);
        let mut local = Local {
            cost: self.prior_cost(unknowns),
            gradient: vec![0.0; layout.len()],
            matrix: self.spare.zeros(layout.len(), reach),
            diagonal: Vec::new(),
            color: Vec::new(),
            slopes: Vec::new(),
        };
        self.add_priors(unknowns, &mut local);
        let costs = self.add_spectral(&linear, &mut local);
        for index in 0..self.data.recipes.len() {
            local.cost = costs.iter().fold(local.cost, |cost, terms| cost + terms[index]);
        }
        local.diagonal = (0..layout.len()).map(|i| local.matrix.diagonal(i)).collect();
        if let Some(color) = &self.color {
            let row = |(index, values): (usize, &Vec<f64>)| {
                let row = color.term.linear(index, values);
                let squared: f64 = row.residual.iter().map(|v| v * v).sum();
                let (cost, share) = robust(squared, color.knee);
                (row, color.strength * share, color.strength * cost)
            };
            let rows: Vec<_> = linear.values.par_iter().enumerate().map(row).collect();
            for (row, weight, cost) in rows {
                local.cost += cost;
                local.color.push((row, weight));
            }
            local.slopes = linear.slopes;
            self.add_color(&mut local);
        }
        local
    }

    /// Adds the spectral term to gradient and matrix, all wavelengths in parallel, and returns its cost by
    /// wavelength and sample.
    fn add_spectral(&self, linear: &Linear, local: &mut Local) -> Vec<Vec<f64>> {
        let per = self.data.layout.per_wavelength();
        let at_one = |(at, (gradient, mut matrix)): (usize, (&mut [f64], ColumnsMut<'_>))| {
            let of_sample = |index: usize| {
                let places = self.data.places(index);
                let value = linear.values[index][at];
                let weight = self.weights[index][at];
                let root = value.cbrt();
                let residual = weight * (root - self.data.roots[index][at]);
                let (cost, share) = robust(residual * residual, self.knee);
                let over_value = weight / (3.0 * root * root);
                let slopes = &linear.slopes[index][at * places.len()..(at + 1) * places.len()];
                for (a, &place) in places.iter().enumerate() {
                    let slope = share * over_value * slopes[a];
                    gradient[place] += slope * residual;
                    for (b, &other) in places[..=a].iter().enumerate() {
                        let row = place.max(other);
                        let column = place.min(other);
                        matrix.add(row, column, slope * over_value * slopes[b]);
                    }
                }
                cost
            };
            (0..self.data.recipes.len()).map(of_sample).collect()
        };
        let parts = local.gradient.par_chunks_mut(per).zip(local.matrix.by_columns(per));
        parts.enumerate().map(at_one).collect()
    }

    /// Places and values of the gradient of one sample's spectral term, where it is not 0.
    pub(super) fn gradient_of_sample(
        &self,
        linear: &Linear,
        index: usize,
    ) -> impl Iterator<Item = (usize, f64)> {
        let per = self.data.layout.per_wavelength();
        let places = self.data.places(index);
        (0..self.data.layout.wavelengths).flat_map(move |at| {
            let value = linear.values[index][at];
            let weight = self.weights[index][at];
            let root = value.cbrt();
            let residual = weight * (root - self.data.roots[index][at]);
            let (_, share) = robust(residual * residual, self.knee);
            let pull = share * residual * weight / (3.0 * root * root);
            let slopes = &linear.slopes[index][at * places.len()..(at + 1) * places.len()];
            places.iter().zip(slopes).map(move |(&place, slope)| (at * per + place, pull * slope))
        })
    }

    /// Moves `unknowns` downhill until one step lowers the cost by less than the fraction `relative`, or
    /// for `iterations` steps, or until the watch ends the fit.
    pub(super) fn descend(&self, unknowns: &mut Vec<f64>, iterations: usize, relative: f64) {
        let mut damping: f64 = FIRST_DAMPING;
        let mut local = self.local(unknowns);
        for _ in (0..iterations).take_while(|_| !self.watch.is_cancelled()) {
            let Some((trial, cost)) = self.improved(unknowns, &local, &mut damping) else { break };
            let decrease = local.cost - cost;
            *unknowns = trial;
            if decrease < relative * local.cost {
                break;
            }
            self.spare.keep(local.matrix);
            local = self.local(unknowns);
        }
        self.spare.keep(local.matrix);
    }

    fn improved(
        &self,
        unknowns: &[f64],
        local: &Local,
        damping: &mut f64,
    ) -> Option<(Vec<f64>, f64)> {
        let held: Vec<bool> = unknowns
            .iter()
            .zip(&local.gradient)
            .map(|(&x, &g)| (x <= LOWER && g > 0.0) || (x >= UPPER && g < 0.0))
            .collect();
        for _ in 0..TRIALS {
            let trial = self.step(local, &held, *damping).map(|step| {
                let moved = unknowns.iter().zip(&step);
                moved
                    .map(|(x, d)| (x + d.clamp(-LONGEST_STEP, LONGEST_STEP)).clamp(LOWER, UPPER))
                    .collect()
            });
            if let Some(trial) = trial {
                let trial: Vec<f64> = trial;
                let cost = self.cost(&trial);
                if cost < local.cost {
                    *damping = (*damping / DAMPING_FALL).max(LEAST_DAMPING);
                    return Some((trial, cost));
                }
            }
            *damping *= DAMPING_RISE;
        }
        None
    }

    /// Damped Gauss-Newton step: directly from the banded factor or, with the colour term, which couples
    /// all wavelengths, by conjugate gradients with that factor as preconditioner.
    fn step(&self, local: &Local, held: &[bool], damping: f64) -> Option<Vec<f64>> {
        let mut matrix = self.spare.copy(&local.matrix);
        let mut right: Vec<f64> = local.gradient.iter().map(|g| -g).collect();
        for (i, diagonal) in local.diagonal.iter().enumerate() {
            matrix.add(i, i, damping * diagonal + DIAGONAL_FLOOR);
        }
        for i in (0..right.len()).filter(|&i| held[i]) {
            matrix.hold(i);
            right[i] = 0.0;
        }
        if self.color.is_none() {
            let factor = matrix.cholesky()?;
            let step = factor.solve(&right);
            self.spare.keep(factor.into_matrix());
            return Some(step);
        }
        let factor = self.spare.copy(&matrix).cholesky()?;
        let step = conjugate_gradients(&right, &factor, |v: &[f64]| {
            let mut product = matrix.times(v);
            self.add_color_product(local, v, &mut product);
            for i in (0..v.len()).filter(|&i| held[i]) {
                product[i] = v[i];
            }
            product
        });
        self.spare.keep(matrix);
        self.spare.keep(factor.into_matrix());
        Some(step)
    }

    /// Strength of the pull of the unknown `place` towards its start.
    pub(super) fn ridge(&self, place: usize) -> f64 {
        let layout = self.data.layout;
        let is_scattering = place % layout.per_wavelength() >= layout.pigments;
        if is_scattering { self.scattering_ridge } else { RIDGE }
    }

    fn prior_cost(&self, unknowns: &[f64]) -> f64 {
        let pull: f64 = unknowns
            .iter()
            .zip(self.start)
            .enumerate()
            .map(|(i, (x, s))| self.ridge(i) * (x - s).powi(2))
            .sum();
        0.5 * pull + 0.5 * self.smoothness * self.roughness(unknowns)
    }

    /// Sum of squared second differences over wavelength.
    pub(super) fn roughness(&self, unknowns: &[f64]) -> f64 {
        let per = self.data.layout.per_wavelength();
        let last = unknowns.len().saturating_sub(2 * per);
        (0..last)
            .map(|i| (unknowns[i] - 2.0 * unknowns[i + per] + unknowns[i + 2 * per]).powi(2))
            .sum()
    }

    fn add_priors(&self, unknowns: &[f64], local: &mut Local) {
        for (i, (x, start)) in unknowns.iter().zip(self.start).enumerate() {
            local.gradient[i] += self.ridge(i) * (x - start);
            let ridge = self.ridge(i);
            local.matrix.add(i, i, ridge);
        }
        if self.smoothness == 0.0 {
            return;
        }
        let per = self.data.layout.per_wavelength();
        for i in 0..unknowns.len().saturating_sub(2 * per) {
            let difference = unknowns[i] - 2.0 * unknowns[i + per] + unknowns[i + 2 * per];
            let places = [(i, 1.0), (i + per, -2.0), (i + 2 * per, 1.0)];
            for (a, &(row, r)) in places.iter().enumerate() {
                local.gradient[row] += self.smoothness * r * difference;
                for &(column, c) in &places[..=a] {
                    local.matrix.add(row, column, self.smoothness * r * c);
                }
            }
        }
    }

    fn add_color(&self, local: &mut Local) {
        let per = self.data.layout.per_wavelength();
        let Local { gradient, diagonal, color, slopes, .. } = local;
        let parts = gradient.par_chunks_mut(per).zip(diagonal.par_chunks_mut(per));
        parts.enumerate().for_each(|(at, (gradient, diagonal))| {
            for (index, (row, weight)) in color.iter().enumerate() {
                let places = self.data.places(index);
                let components = &row.slopes[at];
                let along: f64 = components.iter().zip(&row.residual).map(|(s, r)| s * r).sum();
                let square: f64 = components.iter().map(|s| s * s).sum();
                let slopes = &slopes[index][at * places.len()..];
                for (&place, slope) in places.iter().zip(slopes) {
                    gradient[place] += weight * along * slope;
                    diagonal[place] += weight * square * slope * slope;
                }
            }
        });
    }

    fn add_color_product(&self, local: &Local, vector: &[f64], product: &mut [f64]) {
        let per = self.data.layout.per_wavelength();
        let movement = |(index, (row, _)): (usize, &(ColorResidual, f64))| {
            let places = self.data.places(index);
            let slopes = local.slopes[index].chunks_exact(places.len());
            let mut moved = [0.0; 3];
            for (at, (components, slopes)) in row.slopes.iter().zip(slopes).enumerate() {
                let pairs = places.iter().zip(slopes);
                let change: f64 = pairs.map(|(place, s)| s * vector[at * per + place]).sum();
                for (m, component) in moved.iter_mut().zip(components) {
                    *m += component * change;
                }
            }
            moved
        };
        let moved: Vec<[f64; 3]> = local.color.par_iter().enumerate().map(movement).collect();
        product.par_chunks_mut(per).enumerate().for_each(|(at, product)| {
            for (index, ((row, weight), moved)) in local.color.iter().zip(&moved).enumerate() {
                let places = self.data.places(index);
                let along: f64 = row.slopes[at].iter().zip(moved).map(|(c, m)| c * m).sum();
                let slopes = &local.slopes[index][at * places.len()..];
                for (&place, slope) in places.iter().zip(slopes) {
                    product[place] += weight * along * slope;
                }
            }
        });
    }
}

/// Solves A x = `right` for the matrix A that `product` applies, to a relative residual of a thousandth.
fn conjugate_gradients(
    right: &[f64],
    factor: &BandedCholesky,
    product: impl Fn(&[f64]) -> Vec<f64>,
) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let mut solution = vec![0.0; right.len()];
    let mut residual = right.to_vec();
    let mut preconditioned = factor.solve(&residual);
    let mut direction = preconditioned.clone();
    let mut length = dot(&residual, &preconditioned);
    let tolerance = GRADIENT_TOLERANCE * length;
    for _ in 0..GRADIENT_STEPS {
        if length <= tolerance {
            break;
        }
        let image = product(&direction);
        let along = length / dot(&direction, &image);
        for ((x, r), (d, i)) in
            solution.iter_mut().zip(&mut residual).zip(direction.iter().zip(&image))
        {
            *x += along * d;
            *r -= along * i;
        }
        preconditioned = factor.solve(&residual);
        let next = dot(&residual, &preconditioned);
        for (d, p) in direction.iter_mut().zip(&preconditioned) {
            *d = p + next / length * *d;
        }
        length = next;
    }
    solution
}
