//! Compares motion as a whole with theory: rest, energy, growth, microstructure, walls. Also tries
//! extreme forces, pushes and times, and any number of threads.

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

/// Moves volumes by single steps, and looks at them after each.
fn run(
    volumes: &mut [Volume],
    settings: &MotionSettings,
    surroundings: &Surroundings,
    seconds: f32,
    mut look: impl FnMut(&[Volume]),
) {
    for _ in 0..(seconds / STEP).round() as usize {
        advance(volumes, settings, surroundings, STEP).unwrap();
        look(volumes);
    }
}

fn places(volume: &Volume) -> Vec<DVec3> {
    let [x, y, z] = &volume.particles.places;
    (0..x.len()).map(|i| Vec3::new(x[i], y[i], z[i]).as_dvec3()).collect()
}

fn distances(volume: &Volume) -> Vec<f64> {
    let rest = f64::from(volume.radius / volume.mesh().inradius);
    places(volume).iter().map(|place| place.length() / rest).collect()
}

fn mean_and_deviation(values: &[f64]) -> (f64, f64) {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let square = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
    (mean, (square / values.len() as f64).sqrt())
}

fn kicked(detail: u8) -> Volume {
    let mut ball = Volume::ball(Vec3::new(0.3, -0.2, 0.1), 0.7, detail, 11);
    kick(&mut ball, 0.3, 0);
    ball
}

fn smooth() -> MotionSettings {
    MotionSettings { microstructure: 0.0, ..MotionSettings::default() }
}

#[test]
fn a_kicked_ball_comes_to_rest_as_a_ball() {
    let mut volumes = [kicked(3)];
    let mut roughest = 0.0_f64;
    run(&mut volumes, &smooth(), &Surroundings::new(1.0, 1), 2.0, |volumes| {
        roughest = roughest.max(mean_and_deviation(&distances(&volumes[0])).1);
    });
    let (mean, deviation) = mean_and_deviation(&distances(&volumes[0]));
    assert!((mean - 1.0).abs() < 1e-3 && deviation < 1e-5, "{mean} {deviation}");
    assert!(roughest > 1e-3, "the kick moved it by {roughest} only");
}

/// Kinetic energy plus the energy of all springs. A particle weighs as much as it has neighbours,
/// so that cohesion is the same from both sides.
fn energy(volume: &Volume, settings: &MotionSettings) -> f64 {
    let [kp, ke, ks] = [settings.pressure, settings.elastic, settings.cohesion].map(f64::from);
    let mesh = volume.mesh();
    let rest = f64::from(volume.radius / mesh.inradius);
    let places = places(volume);
    let rays = mesh.directions.iter().map(|at| Vec3::from(*at).as_dvec3() * rest);
    let deviations: Vec<DVec3> = places.iter().zip(rays).map(|(place, ray)| *place - ray).collect();
    let [vx, vy, vz] = &volume.particles.velocities;
    let mut sum = 0.0;
    for i in 0..places.len() {
        let outward = places[i].normalize();
        let across = deviations[i] - outward * deviations[i].dot(outward);
        let speed = Vec3::new(vx[i], vy[i], vz[i]).as_dvec3().length_squared();
        let own = speed + kp * (rest - places[i].length()).powi(2) + ke * across.length_squared();
        sum += own * if i < 12 { 5.0 } else { 6.0 };
        for &other in mesh.neighbours[i].iter().filter(|&&other| other as usize > i) {
            sum += ks * (deviations[i] - deviations[other as usize]).length_squared();
        }
    }
    sum / 2.0
}

#[test]
fn cohesion_is_as_strong_with_five_neighbours_as_with_six() {
    let settings =
        MotionSettings { pressure: 0.0, elastic: 0.0, cohesion: 120.0, friction: 0.0, ..smooth() };
    for particle in [3, 100] {
        let mut volumes = [Volume::ball(Vec3::ZERO, 1.0, 2, 1)];
        volumes[0].particles.places[1][particle] += 0.01;
        advance(&mut volumes, &settings, &Surroundings::new(1.0, 1), STEP).unwrap();
        let speed = volumes[0].particles.velocities[1][particle];
        assert!((speed + 0.01).abs() < 1e-4, "{particle}: {speed}");
    }
}

