//! Compares with golden values: daylights and black bodies of a colour temperature, Kubelka-Munk
//! films and Saunderson surfaces (50 digits), colour rendering, XYZ of spectra and resampling to
//! another grid.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use spectra::color::delta_e_cie76;
use spectra::optics::{Layer, Specular, Surface, absorption_over_scattering, infinite_film};
use spectra::{
    ColorRendering, Extrapolation, Grid, Illuminant, Interpolation, IrregularSpectrum, Observer,
    Reflectance, Response, SECOND_RADIATION_CONSTANT, Spectrum, TristimulusWeights, Viewing,
    black_body, daylight, daylight_chromaticity,
};
use suite::golden::{Golden, assert_near, read};

use super::{Regular, interpolation, observer};

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
        // The tables end at 780 nm and have three decimals at a power of about 100. Some of the
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

#[derive(Deserialize)]
struct Cases {
    layer: Vec<OverBacking>,
    free: Vec<Free>,
    infinite: Vec<Infinite>,
    ratio: Vec<Ratio>,
    saunderson: Vec<Saunderson>,
}

#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
struct OverBacking {
    k: f64,
    s: f64,
    #[serde(rename = "d")]
    d: f64,
    #[serde(rename = "g")]
    g: f64,
    r: f64,
}

#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
struct Free {
    k: f64,
    s: f64,
    #[serde(rename = "d")]
    d: f64,
    r: f64,
    t: f64,
}

#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
struct Infinite {
    k: f64,
    s: f64,
    r: f64,
}

#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
struct Ratio {
    r: f64,
    ks: f64,
}

#[derive(Deserialize)]
struct Saunderson {
    k1: f64,
    k2: f64,
    #[serde(rename = "R")]
    r: f64,
    included: f64,
    excluded: f64,
}

fn golden() -> Golden<Cases> {
    read("km")
}

#[test]
fn films_over_backings() {
    let golden = golden();
    for OverBacking { k, s, d, g, r } in golden.cases.layer {
        let label = format!("K {k}, S {s}, d {d} over {g}");
        assert_near(label, &[Layer::new(k, s, d).over(g)], &[r], golden.tolerance);
    }
}

#[test]
fn films_by_themselves() {
    let golden = golden();
    for Free { k, s, d, r, t } in golden.cases.free {
        let Layer { reflectance, transmittance, .. } = Layer::new(k, s, d);
        let label = format!("K {k}, S {s}, d {d}");
        assert_near(label, &[reflectance, transmittance], &[r, t], golden.tolerance);
    }
}

#[test]
fn films_that_hide() {
    let golden = golden();
    for Infinite { k, s, r } in golden.cases.infinite {
        assert_near(format!("K {k}, S {s}"), &[infinite_film(k, s)], &[r], golden.tolerance);
    }
}

#[test]
fn absorption_over_scattering_of_films_that_hide() {
    let golden = golden();
    for Ratio { r, ks } in golden.cases.ratio {
        // K/S is not bounded, so its tolerance is relative.
        let tolerance = golden.tolerance * ks;
        assert_near(format!("R {r}"), &[absorption_over_scattering(r)], &[ks], tolerance);
    }
}

#[test]
fn saunderson_in_both_geometries() {
    let golden = golden();
    for Saunderson { k1, k2, r, included, excluded } in golden.cases.saunderson {
        for (specular, wanted) in [(Specular::Included, included), (Specular::Excluded, excluded)] {
            let surface = Surface::new(k1, k2, specular).unwrap();
            let label = format!("k1 {k1}, k2 {k2}, {specular:?}, R {r}");
            let got = surface.measured_from_internal(r);
            assert_near(&label, &[got], &[wanted], golden.tolerance);
            let back = surface.internal_from_measured(wanted).unwrap();
            assert_near(format!("back to {label}"), &[back], &[r], golden.tolerance);
        }
    }
}

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
        let bins: Vec<f64> = found.fidelity.hue_bins.iter().map(|bin| bin.unwrap()).collect();
        let indices = [found.fidelity.fidelity, found.fidelity.gamut];
        for (what, found, wanted) in [
            ("Ra", &[found.index.general][..], &[case.ra][..]),
            ("R1 to R14", &found.index.special[..], &case.special[..]),
            ("Rf and Rg", &indices[..], &[case.rf, case.rg][..]),
            ("samples", &found.fidelity.samples[..], &case.samples[..]),
            ("hues", &bins[..], &case.hue_bins[..]),
        ] {
            assert_near(format!("{name}, {what}"), found, wanted, golden.tolerance);
        }
    }
}

