//! This times complete strokes, a replay, and relighting: `cargo bench -p impasto-paint --bench
//! stroke`.
//!
//! Strokes run from samples to paint: the head bends, its footprint is rasterised, the paint of
//! eight pigments moves, and undo saves tiles. The bench counts cells in the contacts' rectangles
//! as items and sub-steps as cycles. Target on two cores: 30 million cells/s with a rectangle of 88
//! x 88, 25,000 sub-steps/s with one of 26 x 26.
//!
//! The replay paints the shipped colour study from bare linen to the last stroke. This bench counts
//! strokes as items.
//!
//! Relighting recomputes every cell of a painting of three dry layers, with relief and gloss. This
//! bench counts cells of the canvas as items. Target at 4096 x 4096: below 3 s, or 5.6 million
//! cells/s.

use std::cell::RefCell;
use std::convert::Infallible;
use std::ops::ControlFlow;

use divan::Bencher;
use divan::counter::{CyclesCount, ItemsCount};
use paint::amount::QUANTA_PER_CELL;
use paint::brush::HeadShape;
use paint::document::{Document, Lighting, Medium, Slots};
use paint::engine::PaintEngine;
use paint::ground::GroundSpec;
use paint::layer::{Cell, Layer, SLOTS};
use paint::painting::Painting;
use paint::pose::Sample;
use paint::session::PaintingSession;
use paint::strokes::StrokeScript;
use pigment::{PigmentId, library::PigmentLibrary};

fn main() {
    divan::main();
}

const CELL_MM: f64 = 0.1;
const UNDO_BYTES: u64 = 512 << 20;

/// Paint of eight pigments and vehicle in every cell, about half a cell high.
fn paint(width: usize, height: usize, seed: usize) -> Layer {
    let mut layer = Layer::empty(width, height);
    let part = f64::from(QUANTA_PER_CELL) / 18.0;
    for index in 0..width * height {
        let wave = ((index + seed * 7919) as f64 * 0.7).sin() * 0.2 + 1.0;
        let pigments = std::array::from_fn(|i| (part * wave * (1.0 + 0.1 * i as f64)) as u32);
        layer.set_cell(index, Cell { pigments, vehicle: part as u32 });
    }
    layer
}

fn oils() -> PigmentLibrary {
    PigmentLibrary::van_gogh_oils()
}

/// A painting on linen with wet paint in every cell and `dry` dry layers below it.
fn painting(width: usize, height: usize, dry: usize) -> Painting {
    let library = oils();
    let ground = GroundSpec::default().build(width, height, CELL_MM, &library).expect("linen");
    let slots: Slots = std::array::from_fn(|slot| Some(PigmentId(slot)));
    let medium = Medium::default();
    let lighting = Lighting::default();
    let mut document = Document::bare("", CELL_MM, ground, library, medium, slots, lighting);
    document.wet = paint(width, height, 0);
    for seed in 1..=dry {
        document.push_dry(slots, paint(width, height, seed));
    }
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    Painting::open(document, engine, UNDO_BYTES).expect("a painting")
}

/// Shape, size in mm and pressure of each head.
const HEADS: [(HeadShape, f64, f64); 4] = [
    (HeadShape::Round, 1.6, 1.0),
    (HeadShape::Flat, 2.1, 0.7),
    (HeadShape::Round, 5.5, 1.0),
    (HeadShape::Flat, 8.75, 0.7),
];

/// One stroke of 160 mm. An undo before each restores the paint and the load of the brush.
#[divan::bench(args = 0..HEADS.len(), sample_count = 10, sample_size = 1)]
fn stroke(bencher: Bencher<'_, '_>, head: usize) {
    let (shape, size_mm, pressure) = HEADS[head];
    let mut painting = painting(2048, 256, 0);
    let brush = painting.add_brush(shape, size_mm).expect("a brush");
    painting.load(brush, &[1.0; SLOTS], 0.1, 0.2).expect("paint for it");
    let samples = [sample(0.0, 25.0, pressure), sample(1.0, 185.0, pressure)];
    let report = painting.stroke(brush, &samples).expect("painted");
    let painting = RefCell::new(painting);
    bencher
        .counter(ItemsCount::new(report.cells))
        .counter(CyclesCount::new(report.substeps))
        .with_inputs(|| painting.borrow_mut().undo().expect("undone"))
        .bench_local_values(|_| painting.borrow_mut().stroke(brush, &samples).expect("painted"));
}

