//! Motion under extreme forces, pushes and times, and on any number of threads.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use graphics::noise::random;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::forces::{cohesion, elastic, pressure};
use super::*;
use crate::volume::Volume;

const STEP: f32 = 1.0 / 120.0;

/// The least determinant over a face of a volume, in unit vectors to the places of its particles.
fn least_cone(volume: &Volume) -> f64 {
    let [x, y, z] = &volume.particles.places;
    let units: Vec<DVec3> =
        (0..x.len()).map(|i: usize| Vec3::new(x[i], y[i], z[i]).as_dvec3().normalize()).collect();
    let cones = volume.mesh().faces.iter().map(|face| {
        let [a, b, c] = face.map(|corner| units[corner as usize]);
        a.cross(b).dot(c)
    });
    cones.fold(f64::MAX, f64::min)
}

#[test]
fn every_cone_stays_open_whatever_happens() {
    let mut random = random(5, 0);
    let settings = MotionSettings { fastest: 100.0, ..MotionSettings::default() };
    let mut surroundings = Surroundings::new(1.0, 1);
    let mut volumes: Vec<Volume> =
        (0..5).map(|detail| Volume::ball(Vec3::splat(0.3), 0.5, detail, detail.into())).collect();
    let mut least = f64::MAX;
    let mut smallest = f32::MAX;
    for step in 0..900 {
        if step % 50 == 0 {
            let speed = [0.3, 1.0, 10.0, 100.0, 100.0, 100.0][step / 150];
            for volume in &mut volumes {
                kick(volume, speed, step as u64);
                volume.target_radius = [0.02, 0.5][step / 150 % 2];
            }
        }
        let center = Vec3::splat(0.3) + 0.3 * unit(&mut random);
        let strength = 3000.0 * random.random::<f32>();
        surroundings.pushes =
            vec![Push { center, direction: unit(&mut random), radius: 0.4, strength }];
        advance(&mut volumes, &settings, &surroundings, STEP).unwrap();
        for volume in &volumes {
            let cone = least_cone(volume);
            assert!(cone > 0.0, "step {step}, detail {}: {cone}", volume.detail);
            least = least.min(cone / f64::from(volume.mesh().least_cone));
            smallest = smallest.min(volume.radius);
        }
    }
    assert!(smallest < 0.0205, "{smallest}");
    assert!(least < 0.1, "the guard had nothing to do: {least}");
}

fn unit(random: &mut ChaCha8Rng) -> Vec3 {
    let mut along = || 2.0 * random.random::<f32>() - 1.0;
    Vec3::new(along(), along(), along()).normalize_or(Vec3::X)
}

/// A number from 0 to `most`: 0, or even in its logarithm over seven decades.
fn spread(random: &mut ChaCha8Rng, most: f32) -> f32 {
    if random.random::<f32>() < 0.1 {
        return 0.0;
    }
    most * 10_f32.powf(-7.0 * random.random::<f32>())
}

/// Steps of volumes of some details under random settings, times and pushes: all stay finite and
/// near the centre, or the step is refused as too stiff. Returns how many were refused.
fn survives(steps: usize, details: &[u8], seed: u64) -> usize {
    let mut random = random(9, seed);
    let random = &mut random;
    let mut refused = 0;
    let floor: Vec<Vec3> =
        (0..400).map(|_| 2.0 * unit(random) * Vec3::new(1.0, 0.0, 1.0)).collect();
    let floor = Arc::new(SurfaceLattice::of(&floor, 1.0).unwrap());
    let ball = |&detail: &u8| Volume::ball(Vec3::splat(detail.into()), 0.5, detail, 1);
    let mut volumes: Vec<Volume> = details.iter().map(ball).collect();
    let mut settings = MotionSettings::default();
    let mut surroundings = Surroundings::new(1.0, 2);
    for step in 0..steps {
        if step % 10 == 0 {
            settings = MotionSettings {
                pressure: spread(random, 1e6),
                elastic: spread(random, 1e6),
                cohesion: spread(random, 1e6),
                friction: spread(random, 1e4),
                microstructure: 0.9 * random.random::<f32>(),
                fastest: 0.001 + spread(random, 999.0),
                surface_pull: spread(random, 1e6),
                gravity: spread(random, 1e6),
                ..settings
            };
            surroundings.surface = (step % 20 == 0).then(|| floor.clone());
            for volume in &mut volumes {
                volume.target_radius = 2.0 * random.random::<f32>();
                kick(volume, spread(random, 100.0), step as u64);
            }
        }
        let push = Push {
            center: 2.0 * unit(random),
            direction: unit(random),
            radius: 2.0,
            strength: spread(random, 1e6),
        };
        surroundings.pushes = vec![push; step % 3];
        let seconds = 1e-4 * 10_f32.powf(4.0 * random.random::<f32>());
        match advance(&mut volumes, &settings, &surroundings, seconds) {
            Ok(count) => assert!((1..=1000).contains(&count)),
            Err(MotionError::TooStiff { .. }) => refused += 1,
            Err(error) => panic!("{error}"),
        }
        for volume in &volumes {
            let places = &volume.particles.places;
            let numbers = places.iter().chain(&volume.particles.velocities).flatten();
            assert!(numbers.copied().all(f32::is_finite), "step {step}: {settings:?}");
            for place in volume.vertices().map(Vec3::from) {
                let share = place.distance(volume.center) / volume.radius;
                assert!(share > 0.0 && share < 10.0, "step {step}: {share}, {settings:?}");
            }
            assert!(least_cone(volume) > 0.0, "step {step}: {settings:?}");
        }
    }
    refused
}

