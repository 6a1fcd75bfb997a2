//! Recipes for films over a ground and for absolute amounts on an area, and corrections of a batch
//! when its paints differ slightly from the library.

use calibrate::evaluate::lab;
use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::matching::{
    Batch, ColorTarget, CorrectRequest, FilmKind, MatchError, Metric, RecipeLimits, RecipeMatch,
    SpectrumWeights, Thickness, recipes,
};
use calibrate::{Recipe, Viewing};
use documents::Task;
use spectra::color::{Lab, delta_e_ciede2000};
use spectra::{Reflectance, Spectrum};

use super::{conditions, oils, target_of};

#[test]
fn a_glaze_over_a_ground_is_found_with_its_thickness() {
    let library = oils();
    let conditions = conditions(&["D65", "A"]);
    let white = library.find("Zinc White").unwrap();
    let blue = library.find("Cobalt Blue").unwrap();
    let ground: Vec<f64> = library.grid.wavelengths_nm().map(|nm| 0.3 + nm / 1400.0).collect();
    let recipe = [(white, 0.7), (blue, 0.3)];
    let film = library.mix(recipe).unwrap().film(0.6, &ground, library.film());
    let target = target_of(&library, &film, &conditions);
    let kind = FilmKind::Over { ground: ground.clone(), thickness: Thickness::Between(0.05, 5.0) };
    let mut limits = RecipeLimits::new(&library, conditions.clone(), kind);
    limits.allowed = vec![white, blue];
    let found = recipes(&library, &target, &limits, &Task::default()).unwrap().remove(0);
    assert!(found.distance < 1e-3, "{found:?}");
    assert!((found.thickness.unwrap() - 0.6).abs() < 1e-3, "{:?}", found.thickness);
    assert!((found.shares.parts()[0].1 - 0.7).abs() < 1e-3, "{:?}", found.shares);

    limits.film = FilmKind::Over { ground, thickness: Thickness::Fixed(2.0) };
    let other = recipes(&library, &target, &limits, &Task::default()).unwrap().remove(0);
    assert_eq!(other.thickness, Some(2.0));
    assert!(other.distance > 0.5, "a film of another thickness has another colour: {other:?}");
}

#[test]
fn the_reflectance_told_is_that_of_the_recipe() {
    let library = oils();
    let conditions = conditions(&["D65"]);
    let wanted = Lab { lightness: 40.0, a: 20.0, b: 10.0 };
    let target = calibrate::matching::Target::from_lab("", wanted, &conditions);
    let ground = vec![0.5; library.grid.count()];
    let over = FilmKind::Over { ground: ground.clone(), thickness: Thickness::Fixed(0.8) };
    for film in [FilmKind::Hiding, over] {
        let limits = RecipeLimits::new(&library, conditions.clone(), film.clone());
        for recipe in recipes(&library, &target, &limits, &Task::default()).unwrap() {
            let mixture = library.mix(&recipe.shares).unwrap();
            let mixed = match film {
                FilmKind::Hiding => mixture.hiding(library.saunderson),
                FilmKind::Over { .. } => mixture.film(0.8, &ground, library.film()),
            };
            suite::golden::assert_near("reflectance", &recipe.reflectance, &mixed, 1e-9);
            let reported = recipe.delta_e[0];
            assert!(
                (reported - recipe.distance).abs() < 1e-9,
                "{reported} for {}",
                recipe.distance
            );
        }
    }
}

/// The oils as a library of absolute amounts. K and S are per unit amount.
fn absolute() -> PigmentLibrary {
    PigmentLibrary { amounts: AmountKind::Absolute, reference: None, ..oils() }
}

#[test]
fn absolute_amounts_are_found_over_paper() {
    let library = absolute();
    let conditions = conditions(&["D65", "FL11"]);
    let paper = vec![0.85; library.grid.count()];
    let red = library.find("Vermilion").unwrap();
    let blue = library.find("Ultramarine").unwrap();
    let wash = library.mix([(red, 0.3), (blue, 0.5)]).unwrap().film(1.0, &paper, library.film());
    let target = target_of(&library, &wash, &conditions);
    let film = RecipeLimits::usual_film(&library, paper);
    let mut limits = RecipeLimits::new(&library, conditions, film);
    limits.allowed = vec![red, blue];
    let found = recipes(&library, &target, &limits, &Task::default()).unwrap().remove(0);
    let amounts: Vec<f64> =
        found.shares.iter().map(|(_, share)| share * found.thickness.unwrap()).collect();
    suite::golden::assert_near("amounts", &amounts, &[0.5, 0.3], 1e-3);
    limits.film = FilmKind::Hiding;
    assert_eq!(
        recipes(&library, &target, &limits, &Task::default()),
        Err(MatchError::AbsoluteHiding)
    );
}