#[derive(Deserialize)]
struct Sum {
    illuminant: String,
    observer: String,
    interpolation: String,
    white: [f64; 3],
    samples: BTreeMap<String, [f64; 3]>,
}

#[derive(Deserialize)]
struct Reflectances {
    reflectances: BTreeMap<String, Regular>,
}

fn sums() -> Golden<Vec<Sum>, Reflectances> {
    read("xyz")
}

#[test]
fn xyz_of_reflectances_under_every_light_and_observer() {
    let golden = sums();
    for case in &golden.cases {
        let light = Illuminant::named(&case.illuminant).unwrap();
        for (name, wanted) in &case.samples {
            let sample = &golden.shared.reflectances[name];
            let weights = TristimulusWeights::new(
                sample.grid(),
                &light,
                observer(&case.observer),
                interpolation(&case.interpolation),
            )
            .unwrap();
            let label = format!(
                "{name} under {} for {}, {}",
                case.illuminant, case.observer, case.interpolation
            );
            let xyz = weights.xyz(&sample.values).to_array();
            assert_near(&label, &xyz, wanted, golden.tolerance);
            let white = weights.white().to_array();
            assert_near(format!("white of {label}"), &white, &case.white, golden.tolerance);
        }
    }
}

#[test]
fn no_light_and_no_observer_lacks_its_golden_xyz() {
    let golden = sums();
    let found: BTreeSet<(&str, &str)> = golden
        .cases
        .iter()
        .filter(|case| case.samples.len() == golden.shared.reflectances.len())
        .map(|case| (case.illuminant.as_str(), observer(&case.observer).name()))
        .collect();
    let shipped = Illuminant::names()
        .flat_map(|light| Observer::ALL.map(|observer| (light, observer.name())));
    assert_eq!(found, shipped.collect(), "pairs of light and observer");
}

#[derive(Deserialize)]
struct Resampling {
    method: String,
    spectrum: String,
    to_start_nm: f64,
    to_step_nm: f64,
    values: Vec<f64>,
}

#[derive(Deserialize)]
struct Sources {
    spectra: BTreeMap<String, Regular>,
}

#[test]
fn spectra_on_another_grid() {
    let golden: Golden<Vec<Resampling>, Sources> = read("sprague");
    for case in &golden.cases {
        let source = &golden.shared.spectra[&case.spectrum];
        // A response may be negative, so we do not cut off values below 0.
        let spectrum = Spectrum::<Response>::new(source.grid(), source.values.clone()).unwrap();
        let to = Grid::from_nm(case.to_start_nm, case.to_step_nm, case.values.len()).unwrap();
        let method = interpolation(&case.method);
        let label = format!("{} of {} to {to}", case.method, case.spectrum);
        let held = spectrum.resampled(to, method, Extrapolation::Hold).unwrap();
        assert_near(&label, held.values(), &case.values, golden.tolerance);

        let inside = [to.start_nm(), to.end_nm()].iter().all(|&nm| source.grid().covers(nm));
        let refused = spectrum.resampled(to, method, Extrapolation::Refuse);
        assert_eq!(refused.is_ok(), inside, "{label}, ends refused");
    }
}

fn orange(nm: f64) -> f64 {
    0.06 + 0.7 / (1.0 + f64::exp(-(nm - 575.0) / 9.0))
}

#[test]
fn irregular_wavelengths_keep_the_color_under_lamps_with_lines() {
    // Steps of 6 to 9 nm suit a grid of 5 nm.
    let nm: Vec<f64> =
        (0..57).map(|i| 365.0 + 7.5 * f64::from(i) + 1.5 * f64::from(i % 2)).collect();
    let values: Vec<f64> = nm.iter().map(|&nm| orange(nm)).collect();
    let irregular = IrregularSpectrum::new(nm.clone(), values).unwrap();
    let grid = Grid::suited_to(&nm).unwrap();
    for lamp in ["FL2", "FL11", "HP1"] {
        let viewing = Viewing::named(lamp, "1931-2").unwrap();
        let lab = |values: Vec<f64>| {
            viewing.color(&Spectrum::<Reflectance>::new(grid, values).unwrap()).unwrap().lab
        };
        let truth = lab(grid.wavelengths_nm().map(orange).collect());
        let error = delta_e_cie76(truth, lab(irregular.on_grid(grid)));
        let linear = delta_e_cie76(
            truth,
            lab(grid
                .wavelengths_nm()
                .map(|nm| irregular.at_linear(nm, Extrapolation::Hold).unwrap())
                .collect()),
        );
        assert!(error < 0.01 && linear > 0.1, "{lamp}: {error}, linearly {linear}");
    }
}
