//! Visibility of a mesh and its toon shading, at 750 x 570 pixels.

use divan::Bencher;
use graphics::camera::{Camera, Framing};
use graphics::compute::{Compute, Image};
use graphics::gpu::BackendChoice;
use graphics::mesh::Mesh;
use graphics::surface::{Fragment, Model, PackedMesh};
use watercolor::{Toon, shade_toon};

const TRIANGLES: [usize; 2] = [25_000, 160_000];

/// A torus knot and the cameras of a turntable. The knot covers about a third of the picture, with
/// an overdraw of about two.
fn knot(triangles: usize) -> (Mesh, Vec<Camera>) {
    let mesh = Mesh::torus_knot(triangles);
    let framing = Framing { aspect: 750.0 / 570.0, ..Framing::default() };
    let cameras = framing.turntable(mesh.bounds(), 36);
    (mesh, cameras)
}

/// Times one frame of the turntable at `samples` times 750 x 570.
fn frames(
    bencher: Bencher<'_, '_>,
    mut compute: Compute,
    triangles: usize,
    samples: usize,
    shade: impl Fn(&mut Compute, &Model, Image<Fragment>, &Camera),
) {
    let (mesh, cameras) = knot(triangles);
    let mut model = Model::new(&mut compute, PackedMesh::new(&mesh)).unwrap();
    let mut cameras = cameras.iter().cycle();
    bencher.bench_local(|| {
        let camera = cameras.next().unwrap();
        let size = (750 * samples, 570 * samples);
        let visible = model.visible(&mut compute, camera, size.0, size.1).unwrap();
        shade(&mut compute, &model, visible, camera);
    });
}

#[divan::bench(args = TRIANGLES)]
fn seen_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    frames(bencher, Compute::cpu(), triangles, 1, |_, _, visible, _| {
        drop(divan::black_box(visible));
    });
}

#[divan::bench(args = TRIANGLES)]
fn toon_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    let toon = Toon::default();
    frames(bencher, Compute::cpu(), triangles, 1, |compute, model, visible, camera| {
        drop(divan::black_box(shade_toon(compute, model, &visible, camera, &toon, None).unwrap()));
    });
}

/// Four samples per pixel.
#[divan::bench(args = TRIANGLES)]
fn smooth_toon_on_cpu(bencher: Bencher<'_, '_>, triangles: usize) {
    let toon = Toon { samples: 2, ..Toon::default() };
    frames(bencher, Compute::cpu(), triangles, 2, |compute, model, visible, camera| {
        drop(divan::black_box(shade_toon(compute, model, &visible, camera, &toon, None).unwrap()));
    });
}

/// Includes the download of the picture. Uses any adapter; does nothing without one.
#[divan::bench(args = TRIANGLES)]
fn toon_on_gpu(bencher: Bencher<'_, '_>, triangles: usize) {
    let Ok(compute) = Compute::choose(BackendChoice::Gpu) else { return };
    let toon = Toon::default();
    frames(bencher, compute, triangles, 1, |compute, model, visible, camera| {
        let color = shade_toon(compute, model, &visible, camera, &toon, None).unwrap();
        drop(divan::black_box(compute.download(&color).unwrap()));
    });
}
