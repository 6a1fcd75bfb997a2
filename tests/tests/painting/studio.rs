//! Helpers: canvases and strokes in the shipped oils, and colour differences between pictures.

use std::io::Write;
use std::sync::OnceLock;

use calibrate::PigmentId;
use calibrate::evaluate::Viewing;
use calibrate::library::PigmentLibrary;
use graphics::field::Field;
use graphics::gpu::{BackendChoice, choose};
use paint::brush::HeadShape;
use paint::document::{Document, Lighting, Medium, Slots};
use paint::engine::BrushId;
use paint::engine::PaintEngine;
use paint::ground::{Ground, GroundSpec};
use paint::layer::SLOTS;
use paint::light::Light;
use paint::painting::{Painting, UNDO_BYTES};
use paint::pose::Sample;
use spectra::color::{Lab, RgbSpace, delta_e_ciede2000};

pub(crate) const CELL_MM: f64 = 0.2;

/// The pigments of the palette, by slot.
pub(crate) const PALETTE: [&str; 7] = [
    "Lead White",
    "Chrome Yellow",
    "Prussian Blue",
    "Vermilion",
    "Viridian",
    "Bone Black",
    "Emerald Green",
];

pub(crate) const WHITE: usize = 0;
pub(crate) const YELLOW: usize = 1;
pub(crate) const BLUE: usize = 2;
pub(crate) const RED: usize = 3;

/// The pigment library of the shipped oils.
pub(crate) fn oils() -> &'static PigmentLibrary {
    static OILS: OnceLock<PigmentLibrary> = OnceLock::new();
    OILS.get_or_init(suite::oils::library)
}

/// Default light and observer, prepared for [`oils`].
pub(crate) fn daylight() -> Light {
    static DAYLIGHT: OnceLock<Light> = OnceLock::new();
    DAYLIGHT.get_or_init(|| Light::new(oils(), &Viewing::default()).unwrap()).clone()
}

/// The id of a pigment of [`oils`].
pub(crate) fn pigment(name: &str) -> PigmentId {
    oils().find(name).unwrap()
}

fn ground(json: &str, width: usize, height: usize) -> Ground {
    let spec: GroundSpec = serde_json::from_str(json).unwrap();
    spec.build(width, height, CELL_MM, oils()).unwrap()
}

/// A canvas of linen without paint.
pub(crate) fn bare(width: usize, height: usize) -> Document {
    bare_on(r#"{"kind": "linen", "seed": 3}"#, width, height)
}

/// A canvas without paint on the ground that `json` describes.
pub(crate) fn bare_on(json: &str, width: usize, height: usize) -> Document {
    let mut slots: Slots = [None; SLOTS];
    for (slot, name) in slots.iter_mut().zip(PALETTE) {
        *slot = Some(pigment(name));
    }
    Document::bare(
        "a trial",
        CELL_MM,
        ground(json, width, height),
        oils().clone(),
        Medium::default(),
        slots,
        Lighting::default(),
    )
}

/// `document` in daylight on the CPU.
pub(crate) fn on_cpu(document: Document) -> Painting {
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    open(document, engine, UNDO_BYTES)
}

/// `document` in daylight on a graphics device, hardware or software; `None` without an
/// adapter.
pub(crate) fn on_gpu(document: Document) -> Option<Painting> {
    gpu_engine(&document).map(|engine| open(document, engine, UNDO_BYTES))
}

/// `document` on the CPU and, with an adapter, on the GPU.
pub(crate) fn on_both(document: &Document) -> Vec<Painting> {
    std::iter::once(on_cpu(document.clone())).chain(on_gpu(document.clone())).collect()
}

pub(crate) fn gpu_engine(document: &Document) -> Option<PaintEngine> {
    let Some(device) = choose(BackendChoice::Gpu).ok().flatten() else {
        let _ = writeln!(std::io::stderr(), "no graphics adapter: not tested");
        return None;
    };
    Some(PaintEngine::on_device(device, &document.ground.height).unwrap())
}

pub(crate) fn open(document: Document, engine: PaintEngine, undo_bytes: u64) -> Painting {
    Painting::open_under(document, daylight(), engine, undo_bytes).unwrap()
}

/// A recipe of the pigment in `slot` alone.
pub(crate) fn pure(slot: usize) -> [f64; SLOTS] {
    std::array::from_fn(|i| if i == slot { 1.0 } else { 0.0 })
}

/// Samples along `places` in mm, one every tenth of a second, at one pressure.
pub(crate) fn along(places: &[(f64, f64)], pressure: f64) -> Vec<Sample> {
    let sample = |(index, &(x_mm, y_mm)): (usize, &(f64, f64))| Sample {
        seconds: 0.1 * index as f64,
        x_mm,
        y_mm,
        pressure,
        tilt_x_deg: 10.0,
        tilt_y_deg: -15.0,
        // At 90 degrees a flat head that moves along x paints with its broad side.
        twist_deg: 90.0 + 5.0 * index as f64,
    };
    places.iter().enumerate().map(sample).collect()
}

/// Adds a brush loaded with `amount_mm` of the pigment in `slot`, with 10 % vehicle.
pub(crate) fn loaded(
    painting: &mut Painting,
    shape: HeadShape,
    size_mm: f64,
    slot: usize,
    amount_mm: f64,
) -> BrushId {
    let brush = painting.add_brush(shape, size_mm).unwrap();
    painting.load(brush, &pure(slot), 0.1, amount_mm).unwrap();
    brush
}

/// Three crossing strokes of different paint over a canvas of 24 mm or more.
pub(crate) fn crossing(painting: &mut Painting) {
    let white = loaded(painting, HeadShape::Flat, 5.0, WHITE, 0.4);
    let yellow = loaded(painting, HeadShape::Filbert, 4.0, YELLOW, 0.3);
    let blue = loaded(painting, HeadShape::Round, 3.0, BLUE, 0.3);
    painting.stroke(white, &along(&[(3.0, 4.0), (20.0, 5.0)], 0.5)).unwrap();
    painting.stroke(yellow, &along(&[(4.0, 12.0), (12.0, 3.0), (21.0, 13.0)], 0.5)).unwrap();
    painting.stroke(blue, &along(&[(12.0, 2.0), (11.0, 9.0), (13.0, 14.0)], 0.6)).unwrap();
}

/// CIEDE2000 between two pictures, one value per cell, ascending.
pub(crate) fn differences(a: &Field<[f32; 4]>, b: &Field<[f32; 4]>) -> Vec<f64> {
    assert_eq!((a.width(), a.height()), (b.width(), b.height()), "sizes of pictures");
    let pairs = a.values().iter().zip(b.values());
    sorted(pairs.map(|(a, b)| delta_e_ciede2000(lab(a), lab(b))).collect())
}

pub(crate) fn sorted(mut values: Vec<f64>) -> Vec<f64> {
    assert!(values.iter().all(|value| value.is_finite()), "a value is not finite");
    values.sort_by(f64::total_cmp);
    values
}

/// CIELAB of a linear sRGB colour.
pub(crate) fn lab(rgb: &[f32; 4]) -> Lab {
    let linear = [rgb[0], rgb[1], rgb[2]].map(f64::from);
    let xyz = RgbSpace::Srgb.xyz_from_linear().apply(linear);
    Lab::from_xyz(xyz.into(), RgbSpace::Srgb.white())
}

pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Prints a line on stderr.
pub(crate) fn tell(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}
