//! Tests of recipes by spectrum: mixtures are found again from their own reflectance, limits hold,
//! and what cannot be searched is refused. Also tests of the progress of a search, and of
//! cancelling it from another thread.

use std::thread;
use std::time::{Duration, Instant};

use calibrate::PigmentId;
use calibrate::library::PigmentLibrary;
use calibrate::matching::{
    ColorTarget, FilmKind, MatchError, MatchRequest, Metric, RecipeLimits, RecipeMatch,
    RequiredName, RequiredPigment, SpectrumWeights, Target, Thickness, ToleranceOrigin, recipes,
};
use documents::hint::Explain;
use documents::{Cancelled, Task};
use spectra::color::Lab;
use spectra::{Extrapolation, Grid, Interpolation, Reflectance, Spectrum, Viewing};

use super::{conditions, oils};

fn by_spectrum(weights: SpectrumWeights) -> MatchRequest {
    MatchRequest {
        metric: Metric::Spectrum(weights),
        conditions: conditions(&["D65", "A", "FL11"]),
        count: 1,
        ..MatchRequest::default()
    }
}

/// The colour of a mixture as a measured target.
fn measured(library: &PigmentLibrary, recipe: &[(&str, f64)]) -> ColorTarget {
    let color = library.color(recipe.iter().copied(), &Viewing::default()).unwrap();
    ColorTarget::measured("mixture", color.reflectance)
}

fn shares(library: &PigmentLibrary, found: &RecipeMatch) -> Vec<(String, f64)> {
    found
        .shares
        .iter()
        .map(|(id, share): &(PigmentId, f64)| (library[*id].name.clone(), *share))
        .collect()
}

#[test]
fn a_mixture_is_found_again_from_its_own_spectrum() {
    let library = oils();
    let recipes: [&[(&str, f64)]; 4] = [
        &[("Cobalt Blue", 1.0)],
        &[("Zinc White", 0.9), ("Viridian", 0.1)],
        &[("Zinc White", 0.7), ("Cobalt Blue", 0.2), ("Viridian", 0.1)],
        &[("Lead White", 0.6), ("Vermilion", 0.2), ("Chrome Yellow", 0.15), ("Bone Black", 0.05)],
    ];
    for recipe in recipes {
        for weights in [SpectrumWeights::Even, SpectrumWeights::Observer] {
            let target = measured(&library, recipe);
            let options = MatchRequest { tolerance: Some(0.0), ..by_spectrum(weights) };
            let found = options.run(&library, &target, &Task::default()).unwrap();
            let best = &found.recipes[0];
            let rms = best.rms_percent.unwrap();
            assert!(rms < 1e-3 && (rms - best.distance).abs() < 1e-9, "{recipe:?}: {best:?}");
            assert!(best.delta_e.iter().all(|d| *d < 0.01), "{recipe:?}: {best:?}");
            assert!(best.metamerism.iter().all(|m| m.unwrap() < 0.01), "{recipe:?}: {best:?}");
            let found_shares = shares(&library, best);
            assert_eq!(found_shares.len(), recipe.len(), "{found_shares:?}");
            for (name, share) in recipe {
                let near = found_shares.iter().find(|(known, _)| known == name);
                assert!(near.is_some_and(|(_, s)| (s - share).abs() < 1e-3), "{found_shares:?}");
            }
        }
    }
}

#[test]
fn a_film_is_found_again_with_its_thickness() {
    let library = oils();
    let film = calibrate::FilmOver { thickness: 0.7, ground: calibrate::Backing::Even(0.85) };
    let recipe = [("Viridian", 0.6), ("Ultramarine", 0.4)];
    let color = library.film_color(recipe, &film, &Viewing::default()).unwrap();
    let target = ColorTarget::measured("glaze", color.reflectance);
    let options = MatchRequest {
        thickness: Some(Thickness::Between(0.1, 5.0)),
        over: Some(calibrate::Backing::Even(0.85)),
        tolerance: Some(0.0),
        ..by_spectrum(SpectrumWeights::Even)
    };
    let found = options.run(&library, &target, &Task::default()).unwrap();
    let best = &found.recipes[0];
    assert!(best.distance < 1e-3, "{best:?}");
    assert!((best.thickness.unwrap() - 0.7).abs() < 1e-3, "{best:?}");
    let found_shares = shares(&library, best);
    assert!(
        found_shares[0].0 == "Viridian" && (found_shares[0].1 - 0.6).abs() < 1e-3,
        "{found_shares:?}"
    );
}

