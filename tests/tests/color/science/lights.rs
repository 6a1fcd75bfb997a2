//! Daylights and black bodies of a colour temperature, compared with golden values.

use serde::Deserialize;
use spectra::{
    Extrapolation, Grid, Illuminant, Interpolation, SECOND_RADIATION_CONSTANT, black_body,
    daylight, daylight_chromaticity,
};
use suite::golden::{Golden, read};
use suite::near::assert_near;

#[derive(Deserialize)]
struct Daylight {
    nominal: Option<String>,
    kelvin: f64,
    xy: [f64; 2],
    spd: Vec<f64>,
    spd_rounded: Vec<f64>,
}

#[derive(Deserialize)]
struct Steps {
    start_nm: f64,
    step_nm: f64,
}

impl Steps {
    /// Wavelengths in nm and values of `power` from `from` to `to` nm.
    fn within(&self, power: &[f64], from: f64, to: f64) -> (Vec<f64>, Vec<f64>) {
        let grid = Grid::from_nm(self.start_nm, self.step_nm, power.len()).unwrap();
        grid.wavelengths_nm()
            .zip(power.iter().copied())
            .filter(|(nm, _)| (from..=to).contains(nm))
            .unzip()
    }
}

fn power_at(light: &Illuminant, nm: &[f64]) -> Vec<f64> {
    nm.iter()
        .map(|&nm| light.power().at(nm, Interpolation::Linear, Extrapolation::Refuse).unwrap())
        .collect()
}

#[test]
fn chromaticity_of_daylight() {
    let golden: Golden<Vec<Daylight>> = read("daylight");
    for case in &golden.cases {
        let (x, y) = daylight_chromaticity(case.kelvin);
        assert_near(format!("{} K", case.kelvin), &[x, y], &case.xy, golden.tolerance);
    }
}

#[test]
fn power_of_daylight_with_unrounded_weights() {
    let golden: Golden<Vec<Daylight>, Steps> = read("daylight");
    for case in &golden.cases {
        let (nm, wanted) = golden.shared.within(&case.spd, 360.0, 830.0);
        let got = power_at(&daylight(case.kelvin).unwrap(), &nm);
        assert_near(format!("{} K from 360 nm", case.kelvin), &got, &wanted, golden.tolerance);
    }
}

#[test]
fn tabulated_daylights_are_those_of_weights_in_three_decimals() {
    let golden: Golden<Vec<Daylight>, Steps> = read("daylight");
    let mut nominal = Vec::new();
    for case in &golden.cases {
        let Some(name) = &case.nominal else { continue };
        // The tables end at 780 nm. They have three decimals at a power of about 100; some of the
        // interpolated rows are truncated instead of rounded.
        let (nm, wanted) = golden.shared.within(&case.spd_rounded, 360.0, 780.0);
        let got = power_at(&Illuminant::named(name).unwrap(), &nm);
        assert_near(format!("{name} from 360 nm"), &got, &wanted, 1e-3 + golden.tolerance);
        nominal.push(name.as_str());
    }
    assert_eq!(nominal, ["D50", "D55", "D65", "D75"], "the daylights with a name");
}

#[derive(Deserialize)]
struct BlackBody {
    kelvin: f64,
    spd: Vec<f64>,
}

#[derive(Deserialize)]
struct BlackBodies {
    c2_m_k: f64,
    #[serde(flatten)]
    steps: Steps,
}

#[test]
fn power_of_black_bodies() {
    let golden: Golden<Vec<BlackBody>, BlackBodies> = read("blackbody");
    assert_eq!(golden.shared.c2_m_k, SECOND_RADIATION_CONSTANT, "c2 of the golden file");
    for case in &golden.cases {
        let (nm, wanted) = golden.shared.steps.within(&case.spd, 360.0, 830.0);
        let got = power_at(&black_body(case.kelvin).unwrap(), &nm);
        assert_near(format!("{} K from 360 nm", case.kelvin), &got, &wanted, golden.tolerance);
    }
}
