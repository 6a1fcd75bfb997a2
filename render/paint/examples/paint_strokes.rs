//! Paints two strokes that cross on a small canvas and saves painting and picture.
//!
//! `cargo run --release -p impasto-paint --example paint_strokes -- strokes.exr strokes.png`

#![expect(clippy::print_stdout, reason = "an example prints what it did")]

use std::error::Error;

use graphics::export::png8;
use paint::{BrushSpec, Canvas, HeadShape, PaintingSession, Sample};
use pigment::library::PigmentLibrary;

fn main() -> Result<(), Box<dyn Error>> {
    let mut paths = std::env::args().skip(1);
    let painting_path = paths.next().unwrap_or_else(|| "strokes.exr".to_owned());
    let picture_path = paths.next().unwrap_or_else(|| "strokes.png".to_owned());

    let oils = PigmentLibrary::van_gogh_oils();
    let canvas = Canvas { width_mm: 60.0, height_mm: 40.0, ..Canvas::default() };
    let mut painting = PaintingSession::on_canvas(&oils, &canvas)?;
    painting.set_brush("flat", &BrushSpec { shape: HeadShape::Flat, size_mm: 8.0 })?;
    painting.set_brush("round", &BrushSpec { shape: HeadShape::Round, size_mm: 5.0 })?;

    painting.load("flat", [("Zinc White", 3.0), ("Prussian Blue", 1.0)], 0.3)?;
    let samples = [(8.0, 12.0), (30.0, 22.0), (52.0, 15.0)].map(|(x_mm, y_mm)| Sample {
        twist_deg: 90.0,
        ..Sample::upright(x_mm / 50.0, x_mm, y_mm, 0.6)
    });
    let report = painting.stroke("flat", &samples)?;
    println!("{} sub-steps over {} cells", report.substeps, report.cells);

    painting.load("round", [("Vermilion", 1.0)], 0.4)?;
    let samples = [(14.0, 34.0), (28.0, 20.0), (44.0, 6.0)]
        .map(|(x_mm, y_mm)| Sample::upright(x_mm / 50.0, x_mm, y_mm, 0.5));
    painting.stroke("round", &samples)?;

    painting.save(&painting_path)?;
    let picture = painting.canvas_mut().picture()?;
    documents::file::write_whole(picture_path.as_ref(), &png8(&picture, canvas.cell_mm)?.bytes)?;
    println!("Wrote {painting_path} and {picture_path}");
    Ok(())
}
