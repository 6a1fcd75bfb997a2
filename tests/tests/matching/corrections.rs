//! Corrections of a batch when it was weighed with errors, or its paints differ from the library.

use calibrate::Viewing;
use calibrate::evaluate::lab;
use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::matching::{
    Batch, ColorTarget, CorrectRequest, MatchError, Metric, SpectrumWeights,
};
use documents::Task;
use spectra::color::delta_e_ciede2000;
use spectra::{Reflectance, Spectrum};

use super::oils;

/// A deviation of weighing that leaves no error to the library.
const LIBRARY_IS_EXACT: f64 = 50.0;

/// Other tubes of the oils: each is stronger or weaker, with a slightly different hue.
fn other_tubes() -> PigmentLibrary {
    let mut library = oils();
    for (index, pigment) in library.pigments.iter_mut().enumerate() {
        let strength = if index % 2 == 0 { 1.15 } else { 0.88 };
        let count = pigment.absorption.len() as f64;
        for (at, k) in pigment.absorption.iter_mut().enumerate() {
            *k *= strength * (1.0 + 0.06 * (at as f64 / count - 0.5));
        }
    }
    library
}

fn measured(library: &PigmentLibrary, parts: &[(&str, f64)]) -> Spectrum<Reflectance> {
    library.color(parts.iter().copied(), &Viewing::default()).unwrap().reflectance
}

const RECIPE: [(&str, f64); 3] =
    [("Zinc White", 80.0), ("Cobalt Blue", 15.0), ("Chrome Yellow", 5.0)];

fn batch(library: &PigmentLibrary, weighed: &[(&str, f64)]) -> Batch {
    let made = RECIPE.map(|(name, part)| (name.to_owned(), part));
    let reflectance = measured(library, weighed);
    Batch { made: made.to_vec(), grams: 500.0, reflectance, rounds: Vec::new() }
}

fn apart(a: &Spectrum<Reflectance>, b: &Spectrum<Reflectance>) -> f64 {
    let weights = Viewing::default().weights(a.grid()).unwrap();
    let [a, b] = [a, b].map(|spectrum| lab(&weights, spectrum.values()));
    delta_e_ciede2000(a, b)
}

#[test]
fn the_real_pot_matches_after_the_correction() {
    let truth = other_tubes();
    let standard = measured(&truth, &RECIPE);
    // There is too much yellow, and too little white and blue.
    let weighed = [("Zinc White", 74.0), ("Cobalt Blue", 13.0), ("Chrome Yellow", 7.0)];
    let batch = batch(&truth, &weighed);
    let before = apart(&standard, &batch.reflectance);
    let target = ColorTarget::measured("standard", standard.clone());
    let options = CorrectRequest::default();
    let library = oils();
    let found = options.run(&library, &target, &batch, &Task::default()).unwrap();
    assert!(found.reaches && before > 4.0, "{before}");
    let least = &found.corrections[0];
    let mut pot: Vec<(String, f64)> =
        weighed.iter().map(|(name, part)| ((*name).to_owned(), 500.0 * part / 94.0)).collect();
    pot.extend(least.additions.iter().map(|(id, grams)| (library[*id].name.clone(), *grams)));
    let pot = truth.color(pot.iter().map(|(n, g)| (n.as_str(), *g)), &Viewing::default());
    let after = apart(&standard, &pot.unwrap().reflectance);
    assert!(after < 1.2 && after < before / 3.0, "{after} after {before}");
    // The library alone would be further off than the pot is from the library.
    assert!(found.recipe_delta_e[0] > 1.0, "{:?}", found.recipe_delta_e);
}

