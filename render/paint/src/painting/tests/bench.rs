//! Small canvases with a film of wet paint.

use pigment::library::PigmentLibrary;

use crate::amount::quanta_from_mm;
use crate::brush::HeadShape;
use crate::canvas::Canvas;
use crate::document::{Document, Lighting, Medium};
use crate::engine::{BrushId, PaintEngine};
use crate::ground::GroundSpec;
use crate::layer::{Layer, SLOTS};
use crate::painting::Painting;
use crate::pose::Sample;
use graphics::gpu::BackendChoice;

/// Width of a cell in mm.
pub(super) const CELL_MM: f64 = 0.2;

/// Width and height of the canvas in mm.
pub(super) const SIZE_MM: (f64, f64) = (40.0, 16.0);

/// Paint of the left half: two pigments and vehicle. The right half has another pigment.
pub(super) const SHARES: [f64; 3] = [0.5, 0.2, 0.3];

fn document(ground: &str) -> Document {
    let library = PigmentLibrary::van_gogh_oils();
    let ground: GroundSpec = serde_json::from_str(ground).unwrap();
    let canvas = Canvas { width_mm: SIZE_MM.0, height_mm: SIZE_MM.1, cell_mm: CELL_MM, ground };
    let mut slots = [None; SLOTS];
    for (slot, name) in slots.iter_mut().zip(["Zinc White", "Prussian Blue", "Chrome Yellow"]) {
        *slot = Some(library.find(name).unwrap());
    }
    let ground = canvas.ground(&library).unwrap();
    let medium = Medium::of(&library);
    Document::bare("", CELL_MM, ground, library, medium, slots, Lighting::default())
}

/// A film of `mm` mm: the left half of white, blue and vehicle, the right half of slot 2.
pub(super) fn film(painting: &Painting, mm: f64) -> Layer {
    let bounds = painting.bounds();
    let mut wet = Layer::empty(bounds.width, bounds.height);
    for index in 0..bounds.width * bounds.height {
        let mut cell = wet.cell(index);
        if index % bounds.width < bounds.width / 2 {
            let [white, blue, vehicle] = SHARES.map(|share| quanta_from_mm(mm * share, CELL_MM));
            (cell.pigments[0], cell.pigments[1], cell.vehicle) = (white, blue, vehicle);
        } else {
            cell.pigments[2] = quanta_from_mm(mm, CELL_MM);
        }
        wet.set_cell(index, cell);
    }
    wet
}

/// A painting on the processor over `ground` (JSON), with a film of `mm` mm.
pub(super) fn on_cpu(ground: &str, mm: f64) -> Painting {
    let document = document(ground);
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    with_film(document, engine, mm)
}

/// Such a painting on a graphics device; `None` without one.
pub(super) fn on_gpu(ground: &str, mm: f64) -> Option<Painting> {
    let document = document(ground);
    let opened = PaintEngine::open(BackendChoice::Gpu, &document.ground.height).ok()?;
    Some(with_film(document, opened.engine, mm))
}

fn with_film(document: Document, engine: PaintEngine, mm: f64) -> Painting {
    let mut painting = Painting::open(document, engine, 1 << 28).unwrap();
    let wet = film(&painting, mm);
    painting.engine.set_wet(&wet).unwrap();
    painting
}

/// A brush of `size_mm` mm with a load of the right half's pigment.
pub(super) fn loaded(painting: &mut Painting, shape: HeadShape, size_mm: f64) -> BrushId {
    let brush = painting.add_brush(shape, size_mm).unwrap();
    let mut recipe = [0.0; SLOTS];
    recipe[2] = 1.0;
    painting.load(brush, &recipe, 0.1, 0.3).unwrap();
    brush
}

/// A stroke along x at `y_mm`, from `from_mm` to `to_mm`.
pub(super) fn along(y_mm: f64, (from_mm, to_mm): (f64, f64), pressure: f64) -> Vec<Sample> {
    (0..=12)
        .map(|step: u32| {
            let share = f64::from(step) / 12.0;
            let x_mm = from_mm + (to_mm - from_mm) * share;
            Sample { twist_deg: 90.0, ..Sample::upright(share, x_mm, y_mm, pressure) }
        })
        .collect()
}

/// Height in mm of the paint in the cell at a place in mm.
pub(super) fn height_mm(wet: &Layer, x_mm: f64, y_mm: f64) -> f64 {
    let x = (x_mm / CELL_MM) as usize;
    let y = (y_mm / CELL_MM) as usize;
    let quanta = wet.cell(y * wet.width() + x).volume();
    crate::amount::mm_from_quanta(quanta, CELL_MM)
}
