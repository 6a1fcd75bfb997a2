//! Volumes for tests.

use glam::{DVec3, Vec3};
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
    let places = |i: u32| volume.vertices().nth(i as usize).map(Vec3::from).unwrap() - center;
    for face in volume.mesh().faces.iter().take(200) {
        let [a, b, c] = face.map(places).map(Vec3::as_dvec3);
        assert!(a.cross(b).dot(c) > 0.0, "a cone is turned inside out");
    }
    volume
}
