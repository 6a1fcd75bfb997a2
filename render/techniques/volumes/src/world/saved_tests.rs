//! Worlds saved and resumed.

use glam::Vec3;

use super::tests::{flat, is_exact, run, single};
use super::*;
use crate::motion::{KeepIn, Push};
use crate::saved::SavedError;

const WISH: &str = "a test";

/// A world in which paint flows along a track, is lifted, pushed and kept in, beside a single
/// volume and dry ones.
fn busy() -> World {
    let mut world = flat();
    world.keep(KeepIn::Above { point: Vec3::X * -4.0, normal: Vec3::X }).unwrap();
    let recipe = Recipe::of_parts([3.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0]).unwrap();
    world.pour(Pour::at(Vec3::new(2.2, 0.0, 0.1), 0.9, 0.2, recipe)).unwrap();
    run(&mut world, 30);
    world.dry();
    let track = Track::along(vec![(0.0, Vec3::ZERO), (0.7, Vec3::new(3.0, 0.0, 2.0))]).unwrap();
    world.pour(Pour { track, rate_mm3_s: 0.7, for_s: 0.8, recipe, region: 2 }).unwrap();
    world.pour(Pour::at(Vec3::Z, 0.1, f64::INFINITY, recipe)).unwrap();
    world.add_volume(&single(Vec3::new(-2.0, 0.0, -2.0), 1.0)).unwrap();
    let lift = Lift { track: Track::at(Vec3::ZERO), radius: 1.0, rate: 2.0, for_s: 0.4 };
    world.lift(lift).unwrap();
    let push = Push { center: Vec3::ZERO, direction: Vec3::X, radius: 3.0, strength: 20.0 };
    world.push(push, 0.6).unwrap();
    world
}

#[test]
fn a_world_that_was_saved_goes_on_to_the_same_bytes() {
    let mut world = busy();
    let beginning = {
        let mut empty = flat();
        empty.keep(KeepIn::Above { point: Vec3::X * -4.0, normal: Vec3::X }).unwrap();
        empty
    };
    for steps in [0, 1, 24, 30, 45, 200] {
        run(&mut world, steps);
        let mut again = beginning.resumed(&world.saved(WISH), WISH).unwrap();
        assert_eq!(again.saved(WISH), world.saved(WISH));
        assert_eq!((again.steps(), again.seconds()), (world.steps(), world.seconds()));
        assert_eq!(again.surroundings(), world.surroundings());
        let mut whole = world.clone();
        run(&mut whole, 90);
        run(&mut again, 90);
        assert_eq!(again.volumes(), whole.volumes(), "after {steps} steps");
        assert_eq!(again.tally(), whole.tally());
        // Births go on with the numbers of before.
        assert_eq!(again.push(push(), 1.0).unwrap(), whole.push(push(), 1.0).unwrap());
        assert!(is_exact(&again));
    }
    let tally = world.tally();
    assert!(tally.lifted[0] > 0 && world.volumes().len() > 20, "{tally:?}");
}

fn push() -> Push {
    Push { center: Vec3::ZERO, direction: Vec3::X, radius: 1.0, strength: 1.0 }
}

#[test]
fn files_of_other_worlds_and_damaged_ones_are_refused() {
    let mut world = flat();
    world.add_volume(&single(Vec3::ZERO, 1.0)).unwrap();
    run(&mut world, 3);
    let file = world.saved(WISH);
    assert!(flat().resumed(&file, WISH).is_ok());
    let other = Err(SavedError::Other);
    let found = |world: &World, wish: &str| world.resumed(&file, wish).map(|world| world.steps());
    assert_eq!(found(&flat(), "another"), other);
    let mut kept = flat();
    kept.keep(KeepIn::Ball { center: Vec3::ZERO, radius: 4.0 }).unwrap();
    assert_eq!(found(&kept, WISH), other);
    let mesh = graphics::mesh::SampleModel::Sphere.mesh(500);
    let settings = WorldSettings { unit_mm: Some(1.0), ..WorldSettings::default() };
    assert_eq!(found(&World::of(&mesh, &settings).unwrap(), WISH), other);
    let damaged = Err(SavedError::Damaged);
    for length in [0, 1, 51, 52, file.len() / 2, file.len() - 1] {
        let short = flat().resumed(&file[..length], WISH).map(|world| world.steps());
        assert_eq!(short, damaged, "{length}");
    }
    for at in (16..file.len()).step_by(997) {
        let mut changed = file.clone();
        changed[at] ^= 1;
        assert!(flat().resumed(&changed, WISH).is_err(), "byte {at}");
    }
}

#[test]
fn states_that_no_world_has_are_refused() {
    let mut world = flat();
    let at = world.add_volume(&single(Vec3::ZERO, 1.0)).unwrap();
    let wrong: [fn(&mut crate::volume::Volume); 4] = [
        |volume| volume.detail = 9,
        |volume| volume.detail = 2,
        |volume| volume.cell = Some(1 << 20),
        |volume| volume.particles.samples.truncate(5),
    ];
    for change in wrong {
        let mut other = world.clone();
        change(&mut other.volumes[at]);
        let refused = flat().resumed(&other.saved(WISH), WISH).map(|world| world.steps());
        assert_eq!(refused, Err(SavedError::Damaged));
    }
}
