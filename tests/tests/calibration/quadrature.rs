//! Quadrature rules of few wavelengths: colour errors on mixtures of the oils, weights and nodes.

use calibrate::PigmentId;
use calibrate::evaluate::Viewing;
use calibrate::fit::Method;
use calibrate::library::PigmentLibrary;
use calibrate::quadrature::{MixtureSet, Quadrature, QuadratureFailure};
use spectra::{Illuminant, Observer};
use suite::oils::{SURFACE, fitted};

fn library() -> PigmentLibrary {
    fitted(Method::Refined, SURFACE).library
}

fn held_out(library: &PigmentLibrary, viewing: &Viewing) -> MixtureSet {
    let weights = viewing.weights(library.grid).unwrap();
    MixtureSet::random(library, &weights, 1000, 7)
}

#[test]
fn eight_fitted_wavelengths_meet_their_figures_on_unseen_mixtures() {
    let library = library();
    let viewing = Viewing::default();
    let error =
        Quadrature::library(&viewing, &library, 8).unwrap().error(&held_out(&library, &viewing));
    assert!(error.mean < 0.25 && error.p95 < 0.6 && error.max < 1.5, "{error:?}");
}

#[test]
fn fitting_beats_moments_and_moments_beat_the_papers_weights() {
    let library = library();
    for light in ["D65", "A", "FL11"] {
        let viewing = Viewing {
            illuminant: Illuminant::named(light).unwrap(),
            observer: Observer::Cie1964Deg10,
        };
        let mixtures = held_out(&library, &viewing);
        let mean = |rule: Quadrature| rule.error(&mixtures).mean;
        let gauss = mean(Quadrature::gauss(&viewing, 8).unwrap());
        let moments = mean(Quadrature::moments(&viewing, 8).unwrap());
        let fitted = mean(Quadrature::library(&viewing, &library, 8).unwrap());
        assert!(fitted < moments && fitted < gauss, "{light}: {fitted} {moments} {gauss}");
        // FL11 has emission lines, so its weight function is not smooth; there the weights of the
        // paper may have the smaller error.
        assert!(light == "FL11" || moments < gauss, "{light}: {moments} {gauss}");
    }
}

#[test]
fn the_weights_of_each_channel_sum_to_the_white() {
    let library = library();
    let viewing = Viewing::default();
    let count = 6;
    for (name, rule) in [
        ("moments", Quadrature::moments(&viewing, count).unwrap()),
        ("library", Quadrature::library(&viewing, &library, count).unwrap()),
    ] {
        let white = rule.xyz(&vec![1.0; count]).to_array();
        for (found, wanted) in white.into_iter().zip(rule.white.to_array()) {
            assert!((found - wanted).abs() < 1e-8, "{name}: {found} for {wanted}");
        }
    }
    // The weights of the paper sum to the white over all three channels, not in each channel.
    let gauss = Quadrature::gauss(&viewing, count).unwrap();
    let sum: f64 = gauss.weights.iter().flatten().sum();
    let wanted: f64 = gauss.white.to_array().iter().sum();
    assert!((sum - wanted).abs() < 1e-8, "gauss: {sum} for {wanted}");
}

#[test]
fn the_same_library_gives_the_same_wavelengths() {
    let library = library();
    let viewing = Viewing::default();
    let rule = || Quadrature::library(&viewing, &library, 8).unwrap();
    assert_eq!(rule(), rule());
}

#[test]
fn nodes_rise_within_the_band() {
    let library = library();
    let viewing = Viewing::default();
    for count in [1, 2, 3, 8, 16] {
        let rule = Quadrature::library(&viewing, &library, count).unwrap();
        assert_eq!(rule.nodes_nm.len(), count);
        assert!(rule.nodes_nm.windows(2).all(|w| w[0] <= w[1]), "{:?}", rule.nodes_nm);
        assert!(rule.nodes_nm.iter().all(|nm| (360.0..=830.0).contains(nm)), "{:?}", rule.nodes_nm);
    }
}

#[test]
fn none_or_too_many_wavelengths_are_refused() {
    for count in [0, 33] {
        let refused = Quadrature::gauss(&Viewing::default(), count).unwrap_err();
        assert_eq!(refused, QuadratureFailure::Count { count });
    }
}

#[test]
fn unseen_mixtures_are_other_mixtures_for_another_seed() {
    let library = library();
    let weights = Viewing::default().weights(library.grid).unwrap();
    let set = |seed| MixtureSet::random(&library, &weights, 50, seed);
    assert_eq!(set(1), set(1));
    assert_ne!(set(1), set(2));
    assert_eq!(set(1).len(), 50);
}

#[test]
fn names_are_found_exactly_then_without_case_then_by_their_start() {
    let mut library = library();
    let red = 2;
    let lake = 5;
    library.pigments[lake].name = "Red Lake".to_owned();
    library.pigments[red].name = "Red".to_owned();
    assert_eq!(library.find("Red"), Ok(PigmentId(red)));
    assert_eq!(library.find("red"), Ok(PigmentId(red)));
    assert_eq!(library.find("red l"), Ok(PigmentId(lake)));
}
