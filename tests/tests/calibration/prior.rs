//! The prior on S: swatches that hardly determine S still predict mixtures that the fit has not seen, and the
//! fit says how far S comes from the data.

use calibrate::fit::{Problem, Refined, Refinement, Smoothness, fit_refined};
use calibrate::synthetic::{SwatchErrors, SwatchKind, SyntheticMixtures};
use calibrate::{Curves, PigmentId, Viewing};
use documents::Task;
use spectra::Grid;

const EXACT: SwatchErrors = SwatchErrors { reading: 0.001, weighing: 0.01 };
const ROUGH: SwatchErrors = SwatchErrors { reading: 0.005, weighing: 0.15 };

fn paints(seed: u64) -> Vec<Curves> {
    let grid = Grid::from_nm(400.0, 10.0, 31).unwrap();
    SyntheticMixtures::of_size(seed, 0.0, grid, 10, 10).curves
}

fn swatches(kind: SwatchKind, errors: SwatchErrors, seed: u64) -> SyntheticMixtures {
    SyntheticMixtures::swatches(paints(seed), suite::oils::SURFACE, kind, errors, seed)
}

fn fitted(made: &SyntheticMixtures, deviations: bool) -> Refined {
    let problem = Problem::new(made.grid, made.surface, &made.observations, PigmentId(0)).unwrap();
    let weights = Viewing::default().weights(made.grid).unwrap();
    let how = Refinement { smoothness: Smoothness::Auto, state: None, deviations };
    fit_refined(&problem, &weights, how, &Task::default()).unwrap()
}

#[test]
fn tints_alone_with_errors_of_weighing_predict_unseen_mixtures() {
    // Without the prior the mean is 3.03 CIEDE2000, because S follows the errors of weighing.
    let errors = (0..4).map(|seed| {
        let made = swatches(SwatchKind::Tints, ROUGH, seed);
        made.error_of_mixtures(&fitted(&made, false).curves, 100, seed)
    });
    let mean = errors.sum::<f64>() / 4.0;
    assert!(mean < 2.75, "{mean}");
}

/// Least and median fraction of S that is known from swatches of random paints.
fn known(kind: SwatchKind, errors: SwatchErrors) -> (f64, f64) {
    let mut known = fitted(&swatches(kind, errors, 1), true).scattering_known;
    assert_eq!(known.remove(0), 1.0, "S of the white is 1");
    known.sort_by(f64::total_cmp);
    (known[0], known[known.len() / 2])
}

#[test]
fn shades_and_exact_scales_make_scattering_known() {
    let (least_of_rough, rough) = known(SwatchKind::Tints, ROUGH);
    let (least_of_exact, exact) = known(SwatchKind::TintsAndShades, EXACT);
    assert!(rough < 0.997 && least_of_rough < 0.97, "{rough} {least_of_rough}");
    assert!(1.0 - exact < 0.1 * (1.0 - rough), "{exact} {rough}");
    assert!(1.0 - least_of_exact < 0.1 * (1.0 - least_of_rough), "{least_of_exact}");
}
