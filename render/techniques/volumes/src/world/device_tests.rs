//! Steps worlds on a device and compares them with the same worlds on the processor. Also measures
//! the outline of paint on a level sheet in its first seconds, and does 100,000 random actions on
//! one world, with a grid and without: no quantum may be lost or made.

use glam::Vec3;
use graphics::compute::Compute;
use graphics::mesh::Mesh;
use paint::layer::SLOTS;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::settings::STEPS_PER_SECOND;
use super::tests::{flat, is_exact, level, run, single};
use super::*;
use crate::containing::Inside;
use crate::motion::{KeepIn, MotionSettings, Push};
use crate::test_volumes::device;
use crate::volume::Volume;

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
    let Some(closed) = crate::test_volumes::device().and_then(Compute::into_device) else { return };
    closed.close();
    let mut closed = StepDevice::new(Compute::gpu(closed)).above(0);
    let error = world.step_on(&mut closed).unwrap_err();
    let lost = matches!(error, WorldError::Device(_) | WorldError::Motion(_));
    assert!(lost && error.to_string().contains("the graphics device was lost"), "{error}");
    assert!(is_exact(&world));
    world.step().unwrap();
    assert!(is_exact(&world));
}

/// We look at this many places along each side of the sheet.
const SIDE: usize = 240;

struct Outline {
    /// Share of the wet area that is not joined to the source.
    apart: f64,
    /// Distances of the nearest dry and the farthest wet place from the source, over the radius of
    /// a circle of the same area.
    rim: [f64; 2],
    /// Wet area over the area that its paint covers as a film.
    area: f64,
}

fn outline(world: &World, from: Vec3) -> Outline {
    let insides: Vec<Inside> = world.volumes().iter().map(Inside::of).collect();
    let width = 12.0 / SIDE as f32;
    let places = (0..SIDE * SIDE).map(|at: usize| {
        let [x, z] = [at % SIDE, at / SIDE].map(|index| (index as f32 + 0.5) * width - 6.0);
        Vec3::new(x, 0.0, z)
    });
    let distances: Vec<f32> = places.clone().map(|place| place.distance(from)).collect();
    let wet: Vec<bool> =
        places.map(|place| insides.iter().any(|inside| inside.holds(place))).collect();
    let area = wet.iter().filter(|wet| **wet).count();
    // We flood from the wet place nearest to the source.
    let [nearest, bare] = [true, false].map(|is_wet| {
        let all = (0..wet.len()).filter(|at| wet[*at] == is_wet);
        all.min_by(|a, b| distances[*a].total_cmp(&distances[*b])).unwrap()
    });
    let mut joined = vec![false; wet.len()];
    let mut waiting = vec![nearest];
    joined[waiting[0]] = true;
    while let Some(at) = waiting.pop() {
        for next in [at.wrapping_sub(1), at + 1, at.wrapping_sub(SIDE), at + SIDE] {
            if wet.get(next) == Some(&true) && !std::mem::replace(&mut joined[next], true) {
                waiting.push(next);
            }
        }
    }
    let held = joined.iter().filter(|joined| **joined).count();
    let of_wet = distances.iter().zip(&wet).filter(|(_, wet)| **wet);
    let farthest = of_wet.map(|(distance, _)| *distance).fold(0.0, f32::max);
    let equal = f64::from(width) * (area as f64 / std::f64::consts::PI).sqrt();
    let rim = [distances[bare], farthest].map(|at| f64::from(at) / equal);
    let on_scene: u64 = world.tally().on_scene.iter().sum();
    let covered = on_scene as f64 * world.quantum_mm3() / 0.02;
    let wet_mm2 = area as f64 * f64::from(width * width);
    Outline { apart: 1.0 - held as f64 / area as f64, rim, area: wet_mm2 / covered }
}

