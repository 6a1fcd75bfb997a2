//! The prior on log S of every pigment of a fit relative to a white: what we assume of S before any data.
//!
//! log S of a pigment is a level plus deviations by wavelength. The level is normal around 0, where the pigment
//! scatters like the white, and the deviations are normal around the level. Tints with white alone hardly
//! determine S. Without this prior the errors of weighing would decide it.

use nalgebra::{Cholesky, DMatrix, DVector};
use pigment::evaluate::percentile;
use spectra::Grid;

use super::banded::{BandedCholesky, TOGETHER};
use super::forward::Forward;
use super::objective::Objective;
use super::problem::{CurveTable, LOWER, UPPER};

/// Standard deviation of the levels of paints, in log units. The levels of the Van Gogh oils differ from the
/// white's by 2.4 (root mean square). Lakes and blacks scatter least.
const LEVEL_SD: f64 = 2.0;
/// How strongly log S is pulled to its level, in 1 / (log unit)^2 for a wavelength step of 10 nm. This is a
/// standard deviation of 0.7. We chose it between 1, with which tints of the oils predict unseen mixtures up to 4 %
/// better, and 3, with which masstones with one tint do so by 2 % (`examples/held_out.rs`).
const RIDGE_PER_STEP: f64 = 2.0;
/// We add this to the curvature of the cost by a level, so that levels without any data stay put.
const LEAST_CURVATURE: f64 = 1e-4;
/// A level moves by at most this much at once, in log units.
const LONGEST_MOVE: f64 = 3.0;

/// How strongly log S is pulled to the level of its pigment, in 1 / (log unit)^2.
pub(super) fn ridge(grid: Grid) -> f64 {
    RIDGE_PER_STEP * grid.step_nm() / 10.0
}

/// Linear model of a fit near its minimum: how the unknowns and the cost change with the levels of the pigments.
pub(super) struct Levels {
    /// Place of each log S with a level among the unknowns of a wavelength.
    places: Vec<usize>,
    /// By level: change of each unknown if the level rises by 1.
    follows: Vec<Vec<f64>>,
    /// Inverse of the second derivatives of the least cost by two levels, without the prior on the levels. If
    /// all residuals were independent, this would be the covariance of the levels.
    covariance: DMatrix<f64>,
}

/// Estimate of a level from the data alone, without the prior on levels.
#[derive(Debug, Clone, Copy)]
struct FreeLevel {
    level: f64,
    variance: f64,
}

impl FreeLevel {
    /// The likeliest level when data and prior are combined.
    fn shrunk(self) -> f64 {
        self.level * LEVEL_SD.powi(2) / (LEVEL_SD.powi(2) + self.variance)
    }

    /// Variance that is left when data and prior are combined.
    fn remaining(self) -> f64 {
        (LEVEL_SD.powi(-2) + self.variance.recip()).recip()
    }
}

impl Levels {
    /// Takes the Cholesky factor of the cost's Gauss-Newton matrix at a minimum.
    pub(super) fn of<F: Forward>(
        objective: &Objective<'_, F>,
        factor: &BandedCholesky,
    ) -> Option<Self> {
        let layout = objective.data.layout;
        let ridge = objective.scattering_ridge;
        let per = layout.per_wavelength();
        let places: Vec<usize> =
            (0..layout.pigments).filter_map(|p| layout.scattering(p)).collect();
        let mut follows: Vec<Vec<f64>> = Vec::with_capacity(places.len());
        for group in places.chunks(TOGETHER) {
            let mut right = vec![[0.0; TOGETHER]; layout.len()];
            for (column, &place) in group.iter().enumerate() {
                (0..layout.wavelengths).for_each(|at| right[at * per + place][column] = ridge);
            }
            factor.solve_together(&mut right);
            let of_group = 0..group.len();
            follows.extend(of_group.map(|column| right.iter().map(|row| row[column]).collect()));
        }
        let count = places.len();
        let pulled = ridge * layout.wavelengths as f64 + LEAST_CURVATURE;
        let curvature = DMatrix::from_fn(count, count, |row, column| {
            let followed =
                (0..layout.wavelengths).map(|at| follows[column][at * per + places[row]]);
            let own = if row == column { pulled } else { 0.0 };
            own - ridge * followed.sum::<f64>()
        });
        Some(Self { places, follows, covariance: Cholesky::new(curvature)?.inverse() })
    }

