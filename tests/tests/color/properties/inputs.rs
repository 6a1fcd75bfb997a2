//! Inputs of spectra, grids, lamps and lights: which are refused, and with which error.

use documents::hint::Explain;
use spectra::{
    Absorption, Extrapolation, Grid, GridError, Illuminant, InterpolateError, Interpolation,
    IrregularSpectrum, IrregularSpectrumError, LampError, LightError, Observer, Power, Quantity,
    Reflectance, Response, Scattering, Spectrum, SpectrumError, lamp_from_bytes, light_from_text,
};

fn grid() -> Grid {
    Grid::from_nm(400.0, 10.0, 6).unwrap()
}

#[track_caller]
fn assert_refused<Q: Quantity>(value: f64) {
    let mut values = vec![0.5; 6];
    values[2] = value;
    match Spectrum::<Q>::new(grid(), values) {
        Err(SpectrumError::Value { nm, quantity, .. }) => {
            assert_eq!((nm, quantity), (420.0, Q::NAME), "wavelength of the value {value}");
        }
        other => panic!("{value}: {other:?}"),
    }
}

#[test]
fn impossible_values_are_refused_with_their_wavelength() {
    for value in [-0.01, 2.01, f64::NAN, f64::INFINITY] {
        assert_refused::<Reflectance>(value);
    }
    for value in [-0.01, f64::NAN, f64::INFINITY] {
        assert_refused::<Power>(value);
        assert_refused::<Absorption>(value);
        assert_refused::<Scattering>(value);
    }
    assert_refused::<Response>(f64::NAN);
    assert!(Spectrum::<Response>::new(grid(), vec![-1.0; 6]).is_ok(), "a response may be negative");
    assert_eq!(
        Spectrum::<Power>::new(grid(), vec![1.0; 5]),
        Err(SpectrumError::Count { expected: 6, found: 5 }),
        "a value is missing"
    );
}

#[test]
fn a_polynomial_that_swings_past_what_is_possible_is_cut_off() {
    let edges = Spectrum::<Reflectance>::new(grid(), vec![0.0, 0.0, 0.0, 2.0, 2.0, 2.0]).unwrap();
    let fine = Grid::from_nm(400.0, 1.0, 51).unwrap();
    let swung = edges.resampled(fine, Interpolation::Sprague, Extrapolation::Refuse).unwrap();
    let again = Spectrum::<Reflectance>::new(fine, swung.values().to_vec());
    assert_eq!(again.as_ref(), Ok(&swung), "every value is a reflectance");
    assert!(swung.values().iter().filter(|&&v| v == 2.0).count() > 3, "{swung:?}");
}

#[test]
fn a_grid_refuses_bad_numbers() {
    for start in [0.0, -400.0, f64::NAN, f64::INFINITY] {
        let refused = Grid::from_nm(start, 10.0, 3);
        assert!(matches!(refused, Err(GridError::Start(_))), "start {start}: {refused:?}");
    }
    for step in [0.0, -10.0, f64::NAN, f64::INFINITY] {
        let refused = Grid::from_nm(400.0, step, 3);
        assert!(matches!(refused, Err(GridError::Step { .. })), "step {step}: {refused:?}");
    }
    assert_eq!(Grid::from_nm(400.0, 10.0, 0), Err(GridError::Empty), "no wavelength");
    let file = r#"{"start_nm": 400, "step_nm": -1, "count": 3}"#;
    assert!(serde_json::from_str::<Grid>(file).is_err(), "a grid in a file is checked too");
}

#[test]
fn a_grid_goes_through_regular_wavelengths_only() {
    let regular: Vec<f64> = grid().wavelengths_nm().collect();
    assert_eq!(Grid::through(&regular), Some(grid()), "{regular:?}");
    assert_eq!(Grid::through(&[400.0, 410.0, 421.0]), None, "the second step differs");
    assert_eq!(Grid::through(&[410.0, 400.0]), None, "falling");
    assert_eq!(Grid::through(&[]), None, "nothing");
}

#[test]
fn samples_refuse_wavelengths_that_do_not_rise() {
    for nm in [[400.0, 390.0], [400.0, 400.0]] {
        let refused = IrregularSpectrum::new(nm.to_vec(), vec![1.0; 2]);
        let [before, after] = nm;
        assert_eq!(refused, Err(IrregularSpectrumError::Order { before, after }), "{nm:?}");
    }
    for nm in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = IrregularSpectrum::new(vec![nm], vec![1.0]);
        assert!(matches!(refused, Err(IrregularSpectrumError::Wavelength(_))), "{nm}: {refused:?}");
    }
    let refused = IrregularSpectrum::new(vec![400.0, 410.0], vec![1.0]);
    assert_eq!(
        refused,
        Err(IrregularSpectrumError::Count { wavelengths: 2, values: 1 }),
        "one too few"
    );
}

