//! Properties of colours, lights and spectra for any values: colour differences, CIELAB, chromatic
//! adaptation, display RGB, metamerism, refused inputs with their errors, and the weighted sums
//! that give XYZ.

use documents::hint::Explain;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::{
    Adaptation, Cie94, Cmc, Lab, Matrix3, Rgb, RgbSpace, Xyz, adapt, ciede2000_metric,
    corrected_to_match, delta_e_cie76, delta_e_cie94, delta_e_ciede2000, delta_e_cmc,
    metamerism_index,
};
use spectra::{
    Absorption, Extrapolation, Grid, GridError, Illuminant, InterpolateError, Interpolation,
    IrregularSpectrum, IrregularSpectrumError, LampError, LightError, Observer, Power, Quantity,
    Reflectance, Response, Scattering, Spectrum, SpectrumError, TristimulusWeights, black_body,
    daylight, lamp_from_bytes, light_from_text,
};
use suite::golden::assert_near;

/// A few rounding errors of numbers of size 100, the range of XYZ and Lab.
const ROUNDING: f64 = 1600.0 * f64::EPSILON;

/// Pairs of colours, each with its seed.
fn random_pairs() -> impl Iterator<Item = (u64, Lab, Lab)> {
    (0..2000).map(|seed| {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let [one, two] = [(); 2].map(|()| Lab {
            lightness: rng.random_range(0.0..=100.0),
            a: rng.random_range(-100.0..=100.0),
            b: rng.random_range(-100.0..=100.0),
        });
        (seed, one, two)
    })
}

/// XYZ of the whites of D65, A and F11. They differ strongly.
const WHITES: [[f64; 3]; 3] =
    [[95.04, 100.0, 108.88], [109.85, 100.0, 35.58], [100.96, 100.0, 64.37]];

#[test]
fn a_color_does_not_differ_from_itself() {
    for (seed, lab, _) in random_pairs() {
        let differences = [
            delta_e_cie76(lab, lab),
            delta_e_cie94(lab, lab, Cie94::GraphicArts),
            delta_e_cie94(lab, lab, Cie94::Textiles),
            delta_e_cmc(lab, lab, Cmc::ACCEPTABILITY),
            delta_e_cmc(lab, lab, Cmc::PERCEPTIBILITY),
            delta_e_ciede2000(lab, lab),
        ];
        assert_eq!(differences, [0.0; 6], "seed {seed}, {lab:?}");
    }
}

#[test]
fn ciede2000_is_symmetric() {
    for (seed, first, second) in random_pairs() {
        let there = delta_e_ciede2000(first, second);
        let back = delta_e_ciede2000(second, first);
        assert!((there - back).abs() <= ROUNDING, "{there}, {back}: seed {seed}");
        assert!(there > 0.0, "{there} between two colours: seed {seed}");
    }
}

#[test]
fn the_metric_of_ciede2000_is_its_difference_nearby() {
    for (seed, center, _) in random_pairs() {
        // Near grey the hue changes too fast for a linear approximation.
        if center.a.hypot(center.b) < 5.0 {
            continue;
        }
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let step: [f64; 3] = std::array::from_fn(|_| rng.random_range(-0.03..=0.03));
        let near: [f64; 3] = std::array::from_fn(|i| center.to_array()[i] + step[i]);
        let predicted =
            ciede2000_metric(center).apply(step).iter().map(|v| v * v).sum::<f64>().sqrt();
        let wanted = delta_e_ciede2000(center, near.into());
        assert!(
            (predicted / wanted - 1.0).abs() < 0.01,
            "{predicted} for {wanted}: seed {seed}, {center:?}"
        );
    }
}

#[test]
fn lab_leads_to_xyz_and_back() {
    for (seed, lab, _) in random_pairs() {
        let white = Xyz::from(WHITES[0]);
        let back = Lab::from_xyz(lab.to_xyz(white), white);
        // CIELAB multiplies a rounding error of a normalized X, Y or Z by up to 500.
        assert_near(format!("seed {seed}"), &back.to_array(), &lab.to_array(), 50.0 * ROUNDING);
    }
}