#[test]
fn pots_come_as_near_as_they_are_expected_to_and_none_is_made_worse() {
    let (truth, library) = (other_tubes(), oils());
    let mut sums = [0.0; 3];
    // Fractions of white, blue and yellow that were weighed too much.
    for errors in [[0.1, -0.2, 0.1], [-0.15, 0.1, 0.25], [0.0, 0.2, -0.2], [-0.1, 0.3, 0.2]] {
        let standard = measured(&truth, &RECIPE);
        let mut pot: Vec<(String, f64)> = (RECIPE.iter().zip(errors))
            .map(|((name, part), error)| ((*name).to_owned(), 5.0 * part * (1.0 + error)))
            .collect();
        let grams: f64 = pot.iter().map(|(_, grams)| grams).sum();
        let weighed: Vec<(&str, f64)> = pot.iter().map(|(name, g)| (name.as_str(), *g)).collect();
        let batch = Batch { grams, ..batch(&truth, &weighed) };
        let before = apart(&standard, &batch.reflectance);
        let target = ColorTarget::measured("standard", standard.clone());
        let options = CorrectRequest::default();
        let found = options.run(&library, &target, &batch, &Task::default()).unwrap();
        let first = &found.corrections[0];
        for (id, _) in &first.additions {
            assert!(RECIPE.iter().any(|(name, _)| library[*id].name == *name), "{first:?}");
        }
        assert!(first.expected >= first.distance && first.grams <= grams / 2.0, "{first:?}");
        pot.extend(first.additions.iter().map(|(id, g)| (library[*id].name.clone(), *g)));
        let pot: Vec<(&str, f64)> = pot.iter().map(|(name, g)| (name.as_str(), *g)).collect();
        let after = apart(&standard, &measured(&truth, &pot));
        assert!(after < before, "{before} -> {after}");
        sums = [sums[0] + before, sums[1] + after, sums[2] + first.expected];
    }
    let [before, after, expected] = sums.map(|sum| sum / 4.0);
    assert!(after < 0.7 && after < before / 3.0, "{before} -> {after}");
    assert!((after / expected - 1.0).abs() < 0.4, "{after}, expected {expected}");
}

#[test]
fn a_pot_that_was_weighed_exactly_shows_how_its_paints_differ() {
    let (truth, library) = (other_tubes(), oils());
    let target = ColorTarget::measured("library", measured(&library, &RECIPE));
    let batch = batch(&truth, &RECIPE);
    let exact = CorrectRequest { weighing: 1e-3, ..CorrectRequest::default() };
    let found = exact.run(&library, &target, &batch, &Task::default()).unwrap();
    for paint in &found.pot {
        assert!((paint.grams / paint.made - 1.0).abs() < 0.01, "{paint:?}");
    }
    // K of the blue is 0.88 times as large in truth, and K of the yellow 1.15 times.
    let [_, blue, yellow] = found.pot[..] else { panic!("three paints: {:?}", found.pot) };
    assert!(blue.strength < 0.98 && yellow.strength > 1.02, "{blue:?} {yellow:?}");
    // Where weights may be wrong, they explain part of it.
    let careless = CorrectRequest { weighing: 0.5, ..CorrectRequest::default() };
    let found = careless.run(&library, &target, &batch, &Task::default()).unwrap();
    assert!(found.pot[1].grams < 0.98 * found.pot[1].made, "{:?}", found.pot);
    assert!(found.pot[1].strength > blue.strength, "{:?}", found.pot);
}

#[test]
fn the_least_addition_comes_first_and_no_smaller_one_is_near() {
    let library = &oils();
    let standard = measured(library, &RECIPE);
    let weighed = [("Zinc White", 80.0), ("Cobalt Blue", 12.0), ("Chrome Yellow", 5.0)];
    let batch = batch(library, &weighed);
    let target = ColorTarget::measured("standard", standard.clone());
    let options =
        CorrectRequest { at_most: 1, count: 11, weighing: LIBRARY_IS_EXACT, ..Default::default() };
    let found = options.run(library, &target, &batch, &Task::default()).unwrap();
    assert!(found.corrections.is_sorted_by(|a, b| a.grams <= b.grams));
    let best = &found.corrections[0];
    let (id, grams) = best.additions[0];
    assert_eq!(library[id].name, "Cobalt Blue");
    // By brute force. The pot is what was weighed, since the library is exact here.
    let after = |blue: f64| {
        let scale = 500.0 / 97.0;
        let pot = [("Zinc White", 80.0 * scale), ("Chrome Yellow", 5.0 * scale)];
        let parts = [pot[0], ("Cobalt Blue", 12.0 * scale + blue), pot[1]];
        apart(&standard, &measured(library, &parts))
    };
    let needed = (1..4000).map(|step| f64::from(step) / 100.0).find(|g| after(*g) <= 0.5).unwrap();
    assert!((grams - needed).abs() < 0.02 * needed + 0.02, "{grams} g, needed {needed} g");
    // S of the pot comes from its recipe, which is not quite what was weighed.
    assert!((best.delta_e[0] - after(grams)).abs() < 0.05, "{} {}", best.delta_e[0], after(grams));
}

