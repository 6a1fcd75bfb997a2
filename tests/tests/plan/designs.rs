//! Predicted precision of swatch designs, compared with fits of simulated readings.

use calibrate::evaluate::Viewing;
use calibrate::fit::{
    ExpectedNoise, Problem, Refined, Refinement, Smoothness, fit_refined, unidentified,
};
use calibrate::library::PigmentLibrary;
use calibrate::observation::{BLACK, Hiding, Observation};
use calibrate::plan::{
    Information, PaintSet, PlanError, PlanRequest, SwatchRecipe, candidates, optimal, usual,
};
use calibrate::{PigmentId, Recipe};
use documents::Task;
use documents::hint::Explain;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use spectra::optics::absorption_over_scattering;

use crate::program::oils;

const NOISE: f64 = 0.004;

struct Bench {
    oils: PigmentLibrary,
    paints: PaintSet,
    pigments: Vec<PigmentId>,
    pool: Vec<SwatchRecipe>,
    information: Information,
}

fn bench() -> Bench {
    let oils = oils();
    let colors = ["Cobalt Blue", "Viridian", "Vermilion", "Chrome Yellow"].map(str::to_owned);
    let paints = PaintSet::new(&colors, "Zinc White", Some("Bone Black")).unwrap();
    let pigments: Vec<PigmentId> = paints.names.iter().map(|n| oils.find(n).unwrap()).collect();
    let pool = candidates(&paints, 0.05);
    let noise = ExpectedNoise { constant: NOISE, even: 0.0 };
    let information = Information::new(&oils, &pigments, &pool, noise);
    Bench { oils, paints, pigments, pool, information }
}

impl Bench {
    /// Fits the swatches of `design`. Their readings are simulated from the oils plus normal noise.
    fn fit(&self, design: &[usize], seed: u64) -> Refined {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let surface = self.oils.saunderson;
        let observations: Vec<Observation> = design
            .iter()
            .map(|&index| {
                let mut shares = vec![0.0; self.pigments.len()];
                for &(paint, share) in &self.pool[index].shares() {
                    shares[paint.index()] = share;
                }
                let parts: Recipe =
                    self.pigments.iter().copied().zip(shares.iter().copied()).collect();
                let truth = self.oils.mix(&parts).unwrap().hiding(surface);
                let internal = truth.iter().map(|value| {
                    let error: f64 = StandardNormal.sample(&mut random);
                    let internal = surface.internal_from_measured(value + NOISE * error);
                    internal.unwrap_or(BLACK).clamp(BLACK, 1.0)
                });
                let internal: Vec<f64> = internal.collect();
                let reflectance: Vec<f64> =
                    internal.iter().map(|&r| surface.measured_from_internal(r)).collect();
                Observation {
                    sample: index.to_string(),
                    shares,
                    ratio: internal.iter().map(|&r| absorption_over_scattering(r)).collect(),
                    as_read: reflectance.clone(),
                    reflectance,
                    hiding: Hiding::Assumed(None),
                    spread: Some(NOISE),
                    below_surface: 0,
                    above_white: 0,
                }
            })
            .collect();
        let problem =
            Problem::new(self.oils.grid, surface, &observations, PaintSet::WHITE).unwrap();
        let weights = Viewing::default().weights(self.oils.grid).unwrap();
        let how = Refinement::prediction(Smoothness::None, None);
        fit_refined(&problem, &weights, how, &Task::default()).unwrap()
    }

    /// Errors of ln K and ln S by pigment and wavelength, each with the standard deviation
    /// predicted for
    /// `design`. Leaves out the S of the white.
    fn errors(&self, design: &[usize], seed: u64) -> Vec<(f64, f64)> {
        let fit = self.fit(design, seed);
        let deviations = self.information.log_deviations(design);
        let mut errors = Vec::new();
        for (paint, &pigment) in self.pigments.iter().enumerate() {
            let truth = &self.oils[pigment];
            for at in 0..self.oils.grid.count() {
                let k = (fit.curves[paint].absorption[at] / truth.absorption[at].max(1e-5)).ln();
                errors.push((k, deviations[paint].absorption[at]));
                if PigmentId(paint) != PaintSet::WHITE {
                    let s =
                        (fit.curves[paint].scattering[at] / truth.scattering[at].max(1e-5)).ln();
                    errors.push((s, deviations[paint].scattering[at]));
                }
            }
        }
        errors
    }

    /// Geometric mean of the absolute errors of ln K and ln S over eight simulated fits.
    /// D-optimality makes this mean small. In an arithmetic mean, large errors of K where a paint
    /// hardly absorbs would dominate, though no design determines them.
    fn typical_error(&self, design: &[usize]) -> f64 {
        let logs: Vec<f64> = (0..8)
            .flat_map(|seed| self.errors(design, 100 + seed))
            .map(|(error, _)| error.abs().max(1e-6).ln())
            .collect();
        (logs.iter().sum::<f64>() / logs.len() as f64).exp()
    }