#[test]
fn slopes_of_lab_are_the_limit_of_difference_quotients() {
    for (seed, lab, _) in random_pairs() {
        let white = Xyz::from(WHITES[1]);
        let xyz = lab.to_xyz(white).to_array().map(|v| v.abs() + 0.01);
        let Matrix3(slopes) = Lab::slopes_over_xyz(xyz.into(), white);
        for column in 0..3 {
            let [below, above] = [-1e-6, 1e-6].map(|step| {
                let mut moved = xyz;
                moved[column] *= 1.0 + step;
                Lab::from_xyz(moved.into(), white).to_array()
            });
            for row in 0..3 {
                let quotient = (above[row] - below[row]) / 2e-6;
                let slope = slopes[row][column] * xyz[column];
                assert!((slope - quotient).abs() < 1e-5, "{slope}, {quotient}: seed {seed}");
            }
        }
    }
}

#[test]
fn adaptation_there_and_back_is_the_same_color() {
    for adaptation in [Adaptation::Bradford, Adaptation::Cat16] {
        for from in WHITES.map(Xyz::from) {
            for to in WHITES.map(Xyz::from) {
                let xyz = Xyz { x: 20.0, y: 12.0, z: 5.0 };
                let there = adapt(xyz, from, to, adaptation);
                let back = adapt(there, to, from, adaptation);
                let label = format!("{adaptation:?} from {from:?} to {to:?}");
                assert_near(&label, &back.to_array(), &xyz.to_array(), ROUNDING);
                let white = adapt(from, from, to, adaptation);
                assert_near(&label, &white.to_array(), &to.to_array(), ROUNDING);
            }
        }
    }
}

#[test]
fn any_white_is_white_on_a_display() {
    for space in [RgbSpace::Srgb, RgbSpace::DisplayP3] {
        for white in [space.white()].into_iter().chain(WHITES.map(Xyz::from)) {
            let rgb = space.encoded_from_xyz(white, white, Adaptation::Bradford);
            assert_near(format!("{space:?} from {white:?}"), &rgb.0, &[1.0; 3], ROUNDING);
            assert_eq!(rgb.to_hex(), "#ffffff", "{space:?} from {white:?}");
        }
    }
}

#[test]
fn every_byte_leads_to_light_and_back() {
    for byte in 0..=255u8 {
        let encoded = Rgb([f64::from(byte) / 255.0; 3]);
        assert_eq!(encoded.linear().encoded().to_bytes(), [byte; 3], "{encoded:?}");
    }
}

#[test]
fn what_lies_outside_the_gamut_is_told_and_cut_off() {
    let outside = Rgb([-0.2, 0.5, 1.3]);
    assert!(!outside.in_gamut() && Rgb([0.0, 0.5, 1.0]).in_gamut(), "{outside:?}");
    assert_eq!(outside.to_bytes(), [0, 128, 255], "{outside:?}");
}

#[test]
fn a_pair_that_matches_under_both_lights_is_no_metamer() {
    let color = [[20.0, 30.0, 40.0], [25.0, 28.0, 10.0]].map(Xyz::from);
    assert_eq!(metamerism_index(color, color, WHITES[1].into()), Ok(0.0), "{color:?}");
}

#[test]
fn correction_of_a_matching_pair_changes_nothing() {
    let test = Xyz::from([25.0, 28.0, 10.0]);
    let reference = Xyz::from([20.0, 30.0, 40.0]);
    assert_eq!(corrected_to_match(test, reference, reference), Ok(test), "already matched");
    let black = Xyz::default();
    let refused = corrected_to_match(test, reference, black).unwrap_err();
    assert_eq!(refused.xyz, [0.0; 3], "black cannot be corrected");
}

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
        assert!(matches!(refused, Err(GridError::Step(..))), "step {step}: {refused:?}");
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
fn the_step_of_samples_is_the_median_of_their_distances() {
    fn step(nm: &[f64]) -> f64 {
        IrregularSpectrum::new(nm.to_vec(), vec![1.0; nm.len()]).unwrap().step_nm()
    }
    assert_eq!(step(&[400.0, 402.0, 412.0, 422.0, 462.0, 472.0]), 10.0);
    assert_eq!(step(&[400.0, 405.0, 430.0]), 25.0);
    assert_eq!(step(&[550.0]), 0.0);
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
    // NaN is not nearer to either end, so we cannot hold an end value.
    assert!(samples.at_linear(f64::NAN, Extrapolation::Hold).is_err(), "held at NaN");
    assert!(spectrum.at(f64::NAN, linear, Extrapolation::Hold).is_err(), "held at NaN");
}