#[test]
fn stock_and_limits_hold() {
    let library = &oils();
    let target = ColorTarget::measured("standard", measured(library, &RECIPE));
    let weighed = [("Zinc White", 80.0), ("Cobalt Blue", 9.0), ("Chrome Yellow", 5.0)];
    let batch = batch(library, &weighed);
    let free = CorrectRequest { only: vec!["Cobalt Blue".into()], ..Default::default() };
    let needed = free.run(library, &target, &batch, &Task::default()).unwrap();
    assert!(needed.reaches);
    let needed = needed.corrections[0].grams;
    let short =
        CorrectRequest { stock: vec![("Cobalt Blue".into(), needed / 2.0)], ..free.clone() };
    let found = short.run(library, &target, &batch, &Task::default()).unwrap();
    assert!(!found.reaches && found.corrections[0].distance > 0.5);
    let (id, grams) = found.corrections[0].additions[0];
    assert!((grams - needed / 2.0).abs() < 0.01 * needed, "{grams} of {needed}");
    assert_eq!(found.corrections[0].out_of_stock, [id]);
    let little = CorrectRequest { most_grams: Some(needed / 4.0), ..free.clone() };
    let found = little.run(library, &target, &batch, &Task::default()).unwrap();
    assert!(!found.reaches && found.corrections[0].grams <= needed / 4.0 * (1.0 + 1e-9));
    let near = Batch { reflectance: measured(library, &RECIPE), ..batch.clone() };
    let found = free.run(library, &target, &near, &Task::default()).unwrap();
    assert!(found.is_near && found.corrections.is_empty());
}

#[test]
fn batches_that_cannot_be_corrected_are_refused() {
    let library = &oils();
    let target = ColorTarget::measured("standard", measured(library, &RECIPE));
    let batch = batch(library, &RECIPE);
    let usual = CorrectRequest::default();
    let unknown = Batch { made: vec![("Cobalt Green".into(), 1.0)], ..batch.clone() };
    let error = usual.run(library, &target, &unknown, &Task::default()).unwrap_err();
    assert!(matches!(error, MatchError::Recipe(_)));
    for grams in [0.0, -1.0, f64::NAN] {
        let wrong = Batch { grams, ..batch.clone() };
        let error = usual.run(library, &target, &wrong, &Task::default()).unwrap_err();
        assert!(matches!(error, MatchError::Number { .. }), "{grams}");
    }
    let none = CorrectRequest { at_most: 0, ..usual.clone() };
    let error = none.run(library, &target, &batch, &Task::default()).unwrap_err();
    assert!(matches!(error, MatchError::Number { .. }));
    let absolute = PigmentLibrary { amounts: AmountKind::Absolute, ..library.clone() };
    let error = usual.run(&absolute, &target, &batch, &Task::default()).unwrap_err();
    assert_eq!(error, MatchError::AbsoluteBatch);
}

#[test]
fn a_batch_is_corrected_by_its_spectrum() {
    let library = &oils();
    let standard = measured(library, &RECIPE);
    let weighed = [("Zinc White", 80.0), ("Cobalt Blue", 12.0), ("Chrome Yellow", 5.0)];
    let batch = batch(library, &weighed);
    let target = ColorTarget::measured("standard", standard.clone());
    let options = CorrectRequest {
        metric: Metric::Spectrum(SpectrumWeights::Even),
        only: vec!["Cobalt Blue".into()],
        tolerance: 0.01,
        weighing: LIBRARY_IS_EXACT,
        ..Default::default()
    };
    let found = options.run(library, &target, &batch, &Task::default()).unwrap();
    assert!(found.reaches && found.batch_rms_percent.unwrap() > 1.0, "{found:?}");
    let least = &found.corrections[0];
    assert!(least.rms_percent.unwrap() <= 0.01 + 1e-9, "{least:?}");
    // The pot of 500 g has 97 parts and lacks 3. Its S comes from what should have been weighed.
    assert!((least.grams - 500.0 * 3.0 / 97.0).abs() < 0.3, "{}", least.grams);
    let same = Batch { reflectance: standard, ..batch.clone() };
    assert!(options.run(library, &target, &same, &Task::default()).unwrap().is_near);
    let color = "#4a7d8c".parse().unwrap();
    let refused = options.run(library, &color, &batch, &Task::default()).unwrap_err();
    assert!(matches!(refused, MatchError::NoSpectrum(..)), "{refused}");
}
