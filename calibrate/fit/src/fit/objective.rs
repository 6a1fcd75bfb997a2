//! Cost of the refinement, and the Levenberg-Marquardt steps that minimise it.
//!
//! The noise model sets the weight of each residual. We split the noise in two. One part is perceptually
//! uniform (e.g. errors of mixing and weighing), the other is constant in reflectance (errors of the
//! instrument).

use documents::Task;
use pigment::evaluate::percentile;
use rayon::prelude::*;

use super::banded::{Banded, BandedCholesky, Spare};
use super::forward::{ColorResidual, ColorTerm, Data, Forward, Linear};
use super::problem::{LOWER, UPPER};

/// Every unknown is pulled towards its start with this strength, in 1 / (log unit)^2. That is a standard
/// deviation of 10. We need it only so that unknowns which no sample determines do not diverge.
pub(super) const RIDGE: f64 = 0.01;
/// A descent begins with this damping (chosen by eye).
const FIRST_DAMPING: f64 = 1e-2;
/// Damping stays above this, so that the matrix keeps a Cholesky factor.
const LEAST_DAMPING: f64 = 1e-8;
/// We divide the damping by this after a step that lowers the cost (chosen by eye).
const DAMPING_FALL: f64 = 5.0;
/// We multiply the damping by this after a step that does not lower the cost (chosen by eye).
const DAMPING_RISE: f64 = 6.0;
/// We try at most this many dampings for one step.
const TRIALS: usize = 8;
/// We let no unknown move further than this in one step, in log units (chosen by eye).
const LONGEST_STEP: f64 = 2.0;
/// We add this to the diagonal, so that unknowns without data have a finite step.
const DIAGONAL_FLOOR: f64 = 1e-9;
/// Conjugate gradients stop if the squared residual is below this fraction of its first value. The
/// residual is then below a thousandth of its first value.
const GRADIENT_TOLERANCE: f64 = 1e-6;
/// We make at most this many steps of conjugate gradients. The preconditioner needs about ten, so this
/// limit is generous (chosen by eye).
const GRADIENT_STEPS: usize = 60;

