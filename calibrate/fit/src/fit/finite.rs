//! Fit of absolute amounts on known backings, by the finite layer equation.

use documents::Task;
use spectra::optics::UnevenFilm;
use spectra::{Grid, TristimulusWeights};

use super::forward::{Data, Finite};
use super::problem::{CurveTable, FitError, Layout};
use super::refined::{Refined, Refinement, refine};
use pigment::{Curves, Recipe};
/// We try this many values of S as a start, evenly spaced in their logarithm (chosen by eye).
const STARTS: i32 = 44;
/// Smallest value of S that we try as a start.
const LEAST_START: f64 = 0.012;
/// Largest value of S that we try as a start, divided by the smallest.
const START_RANGE: f64 = 1000.0;
/// K starts within this range (chosen by eye).
const START_K: [f64; 2] = [4e-4, 120.0];
/// We try this many values of K as a start, at the first wavelength only (chosen by eye).
const COARSE_STEPS: i32 = 25;
/// The robust loss of a start turns linear at this residual. Residuals are differences of cube roots of
/// reflectance (0 to 1), so this is about 2 units of lightness.
const START_KNEE: f64 = 0.02;
/// We make at most this many Gauss-Newton steps for a start (chosen by eye).
const START_STEPS: usize = 12;

/// Films of known amounts over known backings.
#[derive(Debug, Clone)]
pub struct FiniteProblem {
    /// Wavelengths of all reflectances.
    pub grid: Grid,
    /// Number of pigments.
    pub pigments: usize,
    /// Standard deviation of repeated readings (root mean square over films). It is 0 if you repeated none.
    pub reading_sd: f64,
    /// Films on backings of known reflectance.
    pub films: Vec<MeasuredFilm>,
}

/// One film of known amounts over a known backing.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredFilm {
    /// Name of the sample. If the sample has several films, the backing follows.
    pub name: String,
    /// Index of its swatch.
    pub swatch: usize,
    /// Name of its backing.
    pub backing: String,
    /// Pigments with their amounts on the area, above 0.
    pub recipe: Recipe,
    /// Measured reflectance of the film, as a fraction.
    pub reflectance: Vec<f64>,
    /// Measured reflectance of the bare backing, as a fraction.
    pub bare: Vec<f64>,
}

impl FiniteProblem {
    /// Copy with only the films of indices `kept`, in this order.
    #[must_use]
    pub fn with_films(&self, kept: &[usize]) -> Self {
        Self { films: kept.iter().map(|&i| self.films[i].clone()).collect(), ..*self }
    }

    /// Predicted measured reflectance of the film of index `index`.
    #[must_use]
    pub fn predicted(&self, fit: &Refined, film: UnevenFilm, index: usize) -> Vec<f64> {
        let MeasuredFilm { recipe, bare, .. } = &self.films[index];
        let parts = recipe.iter().map(|&(pigment, amount)| {
            let (absorption, scattering) = fit.curves[pigment.index()].as_slices();
            (amount, absorption, scattering)
        });
        Curves::weighted_sum(self.grid, parts).film(1.0, bare, film)
    }
}

/// Fits K and S per unit of amount.
///
/// K d and S d of a film are the sums of its amounts times K and S. The finite layer equation gives its
/// reflectance over the backing. For the start, we use the films that contain one pigment alone: one S for
/// all wavelengths, and the best K at each. Then we minimise the cost of the refinement, see
/// [`super::fit_refined`].
///
/// # Errors
/// [`FitError::Empty`] without films, [`FitError::Cancelled`] if `task` was cancelled.
pub fn fit_finite(
    problem: &FiniteProblem,
    film: UnevenFilm,
    weights: &TristimulusWeights,
    how: Refinement,
    task: &Task,
) -> Result<Refined, FitError> {
    if problem.films.is_empty() {
        return Err(FitError::Empty);
    }
    // Bounds and starts suit amounts near 1, so we divide the amounts by their median total.
    let totals: Vec<f64> = problem.films.iter().map(|film| film.recipe.total()).collect();
    let unit = pigment::evaluate::percentile(&totals, 50.0);
    let recipes: Vec<Vec<(usize, f64)>> = problem
        .films
        .iter()
        .map(|film: &MeasuredFilm| -> Vec<(usize, f64)> {
            film.recipe.iter().map(|&(p, amount)| (p.index(), amount / unit)).collect()
        })
        .collect();
    let reflectance: Vec<Vec<f64>> = problem.films.iter().map(|f| f.reflectance.clone()).collect();
    let backing: Vec<Vec<f64>> = problem
        .films
        .iter()
        .map(|f| {
            f.bare
                .iter()
                .map(|measured: &f64| {
                    film.surface.internal_from_measured(*measured).unwrap_or(0.0).clamp(0.0, 1.0)
                })
                .collect()
        })
        .collect();
    let layout =
        Layout { pigments: problem.pigments, reference: None, wavelengths: problem.grid.count() };
    let start = Start { film, recipes: &recipes, target: &reflectance, backing: &backing };
    let curves: Vec<(Vec<f64>, f64)> =
        (0..problem.pigments).map(|pigment| start.of(pigment, layout.wavelengths)).collect();
    task.check()?;
    let start = CurveTable {
        absorption: curves.iter().map(|(k, _)| k.clone()).collect(),
        scattering: curves.iter().map(|(_, s)| vec![*s; layout.wavelengths]).collect(),
    };
    let forward = Finite { film, backing: &backing };
    let data = Data::new(layout, forward, &recipes, &reflectance, problem.reading_sd);
    let mut refined = refine(&data, &start, weights, problem.grid, how, task)?;
    for curves in refined.curves.iter_mut().chain(refined.deviations.iter_mut().flatten()) {
        let values = curves.absorption.iter_mut().chain(&mut curves.scattering);
        values.for_each(|value| *value /= unit);
    }
    Ok(refined)
}

