//! Whole pictures of a mesh of 750 x 570, from another side each time: seen, shaded,
//! noise, all effects, and read back.

use divan::Bencher;
use render::camera::{Camera, Framing};
use render::gpu::{BackendChoice, choose};
use render::mesh::Mesh;
use render::watercolor::{CoherenceMethod, ModelPainter, MovingBackend, OnCpu, OnGpu, Settings};

const SIZE: (usize, usize) = (750, 570);

/// A painter of a knot, and the cameras around it.
fn painter<B: MovingBackend>(
    backend: &mut B,
    triangles: usize,
    method: CoherenceMethod,
) -> (ModelPainter<B>, Vec<Camera>) {
    let mesh = Mesh::torus_knot(triangles);
    let framing = Framing { aspect: SIZE.0 as f32 / SIZE.1 as f32, ..Framing::default() };
    let cameras = framing.fit_turntable(&mesh.positions, 60);
    let mut settings = Settings::default();
    settings.coherence.method = method;
    let settings = settings.for_size(SIZE.0, SIZE.1);
    (ModelPainter::new(backend, mesh, settings, SIZE, 1).unwrap(), cameras)
}

fn frames<B: MovingBackend>(
    bencher: Bencher<'_, '_>,
    mut backend: B,
    triangles: usize,
    method: CoherenceMethod,
) {
    let (mut painter, cameras) = painter(&mut backend, triangles, method);
    let mut around = cameras.iter().cycle();
    bencher.bench_local(|| {
        let camera = around.next().unwrap();
        let color = painter.frame(&mut backend, camera, None).unwrap();
        backend.color_field(&color).unwrap()
    });
}

fn on_gpu(bencher: Bencher<'_, '_>, triangles: usize, method: CoherenceMethod) {
    if let Some(device) = choose(BackendChoice::Gpu).ok().flatten() {
        frames(bencher, OnGpu::new(device), triangles, method);
    }
}

#[divan::bench(args = [25_000, 160_000], sample_count = 60)]
fn still_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    frames(bencher, OnCpu, triangles, CoherenceMethod::Static);
}

#[divan::bench(args = [25_000, 160_000], sample_count = 20)]
fn still_on_gpu(bencher: Bencher<'_, '_>, triangles: usize) {
    on_gpu(bencher, triangles, CoherenceMethod::Static);
}

#[divan::bench(args = [60_000], sample_count = 60)]
fn features_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    frames(bencher, OnCpu, triangles, CoherenceMethod::Features);
}

#[divan::bench(args = [60_000], sample_count = 20)]
fn features_on_gpu(bencher: Bencher<'_, '_>, triangles: usize) {
    on_gpu(bencher, triangles, CoherenceMethod::Features);
}

#[divan::bench(args = [60_000], sample_count = 60)]
fn particles_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    frames(bencher, OnCpu, triangles, CoherenceMethod::Particles);
}

#[divan::bench(args = [60_000], sample_count = 20)]
fn particles_on_gpu(bencher: Bencher<'_, '_>, triangles: usize) {
    on_gpu(bencher, triangles, CoherenceMethod::Particles);
}
