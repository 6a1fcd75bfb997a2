//! Fits of synthetic mixtures whose K and S are known.

use std::sync::Mutex;

use calibrate::evaluate::Viewing;
use calibrate::fit::{
    FitError, FitStage, Problem, Refined, Refinement, Smoothness, Watch, condition, fit_qp,
    fit_refined, fit_weighted,
};
use calibrate::observation::Observation;
use calibrate::synthetic::SyntheticMixtures;
use calibrate::{Curves, PigmentId};

fn problem(made: &SyntheticMixtures) -> Problem {
    Problem::new(made.grid, made.surface, &made.observations, PigmentId(0)).unwrap()
}

fn refined(made: &SyntheticMixtures, smoothness: Smoothness) -> Refined {
    let weights = Viewing::default().weights(made.grid).unwrap();
    fit_refined(&problem(made), &weights, Refinement::whole(smoothness)).unwrap()
}

/// Largest error of the logarithm of `curve` (K or S) where the true value exceeds 0.01.
fn largest_log_error(found: &[Curves], truth: &[Curves], curve: fn(&Curves) -> &[f64]) -> f64 {
    let pairs = found.iter().flat_map(curve).zip(truth.iter().flat_map(curve));
    pairs.filter(|(_, t)| **t > 1e-2).map(|(f, t)| (f / t).ln().abs()).fold(0.0, f64::max)
}

#[test]
fn every_method_recovers_known_k_and_s_from_readings_without_noise() {
    let made = SyntheticMixtures::paper_size(3, 0.0);
    let problem = problem(&made);
    let refined = refined(&made, Smoothness::None);
    let fits = [
        ("qp", fit_qp(&problem).unwrap(), 0.05),
        ("weighted", fit_weighted(&problem).unwrap(), 0.05),
        ("refined", refined.curves, 0.05),
    ];
    for (name, curves, bound) in fits {
        let k = largest_log_error(&curves, &made.curves, |c| &c.absorption);
        let s = largest_log_error(&curves, &made.curves, |c| &c.scattering);
        assert!(k < bound && s < bound, "{name}: log K off by {k}, log S by {s}");
    }
}

#[test]
fn at_the_papers_size_the_fit_is_nearer_to_the_truth_than_its_readings() {
    for seed in [11, 12] {
        let made = SyntheticMixtures::paper_size(seed, 0.002);
        let rms = |fit: &Refined| made.rms_to_truth(&fit.curves);
        // Noise of 0.002 in 71 mixtures with 21 unknowns leaves 0.002 sqrt(21 / 71) = 0.00109
        // without smoothing.
        let rough = rms(&refined(&made, Smoothness::None));
        assert!(rough < 0.00115, "seed {seed}: {rough}");
        let smooth = rms(&refined(&made, Smoothness::Auto));
        assert!(smooth < 0.0007, "seed {seed}: {smooth}");
    }
}

#[test]
fn standard_deviations_are_of_the_size_of_the_errors() {
    let made = SyntheticMixtures::paper_size(21, 0.002);
    let fit = refined(&made, Smoothness::None);
    let deviations = fit.deviations.as_ref().expect("a whole fit has deviations");
    let mut pulls = Vec::new();
    let pigments = fit.curves.iter().zip(&made.curves).zip(deviations).skip(1);
    for ((fitted, given), deviation) in pigments {
        for at in 0..made.grid.count() {
            let error = fitted.scattering[at] - given.scattering[at];
            pulls.push((error / deviation.scattering[at]).powi(2));
        }
    }
    pulls.sort_by(f64::total_cmp);
    // The median of a squared normal deviate is 0.455.
    let median = pulls[pulls.len() / 2];
    assert!((0.2..1.0).contains(&median), "median squared error in deviations: {median}");
    assert!(deviations[0].scattering.iter().all(|sd| *sd == 0.0), "the reference's S is given");
}

#[test]
fn the_program_ends_at_its_optimum() {
    // At the minimum of a convex program over nonnegative unknowns, the gradient is 0 for each
    // positive unknown and at least 0 for each unknown at 0.
    let made = SyntheticMixtures::paper_size(5, 0.002);
    let curves = fit_qp(&problem(&made)).unwrap();
    let pigments = curves.len();
    for at in (0..made.grid.count()).step_by(10) {
        let mut gradient = vec![0.0; 2 * pigments];
        let mut size = vec![1e-300f64; 2 * pigments];
        for observation in &made.observations {
            let q = observation.ratio[at];
            let row: Vec<f64> = observation
                .shares
                .iter()
                .copied()
                .chain(observation.shares.iter().map(|c| -q * c))
                .collect();
            let values = (0..pigments)
                .map(|p| curves[p].absorption[at])
                .chain((0..pigments).map(|p| curves[p].scattering[at]));
            let residual: f64 = row.iter().zip(values.clone()).map(|(r, v)| r * v).sum();
            let scale: f64 = row.iter().zip(values).map(|(r, v)| (r * v).abs()).sum();
            for (place, r) in row.iter().enumerate() {
                gradient[place] += r * residual;
                size[place] += (r * scale).abs();
            }
        }
        for place in (0..2 * pigments).filter(|&p| p != pigments) {
            let slope = gradient[place] / size[place];
            let value = if place < pigments {
                curves[place].absorption[at]
            } else {
                curves[place - pigments].scattering[at]
            };
            assert!(slope > -1e-5, "the cost still falls along unknown {place} at {at}: {slope}");
            assert!(value < 1e-6 || slope < 1e-5, "unknown {place} = {value} at {at}: {slope}");
        }
    }
}