#[test]
fn sprague_is_refused_below_six_wavelengths() {
    let five = Grid::from_nm(400.0, 10.0, 5).unwrap();
    let spectrum = Spectrum::<Power>::new(five, vec![1.0; 5]).unwrap();
    let refused = spectrum.at(420.0, Interpolation::Sprague, Extrapolation::Refuse);
    assert_eq!(refused, Err(InterpolateError::TooFew(5)), "five");
    assert_eq!(Interpolation::best_for(five), Interpolation::Linear, "five");
    assert_eq!(Interpolation::best_for(grid()), Interpolation::Sprague, "six");
}

#[test]
fn a_lamp_is_read_from_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("lamp.csv");
    std::fs::write(&file, "# desk lamp\nnm,power\n400,1\n700,4\n").unwrap();
    let lamp = light_from_text(file.to_str().unwrap()).unwrap();
    let found = [360.0, 500.0, 800.0]
        .map(|nm| lamp.power().at(nm, Interpolation::Linear, Extrapolation::Refuse).unwrap());
    assert_eq!(found, [1.0, 2.0, 4.0], "{}", lamp.name());

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

fn grids() -> [Grid; 4] {
    [(380.0, 10.0, 36), (400.0, 10.0, 31), (400.0, 20.0, 16), (360.0, 1.0, 471)]
        .map(|(start, step, count)| Grid::from_nm(start, step, count).unwrap())
}

/// Weights of every tabulated illuminant, and of a black body and a daylight of 5600 K. For every
/// observer, each on a different grid, with both interpolations.
fn weights() -> impl Iterator<Item = (String, TristimulusWeights)> {
    let by_temperature = [black_body(5600.0).unwrap(), daylight(5600.0).unwrap()];
    let lights = Illuminant::names().map(|name| Illuminant::named(name).unwrap());
    lights.chain(by_temperature).flat_map(|light| {
        Observer::ALL.into_iter().zip(grids()).flat_map(move |(observer, grid)| {
            let light = light.clone();
            [Interpolation::Linear, Interpolation::Sprague].map(move |method| {
                let label = format!("{} for {observer} on {grid}, {}", light.name(), method.name());
                (label, TristimulusWeights::new(grid, &light, observer, method).unwrap())
            })
        })
    })
}

#[test]
fn a_perfect_diffuser_is_the_white_of_any_light() {
    for (label, weights) in weights() {
        let white = weights.white().to_array();
        let diffuser = weights.xyz(&vec![1.0; weights.grid().count()]).to_array();
        assert_near(&label, &diffuser, &white, ROUNDING);
        assert_near(&label, &white[1..2], &[100.0], ROUNDING);
    }
}

#[test]
fn weights_sum_to_the_white() {
    for (label, weights) in weights() {
        let mut sum = [0.0; 3];
        for row in weights.weights() {
            for (total, weight) in sum.iter_mut().zip(row) {
                *total += weight;
            }
        }
        assert_near(&label, &sum, &weights.white().to_array(), ROUNDING);
    }
}

#[test]
fn a_brighter_light_of_the_same_kind_changes_no_color() {
    let dim = lamp_from_bytes("dim", b"400,1\n500,2\n700,4\n", None).unwrap();
    let bright = lamp_from_bytes("bright", b"400,30\n500,60\n700,120\n", None).unwrap();
    let [dim, bright] = [dim, bright].map(|light| {
        let observer = Observer::Cie1964Deg10;
        TristimulusWeights::new(grids()[1], &light, observer, Interpolation::Linear).unwrap()
    });
    assert_near("white", &dim.white().to_array(), &bright.white().to_array(), ROUNDING);
}
