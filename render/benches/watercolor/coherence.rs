//! Noise that stays on its object, a frame of 750 x 570 and 60,000 triangles: flow
//! and dispersion both, from what is seen to both noises.

use std::sync::Arc;

use divan::Bencher;
use render::camera::{Camera, Framing};
use render::field::Field;
use render::gpu::{BackendChoice, choose};
use render::mesh::Mesh;
use render::surface::visible;
use render::watercolor::coherence::{
    AnchoredNoise, Anchoring, FeatureNoise, Features, Hierarchy, Particles, Projection, Splatting,
    depth_field, repeating_noise,
};
use render::watercolor::{OnCpu, OnGpu};

const SIZE: (usize, usize) = (750, 570);

struct Frame {
    mesh: Mesh,
    hierarchy: Arc<Hierarchy>,
    sight: Projection,
    depth: Field<f32>,
}

fn frame() -> Frame {
    let mesh = Mesh::torus_knot(60_000);
    let (width, height) = SIZE;
    let framing = Framing { aspect: width as f32 / height as f32, ..Framing::default() };
    let camera: Camera = framing.camera(mesh.bounds());
    let depth = depth_field(&visible(&mesh, &camera, width, height));
    let hierarchy = Arc::new(Hierarchy::new(&mesh));
    Frame { mesh, hierarchy, sight: Projection::new(&camera, width, height), depth }
}

/// Once for each model.
#[divan::bench]
fn hierarchy(bencher: Bencher<'_, '_>) {
    let frame = frame();
    bencher.bench_local(|| Hierarchy::new(&frame.mesh));
}

/// What is decided above the backends, for features.
#[divan::bench]
fn features_of_a_view(bencher: Bencher<'_, '_>) {
    let frame = frame();
    let features = Features::new(frame.hierarchy.clone(), 1);
    bencher.bench_local(|| {
        [FeatureNoise::FLOW, FeatureNoise::DISPERSION]
            .map(|noise| features.splats(&frame.sight, noise))
    });
}

fn features<B: Splatting>(bencher: Bencher<'_, '_>, backend: &mut B) {
    let frame = frame();
    let features = Features::new(frame.hierarchy.clone(), 1);
    let depth = backend.grey_of(&frame.depth).unwrap();
    bencher.bench_local(|| {
        [FeatureNoise::FLOW, FeatureNoise::DISPERSION].map(|noise| {
            let drawn = backend.splatted(&depth, &features.splats(&frame.sight, noise));
            backend.grey_field(&drawn.unwrap()).unwrap()
        })
    });
}

fn particles<B: Anchoring>(bencher: Bencher<'_, '_>, backend: &mut B, count: usize) {
    let frame = frame();
    let particles = Particles::new(&frame.hierarchy, count);
    let depth = backend.grey_of(&frame.depth).unwrap();
    let textures = [(32, AnchoredNoise::FLOW), (8, AnchoredNoise::DISPERSION)]
        .map(|(wave, noise)| (backend.grey_of(&repeating_noise(wave, 1)).unwrap(), noise));
    bencher.bench_local(|| {
        for (texture, noise) in &textures {
            let anchors = particles.anchors(&frame.sight, *noise);
            let drawn = backend.anchored(&depth, texture, &anchors).unwrap();
            divan::black_box(backend.grey_field(&drawn).unwrap());
        }
    });
}

#[divan::bench]
fn features_on_cpu(bencher: Bencher<'_, '_>) {
    features(bencher, &mut OnCpu);
}

#[divan::bench]
fn features_on_gpu(bencher: Bencher<'_, '_>) {
    let Some(device) = choose(BackendChoice::Gpu).unwrap() else { return };
    features(bencher, &mut OnGpu::new(device));
}

#[divan::bench(args = [6, 64])]
fn particles_on_cpu(bencher: Bencher<'_, '_>, count: usize) {
    particles(bencher, &mut OnCpu, count);
}

#[divan::bench(args = [6, 64])]
fn particles_on_gpu(bencher: Bencher<'_, '_>, count: usize) {
    let Some(device) = choose(BackendChoice::Gpu).unwrap() else { return };
    particles(bencher, &mut OnGpu::new(device), count);
}