/// Data from which the start of a pigment's K and S is computed.
struct Start<'a> {
    film: UnevenFilm,
    recipes: &'a [Vec<(usize, f64)>],
    target: &'a [Vec<f64>],
    backing: &'a [Vec<f64>],
}

impl Start<'_> {
    /// K by wavelength, and the S that fits best among 44 values from 0.012 to 12. We use no prior on S
    /// here, because it would outweigh the weak information of a series of amounts. If no film has this
    /// pigment alone, K and S start at 1.
    fn of(&self, pigment: usize, wavelengths: usize) -> (Vec<f64>, f64) {
        let own: Vec<(usize, f64)> = self
            .recipes
            .iter()
            .enumerate()
            .filter(|(_, recipe)| recipe.len() == 1 && recipe[0].0 == pigment)
            .map(|(index, recipe)| (index, recipe[0].1))
            .collect();
        if own.is_empty() {
            return (vec![1.0; wavelengths], 1.0);
        }
        let mut best: Option<(f64, Vec<f64>, f64)> = None;
        let mut logs = vec![None; wavelengths];
        for step in 0..STARTS {
            let s = LEAST_START * START_RANGE.powf(f64::from(step) / f64::from(STARTS - 1));
            let mut cost = 0.0;
            for (at, log) in logs.iter_mut().enumerate() {
                let (k, own_cost) = self.best_absorption(&own, at, s, *log);
                *log = Some(k);
                cost += own_cost;
            }
            if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                let curve = logs.iter().map(|log| log.unwrap_or(0.0).exp()).collect();
                best = Some((cost, curve, s));
            }
        }
        let (_, absorption, scattering) = best.expect("there is at least one candidate");
        (absorption, scattering)
    }

    /// Log K that fits the films of this pigment alone best, at one wavelength for a given S, with its
    /// cost. We make Gauss-Newton steps from `near`, or from the best of a coarse grid.
    fn best_absorption(
        &self,
        own: &[(usize, f64)],
        at: usize,
        s: f64,
        near: Option<f64>,
    ) -> (f64, f64) {
        let knee = START_KNEE;
        let sums = |log: f64| {
            let k = log.exp();
            let mut cost = 0.0;
            let mut gradient = 0.0;
            let mut curvature = 0.0;
            for &(index, amount) in own {
                let [value, over_k, _] = self.film.reflectance_with_slopes(
                    amount * k,
                    amount * s,
                    self.backing[index][at],
                );
                let root = value.cbrt();
                let residual = root - self.target[index][at].cbrt();
                let slope = over_k * amount * k / (3.0 * root * root);
                let (own_cost, share) = super::objective::robust(residual * residual, knee);
                cost += own_cost;
                gradient += share * slope * residual;
                curvature += share * slope * slope;
            }
            (cost, gradient, curvature)
        };
        let low = START_K[0].ln();
        let high = START_K[1].ln();
        let mut log = near.unwrap_or_else(|| {
            let last = f64::from(COARSE_STEPS - 1);
            let candidates = (0..COARSE_STEPS).map(|i| low + (high - low) * f64::from(i) / last);
            candidates.min_by(|a, b| sums(*a).0.total_cmp(&sums(*b).0)).unwrap_or(0.0)
        });
        let mut here = sums(log);
        for _ in 0..START_STEPS {
            let step = (-here.1 / (here.2 + 1e-9)).clamp(-1.0, 1.0);
            let next = (log + step).clamp(low, high);
            let there = sums(next);
            if there.0 >= here.0 {
                break;
            }
            let small = here.0 - there.0 < 1e-6 * here.0;
            (log, here) = (next, there);
            if small {
                break;
            }
        }
        (log, here.0)
    }
}
