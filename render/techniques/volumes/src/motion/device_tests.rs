//! Compares motion on a device with motion on the processor.

use std::sync::Arc;

use glam::Vec3;
use graphics::gpu::Device;

use super::*;
use crate::test_volumes::device;
use crate::volume::Volume;

const STEP: f32 = 1.0 / 120.0;

fn opened() -> Option<Device> {
    device()?.into_device()
}

/// Kicked volumes of these levels of detail, which grow side by side. The first is at the origin.
/// Every second one goes to another place.
fn row(details: &[u8]) -> Vec<Volume> {
    details
        .iter()
        .enumerate()
        .map(|(i, &detail): (usize, &u8)| {
            let center = Vec3::new(i as f32, 0.1 * i as f32, 0.0);
            let mut ball = Volume::ball(center, 0.4, detail, 7 + i as u64);
            ball.target_radius = 0.6;
            ball.target_center += Vec3::new(0.1, 0.0, -0.2) * (i % 2) as f32;
            ball.normal = Vec3::Y;
            kick(&mut ball, 0.3, 0);
            ball
        })
        .collect()
}

/// Surroundings with gravity down a slope, three regions that cut into the row, and a push.
fn busy() -> Surroundings {
    let low = Vec3::new(-0.35, -0.4, -0.5);
    Surroundings {
        down: Vec3::new(0.6, -0.8, 0.0),
        regions: vec![
            KeepIn::Box { low, high: Vec3::new(9.0, 0.9, 0.5) },
            KeepIn::Ball { center: Vec3::new(2.0, 0.0, 0.0), radius: 3.0 },
            KeepIn::Above { point: Vec3::new(0.0, -0.3, 0.0), normal: Vec3::Y },
        ],
        pushes: vec![Push {
            center: Vec3::new(1.2, 0.5, 0.0),
            direction: Vec3::new(0.0, -0.6, 0.8),
            radius: 0.9,
            strength: 30.0,
        }],
        ..Surroundings::new(1.0, 5)
    }
}

fn distances(one: &Volume, other: &Volume) -> Vec<f32> {
    let pairs = one.vertices().zip(other.vertices());
    pairs.map(|(a, b)| Vec3::from(a).distance(Vec3::from(b)) / one.radius).collect()
}

fn farthest(one: &Volume, other: &Volume) -> f32 {
    distances(one, other).into_iter().fold(0.0, f32::max)
}

/// The volumes after this many steps on the processor, and on the device. Before each step `at`
/// gets both, and may change the surroundings.
fn both(
    device: &mut Device,
    volumes: &[Volume],
    settings: &MotionSettings,
    mut surroundings: Surroundings,
    (steps, seconds): (usize, f32),
    mut at: impl FnMut(usize, &mut Surroundings, [&[Volume]; 2]),
) -> [Vec<Volume>; 2] {
    let [mut own, mut other] = [volumes.to_vec(), volumes.to_vec()];
    let mut motion = DeviceMotion::default();
    for step in 0..steps {
        at(step, &mut surroundings, [&own, &other]);
        let count = advance(&mut own, settings, &surroundings, seconds).unwrap();
        let found = motion.advance(device, &mut other, settings, &surroundings, seconds);
        assert_eq!(found, Ok(count));
    }
    [own, other]
}

#[test]
fn a_device_agrees_with_the_processor_after_1000_steps() {
    let Some(mut device) = opened() else { return };
    let volumes = row(&[0, 1, 2, 3, 4]);
    let settings = MotionSettings { gravity: 0.5, ..MotionSettings::default() };
    let check = |step: usize, [own, other]: [&[Volume]; 2]| {
        for ((own, other), before) in own.iter().zip(other).zip(&volumes) {
            let far = farthest(own, other);
            assert!(far <= 1e-4, "{step} steps, detail {}: {far} R", own.detail);
            assert_eq!((own.center, own.radius), (other.center, other.radius));
            assert!(step == 0 || farthest(before, other) > 1e-4, "{step}, {}", own.detail);
        }
    };
    let found = both(
        &mut device,
        &volumes,
        &settings,
        busy(),
        (1000, STEP),
        |step: usize, around: &mut Surroundings, found: [&[Volume]; 2]| {
            check(step, found);
            if step == 400 {
                around.pushes.clear();
            }
        },
    );
    check(1000, [&found[0], &found[1]]);
}

#[test]
fn the_finest_sphere_and_many_sub_steps_agree_too() {
    let Some(mut device) = opened() else { return };
    let settings = MotionSettings { cohesion: 4e4, ..MotionSettings::default() };
    let volumes = row(&[5, 2]);
    let [own, other] = both(
        &mut device,
        &volumes,
        &settings,
        busy(),
        (12, 0.05),
        |_: usize, _: &mut Surroundings, _: [&[Volume]; 2]| (),
    );
    for (own, other) in own.iter().zip(&other) {
        let far = farthest(own, other);
        assert!(far <= 1e-4, "detail {}: {far} R", own.detail);
    }
}