#[test]
fn energy_falls_at_every_step() {
    for friction in [10.0, 20.0, 40.0] {
        let settings = MotionSettings { friction, ..smooth() };
        let mut volumes = [kicked(3)];
        let first = energy(&volumes[0], &settings);
        let mut last = first;
        run(&mut volumes, &settings, &Surroundings::new(1.0, 1), 2.0, |volumes| {
            let now = energy(&volumes[0], &settings);
            assert!(now <= last + 1e-6 * first, "{friction}: {now} after {last} of {first}");
            last = now;
        });
        assert!(last <= 1e-6 * first, "{friction}: {last} of {first}");
    }
}

#[test]
fn growth_lags_by_friction_over_pressure() {
    for rate in [0.3, 1.0] {
        let settings = MotionSettings { fastest: rate, ..smooth() };
        let mut volumes = [Volume::ball(Vec3::ZERO, 1.0, 2, 1)];
        let surroundings = Surroundings::new(1.0, 1);
        volumes[0].target_radius = 100.0;
        run(&mut volumes, &settings, &surroundings, 1.0, |_| {});
        assert!((volumes[0].radius - 1.0 - rate).abs() < 1e-3);
        let lag = (1.0 - mean_and_deviation(&distances(&volumes[0])).0) * f64::from(1.0 + rate);
        let theory = f64::from(rate * settings.friction / settings.pressure);
        assert!((lag / theory - 1.0).abs() < 0.12, "{rate}: {lag} for {theory}");
        volumes[0].target_radius = volumes[0].radius;
        run(&mut volumes, &settings, &surroundings, 0.5, |_| {});
        let (mean, _) = mean_and_deviation(&distances(&volumes[0]));
        assert!((mean - 1.0).abs() < 1e-3, "{rate}: {mean}");
    }
}

#[test]
fn the_microstructure_stays_and_is_as_rough_as_it_says() {
    let settings = MotionSettings::default();
    let surroundings = Surroundings::new(1.0, 7);
    let mut volumes: Vec<Volume> = (0..8)
        .map(|i: usize| Volume::ball(Vec3::new(2.3 * i as f32, 0.4, -1.1), 0.7, 3, i as u64))
        .collect();
    volumes.iter_mut().for_each(|volume| kick(volume, 0.3, 0));
    advance(&mut volumes, &settings, &surroundings, 10.0).unwrap();
    let shares: Vec<f64> =
        volumes.iter().map(|volume| mean_and_deviation(&distances(volume)).1 / 0.18).collect();
    assert!(shares.iter().all(|share| (0.2..0.6).contains(share)), "{shares:?}");
}

#[test]
fn volumes_at_one_place_share_the_microstructure() {
    let surroundings = Surroundings::new(1.0, 7);
    let mut volumes = [1, 2].map(|seed| Volume::ball(Vec3::X, 0.7, 3, seed));
    volumes.iter_mut().for_each(|volume| kick(volume, 0.3, 0));
    assert_ne!(volumes[0].particles, volumes[1].particles);
    advance(&mut volumes, &MotionSettings::default(), &surroundings, 10.0).unwrap();
    let [a, b] = volumes.each_ref().map(places);
    let farthest = a.iter().zip(b).map(|(a, b)| a.distance(b)).fold(0.0, f64::max);
    assert!(farthest < 1e-4, "{farthest}");
    // Away from there along any axis it is another.
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        let mut other = [Volume::ball(Vec3::X + axis * 5.1, 0.7, 3, 1)];
        advance(&mut other, &MotionSettings::default(), &surroundings, 10.0).unwrap();
        let apart = a.iter().zip(places(&other[0])).map(|(a, b)| a.distance(b));
        assert!(apart.fold(0.0, f64::max) > 0.05, "{axis}");
    }
}

