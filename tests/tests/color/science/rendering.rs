//! Colour rendering of lights, compared with golden values.

use serde::Deserialize;
use spectra::{ColorRendering, Illuminant};
use suite::golden::{Golden, read};
use suite::near::assert_near;

#[derive(Deserialize)]
struct Case {
    illuminant: String,
    kelvin: f64,
    ra: f64,
    special: Vec<f64>,
    rf: f64,
    rg: f64,
    samples: Vec<f64>,
    hue_bins: Vec<f64>,
}

#[test]
fn indices_of_both_standards_under_every_kind_of_lamp() {
    let golden: Golden<Vec<Case>> = read("rendering");
    for case in &golden.cases {
        let name = &case.illuminant;
        let found = ColorRendering::of(&Illuminant::named(name).unwrap()).unwrap();
        // The file has two decimals of the temperature.
        assert_near(format!("{name}, K"), &[found.temperature.kelvin], &[case.kelvin], 0.03);
        let near = |what: &str, found: &[f64], wanted: &[f64]| {
            assert_near(format!("{name}, {what}"), found, wanted, golden.tolerance);
        };
        near("Ra", &[found.index.general], &[case.ra]);
        near("R1 to R14", &found.index.special, &case.special);
        near("Rf and Rg", &[found.fidelity.fidelity, found.fidelity.gamut], &[case.rf, case.rg]);
        near("samples", &found.fidelity.samples, &case.samples);
        let bins: Vec<f64> = found.fidelity.hue_bins.iter().map(|bin| bin.unwrap()).collect();
        near("hues", &bins, &case.hue_bins);
    }
}
