//! Counts the closed surfaces that hold each visible point, at 750 x 570 pixels.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

use std::hint::black_box;

use divan::Bencher;
use glam::Vec3;
use graphics::camera::{Camera, Framing};
use graphics::compute::{Compute, Image};
use graphics::field::Field;
use graphics::gpu::BackendChoice;
use graphics::mesh::{Mesh, SampleModel, Triangle};
use graphics::surface::{
    ClosedSurfaces, Count, Crossings, Fragment, InsideCounter, Model, PackedMesh, VisibilityBuffer,
    WeighedCount, visible,
};

const SIZE: (usize, usize) = (750, 570);

/// The still life with balls of about 320 faces each, centred on vertices spread evenly over its
/// list of vertices.
struct Scene {
    mesh: Mesh,
    camera: Camera,
    visible: VisibilityBuffer,
    vertices: Vec<[f32; 3]>,
    triangles: Vec<Triangle>,
}

impl Scene {
    fn with_balls(count: usize) -> Self {
        let mesh = SampleModel::StillLife.mesh(60_000);
        let [low, high] = mesh.bounds();
        let radius = (high - low).max_element() / 12.0 * 0.8;
        let ball = Mesh::sphere(320);
        let places = mesh.positions.len();
        let mut vertices = Vec::new();
        let mut triangles = Vec::new();
        for i in 0..count {
            let center = Vec3::from(mesh.positions[i * places / count]);
            let first = vertices.len() as u32;
            let own = ball.positions.iter().map(|&at| center + Vec3::from(at) * radius);
            vertices.extend(own.map(|at| at.to_array()));
            triangles.extend(ball.triangles.iter().map(|one| Triangle {
                corners: one.corners.map(|corner| corner + first),
                material: i as u32,
            }));
        }
        let aspect = SIZE.0 as f32 / SIZE.1 as f32;
        let camera = Framing { aspect, ..Framing::default() }.camera(mesh.bounds());
        let visible = visible(&mesh, &camera, SIZE.0, SIZE.1);
        Self { mesh, camera, visible, vertices, triangles }
    }
}

#[divan::bench(args = [64, 256])]
fn on_the_processor(bencher: Bencher<'_, '_>, count: usize) {
    let Scene { camera, visible, vertices, triangles, .. } = Scene::with_balls(count);
    let surfaces = ClosedSurfaces { vertices: &vertices, triangles: &triangles };
    let mut crossings = Crossings::default();
    bencher.bench_local(|| -> Field<i32> { crossings.sum(&Count, surfaces, &camera, &visible) });
}

#[divan::bench(args = [64, 256])]
fn weighed_on_the_processor(bencher: Bencher<'_, '_>, count: usize) {
    let Scene { camera, visible, vertices, triangles, .. } = Scene::with_balls(count);
    let weights: Vec<i32> = black_box((0..count as i32).map(|i| i * 1000 - 7).collect());
    let weighed = WeighedCount(|surface: u32, _| weights[surface as usize]);
    let surfaces = ClosedSurfaces { vertices: &vertices, triangles: &triangles };
    let mut crossings = Crossings::default();
    bencher.bench_local(|| -> Field<i32> { crossings.sum(&weighed, surfaces, &camera, &visible) });
}

/// Opens a device and draws the scene on it. `None` without an adapter.
fn on_a_device(scene: &Scene) -> Option<(Compute, Model, Image<Fragment>)> {
    let mut compute = Compute::choose(BackendChoice::Gpu).ok()?;
    let mut model = Model::new(&mut compute, PackedMesh::new(&scene.mesh)).unwrap();
    let visible = model.visible(&mut compute, &scene.camera, SIZE.0, SIZE.1).unwrap();
    compute.download(&visible).unwrap();
    Some((compute, model, visible))
}

#[divan::bench(args = [64, 256])]
fn in_the_stencil_of_a_device(bencher: Bencher<'_, '_>, count: usize) {
    let scene = Scene::with_balls(count);
    let Some((mut compute, model, visible)) = on_a_device(&scene) else { return };
    let surfaces = ClosedSurfaces { vertices: &scene.vertices, triangles: &scene.triangles };
    let mut counter = InsideCounter::default();
    bencher.bench_local(|| -> Field<i32> {
        let pictured = (&model, &visible);
        let counts = counter.counts(&mut compute, pictured, &scene.camera, surfaces).unwrap();
        compute.download(&counts).unwrap()
    });
}

#[divan::bench(args = [64, 256])]
fn weighed_on_a_device(bencher: Bencher<'_, '_>, count: usize) {
    let scene = Scene::with_balls(count);
    let Some((mut compute, _, visible)) = on_a_device(&scene) else { return };
    let surfaces = ClosedSurfaces { vertices: &scene.vertices, triangles: &scene.triangles };
    let weights: Vec<i32> = (0..count as i32).map(|i| i * 1000 - 7).collect();
    let mut counter = InsideCounter::default();
    bencher.bench_local(|| -> Field<i32> {
        let weighed = (surfaces, &weights[..]);
        let sums = counter.weighed(&mut compute, &visible, &scene.camera, weighed).unwrap();
        compute.download(&sums).unwrap()
    });
}

fn main() {
    divan::main();
}
