//! Helpers: sessions with a canvas and a palette, and random actions in them.

use paint::brush::HeadShape;
use paint::document::{Document, Lighting};
use paint::engine::PaintEngine;
use paint::layer::Layer;
use paint::optics::Gloss;
use paint::painting::UNDO_BYTES;
use paint::pose::Sample;
use paint::session::{Outcome, PaintingSession};
use paint::strokes::{
    Action, BrushSpec, LayerRef, Load, PaletteSpec, Squeeze, StrokeScript, SurfaceId,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::studio::{PALETTE, gpu_engine, oils, open};

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

/// Makes the engine for a document; `None` without a graphics adapter.
pub(crate) type Backend = fn(&Document) -> Option<PaintEngine>;

/// CPU and GPU.
pub(crate) const BACKENDS: [Backend; 2] =
    [|document| Some(PaintEngine::on_cpu(document.ground.height.clone())), gpu_engine];

/// A recording session on the surfaces that `script` describes; `None` if the backend is
/// missing.
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
    // A brush that was never used has no paint layer; it compares equal to a washed one.
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

/// Canvas or palette at random.
pub(crate) fn surface(random: &mut ChaCha8Rng) -> SurfaceId {
    if random.random_bool(0.5) { SurfaceId::Canvas } else { SurfaceId::Palette }
}

/// Random pen samples, with more digits than a script file keeps.
pub(crate) fn wander(random: &mut ChaCha8Rng, samples: usize) -> Vec<Sample> {
    let mut seconds = random.random_range(0.0..100.0);
    let mut x_mm = random.random_range(0.0..26.0);
    let mut y_mm = random.random_range(0.0..20.0);
    let mut next = || {
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
    };
    (0..samples).map(|_| next()).collect()
}

/// Paints a random stroke, extended in random portions with a random number of sub-steps after
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
    let mut told = samples.as_slice();
    while !told.is_empty() {
        let (piece, rest) = told.split_at(random.random_range(1..=told.len()));
        session.extend(piece).unwrap();
        session.advance(random.random_range(0..60)).unwrap();
        told = rest;
    }
    if random.random_bool(0.5) {
        session.lift().unwrap();
        while session.advance(25).unwrap() > 0 {}
    }
    let report = session.end_stroke().unwrap();
    assert!(report.is_some_and(|report| report.undoable), "{report:?}");
}

/// Tries a random action. Returns whether it became a step of the history; it may be refused, as
/// for a palette without a pigment that is wet, or a swap in a layer without the pigment.
pub(crate) fn something(session: &mut PaintingSession, random: &mut ChaCha8Rng) -> bool {
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
pub(crate) fn loaded(session: &mut PaintingSession) {
    session.set_brush("flat", &spec(HeadShape::Flat, 5.0)).unwrap();
    session.set_brush("knife", &spec(HeadShape::Knife, 4.0)).unwrap();
    session.apply(&load("flat", "Lead White", 0.6)).unwrap();
    session.apply(&load("knife", "Prussian Blue", 0.5)).unwrap();
}

pub(crate) fn seeded(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}