    /// Moves the levels to where they are likeliest, and the unknowns with them.
    pub(super) fn settle<F: Forward>(
        &self,
        objective: &mut Objective<'_, F>,
        unknowns: &mut [f64],
    ) {
        let per = objective.data.layout.per_wavelength();
        let free = self.free(objective, unknowns);
        for ((&place, follows), free) in self.places.iter().zip(&self.follows).zip(&free) {
            let by = free.shrunk() - objective.center[place];
            objective.center.iter_mut().skip(place).step_by(per).for_each(|level| *level += by);
            for (unknown, follow) in unknowns.iter_mut().zip(follows) {
                *unknown = (*unknown + by * follow).clamp(LOWER, UPPER);
            }
        }
    }

    /// Levels without their prior.
    ///
    /// Their variance is the larger of two estimates, as for the standard deviations of K and S: the one
    /// that holds if all residuals are independent, and the spread of the gradients of the samples (Liang
    /// and Zeger 1986). A sample that was weighed wrongly is wrong at every wavelength.
    fn free<F: Forward>(&self, objective: &Objective<'_, F>, unknowns: &[f64]) -> Vec<FreeLevel> {
        let layout = objective.data.layout;
        let per = layout.per_wavelength();
        let ridge = objective.scattering_ridge;
        let downhill = self.places.iter().map(|&place| {
            let above = unknowns.iter().skip(place).step_by(per);
            ridge * above.map(|log| log - objective.center[place]).sum::<f64>()
        });
        let moves = &self.covariance * DVector::from_iterator(self.places.len(), downhill);
        let spread = self.spread(objective, unknowns);
        let levels = self.places.iter().enumerate().map(|(i, &place)| FreeLevel {
            level: objective.center[place] + moves[i].clamp(-LONGEST_MOVE, LONGEST_MOVE),
            variance: f64::max(self.covariance[(i, i)], spread[i]),
        });
        levels.collect()
    }

    /// By level: sum over samples of the squared move that the gradient of this sample alone would cause.
    fn spread<F: Forward>(&self, objective: &Objective<'_, F>, unknowns: &[f64]) -> Vec<f64> {
        let linear = objective.data.linear(&objective.data.layout.curves(unknowns));
        let mut spread = vec![0.0; self.places.len()];
        for index in 0..objective.data.recipes.len() {
            let mut gradient = DVector::zeros(self.places.len());
            for (unknown, value) in objective.gradient_of_sample(&linear, index) {
                for (sum, follows) in gradient.iter_mut().zip(&self.follows) {
                    *sum += follows[unknown] * value;
                }
            }
            let moves = &self.covariance * gradient;
            spread.iter_mut().zip(&moves).for_each(|(sum, by): (&mut f64, &f64)| *sum += by * by);
        }
        spread
    }

    /// Variance that each unknown has because the levels are uncertain.
    pub(super) fn variances<F: Forward>(
        &self,
        objective: &Objective<'_, F>,
        unknowns: &[f64],
    ) -> Vec<f64> {
        let mut variances = vec![0.0; unknowns.len()];
        for (follows, free) in self.follows.iter().zip(self.free(objective, unknowns)) {
            let of_level = free.remaining();
            let pairs = variances.iter_mut().zip(follows);
            pairs.for_each(|(variance, follow)| *variance += follow * follow * of_level);
        }
        variances
    }
}

/// By pigment: the fraction (0 to 1) of the prior variance of log S that the data removed (median over
/// wavelength). The reference has 1.
pub(super) fn known(curves: &CurveTable, deviations: &CurveTable, grid: Grid) -> Vec<f64> {
    let prior = LEVEL_SD.powi(2) + ridge(grid).recip();
    let pigments = curves.scattering.iter().zip(&deviations.scattering);
    let known = pigments.map(|(curve, deviations)| {
        let shares = curve.iter().zip(deviations).map(|(s, sd)| 1.0 - (sd / s).powi(2) / prior);
        percentile(&shares.collect::<Vec<f64>>(), 50.0).clamp(0.0, 1.0)
    });
    known.collect()
}