#[test]
fn paint_soaks_outward_from_where_it_is_poured() {
    // Near the middle of a cell, near an edge and near a corner.
    for (x, z) in [(0.1, 0.2), (0.37, -0.13), (0.6, 0.6)] {
        // Cells filled in a second.
        for rate in [1.0, 4.0, 16.0] {
            let mut world = flat();
            let from = Vec3::new(x, 0.0, z);
            world.pour(Pour::at(from, 0.02 * rate, 3.0, Recipe::of_slot(0))).unwrap();
            for seconds in [0.2, 0.5, 1.0, 2.0, 4.0] {
                let steps = seconds * f64::from(STEPS_PER_SECOND) - world.steps() as f64;
                run(&mut world, steps as usize);
                let Outline { apart, rim: [dry, wet], .. } = outline(&world, from);
                let place = format!("{x} {z}, {rate} cells/s, {seconds} s: {apart} {dry} {wet}");
                assert!(apart < 1e-3, "{place}");
                // A single cell fills as a disk about its middle.
                let round = match (x < 0.3, rate > 4.0) {
                    (true, _) => 0.72..1.28,
                    (false, true) => 0.65..1.35,
                    _ => continue,
                };
                let is_round = round.contains(&dry) && round.contains(&wet);
                assert!(is_round || seconds < 0.5, "{place}");
            }
        }
    }
}

#[test]
fn smooth_paint_spreads_as_a_disc_whose_area_is_that_of_the_paint() {
    let motion = MotionSettings { microstructure: 0.0, kick: 0.0, ..MotionSettings::default() };
    let cell = 1.0 / 40.0;
    let settings = WorldSettings { unit_mm: Some(1.0), cell, motion, ..WorldSettings::default() };
    let mut world = World::of(&level(12.0, 0.0), &settings).unwrap();
    let mut before = 0.0;
    // Whole cells make a rim, so it is rounder if it is more cells away.
    for (cells, round) in [(7.0, 0.9..1.1), (15.0, 0.92..1.06)] {
        let covered = std::f64::consts::PI * cells * cells * 0.3 * 0.3;
        let pour = Pour::at(Vec3::ZERO, 0.02 * (covered - before), 1.0, Recipe::of_slot(0));
        world.pour(pour).unwrap();
        before = covered;
        run(&mut world, 1200);
        let Outline { apart, rim: [dry, wet], area } = outline(&world, Vec3::ZERO);
        let found = format!("{cells} cells: {apart} {dry} {wet} {area}");
        assert!(apart == 0.0 && round.contains(&dry) && round.contains(&wet), "{found}");
        assert!((0.97..1.03).contains(&area), "{found}");
    }
}

const ACTIONS: usize = 100_000;

/// A world over a sphere of radius 1. We do things to it at random.
struct Played {
    world: World,
    random: ChaCha8Rng,
    /// Quanta that all tubes were to give.
    asked: u64,
}

impl Played {
    fn new(settings: &WorldSettings) -> Self {
        let world = World::of(&Mesh::sphere(500), settings).unwrap();
        Self { world, random: ChaCha8Rng::seed_from_u64(3), asked: 0 }
    }

    fn place(&mut self) -> Vec3 {
        let [x, y, z] = [(); 3].map(|()| self.random.random_range(-1.0..1.0_f32));
        Vec3::new(x, y, z).normalize_or(Vec3::Y)
    }

    fn time(&mut self) -> f64 {
        f64::from(self.random.random_range(1..12)) / f64::from(STEPS_PER_SECOND)
    }

    fn pour(&mut self, fastest: f64) {
        let place = self.place();
        let for_s = self.time();
        let parts = [(); SLOTS + 1].map(|()| self.random.random_range(0.0..1.0_f64));
        let rate = self.random.random_range(0.0..fastest);
        let recipe = Recipe::of_parts(parts).unwrap();
        self.world.pour(Pour::at(place, rate, for_s, recipe)).unwrap();
        self.asked += (rate * for_s / self.world.quantum_mm3()).round() as u64;
    }

    fn lift(&mut self) {
        let place = self.place();
        let for_s = self.time();
        let radius = self.random.random_range(0.05..0.8);
        let rate = self.random.random_range(0.0..120.0);
        self.world.lift(Lift { track: Track::at(place), radius, rate, for_s }).unwrap();
    }

