//! Paints a photograph in strokes of oil paint and writes the painting, its picture and the
//! script of strokes.
//!
//! `cargo run --release -p impasto-strokes --example strokes -- docs/images/still-life.png out`
//! writes `out/painting.exr`, `out/painting.png` and `out/strokes.json`.

use std::error::Error;
use std::io::Write;
use std::path::PathBuf;

use documents::Task;
use graphics::export::PictureFormat;
use graphics::gpu::BackendChoice;
use paint::export::PaintingExports;
use pigment::PigmentLibrary;
use strokes::{Photograph, StrokePainter, StrokeSettings};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1).map(PathBuf::from);
    let path = arguments.next().unwrap_or_else(|| "docs/images/still-life.png".into());
    let folder = arguments.next().unwrap_or_else(|| "out".into());
    std::fs::create_dir_all(&folder)?;

    let oils = PigmentLibrary::van_gogh_oils();
    let photograph = Photograph::open(&path)?;
    let settings =
        StrokeSettings { width_mm: 60.0, title: "Still life".to_owned(), ..Default::default() };
    let painter = StrokePainter::new(&photograph, &oils, &settings)?;
    let mut painted = painter.paint(BackendChoice::Auto, &Task::default())?;

    let mut out = std::io::stdout().lock();
    writeln!(out, "palette: {}", painter.pigments().join(", "))?;
    for level in &painted.levels {
        writeln!(out, "{} of {} mm: {} strokes", level.shape, level.size_mm, level.strokes)?;
    }
    writeln!(out, "mean colour error: {:.2} CIEDE2000", painted.error.mean)?;

    let exports = PaintingExports {
        picture: Some((folder.join("painting.png"), PictureFormat::Png8)),
        painting: Some(folder.join("painting.exr")),
        ..PaintingExports::default()
    };
    exports.write(painted.painting_mut())?;
    std::fs::write(folder.join("strokes.json"), painted.script.to_json()?)?;
    Ok(())
}
