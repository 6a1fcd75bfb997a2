//! Simulated readings of planned swatches, computed from K and S of the oils.

use calibrate::Recipe;
use calibrate::library::PigmentLibrary;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use suite::program::repository;

/// Reflectances of the bare cards, equal at all wavelengths.
const WHITE_CARD: f64 = 0.85;
const BLACK_CARD: f64 = 0.05;
/// Thickness of the films, in units in which zinc white has S d = 1. Such films nearly hide.
const THICKNESS: f64 = 8.0;

pub(crate) const OILS: &str = "measurements/van-gogh-oils.pigments.json";

pub(crate) fn oils() -> PigmentLibrary {
    let text = std::fs::read_to_string(repository(OILS)).unwrap();
    PigmentLibrary::from_json(OILS, &text).unwrap()
}

/// Fills in the empty file of a plan with readings predicted from `oils` plus normal noise of
/// standard deviation `sd`. The file must have the wavelengths of `oils`.
pub(crate) fn filled(empty: &str, oils: &PigmentLibrary, sd: f64, seed: u64) -> String {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let header: Vec<&str> = empty.lines().next().unwrap().split(',').collect();
    let first_nm = header.iter().position(|name| *name == "400").unwrap();
    let mut text = format!("{}\n", header.join(","));
    for line in empty.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        assert!(cells[first_nm..].iter().all(|cell| cell.is_empty()), "{line}");
        let card = if cells[2] == "white" { WHITE_CARD } else { BLACK_CARD };
        let card = vec![card; oils.grid.count()];
        let recipe: Recipe = (4..first_nm)
            .filter(|&column| !cells[column].is_empty())
            .map(|column| (oils.find(header[column]).unwrap(), cells[column].parse().unwrap()))
            .collect();
        let read = match cells[1] {
            "none" => card,
            _ => oils.mix(&recipe).unwrap().film(THICKNESS, &card, oils.film()),
        };
        text.push_str(&cells[..first_nm].join(","));
        for value in read {
            let error: f64 = StandardNormal.sample(&mut random);
            text.push_str(&format!(",{:.5}", (value + sd * error).max(0.0305)));
        }
        text.push('\n');
    }
    text
}
