//! Absolute amounts on a known backing: the finite layer equation itself.

use spectra::optics::UnevenFilm;
use spectra::{Grid, TristimulusWeights};

use super::curves::{Curves, Layout};
use super::forward::{Data, Finite};
use super::problem::FitError;
use super::refined::{Refined, Refinement, refine};
use pigment::mixture::Mixture;

/// Films of known amounts over known backings.
#[derive(Debug, Clone)]
pub struct FiniteProblem {
    /// The wavelengths.
    pub grid: Grid,
    /// How many pigments.
    pub pigments: usize,
    /// Root mean square spread of repeated readings; 0 if none were repeated.
    pub reading_sd: f64,
    /// By film: its pigments and the amounts of each on the area.
    pub recipes: Vec<Vec<(usize, f64)>>,
    /// By film and wavelength: measured reflectance.
    pub reflectance: Vec<Vec<f64>>,
    /// By film and wavelength: measured reflectance of its bare backing.
    pub bare: Vec<Vec<f64>>,
}

impl FiniteProblem {
    /// The films number `kept`, in that order.
    #[must_use]
    pub fn of(&self, kept: &[usize]) -> Self {
        let rows = |all: &[Vec<f64>]| kept.iter().map(|&i| all[i].clone()).collect();
        Self {
            grid: self.grid,
            pigments: self.pigments,
            reading_sd: self.reading_sd,
            recipes: kept.iter().map(|&i| self.recipes[i].clone()).collect(),
            reflectance: rows(&self.reflectance),
            bare: rows(&self.bare),
        }
    }

    /// Measured reflectance that K and S predict of film number `index`.
    #[must_use]
    pub fn predicted(&self, fit: &Refined, film: UnevenFilm, index: usize) -> Vec<f64> {
        let parts = self.recipes[index].iter().map(|&(pigment, amount)| {
            (amount, fit.absorption[pigment].as_slice(), fit.scattering[pigment].as_slice())
        });
        Mixture::of(self.grid.count(), parts).film(1.0, &self.bare[index], film)
    }
}

/// K and S per unit of amount.
///
/// K d and S d of a film are the sums of its amounts times K and S; its
/// reflectance over the backing follows by the finite layer equation. Starts
/// from each pigment's films without others (one S for all wavelengths, the
/// best K at each), then minimises what `refined` does.
///
/// # Errors
/// [`FitError::Empty`] without films.
pub fn fit_finite(
    problem: &FiniteProblem,
    film: UnevenFilm,
    weights: &TristimulusWeights,
    how: Refinement,
) -> Result<Refined, FitError> {
    if problem.recipes.is_empty() {
        return Err(FitError::Empty);
    }
    // Bounds and starts are set for amounts near 1, whatever the user's unit.
    let totals: Vec<f64> =
        problem.recipes.iter().map(|r| r.iter().map(|(_, amount)| amount).sum()).collect();
    let unit = pigment::evaluate::percentile(&totals, 50.0);
    let recipes: Vec<Vec<(usize, f64)>> = problem
        .recipes
        .iter()
        .map(|recipe| recipe.iter().map(|&(p, amount)| (p, amount / unit)).collect())
        .collect();
    let below = |measured: &f64| {
        film.surface.internal_from_measured(*measured).unwrap_or(0.0).clamp(0.0, 1.0)
    };
    let backing: Vec<Vec<f64>> =
        problem.bare.iter().map(|bare| bare.iter().map(below).collect()).collect();
    let layout =
        Layout { pigments: problem.pigments, reference: None, wavelengths: problem.grid.count() };
    let start = Start { film, recipes: &recipes, target: &problem.reflectance, backing: &backing };
    let curves: Vec<(Vec<f64>, f64)> =
        (0..problem.pigments).map(|pigment| start.of(pigment, layout.wavelengths)).collect();
    let start = Curves {
        absorption: curves.iter().map(|(k, _)| k.clone()).collect(),
        scattering: curves.iter().map(|(_, s)| vec![*s; layout.wavelengths]).collect(),
    };
    let forward = Finite { film, backing: &backing };
    let data = Data::new(layout, forward, &recipes, &problem.reflectance, problem.reading_sd);
    let step = problem.grid.step_nm();
    let mut refined = refine(&data, &start, weights, step, how);
    for curves in [
        &mut refined.absorption,
        &mut refined.scattering,
        &mut refined.absorption_sd,
        &mut refined.scattering_sd,
    ] {
        curves.iter_mut().flatten().for_each(|v| *v /= unit);
    }
    Ok(refined)
}

/// Where a pigment's K and S start.
struct Start<'a> {
    film: UnevenFilm,
    recipes: &'a [Vec<(usize, f64)>],
    target: &'a [Vec<f64>],
    backing: &'a [Vec<f64>],
}

impl Start<'_> {
    /// K by wavelength and one S: the best of 44 S from 0.012 to 12. A prior
    /// on S would outweigh the weak evidence that a ladder gives of it, so
    /// there is none. A pigment without films of its own starts at 1.
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
        for step in 0..44 {
            let s = 0.012 * 1000f64.powf(f64::from(step) / 43.0);
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
        let (_, absorption, scattering) = best.expect("there are 44 candidates");
        (absorption, scattering)
    }

    /// The log K that fits a pigment's own films best at one wavelength for a
    /// given S, by Gauss-Newton from `near` or from a coarse grid.
    fn best_absorption(
        &self,
        own: &[(usize, f64)],
        at: usize,
        s: f64,
        near: Option<f64>,
    ) -> (f64, f64) {
        // Robust on a scale like lightness; the knee is 2 of 100.
        let knee: f64 = 0.02;
        let sums = |log: f64| {
            let k = log.exp();
            let (mut cost, mut gradient, mut curvature) = (0.0, 0.0, 0.0);
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
        let (low, high) = (4e-4f64.ln(), 120f64.ln());
        let mut log = near.unwrap_or_else(|| {
            let candidates = (0..25).map(|i| low + (high - low) * f64::from(i) / 24.0);
            candidates.min_by(|a, b| sums(*a).0.total_cmp(&sums(*b).0)).unwrap_or(0.0)
        });
        let mut here = sums(log);
        for _ in 0..12 {
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
