//! Whole pictures of a mesh at 750 x 570 pixels, each from another direction: visibility, shading,
//! noise, all effects, and readback.

use divan::Bencher;
use graphics::camera::{Camera, CameraPath, Framing};
use graphics::compute::Compute;
use graphics::gpu::BackendChoice;
use graphics::mesh::Mesh;
use watercolor::{CoherenceMethod, ModelPainter, Settings};

const SIZE: (usize, usize) = (750, 570);

/// A painter of a torus knot with one sample per pixel, and the cameras of a turntable.
fn painter(
    compute: Compute,
    triangles: usize,
    method: CoherenceMethod,
) -> (ModelPainter, Vec<Camera>) {
    let mesh = Mesh::torus_knot(triangles);
    let framing = Framing { aspect: SIZE.0 as f32 / SIZE.1 as f32, ..Framing::default() };
    let cameras = framing.fit_turntable(&mesh.positions, 60);
    let mut settings = Settings::default();
    settings.coherence.method = method;
    let painter = ModelPainter::new(compute, mesh, &settings, SIZE).unwrap();
    (painter.with_samples(1), cameras)
}

fn frames(bencher: Bencher<'_, '_>, compute: Compute, triangles: usize, method: CoherenceMethod) {
    let (mut painter, cameras) = painter(compute, triangles, method);
    let mut around = cameras.iter().cycle();
    bencher.bench_local(|| painter.paint(around.next().unwrap()).unwrap());
}

fn on_gpu(bencher: Bencher<'_, '_>, triangles: usize, method: CoherenceMethod) {
    if let Ok(compute) = Compute::choose(BackendChoice::Gpu) {
        frames(bencher, compute, triangles, method);
    }
}

#[divan::bench(args = [25_000, 160_000], sample_count = 60)]
fn still_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    frames(bencher, Compute::cpu(), triangles, CoherenceMethod::Static);
}

#[divan::bench(args = [25_000, 160_000], sample_count = 20)]
fn still_on_gpu(bencher: Bencher<'_, '_>, triangles: usize) {
    on_gpu(bencher, triangles, CoherenceMethod::Static);
}

#[divan::bench(args = [60_000], sample_count = 60)]
fn features_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    frames(bencher, Compute::cpu(), triangles, CoherenceMethod::Features);
}

#[divan::bench(args = [60_000], sample_count = 20)]
fn features_on_gpu(bencher: Bencher<'_, '_>, triangles: usize) {
    on_gpu(bencher, triangles, CoherenceMethod::Features);
}

#[divan::bench(args = [60_000], sample_count = 60)]
fn particles_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    frames(bencher, Compute::cpu(), triangles, CoherenceMethod::Particles);
}

#[divan::bench(args = [60_000], sample_count = 20)]
fn particles_on_gpu(bencher: Bencher<'_, '_>, triangles: usize) {
    on_gpu(bencher, triangles, CoherenceMethod::Particles);
}

/// From the edge of the table into the still life, so that single fruits fill the picture.
const NEAR: &str = "
frames = 20
[[keyframe]]
eye = [0.9, 1.2, 2.2]
target = [0.0, 0.6, 0.0]
[[keyframe]]
eye = [1.6, 1.3, 1.6]
target = [0.0, 0.6, 0.0]
";

/// A camera that passes near a still life, 1000 x 750 pixels, as `impasto watercolor
/// shape:still-life --camera` paints it: 4 samples a pixel, cast shadows, and noise that stays on
/// its object.
fn near(bencher: Bencher<'_, '_>, compute: Compute) {
    let mesh = Mesh::still_life(60_000);
    let cameras = CameraPath::from_text("near", NEAR).unwrap().cameras(mesh.bounds());
    let mut painter = ModelPainter::new(compute, mesh, &Settings::default(), (1000, 750)).unwrap();
    let mut along = cameras.iter().cycle();
    bencher.bench_local(|| painter.paint(along.next().unwrap()).unwrap());
}

#[divan::bench(sample_count = 20)]
fn near_on_cpu(bencher: Bencher<'_, '_>) {
    near(bencher, Compute::cpu());
}

#[divan::bench(sample_count = 20)]
fn near_on_gpu(bencher: Bencher<'_, '_>) {
    if let Ok(compute) = Compute::choose(BackendChoice::Gpu) {
        near(bencher, compute);
    }
}
