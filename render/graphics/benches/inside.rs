//! Counting of the closed surfaces that hold each visible point, at 750 x 570 pixels.

use std::hint::black_box;

use divan::Bencher;
use glam::Vec3;
use graphics::camera::{Camera, Framing};
use graphics::field::Field;
use graphics::mesh::{Mesh, Triangle};
use graphics::surface::{
    ClosedSurfaces, Count, Crossings, VisibilityBuffer, WeighedCount, visible,
};

const SIZE: (usize, usize) = (750, 570);

/// The still life with balls of about 320 faces, evenly over its vertices.
struct Scene {
    camera: Camera,
    visible: VisibilityBuffer,
    vertices: Vec<[f32; 3]>,
    triangles: Vec<Triangle>,
}

impl Scene {
    fn with_balls(count: usize) -> Self {
        let mesh = Mesh::still_life(60_000);
        let [low, high] = mesh.bounds();
        let radius = (high - low).max_element() / 12.0 * 0.8;
        let (ball, places) = (Mesh::sphere(320), mesh.positions.len());
        let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
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
        Self { camera, visible, vertices, triangles }
    }
}

#[divan::bench(args = [64, 256])]
fn on_the_processor(bencher: Bencher<'_, '_>, count: usize) {
    let Scene { camera, visible, vertices, triangles } = Scene::with_balls(count);
    let surfaces = ClosedSurfaces { vertices: &vertices, triangles: &triangles };
    let mut crossings = Crossings::default();
    bencher.bench_local(|| -> Field<i32> { crossings.sum(&Count, surfaces, &camera, &visible) });
}

#[divan::bench(args = [64, 256])]
fn weighed_on_the_processor(bencher: Bencher<'_, '_>, count: usize) {
    let Scene { camera, visible, vertices, triangles } = Scene::with_balls(count);
    let weights: Vec<i32> = black_box((0..count as i32).map(|i| i * 1000 - 7).collect());
    let weighed = WeighedCount(|surface: u32, _| weights[surface as usize]);
    let surfaces = ClosedSurfaces { vertices: &vertices, triangles: &triangles };
    let mut crossings = Crossings::default();
    bencher.bench_local(|| -> Field<i32> { crossings.sum(&weighed, surfaces, &camera, &visible) });
}

fn main() {
    divan::main();
}
