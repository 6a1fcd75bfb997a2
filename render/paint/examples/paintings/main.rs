//! Writes the stroke scripts of `paintings/`. You always get the same output. For example, run
//! `cargo run -p impasto-paint --example paintings -- paintings`.

mod script_builder;
mod color_study;
mod glaze;
mod landscape;
mod still_life;

use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "paintings".to_owned()));
    for (name, script) in [
        ("colour-study", color_study::script()),
        ("glaze", glaze::script()),
        ("landscape", landscape::script()),
        ("still-life", still_life::script()),
    ] {
        std::fs::write(folder.join(format!("{name}.json")), script.to_json()?)?;
    }
    Ok(())
}
