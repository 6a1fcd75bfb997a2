//! Paints a photograph as a watercolour.
//!
//! Run `cargo run --release -p impasto-watercolor --example watercolor_photograph -- PHOTOGRAPH
//! OUT.png`. If you give no arguments, this paints the still life of the README into
//! `watercolor.png`.

#![expect(clippy::print_stdout, reason = "an example prints what it did")]

use std::error::Error;
use std::path::PathBuf;

use graphics::export::{frame_of, frame_png};
use graphics::picture::Photograph;
use watercolor::{PhotographPainter, Preset};

fn main() -> Result<(), Box<dyn Error>> {
    let mut paths = std::env::args_os().skip(1).map(PathBuf::from);
    let usual = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../docs/images/still-life.png");
    let photograph = paths.next().unwrap_or_else(|| usual.into());
    let out = paths.next().unwrap_or_else(|| "watercolor.png".into());
    let photograph = Photograph::open(&photograph)?;
    let picture = PhotographPainter::new(Preset::Landscape.settings()).paint(&photograph)?;
    std::fs::write(&out, frame_png(&frame_of(&picture))?)?;
    println!("Wrote {}", out.display());
    Ok(())
}
