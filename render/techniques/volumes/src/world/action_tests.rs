//! What lifting and pushing leave as it is.

use glam::Vec3;

use super::tests::{flat, is_exact, level, run, single};
use super::*;
use crate::motion::{MotionSettings, Push};

#[test]
fn a_sponge_takes_the_paint_below_it() {
    let mut world = flat();
    world.pour(Pour::at(Vec3::ZERO, 0.6, 1.0, Recipe::of_slot(0))).unwrap();
    run(&mut world, 400);
    let amounts = |world: &World| -> Vec<u32> {
        world.volumes().iter().map(|volume| volume.paint.volume()).collect()
    };
    let before = amounts(&world);
    // All that lies below, in one step.
    let middle = Vec3::new(0.2, 0.0, 0.1);
    let radius = 1.3;
    let lift = Lift { track: Track::at(middle), radius, rate: 120.0, for_s: 1.0 / 120.0 };
    world.lift(lift).unwrap();
    world.take_up();
    assert!(is_exact(&world));
    for (volume, before) in world.volumes().iter().zip(&before) {
        let far = volume.center.distance(middle) > radius + volume.radius;
        assert!(!far || volume.paint.volume() == *before, "{}", volume.center);
    }
    // Films of 0.02 mm over a disk.
    let lifted = world.tally().lifted[0] as f64 * world.quantum_mm3();
    let disk = std::f64::consts::PI * f64::from(radius * radius) * 0.02;
    assert!((lifted / disk - 1.0).abs() < 0.15, "{lifted} of {disk}");
}

#[test]
fn a_push_ends_and_its_volume_returns() {
    // Pulled to the surface, particles may come to rest at other samples.
    let motion = MotionSettings { surface_pull: 0.0, ..MotionSettings::default() };
    let settings = WorldSettings { motion, ..*flat().settings() };
    let mut world = World::of(&level(12.0, 0.0), &settings).unwrap();
    world.add_volume(&single(Vec3::ZERO, 1.5)).unwrap();
    run(&mut world, 1200);
    let before: Vec<[f32; 3]> = world.volumes()[0].vertices().collect();
    let farthest = |world: &World| {
        let places = world.volumes()[0].vertices().zip(&before);
        let apart = places.map(|(now, before)| Vec3::from(now).distance(Vec3::from(*before)));
        apart.fold(0.0, f32::max)
    };
    let push = Push { center: Vec3::ZERO, direction: Vec3::X, radius: 3.0, strength: 60.0 };
    world.push(push, 0.1).unwrap();
    run(&mut world, 12);
    assert!(farthest(&world) > 0.05, "{}", farthest(&world));
    run(&mut world, 1200);
    assert!(farthest(&world) < 1e-3, "{}", farthest(&world));
}