#[test]
fn any_number_of_wavelengths_will_do() {
    let made = SyntheticMixtures::paper_size(4, 0.001);
    for count in [1, 2, 3, 7] {
        let grid = spectra::Grid::from_nm(500.0, 3.0, count).unwrap();
        let cut = |o: &Observation| Observation {
            ratio: o.ratio[..count].to_vec(),
            reflectance: o.reflectance[..count].to_vec(),
            ..o.clone()
        };
        let observations: Vec<Observation> = made.observations.iter().map(cut).collect();
        let problem = Problem::new(grid, made.surface, &observations, PigmentId(0)).unwrap();
        let weights = Viewing::default().weights(grid).unwrap();
        let fit = fit_refined(&problem, &weights, Refinement::whole(Smoothness::Auto)).unwrap();
        let all = fit.curves.iter().flat_map(|curves| &curves.absorption);
        assert!(all.into_iter().all(|v| v.is_finite() && *v >= 0.0), "{count}");
    }
}

#[test]
fn wrong_shapes_are_refused() {
    let made = SyntheticMixtures::paper_size(1, 0.0);
    let mut observations = made.observations.clone();
    observations[3].ratio.pop();
    let error = Problem::new(made.grid, made.surface, &observations, PigmentId(0)).unwrap_err();
    assert!(matches!(&error, FitError::Shape { sample, .. } if sample == "S03"), "{error}");
    let none = Problem::new(made.grid, made.surface, &[], PigmentId(0)).unwrap_err();
    assert_eq!(none, FitError::Empty);
    let only_black: Vec<Observation> =
        made.observations.iter().filter(|o| o.shares[0] == 0.0).cloned().collect();
    let lost = Problem::new(made.grid, made.surface, &only_black, PigmentId(0)).unwrap_err();
    assert_eq!(lost, FitError::Reference);
}

#[test]
fn pigments_always_mixed_alike_lower_the_rank() {
    let made = SyntheticMixtures::paper_size(6, 0.0);
    let tied: Vec<Observation> = made
        .observations
        .iter()
        .map(|o| {
            let mut shares = o.shares.clone();
            let both = shares[1] + shares[2];
            (shares[1], shares[2]) = (both / 2.0, both / 2.0);
            Observation { shares, ..o.clone() }
        })
        .collect();
    let rank = |observations: &[Observation]| {
        let problem = Problem::new(made.grid, made.surface, observations, PigmentId(0)).unwrap();
        condition(&problem, &made.curves).rank
    };
    assert_eq!(rank(&made.observations), 21);
    // The mixtures determine only the sums of the two K and of the two S: two unknowns fewer.
    assert_eq!(rank(&tied), 19);
}

#[test]
fn a_fit_is_the_same_to_the_bit_on_any_number_of_threads_and_tells_its_stages() {
    // Wide enough that panels of the factor are shared out to threads.
    let grid = spectra::Grid::from_nm(400.0, 20.0, 16).unwrap();
    let made = SyntheticMixtures::of_size(7, 0.002, grid, 30, 120);
    let weights = Viewing::default().weights(grid).unwrap();
    let fit = |threads: usize| {
        let stages = Mutex::new(Vec::new());
        let told = |stage: FitStage| stages.lock().unwrap().push(stage);
        let how = Refinement { watch: Watch::new(&told), ..Refinement::whole(Smoothness::Auto) };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let refined = pool.install(|| fit_refined(&problem(&made), &weights, how).unwrap());
        (refined, stages.into_inner().unwrap())
    };
    let (one, stages) = fit(1);
    let three = fit(3).0;
    assert!(one == three, "a result depends on the number of threads");
    assert_eq!(stages[0], FitStage::Programs { round: 1, of: 6 });
    let place = |wanted: fn(&FitStage) -> bool| stages.iter().position(wanted).unwrap();
    let spectra = place(|stage| matches!(stage, FitStage::Spectra { estimate: 1, round: 1 }));
    let colors = place(|stage| *stage == FitStage::Colors);
    let deviations = place(|stage| matches!(stage, FitStage::Deviations { done: 0, of: 120 }));
    assert!(spectra == 6 && spectra < colors && colors < deviations, "{stages:?}");
}