#[test]
fn outside_the_band_is_refused_or_held() {
    let samples = IrregularSpectrum::new(vec![400.0, 430.0], vec![1.0, 4.0]).unwrap();
    let spectrum = Spectrum::<Power>::new(grid(), vec![1.0, 1.0, 1.0, 4.0, 4.0, 4.0]).unwrap();
    let linear = Interpolation::Linear;
    for (nm, held) in [(399.0, 1.0), (451.0, 4.0)] {
        assert_eq!(samples.at_linear(nm, Extrapolation::Hold), Ok(held), "at {nm} nm");
        assert_eq!(spectrum.at(nm, linear, Extrapolation::Hold), Ok(held), "at {nm} nm");
    }
    for nm in [399.0, 451.0, f64::NAN] {
        let refused = samples.at_linear(nm, Extrapolation::Refuse);
        assert!(
            matches!(refused, Err(IrregularSpectrumError::Outside { .. })),
            "at {nm}: {refused:?}"
        );
        let refused = spectrum.at(nm, linear, Extrapolation::Refuse);
        assert!(matches!(refused, Err(InterpolateError::Outside { .. })), "at {nm}: {refused:?}");
    }
    // NaN is nearer to neither end, so no end value can be held.
    assert!(samples.at_linear(f64::NAN, Extrapolation::Hold).is_err(), "held at NaN");
    assert!(spectrum.at(f64::NAN, linear, Extrapolation::Hold).is_err(), "held at NaN");
}

#[test]
fn sprague_is_refused_below_six_wavelengths() {
    let five = Grid::from_nm(400.0, 10.0, 5).unwrap();
    let spectrum = Spectrum::<Power>::new(five, vec![1.0; 5]).unwrap();
    let refused = spectrum.at(420.0, Interpolation::Sprague, Extrapolation::Refuse);
    assert_eq!(refused, Err(InterpolateError::TooFew { count: 5 }), "five");
    assert_eq!(Interpolation::best_for(five), Interpolation::Linear, "five");
    assert_eq!(Interpolation::best_for(grid()), Interpolation::Sprague, "six");
}

#[test]
fn a_lamp_is_read_from_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("lamp.csv");
    std::fs::write(&file, "# desk lamp\nnm,power\n400,1\n700,4\n").unwrap();
    let lamp = light_from_text(file.to_str().unwrap()).unwrap();
    let at = |nm: f64| lamp.power().at(nm, Interpolation::Linear, Extrapolation::Refuse).unwrap();
    assert_eq!([at(360.0), at(500.0), at(800.0)], [1.0, 2.0, 4.0], "{}", lamp.name());

    std::fs::write(&file, "400,1\n600,-3\n").unwrap();
    let error = light_from_text(file.to_str().unwrap()).unwrap_err();
    assert!(matches!(error, LightError::Lamp(LampError::Power { nm: 600.0, .. })), "{error}");
    assert!(error.to_string().contains("lamp.csv: power"), "{error}");

    std::fs::write(&file, "nm,power\n400,1\n600,x\n").unwrap();
    let error = light_from_text(file.to_str().unwrap()).unwrap_err();
    assert!(error.to_string().contains("lamp.csv, line 3"), "{error}");
}

#[test]
fn a_lamp_in_micrometres_is_refused() {
    let refused = lamp_from_bytes("lamp", b"0.4,1\n0.7,3\n", None);
    assert!(matches!(refused, Err(LampError::Band { .. })), "{refused:?}");
}

#[test]
fn a_light_is_found_by_name_and_by_temperature() {
    for (text, name) in [
        ("d65", "D65"),
        ("FL3.15", "FL3.15"),
        ("led-rgb1", "LED-RGB1"),
        ("5600K", "black body 5600 K"),
        ("D5600k", "daylight 5600 K"),
    ] {
        assert_eq!(light_from_text(text).unwrap().name(), name, "{text}");
    }
    for name in Illuminant::names() {
        assert_eq!(light_from_text(name).unwrap().name(), name, "a shipped light");
    }
}

#[test]
fn an_unknown_light_comes_with_a_hint() {
    for (text, word) in [("moonlight", "D65"), ("D3000K", "D4000K"), ("20K", "500K")] {
        let error = light_from_text(text).unwrap_err();
        let hint = error.hint().unwrap_or_else(|| panic!("{text}: no hint for {error}"));
        assert!(hint.to_string().contains(word), "{text}: {hint}");
    }
    let error = light_from_text("moonlight").unwrap_err().to_string();
    assert!(error.contains("`moonlight`"), "{error}");
}

#[test]
fn observers_are_found_by_name() {
    for observer in Observer::ALL {
        assert_eq!(Observer::named(observer.name()), Ok(observer), "{observer}");
    }
    assert_eq!(Observer::named("2"), Ok(Observer::Cie1931Deg2), "2 degrees");
    assert_eq!(Observer::named("10"), Ok(Observer::Cie1964Deg10), "10 degrees");
    let error = Observer::named("4").unwrap_err().to_string();
    for observer in Observer::ALL {
        assert!(error.contains(observer.name()), "{error}");
    }
}
