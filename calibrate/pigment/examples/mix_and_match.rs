//! Predicts a mixture of the shipped oils and searches recipes for a colour:
//! `cargo run --release -p impasto-pigment --example mix_and_match ["#4a7d8c"]`.

use std::error::Error;
use std::io::Write;

use documents::Task;
use pigment::{MatchRequest, PigmentLibrary, Viewing};

fn main() -> Result<(), Box<dyn Error>> {
    let oils = PigmentLibrary::van_gogh_oils();
    let mut out = std::io::stdout().lock();

    let sky = oils.color([("Zinc White", 9.0), ("Cobalt Blue", 1.0)], &Viewing::default())?;
    let [l, a, b] = sky.lab.to_array();
    writeln!(out, "9 Zinc White + 1 Cobalt Blue: {}, Lab {l:.1} {a:.1} {b:.1}", sky.hex())?;

    let target = std::env::args().nth(1).unwrap_or_else(|| "#4a7d8c".to_owned());
    let found = MatchRequest::default().run(&oils, &target.parse()?, &Task::default())?;
    for recipe in found.recipes.iter().chain(&found.by_cie1976) {
        writeln!(out, "{target} within {:.2} CIEDE2000:", recipe.delta_e[0])?;
        for &(pigment, share) in &recipe.shares {
            writeln!(out, "  {:5.1} % {}", 100.0 * share, oils[pigment].name)?;
        }
    }
    if let Some(hint) = found.hint() {
        writeln!(out, "{hint}")?;
    }
    Ok(())
}