/// Energy of each degree of the spherical harmonics of values on a sphere. We use their addition
/// theorem: the sum over pairs of values times the Legendre polynomial of the angle between them.
fn degrees(directions: &[[f32; 3]], values: &[f64], most: usize) -> Vec<f64> {
    let directions: Vec<DVec3> =
        directions.iter().map(|at| Vec3::from(*at).as_dvec3().normalize()).collect();
    let mut sums = vec![0.0; most + 1];
    for i in 0..values.len() {
        for j in 0..i {
            let cosine = directions[i].dot(directions[j]);
            let product = values[i] * values[j];
            let mut before = 1.0;
            let mut last = cosine;
            for (degree, sum) in sums.iter_mut().enumerate().skip(1) {
                *sum += product * last * (2 * degree + 1) as f64;
                let n = degree as f64;
                (before, last) = (last, ((2.0 * n + 1.0) * cosine * last - n * before) / (n + 1.0));
            }
        }
    }
    let own = values.iter().map(|value| value * value).sum::<f64>();
    sums.iter().enumerate().map(|(l, sum)| 2.0 * sum + own * (2 * l + 1) as f64).collect()
}

#[test]
fn bumps_are_strongest_at_the_grain() {
    for grain in [0.5, 0.8] {
        let settings = MotionSettings { grain, ..MotionSettings::default() };
        let mut sums = vec![0.0; 25];
        let mut volumes: Vec<Volume> = (0..16)
            .map(|i: u8| Volume::ball(Vec3::new(3.7 * f32::from(i), 0.4, -1.1), 1.0, 3, 1))
            .collect();
        advance(&mut volumes, &settings, &Surroundings::new(1.0, 3), 4.0).unwrap();
        for volume in &volumes {
            let distances = distances(volume);
            let (mean, _) = mean_and_deviation(&distances);
            let bumps: Vec<f64> = distances.iter().map(|distance| distance - mean).collect();
            for (sum, energy) in sums.iter_mut().zip(degrees(&volume.mesh().directions, &bumps, 24))
            {
                *sum += energy;
            }
        }
        // We take the middle of what is above half of the peak, which single degrees move less.
        let peak = sums.iter().copied().fold(0.0, f64::max);
        let strong = sums.iter().enumerate().filter(|(_, sum)| **sum > 0.5 * peak);
        let (weighed, all) = strong.fold((0.0, 0.0), |(weighed, all), (degree, sum)| {
            (weighed + sum * (degree as f64 + 0.5), all + sum)
        });
        let wavelength = std::f64::consts::TAU * all / weighed;
        let share = wavelength / f64::from(grain);
        assert!((0.75..1.25).contains(&share), "{grain}: {wavelength}, {sums:?}");
    }
}

#[test]
fn no_particle_leaves_a_region() {
    let regions = vec![
        KeepIn::Box { low: Vec3::splat(-1.0), high: Vec3::new(1.0, 0.4, 1.0) },
        KeepIn::Ball { center: Vec3::ZERO, radius: 1.1 },
        KeepIn::Above { point: Vec3::new(0.0, -0.3, 0.0), normal: Vec3::new(0.6, 0.8, 0.0) },
    ];
    let push = Push { center: Vec3::ZERO, direction: Vec3::X, radius: 3.0, strength: 900.0 };
    let surroundings =
        Surroundings { regions: regions.clone(), pushes: vec![push], ..Surroundings::new(0.5, 1) };
    let centers = [Vec3::new(0.1, 0.2, 0.0), Vec3::new(0.9, 0.3, 0.0), Vec3::new(0.0, -0.29, 0.3)];
    let mut volumes = centers.map(|center| Volume::ball(center, 0.05, 3, 1));
    let mut touching = 0;
    for volume in &mut volumes {
        volume.target_radius = 2.0;
        kick(volume, 3.0, 0);
    }
    let settings = MotionSettings { fastest: 10.0, ..MotionSettings::default() };
    run(&mut volumes, &settings, &surroundings, 1.0, |volumes| {
        for place in volumes.iter().flat_map(Volume::vertices).map(Vec3::from) {
            let beyond = regions.iter().map(|region| region.way_back(place, 0.0).length());
            assert!(beyond.fold(0.0, f32::max) == 0.0, "{place}");
            touching += usize::from(regions[0].way_back(place, 1e-3) != Vec3::ZERO);
        }
    });
    assert!(touching > 100, "volumes must reach the wall");
}

