//! Benchmarks of the grid: what it costs once, and paint that spills.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

use std::sync::Arc;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use graphics::gpu::{BackendChoice, choose};
use graphics::mesh::{Material, Mesh, SampleModel, Triangle};
use paint::layer::Cell;
use volumes::wetting::{DeviceSpilling, Grid, SAMPLES_PER_CELL, Spilling, SurfaceSamples};
use volumes::world::{Pour, Recipe, World, WorldSettings};

fn still_life() -> (Mesh, f32) {
    let mesh = SampleModel::StillLife.mesh(60_000);
    let [low, high] = mesh.bounds();
    let cell = (high - low).max_element() / 12.0;
    (mesh, cell)
}

/// Grid and samples of a still life of 60,000 triangles. Goal: 0.3 s.
#[divan::bench(sample_count = 10)]
fn grid(bencher: Bencher<'_, '_>) {
    let (mesh, cell) = still_life();
    bencher.bench_local(|| Grid::of(black_box(&mesh), cell, SAMPLES_PER_CELL, 1).unwrap());
}

#[divan::bench(sample_count = 10)]
fn samples(bencher: Bencher<'_, '_>) {
    let (mesh, cell) = still_life();
    bencher
        .bench_local(|| SurfaceSamples::of(black_box(&mesh), cell, SAMPLES_PER_CELL, 1).unwrap());
}

fn level(side: f32) -> Mesh {
    let positions = vec![[0.0; 3], [side, 0.0, 0.0], [side, 0.0, side], [0.0, 0.0, side]];
    let triangles = [[0, 2, 1], [0, 3, 2]];
    Mesh {
        normals: vec![[0.0, 1.0, 0.0]; 4],
        texture_coordinates: vec![[0.0; 2]; 4],
        colors: vec![[1.0; 3]; 4],
        positions,
        triangles: triangles.map(|corners| Triangle { corners, material: 0 }).to_vec(),
        materials: vec![Material::plain([1.0; 3])],
    }
}

/// A level square of 400 x 400 wet cells. Each holds more than its capacity, so that paint spills
/// between neighbours.
fn wet(pigments: usize) -> (Grid, Spilling, Vec<Cell>) {
    let grid = Grid::of(&level(400.0), 1.0, SAMPLES_PER_CELL, 1).unwrap();
    let spilling = Spilling::new(&grid.cells, 1.0, 0.04, 0.0).unwrap();
    let paint = (0..grid.cells.len())
        .map(|cell: usize| {
            let mut own = Cell::default();
            let films = 2 + (cell as u32).wrapping_mul(2_654_435_761) % 12;
            own.pigments[..pigments].fill(grid.cells.capacities[cell] * films / pigments as u32);
            own
        })
        .collect();
    (grid, spilling, paint)
}

/// Spilling between wet cells. Our goal is 10 million cell-steps per second.
#[divan::bench(args = [1, 3, 8], sample_count = 10)]
fn spill(bencher: Bencher<'_, '_>, pigments: usize) {
    let (grid, mut spilling, paint) = wet(pigments);
    bencher
        .counter(ItemsCount::new(20 * paint.len()))
        .with_inputs(|| paint.clone())
        .bench_local_refs(|paint| {
            for _ in 0..20 {
                spilling.step((&grid.graph, &grid.cells), paint, true);
            }
        });
}

/// Spills on any graphics device, and copies there and back. Without a device, this does nothing.
#[divan::bench(args = [1, 8], sample_count = 10)]
fn spill_on_a_device(bencher: Bencher<'_, '_>, pigments: usize) {
    let Ok(Some(mut device)) = choose(BackendChoice::Gpu) else { return };
    let (grid, spilling, paint) = wet(pigments);
    let grid = Arc::new(grid);
    let mut on_device = DeviceSpilling::default();
    bencher
        .counter(ItemsCount::new(20 * paint.len()))
        .with_inputs(|| paint.clone())
        .bench_local_refs(|paint| {
            for _ in 0..20 {
                on_device.step(&mut device, (&spilling, &grid), paint, true).unwrap();
            }
        });
}

/// Two steps, as a frame takes, while paint is poured on a still life of 60,000 triangles. We
/// first wait until the grid has this many volumes.
#[divan::bench(args = [64, 256], sample_count = 100)]
fn frame_of_a_world(bencher: Bencher<'_, '_>, volumes: usize) {
    let (mesh, _) = still_life();
    let mut world = World::of(&mesh, &WorldSettings::default()).unwrap();
    let place = world.grid().samples.places[9000];
    world.pour(Pour::at(place, 300.0, f64::INFINITY, Recipe::of_slot(0))).unwrap();
    while world.volumes().len() < volumes {
        world.step().unwrap();
    }
    bencher.with_inputs(|| world.clone()).bench_local_values(|mut world| {
        world.step().unwrap();
        world.step().unwrap();
        world
    });
}

fn main() {
    divan::main();
}
