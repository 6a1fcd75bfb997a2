//! Canvases and strokes in the shipped oils, colour differences between pictures, and sessions with
//! a canvas, a palette and random actions.

use std::io::Write;
use std::sync::OnceLock;

use calibrate::PigmentId;
use calibrate::evaluate::Viewing;
use calibrate::library::PigmentLibrary;
use graphics::field::Field;
use graphics::gpu::{BackendChoice, choose};
use paint::brush::HeadShape;
use paint::document::{Document, Lighting, Medium, Slots};
use paint::engine::{BrushId, PaintEngine};
use paint::ground::{Ground, GroundSpec};
use paint::layer::{Layer, SLOTS};
use paint::light::Light;
use paint::optics::Gloss;
use paint::painting::{Painting, UNDO_BYTES};
use paint::pose::Sample;
use paint::session::{Outcome, PaintingSession};
use paint::strokes::{
    Action, BrushSpec, LayerRef, Load, PaletteSpec, Squeeze, StrokeScript, SurfaceId,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::{Lab, RgbSpace, delta_e_ciede2000};

pub(crate) const CELL_MM: f64 = 0.2;

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

pub(crate) fn oils() -> &'static PigmentLibrary {
    static OILS: OnceLock<PigmentLibrary> = OnceLock::new();
    OILS.get_or_init(suite::oils::library)
}

/// Default light and observer, prepared for [`oils`].
pub(crate) fn daylight() -> Light {
    static DAYLIGHT: OnceLock<Light> = OnceLock::new();
    DAYLIGHT.get_or_init(|| Light::new(oils(), &Viewing::default()).unwrap()).clone()
}

pub(crate) fn pigment(name: &str) -> PigmentId {
    oils().find(name).unwrap()
}

fn ground(json: &str, width: usize, height: usize) -> Ground {
    let spec: GroundSpec = serde_json::from_str(json).unwrap();
    spec.build(width, height, CELL_MM, oils()).unwrap()
}

