//! XYZ of spectra and resampling to another grid, compared with golden values.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use spectra::color::delta_e_cie76;
use spectra::{
    Extrapolation, Grid, Illuminant, IrregularSpectrum, Observer, Reflectance, Response, Spectrum,
    TristimulusWeights, Viewing,
};
use suite::golden::{Golden, read};
use suite::near::assert_near;

use super::{Regular, interpolation, observer};

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
            let told = format!(
                "{name} under {} for {}, {}",
                case.illuminant, case.observer, case.interpolation
            );
            let xyz = weights.xyz(&sample.values).to_array();
            assert_near(&told, &xyz, wanted, golden.tolerance);
            let white = weights.white().to_array();
            assert_near(format!("white of {told}"), &white, &case.white, golden.tolerance);
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
        // A response may be negative, so values below 0 are not cut off.
        let spectrum = Spectrum::<Response>::new(source.grid(), source.values.clone()).unwrap();
        let to = Grid::from_nm(case.to_start_nm, case.to_step_nm, case.values.len()).unwrap();
        let method = interpolation(&case.method);
        let told = format!("{} of {} to {to}", case.method, case.spectrum);
        let held = spectrum.resampled(to, method, Extrapolation::Hold).unwrap();
        assert_near(&told, held.values(), &case.values, golden.tolerance);

        let inside = [to.start_nm(), to.end_nm()].iter().all(|&nm| source.grid().covers(nm));
        let refused = spectrum.resampled(to, method, Extrapolation::Refuse);
        assert_eq!(refused.is_ok(), inside, "{told}, ends refused");
    }
}

/// An orange of steep flank, at `nm`.
fn orange(nm: f64) -> f64 {
    0.06 + 0.7 / (1.0 + f64::exp(-(nm - 575.0) / 9.0))
}

#[test]
fn irregular_wavelengths_keep_the_color_under_lamps_with_lines() {
    // Steps of 6 to 9 nm, which suit a grid of 10 nm.
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