    /// Adds a volume with its own paint.
    fn add(&mut self) -> usize {
        let place = self.place();
        let radius = self.random.random_range(0.05..0.6);
        fn poured(world: &World) -> u64 {
            world.tally().poured.iter().sum::<u64>()
        }
        let before = poured(&self.world);
        let own = Single { detail: 1, ..single(place, radius) };
        let index = self.world.add_volume(&own).unwrap();
        self.asked += poured(&self.world) - before;
        index
    }

    fn go_on(&mut self, action: usize) {
        if action.is_multiple_of(100) {
            return self.world.step().unwrap();
        }
        self.world.move_paint(None).unwrap();
        for volume in self.world.volumes.iter_mut().filter(|volume| !volume.dry) {
            volume.radius = volume.target_radius.max(0.001);
        }
    }

    fn check(&self, action: usize) {
        let world = &self.world;
        assert!(is_exact(world), "{action}");
        for volume in world.volumes() {
            let most = volume.cell.map_or(1 << 30, |cell| {
                (16 * u64::from(world.grid.cells.capacities[cell as usize])).min(1 << 30)
            });
            assert!(u64::from(volume.paint.volume()) <= most, "{action}: {volume:?}");
        }
    }

    /// Lets all tubes run out. Compares what they gave with what they were to give.
    fn finish(mut self) -> Tally {
        (0..20).for_each(|_| self.world.move_paint(None).unwrap());
        self.check(ACTIONS);
        let tally = self.world.tally();
        let out: u64 = tally.poured.iter().chain(&tally.in_tube).sum();
        assert_eq!(out, self.asked);
        tally
    }
}

#[test]
fn random_actions_on_a_grid_keep_every_quantum() {
    let settings = WorldSettings {
        cell: 0.3,
        slope: 0.5,
        rate: 0.06,
        samples: 16,
        ..WorldSettings::default()
    };
    let mut played = Played::new(&settings);
    let mut split = 0;
    let mut most = 0;
    for action in 0..ACTIONS {
        match played.random.random_range(0..5000) {
            0..1500 => played.pour(3e4),
            1500..2000 => played.lift(),
            // Dry volumes stay for good.
            2000 => played.world.dry(),
            2001..2006 => {
                let index = played.add();
                // If a volume is too small, it may hold no sample.
                split += usize::from(played.world.split(index).is_ok());
            }
            2006 => {
                let place = played.place();
                let radius = played.random.random_range(0.05..0.8);
                played.world.dry_within(place, radius).unwrap();
            }
            _ => played.go_on(action),
        }
        most = most.max(played.world.volumes().len());
        if action % 100 == 0 {
            played.check(action);
        }
    }
    let tally = played.finish();
    assert!(split > 50 && most > 500, "{split} split, {most} volumes");
    assert!(tally.poured.iter().chain(&tally.lifted).all(|amount| *amount > 0));
    assert!(tally.in_tube.iter().all(|amount| *amount > 0), "no cell was full");
}

#[test]
fn random_actions_on_single_volumes_keep_every_quantum() {
    let settings = WorldSettings { cell: 0.0, samples: 4, ..WorldSettings::default() };
    let mut played = Played::new(&settings);
    let mut shrunk = 0;
    for action in 0..ACTIONS {
        match played.random.random_range(0..5000) {
            0..1500 => played.pour(3e5),
            1500..1650 => played.lift(),
            1650..1700 if !played.world.volumes().is_empty() => {
                let index = played.random.random_range(0..played.world.volumes().len());
                let share = played.random.random_range(0.0..1.2_f32).min(1.0);
                shrunk += usize::from(played.world.shrink(index, share).is_ok());
            }
            1700 => played.world.dry(),
            1701..1706 => {
                played.add();
            }
            _ => played.go_on(action),
        }
        if action % 100 == 0 {
            played.check(action);
        }
    }
    let tally = played.finish();
    assert!(shrunk > 50, "{shrunk}");
    assert!(tally.poured.iter().chain(&tally.lifted).all(|amount| *amount > 0));
}
