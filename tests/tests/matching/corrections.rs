//! Corrections of a batch whose paints are not quite those of the library.

use calibrate::Viewing;
use calibrate::library::PigmentLibrary;
use calibrate::matching::{
    Batch, ColorTarget, CorrectionOptions, MatchError, Metric, SpectrumWeights,
};
use spectra::color::delta_e_ciede2000;
use spectra::{Reflectance, Spectrum};

use super::oils;

/// The oils as another tube of each would be: stronger or weaker, and of a slightly other hue.
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
    Batch { made: made.to_vec(), grams: 500.0, reflectance: measured(library, weighed) }
}

/// CIEDE2000 between two measured films.
fn apart(a: &Spectrum<Reflectance>, b: &Spectrum<Reflectance>) -> f64 {
    let weights = Viewing::default().weights(a.grid()).unwrap();
    let lab =
        |spectrum: &Spectrum<Reflectance>| calibrate::evaluate::lab(&weights, spectrum.values());
    delta_e_ciede2000(lab(a), lab(b))
}

#[test]
fn the_real_pot_matches_after_the_correction() {
    let truth = other_tubes();
    let standard = measured(&truth, &RECIPE);
    // Too much yellow, and too little white and blue.
    let weighed = [("Zinc White", 74.0), ("Cobalt Blue", 13.0), ("Chrome Yellow", 7.0)];
    let batch = batch(&truth, &weighed);
    let before = apart(&standard, &batch.reflectance);
    let target = ColorTarget::measured("standard", standard.clone());
    let options = CorrectionOptions::default();
    let library = oils();
    let found = library.corrections_for(&target, &batch, &options).unwrap();
    assert!(found.reaches && before > 4.0, "{before}");
    let least = &found.corrections[0];
    let mut pot: Vec<(String, f64)> =
        weighed.iter().map(|(name, part)| ((*name).to_owned(), 500.0 * part / 94.0)).collect();
    pot.extend(least.additions.iter().map(|(id, grams)| (library[*id].name.clone(), *grams)));
    let pot = truth.color(pot.iter().map(|(n, g)| (n.as_str(), *g)), &Viewing::default());
    let after = apart(&standard, &pot.unwrap().reflectance);
    assert!(after < 1.2 && after < before / 3.0, "{after} after {before}");
    // The library alone would be further off than the pot is from it.
    assert!(found.recipe_delta_e[0] > 1.0, "{:?}", found.recipe_delta_e);
}

#[test]
fn the_least_addition_comes_first_and_no_smaller_one_is_near() {
    let library = &oils();
    let standard = measured(library, &RECIPE);
    let weighed = [("Zinc White", 80.0), ("Cobalt Blue", 12.0), ("Chrome Yellow", 5.0)];
    let batch = batch(library, &weighed);
    let target = ColorTarget::measured("standard", standard.clone());
    let options = CorrectionOptions { at_most: 1, count: 11, ..CorrectionOptions::default() };
    let found = library.corrections_for(&target, &batch, &options).unwrap();
    assert!(found.corrections.is_sorted_by(|a, b| a.grams <= b.grams));
    let best = &found.corrections[0];
    let (id, grams) = best.additions[0];
    assert_eq!(library[id].name, "Cobalt Blue");
    // By brute force: the pot is what was weighed, since the library is exact here.
    let after = |blue: f64| {
        let scale = 500.0 / 97.0;
        let pot = [("Zinc White", 80.0 * scale), ("Chrome Yellow", 5.0 * scale)];
        let parts = [pot[0], ("Cobalt Blue", 12.0 * scale + blue), pot[1]];
        apart(&standard, &measured(library, &parts))
    };
    let needed = (1..4000).map(|step| f64::from(step) / 100.0).find(|g| after(*g) <= 0.5).unwrap();
    assert!((grams - needed).abs() < 0.02 * needed + 0.02, "{grams} g, needed {needed} g");
    // S of the pot is that of its recipe, which is not quite what was weighed.
    assert!((best.delta_e[0] - after(grams)).abs() < 0.05, "{} {}", best.delta_e[0], after(grams));
}

