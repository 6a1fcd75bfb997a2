//! Calibration with absolute amounts on one backing: ladders and mixtures of synthetic
//! watercolours.

use calibrate::absolute::{calibrate_absolute, chosen_film, films};
use calibrate::evaluate::Viewing;
use calibrate::fit::{FitSettings, Watch};
use calibrate::library::PigmentLibrary;
use calibrate::measurement::MeasurementError;
use calibrate::observation::BelowSurface;
use calibrate::validation::{ValidationPlan, leave_out_films};
use spectra::optics::{Surface, UnevenFilm};
use suite::watercolors::Watercolors;

const EVEN: UnevenFilm = UnevenFilm { surface: Surface::NONE, unevenness: 0.0 };

#[test]
fn ladders_and_mixtures_without_error_give_back_k_and_s() {
    let made = Watercolors::exact();
    let library =
        calibrate_absolute(&made.swatches(), EVEN, &FitSettings::default(), &Viewing::default())
            .unwrap()
            .library;
    let error = library.evidence.as_ref().unwrap().delta_e;
    assert!(error.max < 0.1, "{error:?}");
    let again = PigmentLibrary::from_json("library", &library.to_json()).unwrap();
    for (index, pigment) in library.pigments.iter().enumerate() {
        let swatches = made.swatches().swatches;
        let amounts = swatches.iter().map(|s| s.amounts[index]).filter(|amount| *amount > 0.0);
        let measured = amounts.fold([f64::INFINITY, 0.0], |range: [f64; 2], amount| {
            [range[0].min(amount), range[1].max(amount)]
        });
        assert_eq!(pigment.measured_amounts, Some(measured), "{}", pigment.name);
        assert_eq!(again.pigments[index].measured_amounts, Some(measured), "{}", pigment.name);
        for at in 0..library.grid.count() {
            let found = pigment.absorption[at];
            let truth = made.absorption[index][at];
            // K below 1 per mL, about a hundredth of the peaks, hardly changes these films.
            if truth > 1.0 {
                assert!(
                    (found / truth).ln().abs() < 0.05,
                    "{}: K {found} for {truth}",
                    pigment.name
                );
            }
        }
    }
}

#[test]
fn unseen_mixtures_of_uneven_washes_are_predicted_within_two() {
    // The deviations are as large as reported for real watercolour: an even film without a surface
    // predicts these mixtures with a mean error of about 2.2.
    let set = Watercolors::hard(1).swatches();
    let problem = films(&set).unwrap();
    let film = chosen_film(&problem, Surface::NONE, Watch::default()).unwrap();
    assert!(film.unevenness > 0.0 || film.surface.k2 > 0.0, "{film:?}");
    let settings = FitSettings::default();
    let viewing = Viewing::default();
    let plan = ValidationPlan {
        settings: &settings,
        viewing: &viewing,
        state: None,
        folds: Some(3),
        watch: Watch::default(),
    };
    let chosen = leave_out_films(&set, film, &plan).unwrap();
    assert_eq!(chosen.per_sample.len(), 702, "three folds of 234 left-out mixtures");
    assert!(chosen.delta_e.mean < 2.0, "{:?}", chosen.delta_e);
    // The error of a sample is larger when the fit has not seen it.
    let fitted = calibrate_absolute(&set, film, &settings, &viewing).unwrap().library;
    let fitted = fitted.evidence.unwrap().per_sample;
    let error = |name: &String| fitted.iter().find(|f| f.sample == *name).unwrap().delta_e;
    let same_films = chosen.per_sample.iter().map(|s| error(&s.sample)).sum::<f64>() / 702.0;
    let ratio = chosen.delta_e.mean / same_films;
    assert!(ratio > 1.02, "{ratio}");
    let plain = leave_out_films(&set, EVEN, &plan).unwrap();
    assert!(chosen.delta_e.mean < plain.delta_e.mean, "{:?}", plain.delta_e);
}

