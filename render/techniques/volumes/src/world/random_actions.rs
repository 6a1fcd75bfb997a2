//! 100,000 random actions on one world: no quantum is lost or made, with a grid and without.

use glam::Vec3;
use graphics::mesh::Mesh;
use paint::layer::SLOTS;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::settings::STEPS_PER_SECOND;
use super::tests::{is_exact, single};
use super::*;

/// Actions in all.
const ACTIONS: usize = 100_000;

/// A world over a sphere of radius 1 at which things are done at random.
struct Played {
    world: World,
    random: ChaCha8Rng,
    /// What all tubes were to give, in quanta.
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

    /// Seconds of a few whole steps.
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

    /// Adds a volume of paint of its own.
    fn add(&mut self) -> usize {
        let place = self.place();
        let radius = self.random.random_range(0.05..0.6);
        let poured = |world: &World| world.tally().poured.iter().sum::<u64>();
        let before = poured(&self.world);
        let own = Single { detail: 1, ..single(place, radius) };
        let index = self.world.add_volume(&own).unwrap();
        self.asked += poured(&self.world) - before;
        index
    }

    /// Moves paint, and volumes at once to where they would grow.
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
            let capacity = |cell| u64::from(world.grid.cells.capacities[cell as usize]);
            let most = volume.cell.map_or(1 << 30, |cell| (16 * capacity(cell)).min(1 << 30));
            assert!(u64::from(volume.paint.volume()) <= most, "{action}: {volume:?}");
        }
    }

    /// Lets all tubes run out, and compares what they gave with what they were to give.
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
                // Too small a volume may hold no sample.
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
