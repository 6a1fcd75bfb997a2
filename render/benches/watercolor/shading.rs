//! What is seen of a mesh, and its toon shading, at 750 x 570.

use divan::Bencher;
use render::camera::{Camera, Framing};
use render::gpu::{BackendChoice, choose};
use render::mesh::Mesh;
use render::surface::PackedMesh;
use render::watercolor::{Backend, OnCpu, OnGpu, Shading, Toon};

const TRIANGLES: [usize; 2] = [25_000, 160_000];

/// A turntable of the knot, which fills some third of the picture, twice over.
fn knot(triangles: usize) -> (Mesh, Vec<Camera>) {
    let mesh = Mesh::torus_knot(triangles);
    let framing = Framing { aspect: 750.0 / 570.0, ..Framing::default() };
    let cameras = framing.turntable(mesh.bounds(), 36);
    (mesh, cameras)
}

/// Frame by frame, in the picture's size times the samples.
fn frames<B: Shading>(
    bencher: Bencher<'_, '_>,
    mut backend: B,
    triangles: usize,
    samples: usize,
    shown: impl Fn(&mut B, &B::Model, B::VisibilityBuffer, &Camera),
) {
    let (mesh, cameras) = knot(triangles);
    let mut model = backend.model(PackedMesh::new(&mesh)).unwrap();
    let mut cameras = cameras.iter().cycle();
    bencher.bench_local(|| {
        let camera = cameras.next().unwrap();
        let visible = backend.seen(&mut model, camera, 750 * samples, 570 * samples).unwrap();
        shown(&mut backend, &model, visible, camera);
    });
}

#[divan::bench(args = TRIANGLES)]
fn seen_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    frames(bencher, OnCpu, triangles, 1, |_, _, visible, _| drop(divan::black_box(visible)));
}

#[divan::bench(args = TRIANGLES)]
fn toon_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    let toon = Toon::default();
    frames(bencher, OnCpu, triangles, 1, |backend, model, visible, camera| {
        drop(divan::black_box(backend.toon(model, &visible, camera, &toon).unwrap()));
    });
}

/// Four samples a pixel.
#[divan::bench(args = TRIANGLES)]
fn smooth_toon_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    let toon = Toon { samples: 2, ..Toon::default() };
    frames(bencher, OnCpu, triangles, 2, |backend, model, visible, camera| {
        drop(divan::black_box(backend.toon(model, &visible, camera, &toon).unwrap()));
    });
}

/// With the picture brought back, on any adapter; nothing without one.
#[divan::bench(args = TRIANGLES)]
fn toon_on_gpu(bencher: Bencher<'_, '_>, triangles: usize) {
    let Ok(Some(device)) = choose(BackendChoice::Gpu) else { return };
    let toon = Toon::default();
    frames(bencher, OnGpu::new(device), triangles, 1, |backend, model, visible, camera| {
        let color = backend.toon(model, &visible, camera, &toon).unwrap();
        drop(divan::black_box(backend.color_field(&color).unwrap()));
    });
}
