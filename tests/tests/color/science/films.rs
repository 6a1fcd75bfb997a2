//! Kubelka-Munk films and Saunderson surfaces, compared with golden values of 50 digits.

use serde::Deserialize;
use spectra::optics::{Layer, Specular, Surface, absorption_over_scattering, infinite_film};
use suite::golden::{Golden, read};
use suite::near::assert_near;

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
        let told = format!("K {k}, S {s}, d {d} over {g}");
        assert_near(told, &[Layer::new(k, s, d).over(g)], &[r], golden.tolerance);
    }
}

#[test]
fn films_by_themselves() {
    let golden = golden();
    for Free { k, s, d, r, t } in golden.cases.free {
        let Layer { reflectance, transmittance, .. } = Layer::new(k, s, d);
        let told = format!("K {k}, S {s}, d {d}");
        assert_near(told, &[reflectance, transmittance], &[r, t], golden.tolerance);
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
            let told = format!("k1 {k1}, k2 {k2}, {specular:?}, R {r}");
            let got = surface.measured_from_internal(r);
            assert_near(&told, &[got], &[wanted], golden.tolerance);
            let back = surface.internal_from_measured(wanted).unwrap();
            assert_near(format!("back to {told}"), &[back], &[r], golden.tolerance);
        }
    }
}
