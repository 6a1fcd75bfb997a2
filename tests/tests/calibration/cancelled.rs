//! Long work that is asked to end: it ends where it stands, with an error that says so.

#![expect(clippy::result_large_err, reason = "the error of calibrate, as its own calls return it")]

use std::sync::Mutex;

use calibrate::calibration::CalibrationError;
use calibrate::fit::{FitError, FitStage, Watch};
use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::matching::{MatchOptions, SearchControl};
use calibrate::plan::{PlanError, PlanOptions, plan_until};
use calibrate::quadrature::{EffectiveQuadrature, QuadratureFailure};
use calibrate::{FitOptions, FittingError, PreparedFit, Readings, ValidationOptions, Viewing};
use documents::Cancellation;
use documents::hint::{Explain, Fault};
use suite::watercolors::Watercolors;

/// The stages that `work` tells, if it is asked to end at the first that `last` selects, and its error.
fn until<T>(
    last: impl Fn(&FitStage) -> bool + Sync,
    work: impl FnOnce(Watch<'_>) -> Result<T, FittingError>,
) -> (Vec<FitStage>, FittingError) {
    let cancellation = Cancellation::default();
    let stages = Mutex::new(Vec::new());
    let told = |stage: FitStage| {
        stages.lock().unwrap().push(stage);
        if last(&stage) {
            cancellation.cancel();
        }
    };
    let error = work(Watch::new(&told).until(&cancellation)).err().expect("it was cancelled");
    (stages.into_inner().unwrap(), error)
}

fn oils() -> Readings {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../measurements/van-gogh-oils.csv");
    Readings::open(path).unwrap()
}

fn is_cancelled(error: &FittingError) -> bool {
    matches!(error, FittingError::Calibration(CalibrationError::Fit(FitError::Cancelled(_))))
        && error.hint().is_some()
        && error.fault() == Fault::Environment
}

#[test]
fn a_fit_ends_at_the_stage_where_it_is_asked_to() {
    let readings = oils();
    let prepared = PreparedFit::new(&readings, &FitOptions::default(), Watch::default()).unwrap();
    let lasts: [fn(&FitStage) -> bool; 4] = [
        |stage| matches!(stage, FitStage::Programs { round: 2, .. }),
        |stage| matches!(stage, FitStage::Spectra { estimate: 1, round: 2 }),
        |stage| *stage == FitStage::Colors,
        |stage| matches!(stage, FitStage::Deviations { .. }),
    ];
    let mut before = 0;
    for last in lasts {
        let (stages, error) = until(last, |watch| prepared.fit_watched(watch));
        assert!(is_cancelled(&error), "{error:?}");
        assert!(last(stages.last().unwrap()), "a stage follows: {stages:?}");
        assert!(stages.len() > before, "{stages:?}");
        before = stages.len();
    }
    // A watch that never ends the work changes nothing.
    let never = Cancellation::default();
    let watched = prepared.fit_watched(Watch::default().until(&never)).unwrap();
    assert!(watched == prepared.fit().unwrap(), "another fit");
}

#[test]
fn a_validation_ends_before_most_of_its_mixtures() {
    let readings = oils();
    let options = ValidationOptions::default();
    let prepared = PreparedFit::new(&readings, &options.fit, Watch::default()).unwrap();
    let left_out = |stage: &FitStage| *stage == FitStage::LeftOut;
    let (stages, error) = until(left_out, |watch| prepared.validate(&options, watch));
    assert!(is_cancelled(&error), "{error:?}");
    let told = stages.iter().filter(|stage| left_out(stage)).count();
    let all = prepared.mixtures(&options).unwrap();
    let at_once = rayon::current_num_threads();
    assert!(told <= at_once && 2 * told < all, "{told} of {all} on {at_once} threads");
}

#[test]
fn the_choice_of_a_film_model_ends_before_most_of_its_fits() {
    let file = tempfile::NamedTempFile::with_suffix(".csv").unwrap();
    std::fs::write(file.path(), Watercolors::hard(1).csv()).unwrap();
    let readings = Readings::open(file.path()).unwrap();
    let options = FitOptions { amounts: AmountKind::Absolute, ..FitOptions::default() };
    let (stages, error) = until(
        |stage| *stage == FitStage::FilmModel,
        |watch| PreparedFit::new(&readings, &options, watch),
    );
    assert!(is_cancelled(&error), "{error:?}");
    assert!(stages.len() <= rayon::current_num_threads().min(5), "{stages:?}");
}

#[test]
fn quadratures_plans_and_recipes_end_too() {
    let oils = PigmentLibrary::van_gogh_oils();
    let cancellation = Cancellation::default();
    cancellation.cancel();
    let failure = EffectiveQuadrature::of_until(&Viewing::default(), &oils, 8, &cancellation);
    let failure = failure.unwrap_err();
    assert!(matches!(failure, QuadratureFailure::Cancelled(_)) && failure.hint().is_some());
    let options = PlanOptions { prior: Some(oils.clone()), ..PlanOptions::default() };
    let error = plan_until(&["Cobalt Blue", "Viridian"], "Zinc White", &options, &cancellation);
    let error = error.unwrap_err();
    assert!(matches!(error, PlanError::Cancelled(_)) && error.hint().is_some(), "{error:?}");
    let search = oils.recipe_search(&MatchOptions::default()).unwrap();
    let control = SearchControl::until(cancellation);
    let target = "#4a7d8c".parse().unwrap();
    assert_eq!(search.recipes_with_control(&target, &control).unwrap(), None);
    let free = search.recipes_with_control(&target, &SearchControl::default()).unwrap();
    assert_eq!(free.unwrap(), search.recipes_for(&target).unwrap());
}