fn floor() -> Arc<SurfaceLattice> {
    let places: Vec<Vec3> = (0..3600)
        .map(|i: i32| Vec3::new((i % 60 - 30) as f32, 0.0, (i / 60 - 30) as f32) * 0.1)
        .collect();
    Arc::new(SurfaceLattice::of(&places, 1.0).unwrap())
}

#[test]
fn the_surface_gravity_and_pushes_draw_particles_their_way() {
    fn low(settings: &MotionSettings, surroundings: &Surroundings) -> (DVec3, f64) {
        let mut volumes = [Volume::ball(Vec3::ZERO, 0.6, 3, 1)];
        volumes[0].normal = Vec3::new(0.6, 0.8, 0.0);
        advance(&mut volumes, settings, surroundings, 2.0).unwrap();
        let places = places(&volumes[0]);
        let mean = places.iter().sum::<DVec3>() / places.len() as f64;
        let height = places.iter().map(|place| place.y.abs()).sum::<f64>() / places.len() as f64;
        (mean, height)
    }
    let free = Surroundings::new(1.0, 1);
    let (still, height) = low(&smooth(), &free);
    assert!(still.length() < 1e-5, "{still}");
    let (_, pulled) = low(&smooth(), &Surroundings { surface: Some(floor()), ..free.clone() });
    assert!(pulled < 0.95 * height, "{pulled} {height}");
    let (slid, _) = low(&MotionSettings { gravity: 20.0, ..smooth() }, &free);
    assert!(slid.x > 0.02 && (slid.x * 0.6 + slid.y * 0.8).abs() < 1e-3, "{slid}");
    let push = Push { center: Vec3::ZERO, direction: Vec3::Z, radius: 2.0, strength: 20.0 };
    let (pushed, _) = low(&smooth(), &Surroundings { pushes: vec![push], ..free });
    assert!(pushed.z > 0.02 && pushed.x.abs() < 1e-3, "{pushed}");
}

#[test]
fn volumes_at_rest_sleep_until_something_changes() {
    let settings = MotionSettings::default();
    let mut surroundings = Surroundings::new(1.0, 1);
    let mut volumes = [kicked(2)];
    run(&mut volumes, &settings, &surroundings, 8.0, |_| {});
    let resting = volumes.clone();
    assert!(volumes[0].rests_under != 0);
    run(&mut volumes, &settings, &surroundings, 0.1, |_| {});
    assert_eq!(volumes, resting);
    let wakes =
        |settings: &MotionSettings, surroundings: &Surroundings, change: fn(&mut Volume)| {
            let mut volumes = resting.clone();
            volumes.iter_mut().for_each(change);
            run(&mut volumes, settings, surroundings, 0.1, |_| {});
            volumes[0].particles != resting[0].particles
        };
    assert!(wakes(&settings, &surroundings, |volume| volume.target_radius = 0.8));
    assert!(wakes(&settings, &surroundings, |volume| kick(volume, 0.3, 1)));
    assert!(!wakes(&settings, &surroundings, |_| {}));
    assert!(wakes(&MotionSettings { grain: 0.4, ..settings }, &surroundings, |_| {}));
    let push = Push { center: Vec3::ZERO, direction: Vec3::Z, radius: 1.0, strength: 20.0 };
    surroundings.pushes.push(push);
    assert!(wakes(&settings, &surroundings, |_| {}));
    assert!(!wakes(&settings, &surroundings, |volume| volume.dry = true));
}

