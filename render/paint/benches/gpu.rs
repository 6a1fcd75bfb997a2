//! Benchmarks on the GPU: sub-steps, rendering, and the cost of a submission.
//!
//! This takes the best adapter it finds, which may be a software adapter. If there is none, it
//! times nothing.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

use divan::{Bencher, counter::ItemsCount};
use graphics::field::Field;
use graphics::gpu::{BackendChoice, Device, choose};
use graphics::tile::{Rect, TileSet};
use paint::contact::{Contact, Touch};
use paint::engine::PaintEngine;
use paint::layer::{Cell, Layer, SLOTS};
use paint::motion::MotionConstants;
use paint::optics::{Gloss, Lamp, LayerOptics, NODES, Scene, SceneSurface};
use paint::{BrushId, View};

fn main() {
    divan::main();
}

fn device() -> Option<Device> {
    choose(BackendChoice::Gpu).ok().flatten()
}

/// Paint of eight pigments and vehicle in every cell.
fn paint(width: usize, height: usize) -> Layer {
    let mut layer = Layer::empty(width, height);
    for i in 0..width * height {
        let [pigments @ .., vehicle]: [u32; SLOTS + 1] =
            std::array::from_fn(|slot| (i * 7919 + slot * 104_729) as u32 % 60_000);
        layer.set_cell(i, Cell { pigments, vehicle });
    }
    layer
}

/// A canvas of `side` x `side` cells with wet paint, and a loaded head of 96 x 96 cells.
fn engine(side: usize) -> Option<(PaintEngine, BrushId)> {
    let mut engine = PaintEngine::on_device(device()?, &Field::filled(side, side, 0)).unwrap();
    let brush = engine.add_brush(96, 96).unwrap();
    engine.set_wet(&paint(side, side)).unwrap();
    engine.set_brush_paint(brush, &paint(96, 96)).unwrap();
    Some((engine, brush))
}

/// `count` sub-steps of a square footprint that moves to the right.
fn contacts(side: usize, count: usize) -> Vec<Contact> {
    let touches: Vec<_> = (0..side * side)
        .map(|i: usize| {
            let brush_cell = (i / side * 96 + i % side) as u32;
            Touch::new(200_000, brush_cell, (200, 40), 256, 1)
        })
        .collect();
    (0..count)
        .map(|step| Contact {
            rect: Rect { x: 10 + step % 128, y: 20, width: side, height: side },
            touches: touches.clone(),
            ..Contact::default()
        })
        .collect()
}

/// 256 sub-steps in one call, then a wait.
#[divan::bench(args = [26, 88], sample_count = 10)]
fn sub_steps(bencher: Bencher<'_, '_>, side: usize) {
    let Some((mut engine, brush)) = engine(512) else { return };
    let contacts = contacts(side, 256);
    bencher.counter(ItemsCount::new(256_u32)).bench_local(|| {
        engine.apply_contacts(brush, &MotionConstants::new(0.1, 0.7), &contacts).unwrap();
        engine.finish().unwrap();
    });
}

/// One sub-step per call, with a wait after each.
#[divan::bench(args = [1, 26, 88], sample_count = 10)]
fn one_sub_step_and_wait(bencher: Bencher<'_, '_>, side: usize) {
    let Some((mut engine, brush)) = engine(512) else { return };
    let contacts = contacts(side, 16);
    bencher.counter(ItemsCount::new(16_u32)).bench_local(|| {
        for contact in &contacts {
            engine
                .apply_contacts(
                    brush,
                    &MotionConstants::new(0.1, 0.7),
                    std::slice::from_ref(contact),
                )
                .unwrap();
            engine.finish().unwrap();
        }
    });
}

fn scene(dry: usize) -> Scene {
    let table = std::array::from_fn(|slot| {
        std::array::from_fn(|node| 1e-7 * (1 + (slot * 3 + node * 5) % 11) as f32)
    });
    let coat = LayerOptics { absorption: table, scattering: table, covers: [2e-5; SLOTS + 1] };
    let gloss = Gloss { strength: 0.25, exponent: 60.0 };
    Scene {
        ground: [0.8; NODES],
        dry: vec![coat; dry],
        wet: LayerOptics { absorption: [[2e-7; NODES]; SLOTS], ..coat },
        surface: SceneSurface { k1: 0.03, k2: 0.5, specular: 0.03 },
        rgb_from_nodes: [[0.125; 3]; NODES],
        lamp: Lamp {
            direction: [-0.45, -0.45, 0.771],
            relief: 1.0,
            ambient: 0.5,
            wet: gloss,
            dry: gloss,
            ground: gloss,
        },
        cell_mm: 0.1,
    }
}

/// Composites and shades the wet layer over baked reflectance, 1024 x 1024 cells.
#[divan::bench(sample_count = 10)]
fn one_layer(bencher: Bencher<'_, '_>) {
    let Some((mut engine, _)) = engine(1024) else { return };
    let all = TileSet::all(engine.bounds());
    bencher.counter(ItemsCount::new(1024_u32 * 1024)).bench_local(|| {
        engine.render(View::First, &scene(0), &TileSet::default(), &all).unwrap();
        engine.finish().unwrap();
    });
}

/// Bakes two dry layers and shows the wet layer over them, 1024 x 1024 cells.
#[divan::bench(sample_count = 10)]
fn three_layers(bencher: Bencher<'_, '_>) {
    let Some((mut engine, _)) = engine(1024) else { return };
    for _ in 0..2 {
        engine.push_dry_layer(&paint(1024, 1024)).unwrap();
    }
    let all = TileSet::all(engine.bounds());
    bencher.counter(ItemsCount::new(1024_u32 * 1024)).bench_local(|| {
        engine.render(View::First, &scene(2), &all, &TileSet::default()).unwrap();
        engine.finish().unwrap();
    });
}

/// Reads the picture back to the CPU, 1024 x 1024 cells.
#[divan::bench(sample_count = 10)]
fn readback(bencher: Bencher<'_, '_>) {
    let Some((mut engine, _)) = engine(1024) else { return };
    bencher.counter(ItemsCount::new(1024_u32 * 1024)).bench_local(|| engine.picture().unwrap());
}
