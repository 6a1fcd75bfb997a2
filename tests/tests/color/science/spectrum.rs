//! XYZ of spectra and resampling to another grid, compared with golden values.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use spectra::{Extrapolation, Grid, Illuminant, Observer, Response, Spectrum, TristimulusWeights};
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
