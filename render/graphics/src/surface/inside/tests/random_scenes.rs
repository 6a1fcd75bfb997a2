//! Random scenes against the oracle.

use glam::Vec3;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::scene::{Found, Scene, mesh_of};
use super::shapes::Surfaces;
use crate::camera::Camera;
use crate::mesh::Mesh;

fn place(random: &mut impl Rng, reach: f32) -> Vec3 {
    Vec3::from_array(std::array::from_fn(|_| random.random_range(-reach..reach)))
}

/// A knot and loose triangles, with 1 to 40 closed surfaces among them, seen from anywhere.
pub(crate) fn random_scene(seed: u64) -> Scene {
    let random = &mut ChaCha8Rng::seed_from_u64(seed);
    let loose: Vec<[Vec3; 3]> =
        (0..25).map(|_| std::array::from_fn(|_| place(random, 1.5))).collect();
    let mut mesh = mesh_of(&loose);
    let knot = Mesh::torus_knot(1200);
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(&knot.positions);
    mesh.triangles.extend(knot.triangles.iter().map(|&one| crate::mesh::Triangle {
        corners: one.corners.map(|corner| corner + first),
        ..one
    }));
    let mut surfaces = Surfaces::default();
    for _ in 0..random.random_range(1..=40) {
        let radius = random.random_range(0.2..0.8);
        surfaces.add_bumpy(place(random, 1.5), radius, random);
    }
    let camera = Camera {
        eye: place(random, 2.0),
        target: place(random, 0.5),
        up: Vec3::Y,
        field_of_view_deg: random.random_range(25.0..90.0),
        near: random.random_range(0.01..0.2),
        far: random.random_range(2.0..8.0),
    };
    Scene { mesh, surfaces, camera, size: (97, 61) }
}

fn compared(seeds: std::ops::Range<u64>) -> Found {
    let found = seeds.map(|seed| {
        let found = random_scene(seed).compared();
        assert_eq!(found.wrong, 0, "scene {seed}: {found:?}");
        found
    });
    found.fold(Found::default(), Found::and)
}

#[test]
fn counts_of_two_hundred_scenes_are_winding_numbers() {
    let found = compared(0..200);
    assert!(found.samples > 400_000 && found.most >= 5, "{found:?}");
    assert!(found.differ * 1000 <= found.samples, "{found:?}");
}
