//! Errors of unseen mixtures for fits to synthetic swatches of each kind, made from the Van Gogh oils and from
//! random paints, with errors of reading and weighing.
//!
//! ```sh
//! cargo run --release -p impasto-calibrate --example held_out
//! ```

#![expect(clippy::print_stdout, reason = "an example prints what it shows")]

use calibrate::fit::{Problem, Refinement, Smoothness, fit_refined};
use calibrate::synthetic::{SwatchErrors, SwatchKind, SyntheticMixtures};
use calibrate::{Curves, PigmentId, PigmentLibrary, Readings, ValidationRequest, Viewing};
use documents::Task;
use spectra::Grid;

/// Number of trials of each kind, each with other errors.
const TRIALS: u64 = 4;
/// Unseen mixtures in each trial.
const MIXTURES: usize = 100;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let oils = PigmentLibrary::van_gogh_oils();
    let kinds = [SwatchKind::Tints, SwatchKind::TintsAndShades, SwatchKind::MasstonesAndTints];
    for (name, errors) in [
        ("exact", SwatchErrors { reading: 0.001, weighing: 0.01 }),
        ("usual", SwatchErrors { reading: 0.003, weighing: 0.05 }),
        ("rough", SwatchErrors { reading: 0.005, weighing: 0.15 }),
    ] {
        for kind in kinds {
            let mut sums = [0.0; 2];
            for seed in 0..TRIALS {
                for (place, curves) in [curves(&oils), random_curves(seed)].into_iter().enumerate()
                {
                    let swatches =
                        SyntheticMixtures::swatches(curves, oils.saunderson, kind, errors, seed);
                    sums[place] += error(&swatches, seed)?;
                }
            }
            let [oils, random] = sums.map(|sum| sum / TRIALS as f64);
            println!("{name:6} {kind:?}: oils {oils:.2}, random paints {random:.2}");
        }
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../measurements/van-gogh-oils.csv");
    let readings = Readings::open(path)?;
    let validated = calibrate::validate(&readings, &ValidationRequest::default())?;
    println!(
        "oils: left out {:.2}, max {:.1}; in sample {:.2}",
        validated.errors.delta_e.mean,
        validated.errors.delta_e.max,
        validated.fit.evidence().delta_e.mean
    );
    Ok(())
}

/// K and S of the oils, the white first and the black last.
fn curves(oils: &PigmentLibrary) -> Vec<Curves> {
    let white = oils.reference_id().expect("the oils have a white");
    let black = oils.ids().find(|id| oils[*id].name.contains("Black")).expect("a black");
    let others = oils.ids().filter(|id| *id != white && *id != black && oils[*id].identified);
    let all = std::iter::once(white).chain(others).chain([black]);
    all.map(|id| oils.curves(id)).collect()
}

/// K and S of ten random paints.
fn random_curves(seed: u64) -> Vec<Curves> {
    let grid = Grid::from_nm(400.0, 10.0, 31).expect("a grid");
    SyntheticMixtures::of_size(seed, 0.0, grid, 10, 10).curves
}

fn error(swatches: &SyntheticMixtures, seed: u64) -> Result<f64, Box<dyn std::error::Error>> {
    let SyntheticMixtures { grid, surface, .. } = *swatches;
    let problem = Problem::new(grid, surface, &swatches.observations, PigmentId(0))?;
    let weights = Viewing::default().weights(grid)?;
    let how = Refinement::prediction(Smoothness::Auto, None);
    let refined = fit_refined(&problem, &weights, how, &Task::default())?;
    Ok(swatches.error_of_mixtures(&refined.curves, MIXTURES, seed))
}