pub(crate) fn bare(width: usize, height: usize) -> Document {
    bare_on(r#"{"kind": "linen", "seed": 3}"#, width, height)
}

/// A canvas without paint on the ground in `json`.
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

pub(crate) fn on_cpu(document: Document) -> Painting {
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    open(document, engine, UNDO_BYTES)
}

/// `document` in daylight on a graphics device, hardware or software. Returns `None` without an adapter.
pub(crate) fn on_gpu(document: Document) -> Option<Painting> {
    gpu_engine(&document).map(|engine| open(document, engine, UNDO_BYTES))
}

/// `document` on the CPU, and on the GPU if there is an adapter.
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
    let samples = places.iter().enumerate().map(|(index, &(x_mm, y_mm))| Sample {
        seconds: 0.1 * index as f64,
        x_mm,
        y_mm,
        pressure,
        tilt_x_deg: 10.0,
        tilt_y_deg: -15.0,
        // At 90 degrees a flat head that moves along x paints with its broad side.
        twist_deg: 90.0 + 5.0 * index as f64,
    });
    samples.collect()
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

/// Three crossing strokes with different paint over a canvas of 24 mm or more.
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

pub(crate) fn lab(rgb: &[f32; 4]) -> Lab {
    let linear = [rgb[0], rgb[1], rgb[2]].map(f64::from);
    let xyz = RgbSpace::Srgb.xyz_from_linear().apply(linear);
    Lab::from_xyz(xyz.into(), RgbSpace::Srgb.white())
}

pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

pub(crate) fn tell(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// A script without actions, with a canvas of 130 x 100 cells and a palette of 90 x 70.
pub(crate) fn header() -> StrokeScript {
    let text = r#"{"format": "strokes", "version": 1, "title": "a session",
        "canvas": {"width_mm": 26, "height_mm": 20, "cell_mm": 0.2},
        "mixing": {"width_mm": 18, "height_mm": 14, "cell_mm": 0.2, "ground": {"kind": "panel"}},
        "palette": ["Lead White"], "brushes": {}, "actions": []}"#;
    let mut script = StrokeScript::from_json("header.json", text.as_bytes()).unwrap();
    script.palette = PaletteSpec::from_names(PALETTE);
    script
}

/// Makes the engine for a document. Returns `None` without a graphics adapter.
pub(crate) type Backend = fn(&Document) -> Option<PaintEngine>;

pub(crate) const BACKENDS: [Backend; 2] =
    [|document| Some(PaintEngine::on_cpu(document.ground.height.clone())), gpu_engine];

/// A recording session on the surfaces of `script`. Returns `None` if the backend is missing.
pub(crate) fn set_up(script: &StrokeScript, backend: Backend) -> Option<PaintingSession> {
    let (canvas, palette) = script.surfaces(oils(), None).unwrap();
    let engine = backend(&canvas)?;
    let palette = palette.unwrap();
    let beside = open(palette.clone(), backend(&palette)?, UNDO_BYTES);
    Some(PaintingSession::recorded(open(canvas, engine, UNDO_BYTES), Some(beside), script).unwrap())
}

/// A session of [`header`] on each available backend.
pub(crate) fn sessions() -> Vec<PaintingSession> {
    BACKENDS.into_iter().filter_map(|backend| set_up(&header(), backend)).collect()
}

/// State of a session: canvas, palette, and the paint on each brush.
pub(crate) type Whole = (Document, Option<Document>, Vec<Option<Layer>>);

pub(crate) fn whole(session: &mut PaintingSession) -> Whole {
    let names: Vec<String> = session.brushes().map(|(name, _)| name.to_owned()).collect();
    let brushes = names.iter().map(|name| session.brush_paint(name).unwrap());
    // A brush that was never used has no paint layer. It compares equal to a washed one.
    let brushes = brushes.map(|paint| paint.filter(|paint| paint.totals() != [0; 9])).collect();
    let (canvas, palette) = session.documents().unwrap();
    (canvas, palette, brushes)
}

pub(crate) fn spec(shape: HeadShape, size_mm: f64) -> BrushSpec {
    BrushSpec { shape, size_mm }
}

/// An action that loads a brush with one pigment and 10 % vehicle.
pub(crate) fn load(brush: &str, pigment: &str, amount_mm: f64) -> Action {
    let recipe = [(pigment.to_owned(), 1.0)].into();
    Action::Load(Load { brush: brush.to_owned(), recipe, vehicle: 0.1, amount_mm })
}

pub(crate) fn squeeze(on: SurfaceId, pigment: &str, (x_mm, y_mm): (f64, f64)) -> Action {
    let recipe = [(pigment.to_owned(), 1.0)].into();
    Action::Squeeze(Squeeze { on, recipe, vehicle: 0.0, x_mm, y_mm, volume_mm3: 3.0 })
}

pub(crate) fn surface(random: &mut ChaCha8Rng) -> SurfaceId {
    if random.random_bool(0.5) { SurfaceId::Canvas } else { SurfaceId::Palette }
}

/// Random pen samples with more digits than a script file keeps.
pub(crate) fn wander(random: &mut ChaCha8Rng, samples: usize) -> Vec<Sample> {
    let mut seconds = random.random_range(0.0..100.0);
    let mut x_mm = random.random_range(0.0..26.0);
    let mut y_mm = random.random_range(0.0..20.0);
    let wandered = (0..samples).map(|_| {
        seconds += random.random_range(0.0..0.02);
        x_mm += random.random_range(-2.0..2.0);
        y_mm += random.random_range(-2.0..2.0);
        Sample {
            seconds,
            x_mm,
            y_mm,
            pressure: random.random_range(0.2..0.8),
            tilt_x_deg: random.random_range(-30.0..30.0),
            tilt_y_deg: random.random_range(-30.0..30.0),
            twist_deg: random.random_range(0.0..180.0),
        }
    });
    wandered.collect()
}

/// Paints a random stroke. Extends it in random portions, with a random number of sub-steps after
/// each.
pub(crate) fn live(
    session: &mut PaintingSession,
    on: SurfaceId,
    brush: &str,
    random: &mut ChaCha8Rng,
) {
    let count = random.random_range(1..12);
    let samples = wander(random, count);
    session.begin_stroke(on, brush).unwrap();
    let mut remaining = samples.as_slice();
    while !remaining.is_empty() {
        let (piece, rest) = remaining.split_at(random.random_range(1..=remaining.len()));
        session.extend(piece).unwrap();
        session.advance(random.random_range(0..60)).unwrap();
        remaining = rest;
    }
    if random.random_bool(0.5) {
        session.lift().unwrap();
        while session.advance(25).unwrap() > 0 {}
    }
    let report = session.end_stroke().unwrap();
    assert!(report.is_some_and(|report| report.undoable), "{report:?}");
}

/// Tries a random action. Returns whether it became a step of the history. It may be refused, e.g.
/// a palette without a pigment that is wet, or a swap in a layer without the pigment.
pub(crate) fn random_action(session: &mut PaintingSession, random: &mut ChaCha8Rng) -> bool {
    let layers = session.canvas().state().dry.len();
    let on = surface(random);
    let action = match random.random_range(0..14) {
        0 => Action::Dry { fraction: random.random_range(0.1..=1.0) },
        1 => {
            let place = (random.random_range(0.0..26.0), random.random_range(0.0..20.0));
            squeeze(on, PALETTE[random.random_range(0..3)], place)
        }
        2 => Action::Scrape { on },
        3 => {
            let more = ["Ultramarine", "Cobalt Blue"][random.random_range(0..2)];
            Action::Palette(PaletteSpec::from_names(PALETTE[..5].iter().copied().chain([more])))
        }
        4 => {
            let illuminant = ["A", "D65"][random.random_range(0..2)].to_owned();
            let azimuth_deg = random.random_range(0.0..360.0);
            Action::Light(Lighting { illuminant, azimuth_deg, ..Lighting::default() })
        }
        5 => {
            let wet = Gloss { strength: random.random_range(0.0..1.0), exponent: 55.5 };
            Action::Gloss { wet, dry: Gloss { strength: 0.01, exponent: 12.0 } }
        }
        6 if layers > 0 => {
            let layer = LayerRef::Dry(random.random_range(0..layers));
            Action::Opacity { layer, value: random.random_range(0.0..2.0) }
        }
        7 => {
            let mut from = "Vermilion".to_owned();
            let mut to = "Minium".to_owned();
            if random.random_bool(0.5) {
                std::mem::swap(&mut from, &mut to);
            }
            let layer = random.random_range(0..=layers);
            let dry = LayerRef::Dry(layer);
            Action::Swap { layer: if layer == layers { LayerRef::Wet } else { dry }, from, to }
        }
        8 if layers > 0 && random.random_bool(0.5) => {
            let layer = session.canvas().state().dry[random.random_range(0..layers)].id;
            let layer = LayerRef::Id(layer);
            match random.random_range(0..3) {
                0 => Action::Name { layer, name: format!("coat {layers}") },
                1 => Action::Visible { layer, value: random.random_bool(0.5) },
                _ => Action::Order { layer, to: random.random_range(0..layers) },
            }
        }
        8 if layers > 1 => {
            Action::Merge { layer: LayerRef::Dry(random.random_range(1..layers)), with: None }
        }
        _ => {
            let brush = ["flat", "knife"][random.random_range(0..2)];
            live(session, on, brush, random);
            return true;
        }
    };
    matches!(session.apply(&action), Ok(Outcome::Done))
}

/// Adds a flat brush loaded with lead white and a knife loaded with Prussian blue.
pub(crate) fn loaded_session(session: &mut PaintingSession) {
    session.set_brush("flat", &spec(HeadShape::Flat, 5.0)).unwrap();
    session.set_brush("knife", &spec(HeadShape::Knife, 4.0)).unwrap();
    session.apply(&load("flat", "Lead White", 0.6)).unwrap();
    session.apply(&load("knife", "Prussian Blue", 0.5)).unwrap();
}

pub(crate) fn seeded(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}
