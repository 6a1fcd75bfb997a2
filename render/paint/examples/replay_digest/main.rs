//! Plays the first actions of scripts of strokes and prints the digests of their paint.
//!
//! ```text
//! cargo run -p impasto-paint --example replay_digest -- 60 paintings/glaze.json ..
//! ```
//!
//! The tests of the pages compare these with the digests of the same strokes in WebAssembly.

#![expect(clippy::print_stdout, reason = "an example prints what it found")]

mod replayed;

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let actions = words.next().ok_or("name a number of actions, then scripts")?.parse()?;
    for path in words {
        let script = documents::file::read(path.as_ref())?;
        println!("{}", replayed::digest(&script, actions)?);
    }
    Ok(())
}