#[test]
fn extreme_settings_keep_volumes_whole_or_are_refused() {
    let refused = survives(1500, &[0, 1, 2], 0);
    assert!((1..750).contains(&refused), "{refused} refused");
}

#[test]
fn extreme_settings_keep_volumes_whole_for_100_000_steps() {
    let refused = (1..=16).into_par_iter().map(|seed| survives(6250, &[0], seed));
    let refused: usize = refused.sum();
    assert!((20..50_000).contains(&refused), "{refused} of 100000 steps refused");
}

/// Plain explicit Euler under the same forces of a smooth ball, the form that the step avoids.
/// Returns the greatest deviation from rest, in radii.
fn explicit_euler(settings: &MotionSettings, seconds: f32, steps: usize) -> f32 {
    let mut ball = Volume::ball(Vec3::ZERO, 1.0, 3, 1);
    kick(&mut ball, 0.3, 0);
    let mesh = ball.mesh();
    let vectors = |[x, y, z]: &[Vec<f32>; 3]| -> Vec<Vec3> {
        (0..x.len()).map(|i| Vec3::new(x[i], y[i], z[i])).collect()
    };
    let rest: Vec<Vec3> = vectors(&mesh.axes).iter().map(|at| *at / mesh.inradius).collect();
    let mut places = vectors(&ball.particles.places);
    let mut velocities = vectors(&ball.particles.velocities);
    for _ in 0..steps {
        let deviations: Vec<Vec3> = places.iter().zip(&rest).map(|(a, b)| *a - *b).collect();
        for i in 0..places.len() {
            let sum = mesh.neighbours[i].iter().map(|&other| deviations[other as usize]).sum();
            let count = if i < 12 { 5.0 } else { 6.0 };
            let distance = places[i].length();
            let outward = places[i].normalize();
            let force = pressure(settings.pressure, 1.0 / mesh.inradius, distance, outward)
                + elastic(settings.elastic, deviations[i], outward)
                + cohesion(settings.cohesion / count, deviations[i], sum)
                - velocities[i] * settings.friction;
            places[i] += velocities[i] * seconds;
            velocities[i] += force * seconds;
        }
    }
    places.iter().zip(&rest).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

#[test]
fn particles_without_a_direction_go_to_their_places_of_rest() {
    let mut ball = [Volume::ball(Vec3::X, 0.5, 2, 1)];
    let still = ball.clone();
    ball[0].particles.places[0][5] = f32::NAN;
    ball[0].particles.velocities[1][6] = f32::INFINITY;
    for along in &mut ball[0].particles.places {
        along[20] = 0.0;
    }
    let settings = MotionSettings { microstructure: 0.0, ..MotionSettings::default() };
    advance(&mut ball, &settings, &Surroundings::new(1.0, 1), STEP).unwrap();
    assert!(ball[0].particles.velocities.iter().flatten().all(|along| along.is_finite()));
    for (place, rest) in ball[0].vertices().zip(still[0].vertices()) {
        // Cohesion draws the neighbours of the one at the centre a little.
        assert!(Vec3::from(place).distance(rest.into()) < 0.005, "{place:?} {rest:?}");
    }
}

#[test]
fn explicit_euler_diverges_where_the_step_does_not() {
    for (friction, seconds) in [(0.0, STEP), (4.0, 1.0 / 30.0), (10.0, 1.0 / 30.0)] {
        let settings =
            MotionSettings { friction, microstructure: 0.0, ..MotionSettings::default() };
        let steps = (4.0 / seconds) as usize;
        let explicit = explicit_euler(&settings, seconds, steps);
        assert!(explicit.is_nan() || explicit > 10.0, "{friction}, {seconds}: {explicit}");
        let mut ball = [Volume::ball(Vec3::ZERO, 1.0, 3, 1)];
        kick(&mut ball[0], 0.3, 0);
        for _ in 0..steps {
            advance(&mut ball, &settings, &Surroundings::new(1.0, 1), seconds).unwrap();
        }
        let rest = 1.0 / ball[0].mesh().inradius;
        let off = ball[0].vertices().map(|place| (Vec3::from(place).length() - rest).abs());
        assert!(off.fold(0.0, f32::max) < 0.2, "{friction}, {seconds}");
    }
    let calm = explicit_euler(&MotionSettings::default(), 1.0 / 480.0, 960);
    assert!(calm < 1e-2, "below k_f / k explicit Euler is stable: {calm}");
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let moved = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let ball = |i: u8| Volume::ball(Vec3::splat(0.4 * f32::from(i)), 0.5, i % 5, i.into());
        let mut volumes: Vec<Volume> = (0..30).map(ball).collect();
        let push = Push { center: Vec3::ONE, direction: Vec3::X, radius: 3.0, strength: 50.0 };
        let surroundings = Surroundings { pushes: vec![push], ..Surroundings::new(1.0, 1) };
        for volume in &mut volumes {
            kick(volume, 2.0, 0);
            volume.target_radius = 0.8;
        }
        for _ in 0..20 {
            pool.install(|| {
                advance(&mut volumes, &MotionSettings::default(), &surroundings, STEP).unwrap()
            });
        }
        volumes
    };
    let one = moved(1);
    assert_eq!(one, moved(2));
    assert_eq!(one, moved(8));
}
