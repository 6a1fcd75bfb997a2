//! Properties of colour differences, CIELAB, chromatic adaptation, display RGB and metamerism.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::{
    Adaptation, Cie94, Cmc, Lab, Matrix3, Rgb, RgbSpace, Xyz, adapt, ciede2000_metric,
    corrected_to_match, delta_e_cie76, delta_e_cie94, delta_e_ciede2000, delta_e_cmc,
    metamerism_index,
};
use suite::near::assert_near;

use super::{ROUNDING, random_pairs};

/// XYZ of the whites of D65, A and F11, which differ strongly.
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
        let told = ciede2000_metric(center).apply(step).iter().map(|v| v * v).sum::<f64>().sqrt();
        let wanted = delta_e_ciede2000(center, near.into());
        assert!((told / wanted - 1.0).abs() < 0.01, "{told} for {wanted}: seed {seed}, {center:?}");
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
            let at = |step: f64| {
                let mut moved = xyz;
                moved[column] *= 1.0 + step;
                Lab::from_xyz(moved.into(), white).to_array()
            };
            let below = at(-1e-6);
            let above = at(1e-6);
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
                let told = format!("{adaptation:?} from {from:?} to {to:?}");
                assert_near(&told, &back.to_array(), &xyz.to_array(), ROUNDING);
                let white = adapt(from, from, to, adaptation);
                assert_near(&told, &white.to_array(), &to.to_array(), ROUNDING);
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
