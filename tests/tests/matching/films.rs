//! Recipes for films over a ground and for absolute amounts on an area.

use calibrate::Recipe;
use calibrate::evaluate::lab;
use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::matching::{FilmKind, MatchError, RecipeLimits, RecipeMatch, Thickness, recipes};
use documents::Task;
use spectra::color::{Lab, delta_e_ciede2000};

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