    fn random(&self, count: usize, seed: u64) -> Vec<usize> {
        let mut others: Vec<usize> = (1..self.pool.len()).collect();
        others.shuffle(&mut ChaCha8Rng::seed_from_u64(seed));
        others.truncate(count - 1);
        others.insert(0, 0);
        others
    }
}

#[test]
fn the_optimal_plan_recovers_k_and_s_better_than_the_usual_and_the_usual_than_chance() {
    let bench = bench();
    let start = usual(&bench.paints, &bench.pool, 20).unwrap();
    let best = optimal(&bench.information, &start, 1, &Task::default()).unwrap();
    let random: Vec<Vec<usize>> = (0..6).map(|seed| bench.random(20, seed)).collect();
    let chance = random.iter().map(|design| bench.typical_error(design)).sum::<f64>() / 6.0;
    let best_error = bench.typical_error(&best);
    let usual_error = bench.typical_error(&start);
    assert!(best_error < 0.97 * usual_error, "{best_error} for {usual_error}");
    assert!(usual_error < chance, "{usual_error} for {chance}");
    assert!(best_error < 0.9 * chance, "{best_error} for {chance}");
    for (seed, design) in random.iter().enumerate() {
        let efficiency = bench.information.efficiency(design, &best);
        assert!(efficiency < 0.95, "random design {seed} has {efficiency}");
    }
}

#[test]
fn the_predicted_deviations_are_of_the_size_of_the_errors() {
    let bench = bench();
    let start = usual(&bench.paints, &bench.pool, 24).unwrap();
    for design in [optimal(&bench.information, &start, 1, &Task::default()).unwrap(), start] {
        let pulls = (0..4).flat_map(|seed| bench.errors(&design, 40 + seed));
        // The prediction is linear, so it holds for relative deviations below about a third.
        let known = pulls.filter(|(_, deviation)| *deviation < 0.3);
        let mut pulls: Vec<f64> = known.map(|(e, deviation)| (e / deviation).powi(2)).collect();
        assert!(pulls.len() > 800, "{} errors", pulls.len());
        pulls.sort_by(f64::total_cmp);
        // The square of a normal deviate has the median 0.455 and the 95th percentile 3.84.
        let median = pulls[pulls.len() / 2];
        let high = pulls[pulls.len() * 95 / 100];
        assert!((0.25..0.8).contains(&median), "median squared error in deviations: {median}");
        assert!((2.0..8.0).contains(&high), "95 % of squared errors below {high}");
    }
}

#[test]
fn no_single_exchange_improves_the_optimal_plan() {
    let bench = bench();
    let start = usual(&bench.paints, &bench.pool, 14).unwrap();
    let best = optimal(&bench.information, &start, 1, &Task::default()).unwrap();
    let reached = bench.information.log_determinant(&best);
    assert!(reached > bench.information.log_determinant(&start), "{reached}");
    assert_eq!(best[0], 0, "the masstone of the white stays");
    for place in 1..best.len() {
        for entering in (0..bench.pool.len()).filter(|index| !best.contains(index)) {
            let mut other = best.clone();
            other[place] = entering;
            let value = bench.information.log_determinant(&other);
            assert!(value < reached + 1e-8, "{entering} for {}: {value}", best[place]);
        }
    }
    assert_eq!(
        best,
        optimal(&bench.information, &start, 1, &Task::default()).unwrap(),
        "the plan is reproducible"
    );
}

#[test]
fn every_plan_identifies_every_pigment_from_the_least_number_of_swatches_on() {
    let bench = bench();
    for count in bench.paints.unknowns()..40 {
        let start = usual(&bench.paints, &bench.pool, count).unwrap();
        assert_eq!(start.len(), count);
        let best = optimal(&bench.information, &start, 1, &Task::default()).unwrap();
        for (name, design) in [("usual", start), ("optimal", best)] {
            let shares = design.iter().map(|&index| {
                let mut shares = vec![0.0; bench.paints.names.len()];
                for &(paint, share) in &bench.pool[index].shares() {
                    shares[paint.index()] = share;
                }
                shares
            });
            let shares: Vec<Vec<f64>> = shares.collect();
            let lost = unidentified(shares.iter().map(Vec::as_slice), PaintSet::WHITE);
            assert!(lost.is_empty(), "{name} of {count}");
        }
    }
}

#[test]
fn impossible_noise_is_refused_before_the_search() {
    let impossible = [(f64::NAN, 0.0), (0.0, 0.0), (-0.1, 0.01), (0.0, 1e300), (5e-324, 0.0)];
    for (constant, even) in impossible {
        let noise = Some(ExpectedNoise { constant, even });
        let options = PlanRequest { prior: Some(oils()), noise, ..PlanRequest::default() };
        let error =
            calibrate::plan(&["Viridian"], "Zinc White", &options, &Task::default()).unwrap_err();
        assert!(matches!(error, PlanError::Noise { .. }), "{constant}, {even}: {error}");
        assert!(error.hint().is_some());
    }
}