const EXTREMES_STEP: f32 = 1.0 / 120.0;

/// The least determinant of a face of a volume: of the unit vectors from the centre to its three
/// corners.
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
        advance(&mut volumes, &settings, &surroundings, EXTREMES_STEP).unwrap();
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
    Vec3::from([(); 3].map(|()| 2.0 * random.random::<f32>() - 1.0)).normalize_or(Vec3::X)
}

/// A random number from 0 to `most`: 0 once in ten times, or else with an evenly distributed
/// logarithm over seven decades.
fn spread(random: &mut ChaCha8Rng, most: f32) -> f32 {
    if random.random::<f32>() < 0.1 {
        return 0.0;
    }
    most * 10_f32.powf(-7.0 * random.random::<f32>())
}

/// Moves volumes of these levels of detail under random settings, times and pushes. All stay finite
/// and near the centre, or we refuse the step as too stiff. Returns how many steps were refused.
fn survives(steps: usize, details: &[u8], seed: u64) -> usize {
    let mut random = random(9, seed);
    let random = &mut random;
    let mut refused = 0;
    let floor: Vec<Vec3> =
        (0..400).map(|_| 2.0 * unit(random) * Vec3::new(1.0, 0.0, 1.0)).collect();
    let floor = Arc::new(SurfaceLattice::of(&floor, 1.0).unwrap());
    let mut volumes: Vec<Volume> = details
        .iter()
        .map(|&detail: &u8| Volume::ball(Vec3::splat(detail.into()), 0.5, detail, 1))
        .collect();
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

/// Moves a smooth ball by plain explicit Euler, which [`advance`] does not use, under the same
/// forces. Returns the greatest deviation from rest, in radii.
fn explicit_euler(settings: &MotionSettings, seconds: f32, steps: usize) -> f32 {
    let mut ball = Volume::ball(Vec3::ZERO, 1.0, 3, 1);
    kick(&mut ball, 0.3, 0);
    let mesh = ball.mesh();
    fn vectors([x, y, z]: &[Vec<f32>; 3]) -> Vec<Vec3> {
        (0..x.len()).map(|i| Vec3::new(x[i], y[i], z[i])).collect()
    }
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
    advance(&mut ball, &settings, &Surroundings::new(1.0, 1), EXTREMES_STEP).unwrap();
    assert!(ball[0].particles.velocities.iter().flatten().all(|along| along.is_finite()));
    for (place, rest) in ball[0].vertices().zip(still[0].vertices()) {
        // Cohesion draws the neighbours of the one at the centre a little.
        assert!(Vec3::from(place).distance(rest.into()) < 0.005, "{place:?} {rest:?}");
    }
}

#[test]
fn explicit_euler_diverges_where_the_step_does_not() {
    for (friction, seconds) in [(0.0, EXTREMES_STEP), (4.0, 1.0 / 30.0), (10.0, 1.0 / 30.0)] {
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
    fn moved(threads: usize) -> Vec<Volume> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut volumes: Vec<Volume> = (0..30)
            .map(|i: u8| Volume::ball(Vec3::splat(0.4 * f32::from(i)), 0.5, i % 5, i.into()))
            .collect();
        let push = Push { center: Vec3::ONE, direction: Vec3::X, radius: 3.0, strength: 50.0 };
        let surroundings = Surroundings { pushes: vec![push], ..Surroundings::new(1.0, 1) };
        for volume in &mut volumes {
            kick(volume, 2.0, 0);
            volume.target_radius = 0.8;
        }
        for _ in 0..20 {
            pool.install(|| {
                advance(&mut volumes, &MotionSettings::default(), &surroundings, EXTREMES_STEP)
                    .unwrap()
            });
        }
        volumes
    }
    let one = moved(1);
    assert_eq!(one, moved(2));
    assert_eq!(one, moved(8));
}
