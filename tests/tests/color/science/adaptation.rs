//! Chromatic adaptation by Bradford and CAT16, compared with golden values.

use serde::Deserialize;
use spectra::color::{Adaptation, Xyz, adapt};
use spectra::{Grid, Illuminant, Interpolation, Observer, TristimulusWeights};
use suite::golden::{Golden, read};
use suite::near::assert_near;

#[derive(Deserialize)]
struct Change {
    transform: String,
    from: String,
    to: String,
    from_white: [f64; 3],
    to_white: [f64; 3],
    matrix: [[f64; 3]; 3],
    samples: Vec<Adapted>,
}

#[derive(Deserialize)]
struct Adapted {
    #[serde(rename = "XYZ")]
    xyz: [f64; 3],
    adapted: [f64; 3],
}

pub(crate) fn transform(name: &str) -> Adaptation {
    match name {
        "Bradford" => Adaptation::Bradford,
        "CAT16" => Adaptation::Cat16,
        _ => panic!("no adaptation is called {name}"),
    }
}

fn white_of(light: &str) -> [f64; 3] {
    let light = Illuminant::named(light).unwrap();
    let observer = Observer::Cie1931Deg2;
    let interpolation = Interpolation::Linear;
    let weights = TristimulusWeights::new(Grid::cie(), &light, observer, interpolation).unwrap();
    weights.white().to_array()
}

#[test]
fn matrices_and_colors_from_white_to_white() {
    let golden: Golden<Vec<Change>> = read("adaptation");
    for case in &golden.cases {
        let told = format!("{} from {} to {}", case.transform, case.from, case.to);
        for (light, wanted) in [(&case.from, case.from_white), (&case.to, case.to_white)] {
            assert_near(format!("white of {light}"), &white_of(light), &wanted, golden.tolerance);
        }
        let adaptation = transform(&case.transform);
        let (from, to) = (Xyz::from(case.from_white), Xyz::from(case.to_white));
        let matrix = adaptation.matrix(from, to).0;
        assert_near(&told, matrix.as_flattened(), case.matrix.as_flattened(), golden.tolerance);
        for sample in &case.samples {
            let got = adapt(sample.xyz.into(), from, to, adaptation).to_array();
            assert_near(&told, &got, &sample.adapted, golden.tolerance);
        }
    }
}