#[test]
fn absolute_amounts_cost_what_is_laid() {
    let library = absolute();
    let conditions = conditions(&["D65"]);
    let film = RecipeLimits::usual_film(&library, vec![0.85; library.grid.count()]);
    let mut limits = RecipeLimits::new(&library, conditions.clone(), film);
    limits.costs = (0..library.pigments.len()).map(|index| 1.0 + index as f64).collect();
    let wanted = Lab { lightness: 60.0, a: -5.0, b: -20.0 };
    let target = calibrate::matching::Target::from_lab("", wanted, &conditions);
    for recipe in recipes(&library, &target, &limits, &Task::default()).unwrap() {
        let amount = recipe.thickness.unwrap();
        let parts =
            recipe.shares.iter().map(|(pigment, share)| share * limits.costs[pigment.index()]);
        let wanted = amount * parts.sum::<f64>();
        assert!((amount - 1.0).abs() > 1e-3, "an amount near 1 tests nothing: {amount}");
        assert!((recipe.cost.unwrap() - wanted).abs() < 1e-9, "{recipe:?}");
    }
}

#[test]
fn absolute_amounts_stay_within_what_was_measured() {
    const RANGE: [f64; 2] = [0.1, 0.6];
    let mut library = absolute();
    for pigment in &mut library.pigments {
        pigment.measured_amounts = Some(RANGE);
    }
    let conditions = conditions(&["D65"]);
    let paper = vec![0.85; library.grid.count()];
    let pair = ["Vermilion", "Ultramarine"].map(|name| library.find(name).unwrap());
    fn amounts(recipe: &RecipeMatch) -> Vec<f64> {
        recipe.shares.iter().map(|(_, share)| share * recipe.thickness.unwrap()).collect()
    }
    for wished in [[0.3, 0.02], [0.9, 0.2], [0.02, 0.03], [0.3, 0.4]] {
        let recipe: Recipe = pair.into_iter().zip(wished).collect();
        let wash = library.mix(&recipe).unwrap().film(1.0, &paper, library.film());
        let target = target_of(&library, &wash, &conditions);
        let film = RecipeLimits::usual_film(&library, paper.clone());
        let mut limits = RecipeLimits::new(&library, conditions.clone(), film);
        (limits.allowed, limits.tolerance, limits.count) = (pair.to_vec(), 0.0, 10);
        let found = recipes(&library, &target, &limits, &Task::default()).unwrap();
        for recipe in &found {
            assert!(
                amounts(recipe)
                    .iter()
                    .all(|amount: &f64| (RANGE[0] - 1e-9..=RANGE[1] + 1e-9).contains(amount)),
                "{wished:?}: {recipe:?}"
            );
        }
        let limited = wished.iter().any(|amount| !(RANGE[0]..=RANGE[1]).contains(amount));
        // The nearest recipe may also leave out the pigment, if its amount is too small.
        let acted = !found[0].at_limit.is_empty() || found[0].shares.len() < 2;
        assert_eq!(acted, limited, "{wished:?}: {:?}", found[0]);
        // Within the limits, no recipe of a fine grid is nearer.
        let weights = conditions[0].viewing.weights(library.grid).unwrap();
        let steps = (0..=50).map(|step| RANGE[0] + (RANGE[1] - RANGE[0]) * f64::from(step) / 50.0);
        let steps: Vec<f64> = steps.collect();
        let both = steps.iter().flat_map(|&red| steps.iter().map(move |&blue| [red, blue]));
        let alone = steps.iter().flat_map(|&amount| [[amount, 0.0], [0.0, amount]]);
        for tried in both.chain(alone) {
            let recipe: Recipe = pair.into_iter().zip(tried).collect();
            let film = library.mix(&recipe).unwrap().film(1.0, &paper, library.film());
            let apart = delta_e_ciede2000(target.lab[0], lab(&weights, &film));
            assert!(found[0].distance <= apart + 0.01, "{wished:?}: {apart} with {tried:?}");
        }
        limits.amounts.clear();
        let free = recipes(&library, &target, &limits, &Task::default()).unwrap().remove(0);
        assert!(free.distance < 1e-3 && free.at_limit.is_empty(), "{wished:?}: {free:?}");
    }
}

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
    Batch { made: made.to_vec(), grams: 500.0, reflectance: measured(library, weighed) }
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
fn the_least_addition_comes_first_and_no_smaller_one_is_near() {
    let library = &oils();
    let standard = measured(library, &RECIPE);
    let weighed = [("Zinc White", 80.0), ("Cobalt Blue", 12.0), ("Chrome Yellow", 5.0)];
    let batch = batch(library, &weighed);
    let target = ColorTarget::measured("standard", standard.clone());
    let options = CorrectRequest { at_most: 1, count: 11, ..CorrectRequest::default() };
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
    let refused = |batch: &Batch, options: &CorrectRequest| {
        options.run(library, &target, batch, &Task::default()).unwrap_err()
    };
    let usual = CorrectRequest::default();
    let unknown = Batch { made: vec![("Cobalt Green".into(), 1.0)], ..batch.clone() };
    assert!(matches!(refused(&unknown, &usual), MatchError::Recipe(_)));
    for grams in [0.0, -1.0, f64::NAN] {
        let wrong = Batch { grams, ..batch.clone() };
        assert!(matches!(refused(&wrong, &usual), MatchError::Number { .. }), "{grams}");
    }
    let none = CorrectRequest { at_most: 0, ..usual.clone() };
    assert!(matches!(refused(&batch, &none), MatchError::Number { .. }));
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
