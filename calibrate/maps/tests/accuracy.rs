//! Accuracy of maps on measured swatches and simulated paintings with fixed seeds. If you want to
//! see the numbers, run the example `accuracy`. The bounds in this file lie a little below them.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use calibrate::Readings;
use documents::Task;
use maps::accuracy::{
    Baseline, NamedGroups, PaintingPlan, Scores, SwatchTrials, Told, coverage, light_palette,
    missing_pigment, oil_groups, painting_trials, prepared_oils, reliability, residuals_of,
    swatch_trials,
};
use maps::{MapSettings, ModelError};
use pigment::PigmentLibrary;

fn readings() -> Readings {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../measurements/van-gogh-oils.csv");
    Readings::open(path).unwrap()
}

fn stated() -> MapSettings {
    MapSettings {
        groups: oil_groups(),
        group_alike: false,
        model_error: Some(ModelError::Stated(0.1)),
        ..MapSettings::default()
    }
}

fn plan(pixels: usize) -> PaintingPlan {
    PaintingPlan { pixels, ..PaintingPlan::default() }
}

#[test]
fn left_out_swatches_are_unmixed_better_than_by_linear_methods() {
    let samples = prepared_oils(&readings()).unwrap().left_out(&Task::default()).unwrap();
    assert_eq!(samples.len(), 65, "binary mixtures");
    let groups = oil_groups();
    // As `identify` does.
    let settings = MapSettings { at_most: 3, ..MapSettings::default() };
    let trials = swatch_trials(&samples, &settings, &groups).unwrap();
    let pigments = Scores::of(&trials.pigments);
    let joined = Scores::of(&trials.groups);
    println!("pigments {pigments}, groups {joined}");
    assert!(joined.precision > 0.92 && joined.recall > 0.84, "groups {joined}");
    assert!(joined.share_error < 0.15, "groups {joined}");
    assert!(pigments.precision > 0.79 && pigments.recall > 0.74, "pigments {pigments}");
    let named = NamedGroups::of(&samples, &groups);
    for baseline in Baseline::ALL {
        let linear = SwatchTrials::baseline(&samples, &named, baseline, 0.1);
        let linear = Scores::of(&linear.groups);
        assert!(linear.f1() + 0.15 < joined.f1(), "{}: {linear}", baseline.name());
        assert!(linear.share_error > 2.0 * joined.share_error, "{}: {linear}", baseline.name());
    }
}

#[test]
fn simulated_paintings_are_unmixed_and_told_honestly() {
    let oils = PigmentLibrary::van_gogh_oils();
    let light = PaintingPlan { palette: light_palette(), ..plan(100) };
    let trials =
        painting_trials((&oils, &oils), &light, 201..211, (&stated(), Told::Nothing)).unwrap();
    let searched = Scores::of(&trials.searched);
    let mapped = Scores::of(&trials.mapped);
    println!("light palette: searched {searched}, mapped {mapped}, worse {:.3}", trials.worse());
    assert!(searched.precision > 0.95 && searched.recall > 0.88, "searched {searched}");
    assert!(searched.share_error < 0.08, "searched {searched}");
    assert!(mapped.f1() > 0.93 && mapped.share_error < 0.08, "mapped {mapped}");
    assert!(trials.worse() < 0.03, "{}", trials.worse());
    let trials =
        painting_trials((&oils, &oils), &plan(100), 201..221, (&stated(), Told::Nothing)).unwrap();
    let searched = Scores::of(&trials.searched);
    let mapped = Scores::of(&trials.mapped);
    println!("searched {searched}, mapped {mapped}, worse {:.3}", trials.worse());
    assert!(searched.precision > 0.88 && searched.recall > 0.76, "searched {searched}");
    assert!(searched.share_error < 0.19, "searched {searched}");
    assert!(mapped.precision > 0.92 && mapped.recall > 0.80, "mapped {mapped}");
    assert!(mapped.share_error < 0.16, "mapped {mapped}");
    assert!(mapped.f1() > searched.f1() - 0.03, "mapped {mapped}");
    assert!(trials.worse() < 0.10, "{}", trials.worse());
    for range in reliability(&trials.searched, &[0.0, 0.1, 0.9]) {
        println!("{range:?}");
        assert!((range.told - range.true_part).abs() < 0.05, "{range:?}");
    }
    // After a survey as in a whole search.
    for told in [&trials.searched, &trials.mapped] {
        let covered = coverage(told);
        println!("{covered:?}");
        assert!((0.62..0.80).contains(&covered.within), "{covered:?}");
        for range in reliability(told, &[0.1, 0.3, 0.5, 0.7, 0.9]) {
            println!("{range:?}");
            assert!((range.told - range.true_part).abs() < 0.1, "{range:?}");
        }
    }
}

#[test]
fn a_library_of_other_readings_serves_too() {
    let prepared = prepared_oils(&readings()).unwrap();
    let halves = [0, 1].map(|half| prepared.half(half));
    let [real, known] = halves.each_ref().map(|half| half.fit(&Task::default()).unwrap().library);
    let residuals = residuals_of(&halves[1].left_out(&Task::default()).unwrap()).unwrap();
    let model_error = Some(ModelError::Residuals(residuals));
    let settings = MapSettings { model_error, ..stated() };
    let exact = PaintingPlan { error: 0.0, ..plan(100) };
    let trials =
        painting_trials((&real, &known), &exact, 301..321, (&settings, Told::Nothing)).unwrap();
    let searched = Scores::of(&trials.searched);
    println!("searched {searched}, worse {:.3}", trials.worse());
    assert!(searched.precision > 0.85 && searched.recall > 0.68, "{searched}");
}

#[test]
fn a_pigment_that_the_library_lacks_raises_chi_square() {
    let oils = PigmentLibrary::van_gogh_oils();
    let found = missing_pigment(&oils, &plan(100), 401..411, &stated()).unwrap();
    println!("{found:?}");
    assert!(found.chi2[1] > 1.5 * found.chi2[0], "{found:?}");
    assert!(found.noticed > 0.3, "{found:?}");
}
