//! Conversions between XYZ, xyY, Lab, LCh and Luv, compared with golden values.

use serde::Deserialize;
use spectra::color::{Lab, Lch, Luv, Xyz};
use suite::golden::{Golden, read};
use suite::near::assert_near;

/// Chroma below which hues are not compared, because rounding determines them.
const GREY: f64 = 0.01;

#[derive(Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Color {
    #[serde(rename = "white")]
    white: [f64; 3],
    #[serde(rename = "XYZ")]
    xyz: [f64; 3],
    #[serde(rename = "xyY", default)]
    xyy: Option<[f64; 3]>,
    lab: [f64; 3],
    #[serde(rename = "LCh")]
    lch: [f64; 3],
}

#[derive(Deserialize)]
struct Colors {
    from_xyz: Vec<Color>,
    from_lab: Vec<Color>,
}

fn colors() -> Golden<Colors> {
    read("lab")
}

#[test]
fn lab_from_xyz_and_back() {
    let golden = colors();
    for case in &golden.cases.from_xyz {
        let white = Xyz::from(case.white);
        let lab = Lab::from_xyz(case.xyz.into(), white);
        let told = format!("XYZ {:?}", case.xyz);
        assert_near(&told, &lab.to_array(), &case.lab, golden.tolerance);
        let back = Lab::from(case.lab).to_xyz(white);
        assert_near(format!("back to {told}"), &back.to_array(), &case.xyz, golden.tolerance);
    }
}

#[test]
fn xyz_from_lab() {
    let golden = colors();
    for case in &golden.cases.from_lab {
        let xyz = Lab::from(case.lab).to_xyz(case.white.into());
        assert_near(format!("{:?}", case.lab), &xyz.to_array(), &case.xyz, golden.tolerance);
    }
}

#[test]
fn lch_from_lab_and_back() {
    let golden = colors();
    for case in golden.cases.from_xyz.iter().chain(&golden.cases.from_lab) {
        let Lch { lightness, chroma, hue_degrees } = Lab::from(case.lab).to_lch();
        let told = format!("Lab {:?}", case.lab);
        assert_near(&told, &[lightness, chroma], &case.lch[..2], golden.tolerance);
        if chroma >= GREY {
            // The golden Lab is rounded, which turns the hue the more, the smaller the chroma is.
            let turn = golden.tolerance * (1.0 + 1f64.to_degrees() / chroma);
            assert_near(&told, &[hue_degrees], &case.lch[2..], turn);
        }
        let back = Lab::from(Lch { lightness, chroma, hue_degrees });
        assert_near(format!("back to {told}"), &back.to_array(), &case.lab, golden.tolerance);
    }
}

#[test]
fn chromaticity_from_xyz_and_back() {
    let golden = colors();
    for case in &golden.cases.from_xyz {
        let white = Xyz::from(case.white);
        let xyz = Xyz::from(case.xyz);
        let xyy = xyz.to_xyy(white);
        let got = [xyy.x, xyy.y, xyy.luminance];
        // Black has no chromaticity; it is given that of the white.
        let of_white = || {
            let [x, y, z] = case.white;
            [x / (x + y + z), y / (x + y + z), 0.0]
        };
        let told = format!("XYZ {:?}", case.xyz);
        assert_near(&told, &got, &case.xyy.unwrap_or_else(of_white), golden.tolerance);
        let back = Xyz::from(xyy).to_array();
        assert_near(format!("back to {told}"), &back, &case.xyz, golden.tolerance);
    }
}

#[derive(Deserialize)]
struct InLuv {
    white: [f64; 3],
    #[serde(rename = "XYZ")]
    xyz: [f64; 3],
    #[serde(rename = "Luv")]
    luv: [f64; 3],
}

#[test]
fn luv_from_xyz() {
    let golden: Golden<Vec<InLuv>> = read("luv");
    for case in &golden.cases {
        let luv = Luv::from_xyz(case.xyz.into(), case.white.into()).to_array();
        assert_near(format!("XYZ {:?}", case.xyz), &luv, &case.luv, golden.tolerance);
    }
}
