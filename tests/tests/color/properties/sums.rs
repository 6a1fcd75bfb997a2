//! Properties of the weighted sums that give XYZ from a spectrum.

use spectra::{
    Grid, Illuminant, Interpolation, Observer, TristimulusWeights, black_body, daylight,
    lamp_from_bytes,
};
use suite::near::assert_near;

use super::ROUNDING;

fn grids() -> [Grid; 4] {
    [(380.0, 10.0, 36), (400.0, 10.0, 31), (400.0, 20.0, 16), (360.0, 1.0, 471)]
        .map(|(start, step, count)| Grid::from_nm(start, step, count).unwrap())
}

/// Weights of every tabulated illuminant and of a black body and a daylight of 5600 K, for every
/// observer (each on another grid), with both interpolations.
fn weights() -> impl Iterator<Item = (String, TristimulusWeights)> {
    let by_temperature = [black_body(5600.0).unwrap(), daylight(5600.0).unwrap()];
    let lights = Illuminant::names().map(|name| Illuminant::named(name).unwrap());
    lights.chain(by_temperature).flat_map(|light| {
        Observer::ALL.into_iter().zip(grids()).flat_map(move |(observer, grid)| {
            let light = light.clone();
            [Interpolation::Linear, Interpolation::Sprague].map(move |method| {
                let told = format!("{} for {observer} on {grid}, {}", light.name(), method.name());
                (told, TristimulusWeights::new(grid, &light, observer, method).unwrap())
            })
        })
    })
}

#[test]
fn a_perfect_diffuser_is_the_white_of_any_light() {
    for (told, weights) in weights() {
        let white = weights.white().to_array();
        let diffuser = weights.xyz(&vec![1.0; weights.grid().count()]).to_array();
        assert_near(&told, &diffuser, &white, ROUNDING);
        assert_near(&told, &white[1..2], &[100.0], ROUNDING);
    }
}

#[test]
fn weights_sum_to_the_white() {
    for (told, weights) in weights() {
        let mut sum = [0.0; 3];
        for row in weights.weights() {
            for (total, weight) in sum.iter_mut().zip(row) {
                *total += weight;
            }
        }
        assert_near(&told, &sum, &weights.white().to_array(), ROUNDING);
    }
}

#[test]
fn a_brighter_light_of_the_same_kind_changes_no_color() {
    let dim = lamp_from_bytes("dim", b"400,1\n500,2\n700,4\n", None).unwrap();
    let bright = lamp_from_bytes("bright", b"400,30\n500,60\n700,120\n", None).unwrap();
    let [dim, bright] = [dim, bright].map(|light| {
        let observer = Observer::Cie1964Deg10;
        TristimulusWeights::new(grids()[1], &light, observer, Interpolation::Linear).unwrap()
    });
    assert_near("white", &dim.white().to_array(), &bright.white().to_array(), ROUNDING);
}
