//! sRGB and Display P3: matrices, whites, colours and transfer curve, compared with golden values.

use std::collections::BTreeMap;

use serde::Deserialize;
use spectra::color::{Adaptation, Rgb, RgbSpace, Xyz};
use suite::golden::{Golden, read};
use suite::near::assert_near;

use super::adaptation::transform;

#[derive(Deserialize)]
struct Cases {
    #[serde(rename = "colours")]
    colors: Vec<Color>,
    transfer: Vec<Transfer>,
}

#[derive(Deserialize)]
struct Color {
    transform: Option<String>,
    white: [f64; 3],
    #[serde(rename = "XYZ")]
    xyz: [f64; 3],
    srgb: Values,
    #[serde(rename = "display-p3")]
    display_p3: Values,
}

#[derive(Deserialize)]
struct Values {
    linear: [f64; 3],
    encoded: [f64; 3],
}

#[derive(Deserialize)]
struct Transfer {
    linear: f64,
    encoded: f64,
}

#[derive(Deserialize)]
struct Spaces {
    white_xy: [f64; 2],
    spaces: BTreeMap<String, Space>,
}

#[derive(Deserialize)]
struct Space {
    to_xyz: [[f64; 3]; 3],
    from_xyz: [[f64; 3]; 3],
}

fn golden() -> Golden<Cases, Spaces> {
    read("rgb")
}

const SPACES: [(&str, RgbSpace); 2] =
    [("srgb", RgbSpace::Srgb), ("display-p3", RgbSpace::DisplayP3)];

#[test]
fn matrices_and_white_of_each_space() {
    let golden = golden();
    for (name, space) in SPACES {
        let white = space.white();
        let xyy = white.to_xyy(white);
        assert_near(name, &[xyy.x, xyy.y], &golden.shared.white_xy, golden.tolerance);
        // The golden white has Y = 1, the white of `spectra` has Y = 100.
        let to_xyz = space.xyz_from_linear();
        let from_xyz = to_xyz.inverse();
        let wanted = &golden.shared.spaces[name];
        let scaled = |matrix: [[f64; 3]; 3], scale: f64| -> Vec<f64> {
            matrix.as_flattened().iter().map(|v| v * scale).collect()
        };
        let to_wanted = wanted.to_xyz.as_flattened();
        let from_wanted = wanted.from_xyz.as_flattened();
        assert_near(name, &scaled(to_xyz.0, 0.01), to_wanted, golden.tolerance);
        assert_near(name, &scaled(from_xyz.0, 100.0), from_wanted, golden.tolerance);
    }
}

#[test]
fn display_colors_unclipped() {
    let golden = golden();
    for case in &golden.cases.colors {
        for ((name, space), wanted) in SPACES.into_iter().zip([&case.srgb, &case.display_p3]) {
            // Without a transform the white is that of the space, so XYZ is not adapted.
            let (white, adaptation) = match &case.transform {
                Some(name) => (Xyz::from(case.white), transform(name)),
                None => (space.white(), Adaptation::Bradford),
            };
            let told = format!("{:?} in {name}, {:?}", case.xyz, case.transform);
            let linear = space.linear_from_xyz(case.xyz.into(), white, adaptation);
            assert_near(&told, &linear.0, &wanted.linear, golden.tolerance);
            let encoded = space.encoded_from_xyz(case.xyz.into(), white, adaptation);
            assert_near(&told, &encoded.0, &wanted.encoded, golden.tolerance);
        }
    }
}

#[test]
fn transfer_curve_and_back() {
    let golden = golden();
    for Transfer { linear, encoded } in golden.cases.transfer {
        let Rgb([got, ..]) = Rgb([linear; 3]).encoded();
        assert_near(format!("curve at {linear}"), &[got], &[encoded], golden.tolerance);
        let Rgb([back, ..]) = Rgb([got; 3]).linear();
        assert_near(format!("back to {linear}"), &[back], &[linear], golden.tolerance);
    }
}
