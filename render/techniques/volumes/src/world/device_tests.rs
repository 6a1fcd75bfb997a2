//! Worlds stepped on a device against the same worlds on the processor.

use glam::Vec3;
use graphics::compute::Compute;

use super::tests::{flat, is_exact, single};
use super::*;
use crate::motion::{KeepIn, Push};
use crate::test_device::device;
use crate::volume::Volume;

/// A world in which paint spills, a single volume is pushed, and a wall keeps both in.
fn busy() -> World {
    let mut world = flat();
    world.keep(KeepIn::Above { point: Vec3::X * 3.2, normal: Vec3::NEG_X }).unwrap();
    let recipe = Recipe::of_parts([3.0, 1.0, 0.0, 2.0, 0.0, 0.0, 0.5, 0.1, 2.0]).unwrap();
    for (x, rate) in [(2.2, 0.9), (-3.4, 0.5)] {
        let pour = Pour::at(Vec3::new(x, 0.0, 0.4), rate, 1.0, recipe);
        world.pour(pour).unwrap();
    }
    world.add_volume(&single(Vec3::new(0.0, 0.2, 3.0), 1.1)).unwrap();
    let center = Vec3::new(0.0, 0.5, 2.5);
    let direction = Vec3::new(0.6, 0.0, 0.8);
    world.push(Push { center, direction, radius: 2.0, strength: 20.0 }, 0.8).unwrap();
    world
}

fn distances(one: &Volume, other: &Volume) -> impl Iterator<Item = f32> {
    let pairs = one.vertices().zip(other.vertices());
    let radius = one.radius;
    pairs.map(move |(a, b)| Vec3::from(a).distance(Vec3::from(b)) / radius)
}

#[test]
fn a_world_on_a_device_has_the_same_paint_and_nearly_the_same_places() {
    let Some(compute) = device() else { return };
    let mut device = StepDevice::beside(&compute).above(0);
    let [mut own, mut other] = [busy(), busy()];
    let mut near = 0;
    let mut all = 0;
    for step in 0..300 {
        assert!(device.serves(&other) || step == 0);
        own.step().unwrap();
        other.step_on(&mut device).unwrap();
        assert_eq!(own.tally(), other.tally(), "step {step}");
        assert_eq!(own.volumes().len(), other.volumes().len(), "step {step}");
        for (own, other) in own.volumes().iter().zip(other.volumes()) {
            assert_eq!((own.paint, own.cell, own.center), (other.paint, other.cell, other.center));
            assert_eq!((own.radius, own.target_radius), (other.radius, other.target_radius));
        }
    }
    for (own, other) in own.volumes().iter().zip(other.volumes()) {
        for far in distances(own, other) {
            assert!(far < 0.05, "{far}");
            near += usize::from(far <= 1e-4);
            all += 1;
        }
    }
    assert!(own.volumes().len() > 30 && is_exact(&other));
    assert!(near * 100 >= all * 98, "{near} of {all}");
}

#[test]
fn small_worlds_and_those_without_a_device_are_stepped_on_the_processor() {
    let Some(compute) = device() else { return };
    let processor = Compute::cpu();
    let mut unused = [
        StepDevice::beside(&compute),
        StepDevice::new(compute),
        StepDevice::beside(&processor).above(0),
        StepDevice::new(processor).above(0),
    ];
    for device in &mut unused {
        let [mut own, mut other] = [busy(), busy()];
        assert!(!device.serves(&other));
        for _ in 0..40 {
            own.step().unwrap();
            other.step_on(device).unwrap();
        }
        assert_eq!(own.volumes(), other.volumes());
    }
}

#[test]
fn a_lost_device_is_an_error_and_no_paint_is_lost() {
    let Some(compute) = device() else { return };
    let mut device = StepDevice::new(compute).above(0);
    let mut world = busy();
    for _ in 0..90 {
        world.step_on(&mut device).unwrap();
    }
    let Some(closed) = crate::test_device::device().and_then(Compute::into_device) else { return };
    closed.close();
    let mut closed = StepDevice::new(Compute::gpu(closed)).above(0);
    let error = world.step_on(&mut closed).unwrap_err();
    let lost = matches!(error, WorldError::Device(_) | WorldError::Motion(_));
    assert!(lost && error.to_string().contains("the graphics device was lost"), "{error}");
    assert!(is_exact(&world));
    // It goes on elsewhere.
    world.step().unwrap();
    assert!(is_exact(&world));
}
