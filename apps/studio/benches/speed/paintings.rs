//! Paintings that the program opens.

use std::error::Error;
use std::path::Path;

use paint::brush::HeadShape;
use paint::document::Canvas;
use paint::file;
use paint::ground::GroundSpec;
use paint::session::PaintingSession;
use paint::strokes::BrushSpec;
use pigment::library::PigmentLibrary;

/// Writes a painting of 192 x 108 mm with one brush: a flat of `size_mm`, loaded with paint.
pub(crate) fn loaded_flat(path: &Path, size_mm: f64) -> Result<(), Box<dyn Error>> {
    let library = PigmentLibrary::van_gogh_oils();
    let canvas =
        Canvas { width_mm: 192.0, height_mm: 108.0, cell_mm: 0.1, ground: GroundSpec::default() };
    let mut session = PaintingSession::on_canvas(&library, &canvas)?;
    session.set_brush("flat", &BrushSpec { shape: HeadShape::Flat, size_mm })?;
    session.load("flat", [("Ultramarine", 1.0)], 0.3)?;
    let brushes = session.kept_brushes()?;
    let document = session.documents()?.0;
    std::fs::write(path, file::write_with_table(&document, &document, &brushes)?)?;
    Ok(())
}

/// Writes a bare canvas of `side` x `side` cells of 0.1 mm.
pub(crate) fn bare(path: &Path, side: u32) -> Result<(), Box<dyn Error>> {
    let library = PigmentLibrary::van_gogh_oils();
    let side_mm = f64::from(side) * 0.1;
    let canvas = Canvas {
        width_mm: side_mm,
        height_mm: side_mm,
        cell_mm: 0.1,
        ground: GroundSpec::default(),
    };
    PaintingSession::on_canvas(&library, &canvas)?.save(path)?;
    Ok(())
}