#[test]
fn a_surface_pulls_alike_but_for_particles_between_two_samples() {
    let Some(mut device) = opened() else { return };
    let floor: Vec<Vec3> = (0..1024)
        .map(|i: usize| Vec3::new((i % 32) as f32, 0.0, (i / 32) as f32) / 8.0 - 0.9)
        .collect();
    let surface = Some(Arc::new(SurfaceLattice::of(&floor, 1.0).unwrap()));
    let surroundings = Surroundings { surface, ..Surroundings::new(1.0, 5) };
    let settings = MotionSettings::default();
    let volumes = row(&[2, 3, 3]);
    let bound = surroundings.clone();
    let [own, other] = both(&mut device, &volumes, &settings, bound, (1000, STEP), |_, _, _| {});
    let loose = Surroundings { surface: None, ..surroundings };
    let [free, _] = both(&mut device, &volumes, &settings, loose, (1000, STEP), |_, _, _| {});
    for ((own, other), free) in own.iter().zip(&other).zip(&free) {
        let mut all = distances(own, other);
        all.sort_by(f32::total_cmp);
        let near = all.iter().filter(|far| **far <= 1e-4).count();
        // A particle as near to one sample as to another may be pulled to either.
        assert!(near * 100 >= all.len() * 98, "{near} of {}", all.len());
        assert!(all[all.len() - 1] < 0.02, "{all:?}");
        assert!(farthest(own, free) > 0.01, "the surface pulls nothing");
    }
}

#[test]
fn volumes_come_to_rest_on_a_device_and_are_left_alone() {
    let Some(mut device) = opened() else { return };
    let settings = MotionSettings::default();
    let surroundings = Surroundings::new(1.0, 5);
    let mut volumes = row(&[2, 3]);
    volumes[1].dry = true;
    let before = volumes.clone();
    let mut motion = DeviceMotion::default();
    let mut advance = |volumes: &mut [Volume]| {
        motion.advance(&mut device, volumes, &settings, &surroundings, STEP)
    };
    for _ in 0..1000 {
        advance(&mut volumes).unwrap();
    }
    assert_eq!(volumes[1], before[1]);
    let resting = volumes.clone();
    assert!(resting[0].rests_under > 0 && resting[0].radius == resting[0].target_radius);
    assert!(resting[0].particles.velocities.concat().iter().all(|speed| *speed == 0.0));
    advance(&mut volumes).unwrap();
    assert_eq!(volumes, resting);
    // It moves again when it grows, and the other as soon as it is wet.
    volumes[0].target_radius = 0.7;
    volumes[1].dry = false;
    advance(&mut volumes).unwrap();
    assert!(volumes[0].rests_under == 0 && volumes[0] != resting[0] && volumes[1] != resting[1]);
}

#[test]
fn the_guard_keeps_stars_on_a_device() {
    let Some(mut device) = opened() else { return };
    let mut volumes = row(&[0, 2, 3, 4]);
    for (moment, volume) in volumes.iter_mut().enumerate() {
        kick(volume, 100.0, moment as u64);
    }
    // What is not a number or has no direction goes to its place of rest.
    volumes[1].particles.places[0][5] = f32::NAN;
    volumes[1].particles.velocities[2][9] = f32::INFINITY;
    (0..3).for_each(|axis| volumes[2].particles.places[axis][7] = 0.0);
    let mut motion = DeviceMotion::default();
    let settings = MotionSettings::default();
    let surroundings = busy();
    for step in 0..40 {
        motion.advance(&mut device, &mut volumes, &settings, &surroundings, STEP).unwrap();
        for volume in &volumes {
            let corners: Vec<_> = (0..volume.mesh().directions.len())
                .map(|i: usize| {
                    let [x, y, z] = volume.particles.places.each_ref().map(|along| along[i]);
                    Vec3::new(x, y, z)
                })
                .collect();
            assert!(corners.iter().all(|corner| corner.is_finite()));
            let mut cones = volume.mesh().faces.iter().map(|face| {
                let [a, b, c] = face.map(|i| corners[i as usize]);
                a.dot(b.cross(c))
            });
            assert!(cones.all(|cone| cone > 0.0), "step {step}, detail {}", volume.detail);
        }
    }
}

#[test]
fn the_same_device_gives_the_same_bits() {
    let Some(mut device) = opened() else { return };
    let mut run = |motion: &mut DeviceMotion| {
        let mut volumes = row(&[2, 4, 3]);
        let settings = MotionSettings::default();
        for _ in 0..20 {
            motion.advance(&mut device, &mut volumes, &settings, &busy(), STEP).unwrap();
        }
        volumes
    };
    let mut used = DeviceMotion::default();
    let first = run(&mut used);
    assert_eq!(run(&mut used), first);
    assert_eq!(run(&mut DeviceMotion::default()), first);
}

#[test]
fn faults_are_errors_and_move_nothing() {
    let Some(mut device) = opened() else { return };
    let settings = MotionSettings::default();
    let surroundings = Surroundings::new(1.0, 1);
    let mut motion = DeviceMotion::default();
    let mut volumes = row(&[2, 2]);
    assert_eq!(motion.advance(&mut device, &mut [], &settings, &surroundings, STEP), Ok(1));
    assert_eq!(motion.advance(&mut device, &mut volumes, &settings, &surroundings, 0.0), Ok(0));
    volumes[1].center.y = f32::NAN;
    let before = volumes[0].clone();
    let error = motion.advance(&mut device, &mut volumes, &settings, &surroundings, STEP);
    assert!(error.unwrap_err().to_string().starts_with("volume 1 has centre `NaN`"));
    assert_eq!(volumes[0], before);
    volumes[1].center.y = 0.0;
    let before = volumes.clone();
    device.close();
    let error = motion.advance(&mut device, &mut volumes, &settings, &surroundings, STEP);
    assert!(matches!(error, Err(MotionError::Device(_))), "{error:?}");
    assert_eq!(volumes, before);
}