#[test]
fn limits_of_recipes_hold_by_spectrum_too() {
    let library = oils();
    let target = measured(&library, &[("Zinc White", 0.7), ("Cobalt Blue", 0.2), ("Minium", 0.1)]);
    let of = |change: &dyn Fn(&mut MatchRequest)| {
        let mut options = by_spectrum(SpectrumWeights::Even);
        change(&mut options);
        options.run(&library, &target, &Task::default()).unwrap()
    };
    let free = of(&|_| {});
    assert!(free.nearest() < 1e-3);
    let two = of(&|options| options.at_most = 2);
    assert!(two.recipes[0].shares.len() <= 2 && two.nearest() > free.nearest());
    let without = of(&|options| options.without = vec!["Cobalt Blue".to_owned()]);
    let names = shares(&library, &without.recipes[0]);
    assert!(names.iter().all(|(name, _)| name != "Cobalt Blue") && without.nearest() > 1.0);
    assert!(without.hint().is_some() && free.hint().is_none());
    assert!(without.by_cie1976.is_empty(), "CIE 1976 is not a measure of spectra");
    let fixed = of(&|options| {
        options.with = vec![RequiredName { name: "Viridian".to_owned(), share: Some(0.3) }];
    });
    let names = shares(&library, &fixed.recipes[0]);
    let viridian = names.iter().find(|(name, _)| name == "Viridian").unwrap();
    assert!((viridian.1 - 0.3).abs() < 1e-9, "{names:?}");
    let whole = of(&|options| options.whole_parts = Some(10));
    assert_eq!(whole.recipes[0].parts, Some(vec![7, 2, 1]), "{:?}", whole.recipes[0]);
}

#[test]
fn the_difference_is_the_root_mean_square_over_the_shared_band() {
    let library = oils();
    let recipe = [("Zinc White", 0.9), ("Ultramarine", 0.1)];
    let color = library.color(recipe, &Viewing::default()).unwrap();
    // Measured from 450 to 620 nm only, and 2 % brighter at every wavelength.
    let band = Grid::from_nm(450.0, 10.0, 18).unwrap();
    let cut = color.reflectance.resampled(band, Interpolation::Linear, Extrapolation::Hold);
    let values = cut.unwrap().values().iter().map(|value| value + 0.02).collect();
    let target = Spectrum::<Reflectance>::new(band, values).unwrap();
    let options = MatchRequest {
        with: recipe
            .map(|(name, share)| RequiredName { name: name.into(), share: Some(share) })
            .into(),
        at_most: 2,
        ..by_spectrum(SpectrumWeights::Even)
    };
    let target = ColorTarget::measured("part", target);
    let found = options.run(&library, &target, &Task::default()).unwrap();
    assert!((found.nearest() - 2.0).abs() < 1e-9, "{}", found.nearest());
    assert_eq!(found.target.spectrum.as_ref().unwrap().band_nm(), [450.0, 620.0]);
    assert!(found.remarks.iter().any(|r| r.text.contains("450 to 620 nm only")), "{found:?}");
}