/// Cost of a fit, in units of the residual's variance. It is the sum of
///
/// - spectral: rho(w (cbrt R - cbrt R_measured)), with the knee at 3 standard deviations
/// - roughness: smoothness / 2 (second difference over wavelength)^2 of each log K and log S
/// - ridge: [`RIDGE`] / 2 (log - center)^2, for log S with `scattering_ridge` instead
/// - colour: strength x rho(CIEDE2000) of each sample
///
/// where rho(r) = c^2 (sqrt(1 + (r/c)^2) - 1) is half a square near 0 and straight beyond the knee c.
pub(super) struct Objective<'a, F> {
    pub(super) data: &'a Data<'a, F>,
    /// Weight w by sample and wavelength: one over the residual's standard deviation.
    pub(super) weights: Vec<Vec<f64>>,
    pub(super) knee: f64,
    pub(super) smoothness: f64,
    /// Each unknown is pulled towards its entry here: log K towards its start, log S towards its start or
    /// towards the level of its pigment.
    pub(super) center: Vec<f64>,
    /// How strongly log S is pulled. For log K it is [`RIDGE`].
    pub(super) scattering_ridge: f64,
    pub(super) color: Option<ColorPart<'a>>,
    pub(super) spare: Spare,
    /// Task that can cancel a descent.
    pub(super) task: &'a Task,
}

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
        let terms = values.par_iter().enumerate().map(|(index, row)| {
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
        });
        let terms: Vec<Vec<f64>> = terms.collect();
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
            let rows = linear.values.par_iter().enumerate().map(|(index, values)| {
                let row = color.term.linear(index, values);
                let squared: f64 = row.residual.iter().map(|v| v * v).sum();
                let (cost, share) = robust(squared, color.knee);
                (row, color.strength * share, color.strength * cost)
            });
            for (row, weight, cost) in rows.collect::<Vec<_>>() {
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
        let parts = local.gradient.par_chunks_mut(per).zip(local.matrix.by_columns(per));
        let costs = parts.enumerate().map(|(at, (gradient, mut matrix))| {
            let costs = (0..self.data.recipes.len()).map(|index| {
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
            });
            costs.collect()
        });
        costs.collect()
    }

    /// Gradient of one sample's spectral term: index and value of each entry that is not 0.
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
    /// for `iterations` steps, or until the fit is cancelled.
    pub(super) fn descend(&self, unknowns: &mut Vec<f64>, iterations: usize, relative: f64) {
        let mut damping: f64 = FIRST_DAMPING;
        let mut local = self.local(unknowns);
        for _ in (0..iterations).take_while(|_| !self.task.is_cancelled()) {
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

    /// Damped Gauss-Newton step, directly from the banded factor. The colour term couples all wavelengths.
    /// With this term we use conjugate gradients, and the factor is the preconditioner.
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

    /// How strongly the unknown with the index `place` is pulled towards its start.
    pub(super) fn ridge(&self, place: usize) -> f64 {
        if self.data.layout.is_scattering(place) { self.scattering_ridge } else { RIDGE }
    }

    fn prior_cost(&self, unknowns: &[f64]) -> f64 {
        let pull: f64 = unknowns
            .iter()
            .zip(&self.center)
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
        for (i, (x, center)) in unknowns.iter().zip(&self.center).enumerate() {
            local.gradient[i] += self.ridge(i) * (x - center);
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
        let moved = local.color.par_iter().enumerate().map(|(index, (row, _))| {
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
        });
        let moved: Vec<[f64; 3]> = moved.collect();
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

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// We assume at least this standard deviation of a residual, as a cube root of reflectance (chosen by eye).
const LEAST_SD: f64 = 1e-4;
/// Ratio of the standard deviation to the median absolute value, for normal noise.
const SD_OVER_MEDIAN: f64 = 1.4826;
/// We try this many ratios of the two kinds of noise besides 0, evenly spaced in their logarithm.
const RATIOS: i32 = 25;
/// Least of these ratios (chosen by eye).
const LEAST_RATIO: f64 = 0.02;
/// The ratios span this many decades (chosen by eye).
const RATIO_DECADES: f64 = 4.0;

/// Errors that you expect of a swatch's reflectance, as standard deviations in measured reflectance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpectedNoise {
    /// Error of the instrument, equal at every reflectance, 0 to below 1.
    pub constant: f64,
    /// Error of weighing, mixing and the film, 0 to below 1, for a swatch of typical reflectance. It is
    /// perceptually uniform, so it is smaller in the dark.
    pub even: f64,
}

impl ExpectedNoise {
    /// Whether both errors are 0 to below 1, and their sum is 1e-6 or more.
    #[must_use]
    pub fn is_possible(&self) -> bool {
        let range = 0.0..1.0;
        range.contains(&self.constant)
            && range.contains(&self.even)
            && self.constant + self.even >= 1e-6
    }
}

/// Distribution of the noise over samples and wavelengths.
pub(super) struct Noise {
    roots: Vec<Vec<f64>>,
    /// By sample and wavelength: weight of a cube-root residual that makes it perceptually uniform.
    even: Vec<Vec<f64>>,
    /// By sample and wavelength: weight that makes a residual of reflectance, not of its cube root,
    /// perceptually uniform.
    slope: Vec<Vec<f64>>,
    median_slope: f64,
    /// Least standard deviation of a residual, from repeated readings. With few samples a fit may come
    /// nearer to the readings than this. You would then think that the readings are more precise than they
    /// are.
    least_sd: f64,
}

impl Noise {
    pub(super) fn new(term: &ColorTerm<'_>, target: &[Vec<f64>], reading_sd: f64) -> Self {
        let mut even = term.sensitivity(target);
        for (row, reflectances) in even.iter_mut().zip(target) {
            for (value, &r) in row.iter_mut().zip(reflectances) {
                *value /= root_slope(r);
            }
        }
        // We divide weights by their mean at each wavelength, so that they differ only among samples.
        // Otherwise we would hardly fit the ends of the band, where the eye is least sensitive.
        for at in 0..even[0].len() {
            let mean = even.iter().map(|row| row[at]).sum::<f64>() / even.len() as f64;
            for row in &mut even {
                row[at] = if mean > 0.0 { row[at] / mean } else { 1.0 };
            }
        }
        let slope: Vec<Vec<f64>> = even
            .iter()
            .zip(target)
            .map(|(row, rs)| row.iter().zip(rs).map(|(e, &r)| e * root_slope(r)).collect())
            .collect();
        let all: Vec<f64> = slope.iter().flatten().copied().collect();
        let median_slope = percentile(&all, 50.0);
        let least_sd = (reading_sd * median_slope).max(LEAST_SD);
        let roots = target.iter().map(|row| row.iter().map(|r| r.cbrt()).collect()).collect();
        Self { roots, even, slope, median_slope, least_sd }
    }

    /// One over the standard deviation of each residual, and the deviation at a typical sample, which
    /// is `least` or more.
    pub(super) fn weights(
        &self,
        ratio: f64,
        values: &[Vec<f64>],
        least: f64,
    ) -> (Vec<Vec<f64>>, f64) {
        let at_median = 1.0 + (ratio * self.median_slope).powi(2);
        let rows = self.even.par_iter().zip(&self.slope).zip(values.par_iter().zip(&self.roots));
        let (mut weights, sizes): (Vec<Vec<f64>>, Vec<Vec<f64>>) = rows
            .map(|((even, slope), (values, roots))| {
                let pairs = even.iter().zip(slope);
                let weights: Vec<f64> = pairs
                    .map(|(e, g)| e * (at_median / (1.0 + (ratio * g).powi(2))).sqrt())
                    .collect();
                let residuals = weights.iter().zip(values.iter().zip(roots));
                let sizes = residuals.map(|(w, (v, root))| (w * (v.cbrt() - root)).abs()).collect();
                (weights, sizes)
            })
            .unzip();
        let sizes: Vec<f64> = sizes.into_iter().flatten().collect();
        let least = if least.is_finite() { least.max(self.least_sd) } else { self.least_sd };
        let sd = (SD_OVER_MEDIAN * percentile(&sizes, 50.0)).max(least);
        weights.par_iter_mut().flatten().for_each(|w| *w /= sd);
        (weights, sd)
    }

    /// One over the standard deviation of each reading in measured reflectance, for `noise` with two known
    /// parts.
    pub(super) fn precision(&self, noise: ExpectedNoise) -> Vec<Vec<f64>> {
        let rows = self.slope.iter().map(|row| {
            let even = row.iter().map(|slope| noise.even * self.median_slope / slope);
            even.map(|even| noise.constant.hypot(even).recip()).collect()
        });
        rows.collect()
    }

    /// Ratio of the two kinds of noise (constant over uniform) that makes the residuals of `values` most
    /// likely by Laplace's law.
    pub(super) fn likeliest_ratio(&self, values: &[Vec<f64>]) -> f64 {
        let rows = values.par_iter().zip(&self.roots).zip(&self.even);
        let residuals: Vec<Vec<f64>> = rows
            .map(|((row, roots), even)| {
                let pairs = row.iter().zip(roots).zip(even);
                pairs.map(|((v, root), even)| even * (v.cbrt() - root)).collect()
            })
            .collect();
        let scores = (0..=RATIOS).into_par_iter().map(|i| {
            let ratio = candidate(i);
            let mut sum = 0.0;
            let mut logs = 0.0;
            let mut count = 0.0;
            for (residual, slope) in residuals.iter().flatten().zip(self.slope.iter().flatten()) {
                let sd = (1.0 + (ratio * slope).powi(2)).sqrt();
                sum += (residual / sd).abs();
                logs += sd.ln();
                count += 1.0;
            }
            (count * (sum / count).max(f64::MIN_POSITIVE).ln() + logs, ratio)
        });
        let scores: Vec<(f64, f64)> = scores.collect();
        let best =
            scores.into_iter().reduce(|best, next| if next.0 < best.0 { next } else { best });
        best.map_or(0.0, |(_, ratio)| ratio)
    }
}

fn candidate(i: i32) -> f64 {
    match i {
        0 => 0.0,
        _ => LEAST_RATIO * 10f64.powf(RATIO_DECADES * f64::from(i - 1) / f64::from(RATIOS - 1)),
    }
}

fn root_slope(reflectance: f64) -> f64 {
    reflectance.cbrt().powi(-2) / 3.0
}
