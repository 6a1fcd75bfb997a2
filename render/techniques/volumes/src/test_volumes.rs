//! Volumes and scenes for tests.

use glam::{DVec3, Vec3};
use graphics::camera::Camera;
use graphics::mesh::{Material, Mesh, Triangle};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::volume::Volume;

/// A volume with bumps of a third of its radius, whose vertices also lie beside their resting
/// directions. It is star-shaped.
pub(crate) fn bumpy(center: Vec3, radius: f32, detail: u8, seed: u64) -> Volume {
    let random = &mut ChaCha8Rng::seed_from_u64(seed);
    let mut volume = Volume::ball(center, radius, detail, seed);
    let mut axis = || random.random_range(-1.0_f64..1.0);
    let waves: [DVec3; 3] = std::array::from_fn(|_| DVec3::new(axis(), axis(), axis()));
    let shift = 0.5 / f64::from(1 << detail);
    let sway = |along: DVec3| {
        let phases = waves.map(|wave| wave.dot(along) * 5.0);
        let [a, b, c] = phases.map(f64::sin);
        (1.0 + 0.11 * (a + b + c), DVec3::new(b, c, a) * 0.3 * shift)
    };
    let [x, y, z] = &mut volume.particles.places;
    for i in 0..x.len() {
        let place = Vec3::new(x[i], y[i], z[i]).as_dvec3();
        let along = place.normalize();
        let (times, aside) = sway(along);
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
    let at = |i: usize| [i % side, i / side].map(|at| 4.0 * at as f32 / count as f32);
    let positions: Vec<[f32; 3]> = (0..side * side).map(|i| [at(i)[0], at(i)[1], 0.0]).collect();
    let squares = (0..count * count).map(|i| (i % count + i / count * side) as u32);
    let right = 1;
    let up = side as u32;
    Mesh {
        texture_coordinates: (0..side * side).map(|i| at(i).map(|value| value / 4.0)).collect(),
        colors: vec![[1.0; 3]; side * side],
        normals: vec![[0.0, 0.0, 1.0]; side * side],
        triangles: squares
            .flat_map(|a: u32| {
                let corners = [[a, a + right, a + right + up], [a, a + right + up, a + up]];
                corners.map(|corners| Triangle { corners, material: 0 })
            })
            .collect(),
        materials: vec![Material::plain([1.0; 3])],
        positions,
    }
}

/// A camera that looks at the middle of [`plane`] from a distance, turned about the vertical by
/// some degrees.
pub(crate) fn camera(turned_deg: f32, distance: f32) -> Camera {
    let target = Vec3::new(2.0, 2.0, 0.0);
    let (sin, cos) = turned_deg.to_radians().sin_cos();
    let eye = target + distance * Vec3::new(sin, 0.0, cos);
    let up = Vec3::Y;
    Camera { eye, target, up, field_of_view_deg: 40.0, near: 0.05 * distance, far: 3.0 * distance }
}