#[test]
fn a_colour_and_a_foreign_band_are_refused_with_a_way_out() {
    let library = oils();
    let options = by_spectrum(SpectrumWeights::Even);
    for text in ["#4a7d8c", "52,-10.5,8"] {
        let refused = options.run(&library, &text.parse().unwrap(), &Task::default()).unwrap_err();
        assert!(matches!(refused, MatchError::NoSpectrum(..)), "{refused}");
        assert!(refused.hint().unwrap().to_string().contains("match by colour"), "{refused}");
    }
    // Blue light only, where this copy of the library does not reach.
    let blue = Grid::from_nm(400.0, 10.0, 5).unwrap();
    let blue = Spectrum::<Reflectance>::new(blue, vec![0.3; 5]).unwrap();
    let mut red = library;
    for pigment in &mut red.pigments {
        for curve in [&mut pigment.absorption, &mut pigment.scattering] {
            curve.drain(..10);
        }
        pigment.absorption_sd.clear();
        pigment.scattering_sd.clear();
    }
    red.grid = Grid::from_nm(500.0, 10.0, 21).unwrap();
    let refused =
        options.run(&red, &ColorTarget::measured("blue", blue), &Task::default()).unwrap_err();
    let message = refused.to_string();
    assert!(message.contains("400 to 440 nm") && message.contains("500 to 700 nm"), "{message}");
}

#[test]
fn the_tolerance_is_in_percent_of_reflectance() {
    let library = oils();
    let options = by_spectrum(SpectrumWeights::Even);
    let search = library.recipe_search(&options).unwrap();
    assert_eq!((search.limits.tolerance, search.tolerance_origin), (0.2, ToleranceOrigin::Usual));
    let target = measured(&library, &[("Zinc White", 0.5), ("Minium", 0.3), ("Viridian", 0.2)]);
    let counts = [0.0, 20.0].map(|tolerance| {
        let options = MatchRequest { tolerance: Some(tolerance), ..options.clone() };
        options.run(&library, &target, &Task::default()).unwrap().recipes[0].shares.len()
    });
    assert_eq!(counts, [3, 1]);
}

fn target(limits: &RecipeLimits) -> Target {
    Target::from_lab("grey", Lab { lightness: 55.0, a: 3.0, b: -6.0 }, &limits.conditions)
}

#[test]
fn an_observed_search_finds_the_same_and_its_share_ends_at_one() {
    let library = oils();
    for at_most in 1..=4 {
        let plain = RecipeLimits::new(&library, conditions(&["D65"]), FilmKind::Hiding);
        let whole_parts = (at_most == 3).then_some(12);
        let limits = RecipeLimits { at_most, whole_parts, ..plain };
        let target = target(&limits);
        let task = Task::default();
        assert_eq!(task.progress().share(), None);
        let watched = recipes(&library, &target, &limits, &task).unwrap();
        assert_eq!(watched, recipes(&library, &target, &limits, &Task::default()).unwrap());
        assert_eq!(task.progress().share(), Some(1.0), "up to {at_most} pigments");
    }
}

#[test]
fn with_required_pigments_the_share_ends_at_one_too() {
    let library = oils();
    let mut limits = RecipeLimits::new(&library, conditions(&["D65"]), FilmKind::Hiding);
    limits.required =
        [0, 3].map(|id| RequiredPigment { pigment: PigmentId(id), share: None }).to_vec();
    let task = Task::default();
    recipes(&library, &target(&limits), &limits, &task).unwrap();
    assert_eq!(task.progress().share(), Some(1.0));
}

#[test]
fn a_search_that_is_stopped_gives_nothing_and_ends_early() {
    let library = oils();
    let mut limits = RecipeLimits::new(&library, conditions(&["D65", "A"]), FilmKind::Hiding);
    limits.at_most = 8;
    let target = target(&limits);
    let task = Task::default();
    task.cancel();
    let cancelled = Err(MatchError::Cancelled(Cancelled));
    assert_eq!(recipes(&library, &target, &limits, &task), cancelled);
    assert_eq!(task.progress().share(), Some(0.0), "nothing was tried");
    let running = Task::default();
    let share = || running.progress().share().unwrap_or(0.0);
    thread::scope(|scope| {
        let search = scope.spawn(|| recipes(&library, &target, &limits, &running));
        let patience = Instant::now() + Duration::from_secs(60);
        while share() == 0.0 && Instant::now() < patience {
            thread::sleep(Duration::from_micros(100));
        }
        running.cancel();
        assert_eq!(search.join().unwrap(), cancelled);
    });
    assert!(share() > 0.0 && share() < 1.0, "{}", share());
}
