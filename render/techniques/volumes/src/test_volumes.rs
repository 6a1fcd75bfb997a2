//! Volumes, scenes and surfaces for tests. Also a graphics device for tests, and how far its
//! pictures may be from the processor's.

use std::io::Write;

use glam::{DVec3, Vec3};
use graphics::camera::Camera;
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::gpu::{BackendChoice, choose};
use graphics::mesh::{Material, Mesh, Triangle};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::volume::Volume;

/// A volume with bumps of a third of its radius. Its vertices also lie beside their resting
/// directions. It is star-shaped.
pub(crate) fn bumpy(center: Vec3, radius: f32, detail: u8, seed: u64) -> Volume {
    let random = &mut ChaCha8Rng::seed_from_u64(seed);
    let mut volume = Volume::ball(center, radius, detail, seed);
    let waves = [(); 3].map(|()| DVec3::from([(); 3].map(|()| random.random_range(-1.0_f64..1.0))));
    let shift = 0.5 / f64::from(1 << detail);
    let [x, y, z] = &mut volume.particles.places;
    for i in 0..x.len() {
        let place = Vec3::new(x[i], y[i], z[i]).as_dvec3();
        let along = place.normalize();
        let [a, b, c] = waves.map(|wave| (wave.dot(along) * 5.0).sin());
        let times = 1.0 + 0.11 * (a + b + c);
        let aside = DVec3::new(b, c, a) * 0.3 * shift;
        let moved = ((along + aside) * place.length() * times).as_vec3();
        [x[i], y[i], z[i]] = moved.to_array();
    }
    for face in volume.mesh().faces.iter().take(200) {
        let [a, b, c] = face
            .map(|i: u32| volume.vertices().nth(i as usize).map(Vec3::from).unwrap() - center)
            .map(Vec3::as_dvec3);
        assert!(a.cross(b).dot(c) > 0.0, "a cone is turned inside out");
    }
    volume
}

/// A plane from (0, 0, 0) to (4, 4, 0) that faces along z, of `2 * count * count` triangles.
pub(crate) fn plane(count: usize) -> Mesh {
    let side = count + 1;
    let places = (0..side * side)
        .map(|i: usize| [i % side, i / side].map(|at| 4.0 * at as f32 / count as f32));
    let squares = (0..count * count).map(|i| (i % count + i / count * side) as u32);
    let right = 1;
    let up = side as u32;
    Mesh {
        texture_coordinates: places.clone().map(|at| at.map(|value| value / 4.0)).collect(),
        colors: vec![[1.0; 3]; side * side],
        normals: vec![[0.0, 0.0, 1.0]; side * side],
        triangles: squares
            .flat_map(|a: u32| {
                let corners = [[a, a + right, a + right + up], [a, a + right + up, a + up]];
                corners.map(|corners| Triangle { corners, material: 0 })
            })
            .collect(),
        materials: vec![Material::plain([1.0; 3])],
        positions: places.map(|[x, y]| [x, y, 0.0]).collect(),
    }
}

/// Looks at the middle of [`plane`] from a distance, turned about the vertical by some degrees.
pub(crate) fn camera(turned_deg: f32, distance: f32) -> Camera {
    let target = Vec3::new(2.0, 2.0, 0.0);
    let (sin, cos) = turned_deg.to_radians().sin_cos();
    let eye = target + distance * Vec3::new(sin, 0.0, cos);
    let up = Vec3::Y;
    Camera { eye, target, up, field_of_view_deg: 40.0, near: 0.05 * distance, far: 3.0 * distance }
}

/// A mesh of plain triangles. Its normals point up.
pub(crate) fn bare(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Mesh {
    let count = positions.len();
    Mesh {
        positions: positions.to_vec(),
        normals: vec![[0.0, 1.0, 0.0]; count],
        texture_coordinates: vec![[0.0; 2]; count],
        colors: vec![[1.0; 3]; count],
        triangles: triangles.iter().map(|&corners| Triangle { corners, material: 0 }).collect(),
        materials: vec![Material::plain([1.0; 3])],
    }
}

/// A sheet of `squares` by `squares` squares. `at(u, v)` gives the places for u and v in 0..1.
pub(crate) fn sheet(squares: u32, at: impl Fn(f32, f32) -> [f32; 3]) -> Mesh {
    let row = squares + 1;
    let shares =
        (0..row * row).map(|i: u32| [i % row, i / row].map(|steps| steps as f32 / squares as f32));
    let points: Vec<_> = shares.map(|[u, v]| at(u, v)).collect();
    let firsts = (0..squares * squares).map(|i| i / squares * row + i % squares);
    let triangles: Vec<[u32; 3]> =
        firsts.flat_map(|a| [[a, a + row + 1, a + 1], [a, a + row, a + row + 1]]).collect();
    bare(&points, &triangles)
}

pub(crate) fn joined(mut one: Mesh, other: &Mesh) -> Mesh {
    let first = one.positions.len() as u32;
    one.positions.extend(&other.positions);
    one.normals.extend(&other.normals);
    one.texture_coordinates.extend(&other.texture_coordinates);
    one.colors.extend(&other.colors);
    one.triangles.extend(other.triangles.iter().map(|triangle| Triangle {
        corners: triangle.corners.map(|corner| corner + first),
        material: triangle.material,
    }));
    one
}

/// A device, hardware before software. Without an adapter you get `None`, with a note on standard
/// error. If you set the environment variable `IMPASTO_GPU_TESTS`, this appends the name of the
/// adapter (or `none`) to the file with that name.
pub(crate) fn device() -> Option<Compute> {
    let device = choose(BackendChoice::Gpu).ok().flatten();
    let name = device.as_ref().map_or("none", |device| &device.adapter().name);
    if let Some(path) = std::env::var_os("IMPASTO_GPU_TESTS") {
        let mut list = std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap();
        writeln!(list, "{name}").unwrap();
    }
    if device.is_none() {
        let _ = writeln!(std::io::stderr(), "no graphics adapter: not tested");
    }
    device.map(Compute::gpu)
}

/// Greatest difference of two pictures, and the share of pixels that differ by more than 1/255.
pub(crate) fn far(one: &Field<[f32; 4]>, other: &Field<[f32; 4]>) -> (f32, f32) {
    assert_eq!((one.width(), one.height()), (other.width(), other.height()));
    let mut most = 0.0_f32;
    let mut over = 0;
    for (a, b) in one.values().iter().zip(other.values()) {
        let off = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(off.is_finite(), "{a:?} {b:?}");
        most = most.max(off);
        over += usize::from(off > 1.0 / 255.0);
    }
    (most, over as f32 / one.values().len().max(1) as f32)
}