fn sample(seconds: f64, x_mm: f64, pressure: f64) -> Sample {
    Sample {
        seconds,
        x_mm,
        y_mm: 12.83,
        pressure,
        tilt_x_deg: 20.0,
        tilt_y_deg: 10.0,
        twist_deg: 90.0,
    }
}

/// A loaded flat of 25 mm, held upright, paints two circles over each other on linen. It moves as
/// fast as in the studio's bench `speed`.
#[divan::bench(sample_count = 3, sample_size = 1)]
fn wide_flat(bencher: Bencher<'_, '_>) {
    let library = oils();
    let ground = GroundSpec::default().build(1920, 1080, CELL_MM, &library).expect("linen");
    let slots: Slots = std::array::from_fn(|slot| Some(PigmentId(slot)));
    let medium = Medium::default();
    let lighting = Lighting::default();
    let document = Document::bare("", CELL_MM, ground, library, medium, slots, lighting);
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    let mut painting = Painting::open(document, engine, UNDO_BYTES).expect("a painting");
    let brush = painting.add_brush(HeadShape::Flat, 25.0).expect("a brush");
    painting.load(brush, &[1.0; SLOTS], 0.1, 0.2).expect("paint for it");
    let samples: Vec<Sample> = (0..400)
        .map(|i| {
            let (sine, cosine) = (f64::from(i) * 0.01 * std::f64::consts::TAU).sin_cos();
            Sample::upright(f64::from(i) * 0.01, 96.0 + 15.0 * cosine, 54.0 + 15.0 * sine, 0.5)
        })
        .collect();
    let report = painting.stroke(brush, &samples[..200]).expect("painted");
    let painting = RefCell::new(painting);
    bencher
        .counter(ItemsCount::new(report.cells))
        .counter(CyclesCount::new(report.substeps))
        .with_inputs(|| painting.borrow_mut().undo().expect("undone"))
        .bench_local_values(|_| {
            painting.borrow_mut().stroke(brush, &samples[..200]).expect("painted")
        });
}

/// Changes the direction of the light only.
#[divan::bench(args = [1024, 2048], sample_count = 5, sample_size = 1)]
fn relight_from_another_side(bencher: Bencher<'_, '_>, side: usize) {
    let mut azimuths = [45.0, 315.0].into_iter().cycle();
    relight(bencher, side, || {
        let azimuth_deg = azimuths.next().unwrap_or_default();
        Lighting { azimuth_deg, ..Lighting::default() }
    });
}

/// Changes the illuminant, which includes fitting its eight wavelengths.
#[divan::bench(args = [1024, 2048], sample_count = 5, sample_size = 1)]
fn relight_by_another_illuminant(bencher: Bencher<'_, '_>, side: usize) {
    let mut lights = ["A", "D65"].into_iter().cycle();
    relight(bencher, side, || {
        let illuminant = lights.next().unwrap_or_default().to_owned();
        Lighting { illuminant, ..Lighting::default() }
    });
}

fn relight(bencher: Bencher<'_, '_>, side: usize, mut lighting: impl FnMut() -> Lighting) {
    let mut painting = painting(side, side, 3);
    painting.picture().expect("a picture");
    bencher.counter(ItemsCount::new(side * side)).bench_local(|| {
        painting.relight(lighting()).expect("a light that has a name");
        painting.picture().expect("a picture")
    });
}

#[divan::bench(sample_count = 5)]
fn replay_the_color_study(bencher: Bencher<'_, '_>) {
    let text = include_str!("../../../paintings/colour-study.json");
    let script =
        StrokeScript::from_json("colour-study.json", text.as_bytes()).expect("it is sound");
    let library = oils();
    let (bare, _) = script.surfaces(&library, None).expect("bare linen");
    let strokes = script.actions.iter().filter(|action| action.kind() == "stroke").count();
    bencher
        .counter(ItemsCount::new(strokes))
        .with_inputs(|| {
            let engine = PaintEngine::on_cpu(bare.ground.height.clone());
            let canvas = Painting::open(bare.clone(), engine, UNDO_BYTES).expect("a painting");
            PaintingSession::new(canvas, None).expect("a canvas alone")
        })
        .bench_values(|mut session| {
            script
                .replay(
                    &mut session,
                    |_: &str, _: &mut Painting| Ok::<_, Infallible>(()),
                    || ControlFlow::Continue(()),
                )
                .expect("played");
            session
        });
}
