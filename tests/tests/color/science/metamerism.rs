//! Metamerism index for a change of illuminant, compared with golden values.

use std::collections::BTreeMap;

use serde::Deserialize;
use spectra::color::{
    Lab, Xyz, corrected_to_match, delta_e_cie76, delta_e_ciede2000, metamerism_index,
};
use spectra::{Grid, Illuminant, Interpolation, TristimulusWeights};
use suite::golden::{Golden, read};
use suite::near::assert_near;

use super::observer;

#[derive(Deserialize)]
struct Case {
    pair: String,
    observer: String,
    reference: String,
    test: String,
    reference_cie1976: f64,
    reference_ciede2000: f64,
    #[serde(rename = "corrected_XYZ")]
    corrected_xyz: [f64; 3],
    cie1976: f64,
    ciede2000: f64,
}

#[derive(Deserialize)]
struct Pairs {
    pairs: BTreeMap<String, Pair>,
}

#[derive(Deserialize)]
struct Pair {
    start_nm: f64,
    step_nm: f64,
    one: Vec<f64>,
    two: Vec<f64>,
}

#[test]
fn metamerism_of_pairs_from_light_to_light() {
    let golden: Golden<Vec<Case>, Pairs> = read("metamerism");
    for case in &golden.cases {
        let told = format!("{} from {} to {}", case.pair, case.reference, case.test);
        let pair = &golden.shared.pairs[&case.pair];
        let grid = Grid::from_nm(pair.start_nm, pair.step_nm, pair.one.len()).unwrap();
        let [reference, test] = [&case.reference, &case.test].map(|light| {
            let light = Illuminant::named(light).unwrap();
            let observer = observer(&case.observer);
            TristimulusWeights::new(grid, &light, observer, Interpolation::Sprague).unwrap()
        });
        let [one, two] = [&pair.one, &pair.two].map(|r| [reference.xyz(r), test.xyz(r)]);
        let differences = |first: Xyz, second: Xyz, white: Xyz| {
            let [first, second] = [first, second].map(|xyz| Lab::from_xyz(xyz, white));
            [delta_e_cie76(first, second), delta_e_ciede2000(first, second)]
        };

        let apart = differences(one[0], two[0], reference.white());
        let wanted = [case.reference_cie1976, case.reference_ciede2000];
        assert_near(format!("{told}, reference"), &apart, &wanted, golden.tolerance);

        let corrected = corrected_to_match(two[1], one[0], two[0]).unwrap();
        let corrected_xyz = corrected.to_array();
        assert_near(
            format!("{told}, corrected"),
            &corrected_xyz,
            &case.corrected_xyz,
            golden.tolerance,
        );
        let apart = differences(one[1], corrected, test.white());
        assert_near(&told, &apart, &[case.cie1976, case.ciede2000], golden.tolerance);

        let index = metamerism_index(one, two, test.white()).unwrap();
        assert_near(format!("{told}, index"), &[index], &[case.ciede2000], golden.tolerance);
    }
}