#[test]
fn amounts_in_another_unit_change_only_the_unit_of_k_and_s() {
    let made = Watercolors::exact();
    let mut set = made.swatches();
    let fit = |set: &calibrate::swatch::SwatchSet| {
        calibrate_absolute(set, EVEN, &FitSettings::default(), &Viewing::default()).unwrap().library
    };
    let millilitres = fit(&set);
    set.swatches.iter_mut().flat_map(|s| &mut s.amounts).for_each(|amount| *amount *= 1000.0);
    let microlitres = fit(&set);
    for (a, b) in millilitres.pigments.iter().zip(&microlitres.pigments) {
        for (a, b) in a.absorption.iter().zip(&b.absorption) {
            assert!((a / b / 1000.0 - 1.0).abs() < 1e-3, "{a} {b}");
        }
    }
}

#[test]
fn a_film_without_its_bare_backing_is_refused() {
    let mut set = Watercolors::exact().swatches();
    set.swatches[2].films[0].bare = None;
    let error = films(&set).unwrap_err();
    let MeasurementError::NoBareBacking { sample, .. } = &error else { panic!("{error}") };
    assert_eq!(*sample, set.swatches[2].sample);
}

#[test]
fn a_reading_below_the_surface_is_refused_or_named_also_of_the_bare_backing() {
    let mut set = Watercolors::exact().swatches();
    let film = UnevenFilm { surface: Surface { k1: 0.03, k2: 0.5, ..Surface::NONE }, ..EVEN };
    set.swatches.retain(|s| s.films[0].reflectance.iter().all(|r| *r > 0.03));
    let fit = |set: &calibrate::swatch::SwatchSet, below| {
        let settings = FitSettings { below_surface: below, ..FitSettings::default() };
        calibrate_absolute(set, film, &settings, &Viewing::default())
    };
    assert!(fit(&set, BelowSurface::Refuse).is_ok());
    set.swatches[0].films[0].bare.as_mut().unwrap()[3] = 0.01;
    let error = fit(&set, BelowSurface::Refuse).unwrap_err();
    assert!(error.to_string().contains("430 nm"), "{error}");
    let warnings = fit(&set, BelowSurface::Floor).unwrap().library.evidence.unwrap().warnings;
    assert!(warnings.iter().any(|w| w.contains("W000 (1)")), "{warnings:?}");
}

#[test]
fn few_films_are_fitted_without_holding_any_back() {
    let mut set = Watercolors::exact().swatches();
    set.swatches.truncate(1);
    let set = set.retaining(|_| true);
    let problem = films(&set).unwrap();
    assert_eq!(chosen_film(&problem, Surface::NONE, Watch::default()).unwrap(), EVEN);
    assert!(calibrate_absolute(&set, EVEN, &FitSettings::default(), &Viewing::default()).is_ok());
}

#[test]
fn thin_films_that_tell_little_of_scattering_are_told() {
    let set = Watercolors::hard(2).swatches();
    let white = set.pigments.iter().position(|p| p == "chinese white").unwrap();
    // Keeps chinese white only in its thinnest wash, which on white paper shows only noise.
    let kept = |s: &calibrate::swatch::Swatch| {
        let alone = s.amounts.iter().filter(|a| **a > 0.0).count() == 1;
        alone && (s.amounts[white] == 0.0 || s.amounts[white] < 0.015)
    };
    let ladders = set.retaining(kept);
    let library =
        calibrate_absolute(&ladders, EVEN, &FitSettings::default(), &Viewing::default()).unwrap();
    let library = library.library;
    let warnings = &library.evidence.as_ref().unwrap().warnings;
    let said = |name: &str| {
        warnings.iter().any(|w| w.starts_with(&format!("{name}: these films tell little")))
    };
    assert!(said("chinese white"), "{warnings:?}");
    assert!(!said("cadmium red"), "{warnings:?}");
    assert!(!library.pigments[white].notes.is_empty(), "the pigment carries the note");
}
