//! Sub-steps on the CPU: `cargo bench -p impasto-paint --bench motion`.
//!
//! A head with a curved bottom moves one cell per sub-step over wet paint of eight pigments. The
//! bench counts cells in the contact's rectangle as items. For comparison: Baxter, Wendt and Lin
//! (2004) reached 0.52 million cells/s at 88 x 88 and 116 sub-steps/s at 26 x 26 on a GeForce FX
//! 5900. libmypaint, which does not simulate paint, reaches 8.5 million cells/s for a dab of radius
//! 32. To measure one core, set `RAYON_NUM_THREADS=1`.

use divan::{Bencher, counter::ItemsCount};
use graphics::field::Field;
use graphics::tile::Rect;
use paint::contact::{Contact, Touch};
use paint::engine::PaintEngine;
use paint::layer::{Cell, Layer};
use paint::motion::MotionConstants;
use paint::{BrushId, amount::QUANTA_PER_CELL};

fn main() {
    divan::main();
}

const CANVAS: usize = 512;
const HEAD: usize = 96;
/// Number of sub-steps of one stroke across the canvas, over paint that no stroke has moved.
const STROKE: usize = CANVAS - HEAD;

/// Paint of eight pigments and vehicle in every cell, about `cells` cells high.
fn paint(width: usize, height: usize, cells: f64) -> Layer {
    let mut layer = Layer::empty(width, height);
    let part = cells * f64::from(QUANTA_PER_CELL) / 9.0;
    for index in 0..width * height {
        let wave = (index as f64 * 0.7).sin() * 0.2 + 1.0;
        let pigments = std::array::from_fn(|i| (part * wave * (1.0 + 0.1 * i as f64)) as u32);
        layer.set_cell(index, Cell { pigments, vehicle: part as u32 });
    }
    layer
}

fn engine() -> (PaintEngine, BrushId) {
    let mut engine = PaintEngine::on_cpu(Field::filled(CANVAS, CANVAS, 0));
    engine.set_wet(&paint(CANVAS, CANVAS, 1.0)).expect("room");
    let brush = engine.add_brush(HEAD, HEAD).expect("room");
    engine.set_brush_paint(brush, &paint(HEAD, HEAD, 2.0)).expect("room");
    (engine, brush)
}

/// Contact of a square head or, if not `whole`, of a round head of the same width. The bottom of
/// the square rises by one and a half cells from the centre to the corners.
fn contact(size: usize, x: usize, whole: bool) -> Contact {
    let radius = size as f64 / 2.0;
    let touches = (0..size * size).map(|i| {
        let [right, down] = [i % size, i / size].map(|at| (at as f64 + 0.5 - radius) / radius);
        let r2 = right.powi(2) + down.powi(2);
        if r2 > 1.0 && !whole {
            return Touch::NONE;
        }
        let height = (0.25 + 1.5 * (r2 / 2.0).powi(2)) * f64::from(QUANTA_PER_CELL);
        let cell = i / size * HEAD + i % size;
        Touch::new(height as i32, cell as u32, (250, 30), 256, 1)
    });
    let rect = Rect { x, y: (CANVAS - size) / 2, width: size, height: size };
    Contact { rect, touches: touches.collect(), ..Contact::default() }
}

fn stroke(size: usize, whole: bool) -> Vec<Contact> {
    (0..STROKE).map(|x| contact(size, x, whole)).collect()
}

fn run(bencher: Bencher<'_, '_>, size: usize, whole: bool, batch: usize) {
    let contacts = stroke(size, whole);
    let items = ItemsCount::new(size * size * contacts.len());
    bencher.counter(items).with_inputs(engine).bench_local_refs(|(engine, brush)| {
        for contacts in contacts.chunks(batch) {
            engine
                .apply_contacts(*brush, &MotionConstants::new(0.1, 0.7), contacts)
                .expect("played");
        }
    });
}

#[divan::bench(args = [26, 65, 88], sample_count = 10)]
fn square(bencher: Bencher<'_, '_>, size: usize) {
    run(bencher, size, true, STROKE);
}

#[divan::bench(args = [26, 65, 88], sample_count = 10)]
fn disc(bencher: Bencher<'_, '_>, size: usize) {
    run(bencher, size, false, STROKE);
}

/// One sub-step per call, as in an interactive program.
#[divan::bench(args = [26, 65, 88], sample_count = 10)]
fn one_by_one(bencher: Bencher<'_, '_>, size: usize) {
    run(bencher, size, true, 1);
}