#[test]
fn stock_and_limits_hold() {
    let library = &oils();
    let target = ColorTarget::measured("standard", measured(library, &RECIPE));
    let weighed = [("Zinc White", 80.0), ("Cobalt Blue", 9.0), ("Chrome Yellow", 5.0)];
    let batch = batch(library, &weighed);
    let free = CorrectionOptions { only: vec!["Cobalt Blue".into()], ..Default::default() };
    let needed = library.corrections_for(&target, &batch, &free).unwrap();
    assert!(needed.reaches);
    let needed = needed.corrections[0].grams;
    let short =
        CorrectionOptions { stock: vec![("Cobalt Blue".into(), needed / 2.0)], ..free.clone() };
    let found = library.corrections_for(&target, &batch, &short).unwrap();
    assert!(!found.reaches && found.corrections[0].distance > 0.5);
    let (id, grams) = found.corrections[0].additions[0];
    assert!((grams - needed / 2.0).abs() < 0.01 * needed, "{grams} of {needed}");
    assert_eq!(found.corrections[0].out_of_stock, [id]);
    let little = CorrectionOptions { most_grams: Some(needed / 4.0), ..free.clone() };
    let found = library.corrections_for(&target, &batch, &little).unwrap();
    assert!(!found.reaches && found.corrections[0].grams <= needed / 4.0 * (1.0 + 1e-9));
    let near = Batch { reflectance: measured(library, &RECIPE), ..batch.clone() };
    let found = library.corrections_for(&target, &near, &free).unwrap();
    assert!(found.is_near && found.corrections.is_empty());
}

#[test]
fn batches_that_cannot_be_corrected_are_refused() {
    let library = &oils();
    let target = ColorTarget::measured("standard", measured(library, &RECIPE));
    let batch = batch(library, &RECIPE);
    let refused = |batch: &Batch, options: &CorrectionOptions| {
        library.corrections_for(&target, batch, options).unwrap_err()
    };
    let usual = CorrectionOptions::default();
    let unknown = Batch { made: vec![("Cobalt Green".into(), 1.0)], ..batch.clone() };
    assert!(matches!(refused(&unknown, &usual), MatchError::Recipe(_)));
    for grams in [0.0, -1.0, f64::NAN] {
        let wrong = Batch { grams, ..batch.clone() };
        assert!(matches!(refused(&wrong, &usual), MatchError::Number { .. }), "{grams}");
    }
    let none = CorrectionOptions { at_most: 0, ..usual.clone() };
    assert!(matches!(refused(&batch, &none), MatchError::Number { .. }));
    let absolute =
        PigmentLibrary { amounts: calibrate::library::AmountKind::Absolute, ..library.clone() };
    let error = absolute.corrections_for(&target, &batch, &usual).unwrap_err();
    assert_eq!(error, MatchError::AbsoluteBatch);
}

#[test]
fn a_batch_is_corrected_by_its_spectrum() {
    let library = &oils();
    let standard = measured(library, &RECIPE);
    let weighed = [("Zinc White", 80.0), ("Cobalt Blue", 12.0), ("Chrome Yellow", 5.0)];
    let batch = batch(library, &weighed);
    let target = ColorTarget::measured("standard", standard.clone());
    let options = CorrectionOptions {
        metric: Metric::Spectrum(SpectrumWeights::Even),
        only: vec!["Cobalt Blue".into()],
        tolerance: 0.01,
        ..Default::default()
    };
    let found = library.corrections_for(&target, &batch, &options).unwrap();
    assert!(found.reaches && found.batch_rms_percent.unwrap() > 1.0, "{found:?}");
    let least = &found.corrections[0];
    assert!(least.rms_percent.unwrap() <= 0.01 + 1e-9, "{least:?}");
    // The pot of 500 g is 97 parts and lacks 3; its S is taken from what was to be weighed.
    assert!((least.grams - 500.0 * 3.0 / 97.0).abs() < 0.3, "{}", least.grams);
    let same = Batch { reflectance: standard, ..batch.clone() };
    assert!(library.corrections_for(&target, &same, &options).unwrap().is_near);
    let color = "#4a7d8c".parse().unwrap();
    let refused = library.corrections_for(&color, &batch, &options).unwrap_err();
    assert!(matches!(refused, MatchError::NoSpectrum { .. }), "{refused}");
}
