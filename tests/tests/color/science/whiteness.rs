//! CIE whiteness and tint, compared with golden values.

use serde::Deserialize;
use spectra::Illuminant;
use spectra::color::{Whiteness, WhitenessError};
use suite::golden::{Golden, read};
use suite::near::assert_near;

use super::observer;

#[derive(Deserialize)]
struct Case {
    illuminant: String,
    observer: String,
    white: [f64; 3],
    #[serde(rename = "XYZ")]
    xyz: [f64; 3],
    #[serde(rename = "WT")]
    wanted: [f64; 2],
    white_enough: bool,
}

#[test]
fn whiteness_and_tint_within_the_limits_and_none_beyond() {
    let golden: Golden<Vec<Case>> = read("whiteness");
    let enough = golden.cases.iter().filter(|case| case.white_enough).count();
    assert!(enough > 0 && enough < golden.cases.len(), "both sides of the limits are tested");
    for case in &golden.cases {
        let told = format!("{:?} under {} for {}", case.xyz, case.illuminant, case.observer);
        let light = Illuminant::named(&case.illuminant).unwrap();
        let observer = observer(&case.observer);
        let found = Whiteness::of(case.xyz.into(), case.white.into(), &light, observer);
        assert_eq!(found.is_ok(), case.white_enough, "{told}: {found:?}");
        match found {
            Ok(found) => {
                let found = [found.whiteness, found.tint];
                assert_near(&told, &found, &case.wanted, golden.tolerance);
            }
            Err(WhitenessError::NotWhite { whiteness, .. }) => {
                assert_near(&told, &[whiteness], &case.wanted[..1], golden.tolerance);
            }
            Err(WhitenessError::Tinted { tint }) => {
                assert_near(&told, &[tint], &case.wanted[1..], golden.tolerance);
            }
            Err(other) => panic!("{told}: {other}"),
        }
    }
}
