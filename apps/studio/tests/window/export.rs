//! The engine's own export of a saved painting, compared with the screen.

use std::path::Path;
use web_time::{Duration, Instant};

use graphics::export::png8;
use paint::document::Document;
use paint::light::Light;
use paint::{file, scene};

use crate::program::Program;
use crate::screen::{CONTROL, Pixels, until};

/// Reads a painting file.
pub(crate) fn painting(path: &Path) -> Document {
    let bytes = std::fs::read(path).expect("the painting was saved");
    file::read(&path.display().to_string(), &bytes).expect("it is a painting")
}

/// Renders a painting as `impasto relight PAINTING --png` does.
pub(crate) fn exported(document: &Document) -> Pixels {
    let lighting = &document.lighting;
    let light = Light::named(&document.library, &lighting.illuminant, &lighting.observer);
    let scene = scene::scene(document, &light.expect("the light is known"));
    let picture = scene::picture(document, &scene);
    let png = png8(&picture, document.cell_mm).expect("a picture can be exported");
    let picture = image::load_from_memory(&png.bytes).expect("a PNG").into_rgb8();
    let width = picture.width() as usize;
    let height = picture.height() as usize;
    Pixels { width, height, rows: picture.pixels().map(|pixel| pixel.0).collect() }
}

/// Waits until the visible part of the canvas equals `picture`, one cell per pixel, to
/// the bit. Returns the number of pixels compared.
pub(crate) fn shows(program: &Program<'_>, picture: &Pixels) -> usize {
    let screen = program.screen;
    let (x, y) = &program.room;
    screen.aside();
    let began = Instant::now();
    until("the screen shows the picture of the file", || {
        // Opening a painting fits it into the view, so the zoom is set afterwards.
        screen.key(u32::from('1'), &[CONTROL]);
        let shown = screen.still(x.clone(), y.clone());
        let found = seen(program, picture).filter(|seen| *seen == shown);
        if found.is_none() && began.elapsed() > Duration::from_secs(60) {
            let on_screen = shown.keep("shown");
            let in_file = picture.keep("exported");
            let differing = seen(program, picture).map(|seen| seen.differing(&shown));
            panic!("{differing:?} pixels differ: see {on_screen} and {in_file}");
        }
        found.map(|seen| seen.rows.len())
    })
}

/// Part of the picture that is visible, from the position that the program reports.
fn seen(program: &Program<'_>, picture: &Pixels) -> Option<Pixels> {
    let [left, top, right, bottom] = program.canvas()?;
    let whole = left.fract() == 0.0 && top.fract() == 0.0;
    let size = (right - left, bottom - top) == (picture.width as f64, picture.height as f64);
    if !(whole && size) {
        return None;
    }
    let (x, y) = &program.room;
    let cell = |at: usize, first: f64| usize::try_from(at as i64 - first as i64).ok();
    let mut rows = Vec::with_capacity(x.len() * y.len());
    for row in y.clone() {
        for column in x.clone() {
            let column = cell(column, left)?;
            let row = cell(row, top)?;
            let inside = column < picture.width && row < picture.height;
            rows.push(inside.then(|| picture.at(column, row))?);
        }
    }
    Some(Pixels { width: x.len(), height: y.len(), rows })
}
