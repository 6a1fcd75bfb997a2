//! Coherent noise for a frame of 750 x 570 pixels and 60,000 triangles: flow and dispersion, from
//! a visible surface to both noises.

use std::sync::Arc;

use divan::Bencher;
use graphics::camera::{Camera, Framing};
use graphics::coherence::{
    AnchoredNoise, FeatureNoise, Features, Hierarchy, Particles, Projection, depth_field,
    draw_anchored, draw_splats, repeating_noise,
};
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::gpu::BackendChoice;
use graphics::mesh::Mesh;
use graphics::surface::visible;

const SIZE: (usize, usize) = (750, 570);

struct Frame {
    mesh: Mesh,
    hierarchy: Arc<Hierarchy>,
    projection: Projection,
    depth: Field<f32>,
}

fn frame() -> Frame {
    let mesh = Mesh::torus_knot(60_000);
    let (width, height) = SIZE;
    let framing = Framing { aspect: width as f32 / height as f32, ..Framing::default() };
    let camera: Camera = framing.camera(mesh.bounds());
    let depth = depth_field(&visible(&mesh, &camera, width, height));
    let hierarchy = Arc::new(Hierarchy::new(&mesh));
    Frame { mesh, hierarchy, projection: Projection::new(&camera, width, height), depth }
}

/// The hierarchy of patches, built once for each model.
#[divan::bench]
fn hierarchy(bencher: Bencher<'_, '_>) {
    let frame = frame();
    bencher.bench_local(|| Hierarchy::new(&frame.mesh));
}

/// The selection of features, which runs on the CPU for both backends.
#[divan::bench]
fn features_of_a_view(bencher: Bencher<'_, '_>) {
    let frame = frame();
    let features = Features::new(frame.hierarchy.clone(), 1);
    bencher.bench_local(|| {
        [FeatureNoise::FLOW, FeatureNoise::DISPERSION]
            .map(|noise| features.splats(&frame.projection, noise))
    });
}

fn features(bencher: Bencher<'_, '_>, compute: &mut Compute) {
    let frame = frame();
    let features = Features::new(frame.hierarchy.clone(), 1);
    let depth = compute.upload(&frame.depth).unwrap();
    bencher.bench_local(|| {
        [FeatureNoise::FLOW, FeatureNoise::DISPERSION].map(|noise| {
            let drawn = draw_splats(compute, &depth, &features.splats(&frame.projection, noise));
            compute.download(&drawn.unwrap()).unwrap()
        })
    });
}

fn particles(bencher: Bencher<'_, '_>, compute: &mut Compute, count: usize) {
    let frame = frame();
    let particles = Particles::new(&frame.hierarchy, count);
    let depth = compute.upload(&frame.depth).unwrap();
    let textures = [(32, AnchoredNoise::FLOW), (8, AnchoredNoise::DISPERSION)]
        .map(|(wave, noise)| (compute.upload(&repeating_noise(wave, 1)).unwrap(), noise));
    bencher.bench_local(|| {
        for (texture, noise) in &textures {
            let anchors = particles.anchors(&frame.projection, *noise);
            let drawn = draw_anchored(compute, &depth, texture, &anchors).unwrap();
            divan::black_box(compute.download(&drawn).unwrap());
        }
    });
}

#[divan::bench]
fn features_on_cpu(bencher: Bencher<'_, '_>) {
    features(bencher, &mut Compute::cpu());
}

#[divan::bench]
fn features_on_gpu(bencher: Bencher<'_, '_>) {
    let Ok(mut gpu) = Compute::choose(BackendChoice::Gpu) else { return };
    features(bencher, &mut gpu);
}

#[divan::bench(args = [6, 64])]
fn particles_on_cpu(bencher: Bencher<'_, '_>, count: usize) {
    particles(bencher, &mut Compute::cpu(), count);
}

#[divan::bench(args = [6, 64])]
fn particles_on_gpu(bencher: Bencher<'_, '_>, count: usize) {
    let Ok(mut gpu) = Compute::choose(BackendChoice::Gpu) else { return };
    particles(bencher, &mut gpu, count);
}
