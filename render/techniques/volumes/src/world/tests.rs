//! Worlds over surfaces of known form: lifting and pushing, paint that dries within a reach,
//! worlds without room for more volumes, worlds at rest, and worlds saved and resumed.

use glam::Vec3;
use graphics::mesh::{Mesh, SampleModel};

use super::*;
use crate::containing::Inside;
use crate::motion::{KeepIn, MotionSettings, Push};
use crate::saved::SavedError;
use crate::surfaces::VolumeSurfaces;
use crate::test_volumes::{joined, sheet};
use crate::volume::{Particles, Volume};
use crate::wetting::{SAMPLES_PER_CELL, SurfaceSamples};

pub(super) fn level(side: f32, height: f32) -> Mesh {
    sheet(1, |u, v| [side * (u - 0.5), height, side * (v - 0.5)])
}

/// A world over a level sheet of 12 by 12 mm in the middle, with 12 by 12 cells of 1 mm.
pub(super) fn flat() -> World {
    let settings = WorldSettings { unit_mm: Some(1.0), ..WorldSettings::default() };
    World::of(&level(12.0, 0.0), &settings).unwrap()
}

pub(super) fn run(world: &mut World, steps: usize) {
    for _ in 0..steps {
        world.step().unwrap();
    }
}

pub(super) fn is_exact(world: &World) -> bool {
    let tally = world.tally();
    (0..9).all(|slot| tally.poured[slot] == tally.on_scene[slot] + tally.lifted[slot])
}

pub(super) fn single(center: Vec3, radius: f32) -> Single {
    Single { center, radius, detail: 4, recipe: Some(Recipe::of_slot(2)), region: 1 }
}

fn held(world: &World) -> Vec<Vec3> {
    let insides: Vec<Inside> = world.volumes().iter().map(Inside::of).collect();
    let places = world.grid().samples.places.iter().copied();
    places.filter(|place| insides.iter().any(|inside| inside.holds(*place))).collect()
}

#[test]
fn what_is_poured_arrives_to_the_quantum_and_covers_its_area() {
    let mut world = flat();
    let recipe = Recipe::of_parts([3.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0]).unwrap();
    // As a film of 0.02 mm, 0.6 mm^3 cover 30 mm^2.
    let pour = Pour::at(Vec3::new(0.2, 0.3, 0.1), 0.4, 1.5, recipe);
    world.pour(Pour { region: 3, ..pour }).unwrap();
    run(&mut world, 600);
    assert!(world.volumes().len() > 20);
    for volume in world.volumes() {
        let capacity = world.grid().cells.capacities[volume.cell.unwrap() as usize];
        assert!(volume.region == 3 && volume.paint.volume() < capacity + capacity / 100);
    }
    let tally = world.tally();
    let whole = (0.6 / world.quantum_mm3()).round() as u64;
    assert_eq!(tally.poured.iter().sum::<u64>(), whole);
    assert_eq!(tally.on_scene, tally.poured);
    assert!(tally.poured[0].abs_diff(whole / 2) < 4 && tally.poured[8].abs_diff(whole / 3) < 4);
    let area = held(&world).len() as f32 * world.grid().samples.areas[0];
    assert!((area / 30.0 - 1.0).abs() < 0.15, "{area}");
}

#[test]
fn particles_are_kicked_at_birth_and_wherever_paint_is_poured() {
    fn across(world: &World) -> f32 {
        let Volume { particles, radius, .. } = &world.volumes()[0];
        let [places, speeds] = [&particles.places, &particles.velocities]
            .map(|[x, y, z]| (0..x.len()).map(|i| Vec3::new(x[i], y[i], z[i])).collect::<Vec<_>>());
        let pairs = places.iter().zip(&speeds);
        // Growth moves particles along their rays.
        pairs.map(|(place, speed)| place.normalize().cross(*speed).length()).fold(0.0, f32::max)
            / radius
    }
    fn kicked(kick: f32) -> [[f32; 3]; 2] {
        let motion = MotionSettings {
            kick,
            microstructure: 0.0,
            surface_pull: 0.0,
            ..MotionSettings::default()
        };
        let settings = WorldSettings { unit_mm: Some(1.0), motion, ..WorldSettings::default() };
        let mut world = World::of(&level(12.0, 0.0), &settings).unwrap();
        let pour = Pour::at(Vec3::new(0.5, 0.0, 0.5), 0.005, 0.5, Recipe::of_slot(0));
        [240, 600].map(|rest| {
            world.pour(pour.clone()).unwrap();
            run(&mut world, 1);
            let moving = across(&world);
            // Paint flows for 60 steps, but gives a kick only once.
            run(&mut world, 30);
            let flowing = across(&world);
            run(&mut world, rest);
            [moving, flowing, across(&world)]
        })
    }
    for [moving, flowing, resting] in kicked(0.3) {
        assert!(moving > 0.1 && resting < 0.01, "{moving} {resting}");
        assert!(flowing < 0.25 * moving, "{moving} {flowing}");
    }
    for [moving, ..] in kicked(0.0) {
        assert!(moving < 1e-3, "{moving}");
    }
}

#[test]
fn a_snapshot_goes_on_to_the_same_bits_on_any_number_of_threads() {
    fn whole(threads: usize, from: Option<&World>) -> (World, World) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut world = match from {
                Some(world) => world.clone(),
                None => {
                    let settings = WorldSettings { slope: 0.3, ..WorldSettings::default() };
                    let mut world =
                        World::of(&SampleModel::StillLife.mesh(2000), &settings).unwrap();
                    let at = world.grid().samples.places[1000];
                    let other = world.grid().samples.places[1200];
                    let path = Track::along(vec![(0.0, at), (1.0, other)]).unwrap();
                    let pour = Pour { track: path, ..Pour::at(at, 60.0, 0.8, Recipe::of_slot(1)) };
                    world.pour(pour).unwrap();
                    let lift = Lift { track: Track::at(at), radius: 0.2, rate: 3.0, for_s: 0.4 };
                    world.lift(lift).unwrap();
                    let push = Push { center: at, direction: Vec3::X, radius: 0.5, strength: 9.0 };
                    world.push(push, 0.5).unwrap();
                    run(&mut world, 40);
                    world
                }
            };
            let snapshot = world.clone();
            run(&mut world, 50);
            (snapshot, world)
        })
    }
    let (snapshot, end) = whole(1, None);
    assert!(end.volumes().len() > 3 && end.volumes() != snapshot.volumes());
    for threads in [1, 2, 8] {
        let (_, again) = whole(threads, Some(&snapshot));
        assert_eq!(again.volumes(), end.volumes());
        assert_eq!((again.tally(), again.steps()), (end.tally(), 90));
        assert_eq!(whole(threads, None).1.volumes(), end.volumes());
    }
}

#[test]
fn sources_off_the_surface_are_refused_with_their_distance() {
    let mut world = flat();
    fn pour(y: f32) -> Pour {
        Pour::at(Vec3::new(0.0, y, 0.0), 1.0, 1.0, Recipe::of_slot(0))
    }
    assert!(world.pour(pour(0.9)).is_ok());
    let Err(WorldError::OffSurface { distance, most, .. }) = world.pour(pour(2.0)) else {
        panic!("poured in the air");
    };
    assert!((distance - 2.0).abs() < 0.02 && (most - 1.0).abs() < 1e-6, "{distance} {most}");
    assert!(world.move_source(1, Vec3::splat(9.0)).is_err());
    assert!(world.pour(Pour { rate_mm3_s: -1.0, ..pour(0.0) }).is_err());
    assert!(world.pour(Pour { for_s: f64::NAN, ..pour(0.0) }).is_err());
}

#[test]
fn what_a_full_cell_has_no_room_for_stays_in_the_tube() {
    let mut world = flat();
    let walls = Vec3::new(0.6, 1.0, 0.6);
    world.keep(KeepIn::Box { low: -walls, high: walls }).unwrap();
    let kept = world.grid().cells.capacities.iter().filter(|capacity| **capacity > 0).count();
    world.pour(Pour::at(Vec3::ZERO, 2.0, 1.0, Recipe::of_slot(0))).unwrap();
    run(&mut world, 200);
    let tally = world.tally();
    assert_eq!(world.volumes().len(), kept);
    assert!(is_exact(&world) && tally.in_tube[0] > 0);
    let asked = tally.poured[0] + tally.in_tube[0];
    assert_eq!(asked, (2.0 / world.quantum_mm3()).round() as u64);
    // There is no surface left to pour on or to split to.
    let mut bare = world.clone();
    bare.keep(KeepIn::Ball { center: Vec3::splat(5.0), radius: 0.1 }).unwrap();
    assert!(bare.pour(Pour::at(Vec3::ZERO, 2.0, 1.0, Recipe::of_slot(0))).is_err());
    bare.add_volume(&single(Vec3::ZERO, 1.0)).unwrap();
    run(&mut bare, 20);
    assert!(is_exact(&bare) && bare.grid().samples.is_empty());
    // Walls hold the volumes back, except for the rounding of a wall.
    for volume in world.volumes() {
        assert!(volume.vertices().all(|at| at[0].abs() < 0.6001 && at[2].abs() < 0.6001));
    }
    for at in held(&world) {
        assert!(at.x.abs() < 0.6001 && at.z.abs() < 0.6001);
    }
}

#[test]
fn dry_paint_stays_as_it_is_under_new_paint() {
    let mut world = flat();
    fn pour(slot: usize) -> Pour {
        Pour::at(Vec3::ZERO, 0.1, 0.5, Recipe::of_slot(slot))
    }
    world.pour(pour(0)).unwrap();
    run(&mut world, 60);
    world.dry();
    let before = world.volumes().to_vec();
    assert!(before.len() > 1 && before.iter().all(|volume| volume.dry));
    let track = Track::at(Vec3::ZERO);
    world.lift(Lift { track, radius: 9.0, rate: 20.0, for_s: 0.2 }).unwrap();
    run(&mut world, 24);
    assert_eq!(world.volumes(), before, "a sponge took dry paint");
    world.pour(pour(1)).unwrap();
    run(&mut world, 60);
    assert_eq!(world.volumes()[..before.len()], before);
    assert!(world.volumes()[before.len()..].iter().all(|volume| volume.paint.pigments[0] == 0));
    assert!(is_exact(&world) && world.tally().on_scene[1] > 0);
}

#[test]
fn a_split_volume_leaves_its_paint_in_the_cells_it_held() {
    let mut world = flat();
    let index = world.add_volume(&single(Vec3::ZERO, 2.5)).unwrap();
    let whole = world.volumes()[index].paint;
    let film = whole.volume() as f64 * world.quantum_mm3() / 0.02;
    assert!((film / (2.5 * 2.5 * std::f64::consts::PI) - 1.0).abs() < 0.03, "{film}");
    run(&mut world, 10);
    let cells = world.split(index).unwrap();
    assert!((20..50).contains(&cells), "{cells}");
    assert!(is_exact(&world));
    assert_eq!(world.tally().on_scene[2], u64::from(whole.pigments[2]));
    assert_eq!(world.volumes().len(), cells + 1);
    assert!(world.volumes()[1..].iter().all(|volume| volume.detail == 2 && volume.region == 1));
    // Cells at the rim hold less of the surface than those in the middle.
    let amounts = world.volumes()[1..].iter().map(|volume| volume.paint.volume());
    let most = f64::from(amounts.clone().max().unwrap());
    assert!(amounts.min().unwrap() < whole.volume() / cells as u32 / 2);
    let full = f64::from(crate::wetting::QUANTA_PER_FACE);
    assert!((most / full - 1.0).abs() < 0.2, "{most} of {full}");
    run(&mut world, 400);
    assert_eq!(world.volumes().len(), cells, "the whole vanishes");
    for wrong in [0, 99] {
        assert!(matches!(world.split(wrong), Err(WorldError::Volume { .. })));
    }
    let away = world.add_volume(&single(Vec3::splat(9.0), 0.5)).unwrap();
    assert!(world.split(away).is_err());
}

#[test]
fn a_volume_without_paint_left_vanishes() {
    let mut world = flat();
    world.pour(Pour::at(Vec3::ZERO, 0.1, 0.5, Recipe::of_slot(0))).unwrap();
    world.add_volume(&single(Vec3::new(1.0, 0.0, 1.0), 0.7)).unwrap();
    run(&mut world, 60);
    assert!(world.volumes().len() > 2);
    let track = Track::at(Vec3::ZERO);
    world.lift(Lift { track, radius: 9.0, rate: 20.0, for_s: 3.0 }).unwrap();
    run(&mut world, 400);
    assert!(world.volumes().is_empty());
    assert!(is_exact(&world));
    assert_eq!(world.tally().lifted, world.tally().poured);
}

#[test]
fn a_volume_shrinks_with_its_paint_until_it_vanishes() {
    let mut world = flat();
    let index = world.add_volume(&single(Vec3::ZERO, 2.0)).unwrap();
    let bare = Single { recipe: None, ..single(Vec3::X, 1.0) };
    let other = world.add_volume(&bare).unwrap();
    world.shrink(index, 0.75).unwrap();
    world.shrink(other, 0.5).unwrap();
    run(&mut world, 300);
    let radii = [index, other].map(|index| world.volumes()[index].radius);
    // A quarter of the paint covers a quarter of the area.
    assert!((radii[0] - 1.0).abs() < 0.05 && (radii[1] - 0.5).abs() < 1e-3, "{radii:?}");
    world.shrink(index, 1.0).unwrap();
    world.shrink(other, 1.0).unwrap();
    run(&mut world, 300);
    assert!(world.volumes().is_empty() && is_exact(&world));
    assert!(world.shrink(0, 1.0).is_err());
}

#[test]
fn full_cells_of_rough_volumes_hold_all_surface() {
    for shape in SampleModel::ALL {
        let mesh = shape.mesh(3000);
        let settings = WorldSettings { cell: 0.125, ..WorldSettings::default() };
        let mut world = World::of(&mesh, &settings).unwrap();
        for cell in 0..world.grid.cells.len() {
            let place = world.grid.samples.places[world.grid.samples.of_cell(cell).start];
            let index = world.volume_in(cell, place, 0).unwrap();
            let paint = Recipe::of_slot(0).measured(world.grid.cells.capacities[cell]);
            world.set_paint(index, paint);
            world.volumes[index].radius = world.volumes[index].target_radius;
        }
        run(&mut world, 60);
        let insides: Vec<(Vec3, Inside)> =
            world.volumes().iter().map(|volume| (volume.center, Inside::of(volume))).collect();
        // These are other places than the grid has, four times as many.
        let places =
            SurfaceSamples::of(&mesh, world.scale.cell / 2.0, SAMPLES_PER_CELL, 77).unwrap().places;
        let bare = places.iter().filter(|&&at: &&Vec3| {
            let mut near = insides
                .iter()
                .filter(|(center, inside)| f64::from(center.distance(at)) <= inside.farthest());
            !near.any(|(_, inside)| inside.holds(at))
        });
        let bare = bare.count();
        assert_eq!(bare, 0, "{} of {} on {}", bare, places.len(), shape.name());
    }
}

#[test]
fn paint_stays_on_one_of_two_plates() {
    let settings = WorldSettings { unit_mm: Some(1.0), ..WorldSettings::default() };
    let plates = joined(level(12.0, 0.0), &level(12.0, 1.0));
    let mut world = World::of(&plates, &settings).unwrap();
    world.pour(Pour::at(Vec3::new(0.0, -0.1, 0.0), 1.0, 1.0, Recipe::of_slot(0))).unwrap();
    run(&mut world, 240);
    assert!(world.volumes().len() > 20);
    assert!(world.volumes().iter().all(|volume| volume.center.y < 0.1));
}

#[test]
fn without_a_grid_paint_grows_single_volumes() {
    let settings = WorldSettings { unit_mm: Some(1.0), cell: 0.0, ..WorldSettings::default() };
    let mut world = World::of(&level(12.0, 0.0), &settings).unwrap();
    world.pour(Pour::at(Vec3::ZERO, 0.1, 1.0, Recipe::of_slot(0))).unwrap();
    run(&mut world, 400);
    assert_eq!(world.volumes().len(), 1);
    // As a film of 0.02 mm, 0.1 mm^3 make a disk of 5 mm^2.
    let radius = world.volumes()[0].radius;
    assert!((radius / (5.0 / std::f32::consts::PI).sqrt() - 1.0).abs() < 0.04, "{radius}");
    assert!(world.split(0).is_err());
}

#[test]
fn worlds_and_volumes_out_of_range_are_refused() {
    let mesh = level(12.0, 0.0);
    let defaults = WorldSettings::default();
    for wrong in [
        WorldSettings { cell: -0.1, ..defaults },
        WorldSettings { film_mm: 0.0, ..defaults },
        WorldSettings { unit_mm: Some(f64::NAN), ..defaults },
        WorldSettings { rate: 0.1, ..defaults },
        WorldSettings { cell: 1e-6, ..defaults },
    ] {
        assert!(World::of(&mesh, &wrong).is_err());
    }
    let mut world = World::of(&mesh, &defaults).unwrap();
    assert!((world.unit_mm() - 200.0 / 12.0).abs() < 1e-9);
    let good = Single { recipe: None, detail: 0, ..single(Vec3::ZERO, 1.0) };
    for wrong in [
        Single { radius: 0.0, ..good },
        Single { detail: 6, ..good },
        Single { center: Vec3::NAN, ..good },
    ] {
        assert!(world.add_volume(&wrong).is_err());
    }
    for _ in 0..MOST_VOLUMES {
        world.add_volume(&good).unwrap();
    }
    let full = world.add_volume(&good);
    assert_eq!(full, Err(WorldError::Full { what: "volumes", most: MOST_VOLUMES }));
    assert_eq!(world.tally(), Tally::default());
}

#[test]
fn a_sponge_takes_the_paint_below_it() {
    let mut world = flat();
    world.pour(Pour::at(Vec3::ZERO, 0.6, 1.0, Recipe::of_slot(0))).unwrap();
    run(&mut world, 400);
    fn amounts(world: &World) -> Vec<u32> {
        world.volumes().iter().map(|volume| volume.paint.volume()).collect()
    }
    let before = amounts(&world);
    // The sponge takes all that lies below in one step.
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
    // If the surface pulls particles, they may come to rest at other samples.
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

fn spread() -> World {
    let mut world = flat();
    world.pour(Pour::at(Vec3::ZERO, 2.0, 0.5, Recipe::of_slot(0))).unwrap();
    run(&mut world, 360);
    assert!(world.volumes().len() > 30, "{}", world.volumes().len());
    world
}

fn with(world: &World, dry: bool) -> Vec<Volume> {
    world.volumes().iter().filter(|volume| volume.dry == dry).cloned().collect()
}

#[test]
fn paint_dries_below_the_dryer_and_flows_on_beside_it() {
    let mut world = spread();
    let place = Vec3::new(1.0, 0.0, 0.0);
    let radius = 1.6;
    let dried = world.dry_within(place, radius).unwrap();
    let dry = with(&world, true);
    assert_eq!(dry.len(), dried);
    // The cells are 1 mm wide. 12 have their middle below, and paint in others may lie near.
    assert!((8..=16).contains(&dried), "{dried}");
    for volume in &dry {
        assert!(volume.center.distance(place) < radius + 0.5, "{:?}", volume.center);
    }
    for volume in with(&world, false) {
        assert!(volume.center.distance(place) > radius - 0.5, "{:?}", volume.center);
    }
    assert_eq!(world.dry_within(place, radius), Ok(0), "they are dry already");
    let wet: Vec<u64> = with(&world, false).iter().map(|volume| volume.seed).collect();
    world.pour(Pour::at(place, 1.0, 1.0, Recipe::of_slot(1))).unwrap();
    run(&mut world, 240);
    assert_eq!(with(&world, true), dry, "shape and paint stay");
    let new = with(&world, false).into_iter().filter(|volume| !wet.contains(&volume.seed));
    let over = new.filter(|volume| volume.center.distance(place) < radius).count();
    assert!(over > 4, "new paint lies over the dry one: {over} volumes");
    assert!(is_exact(&world));
}

#[test]
fn a_small_dryer_dries_the_volume_that_it_touches_and_a_large_one_all() {
    let mut world = spread();
    let touched = world.volumes().iter().max_by_key(|volume| volume.paint.volume()).unwrap();
    let seed = touched.seed;
    let place = touched.center;
    assert!(world.dry_within(place, 1e-3).unwrap() >= 1);
    assert!(with(&world, true).iter().any(|volume| volume.seed == seed));
    assert_eq!(world.dry_within(Vec3::new(0.0, 9.0, 0.0), 1.0), Ok(0), "above the surface");
    let wet = with(&world, false).len();
    assert_eq!(world.dry_within(Vec3::ZERO, 100.0), Ok(wet));
    let mut all = spread();
    all.dry_within(Vec3::ZERO, 100.0).unwrap();
    let mut dried = spread();
    dried.dry();
    run(&mut all, 30);
    run(&mut dried, 30);
    assert_eq!(all.volumes(), dried.volumes());
}

#[test]
fn single_volumes_dry_below_the_dryer() {
    let mut world = flat();
    for x in [-4.0, 4.0] {
        world.add_volume(&single(Vec3::new(x, 0.0, 0.0), 1.0)).unwrap();
    }
    run(&mut world, 10);
    assert_eq!(world.dry_within(Vec3::new(4.0, 0.0, 0.0), 1.5), Ok(1));
    let dry: Vec<bool> = world.volumes().iter().map(|volume| volume.dry).collect();
    assert_eq!(dry, [false, true]);
}

#[test]
fn dryers_out_of_range_are_refused() {
    let mut world = flat();
    for (place, radius) in [
        (Vec3::ZERO, 0.0),
        (Vec3::ZERO, f32::NAN),
        (Vec3::ZERO, f32::INFINITY),
        (Vec3::new(f32::NAN, 0.0, 0.0), 1.0),
    ] {
        let refused = world.dry_within(place, radius);
        assert!(matches!(refused, Err(WorldError::Number { .. })), "{place} {radius}");
    }
}

#[test]
fn a_full_world_keeps_paint_where_it_is_or_in_the_tube() {
    let mut world = flat();
    let dot = Single { recipe: None, detail: 0, ..single(Vec3::splat(9.0), 0.1) };
    for _ in 0..MOST_VOLUMES - 3 {
        world.add_volume(&dot).unwrap();
    }
    world.pour(Pour::at(Vec3::ZERO, 1.0, 1.0, Recipe::of_slot(0))).unwrap();
    let far = Vec3::new(4.0, 0.0, 4.0);
    for _ in 0..60 {
        world.move_paint(None).unwrap();
    }
    world.add_volume(&dot).unwrap();
    world.add_volume(&dot).unwrap();
    world.pour(Pour::at(far, 1.0, 0.5, Recipe::of_slot(1))).unwrap();
    for _ in 0..60 {
        world.move_paint(None).unwrap();
    }
    assert_eq!(world.volumes().len(), MOST_VOLUMES);
    assert!(is_exact(&world));
    let tally = world.tally();
    assert_eq!(tally.in_tube[1], (0.5 / world.quantum_mm3()).round() as u64);
    assert!(tally.on_scene[0] > 0 && tally.on_scene[1] == 0);
}

#[test]
fn volumes_on_a_surface_come_to_rest() {
    let mut world =
        World::of(&SampleModel::StillLife.mesh(3000), &WorldSettings::default()).unwrap();
    for cell in (0..world.grid().cells.len()).step_by(7) {
        let samples = &world.grid().samples;
        let place = samples.places[samples.of_cell(cell).start];
        world.pour(Pour::at(place, 4.0, 1.0, Recipe::of_slot(cell % 3))).unwrap();
    }
    run(&mut world, 1200);
    let moving = world.volumes.iter().filter(|volume| volume.rests_under == 0).count();
    assert!(world.volumes.len() > 100 && moving == 0, "{moving} of {}", world.volumes.len());
    let rested = world.volumes.clone();
    run(&mut world, 10);
    assert_eq!(world.volumes, rested);
}

#[test]
fn particles_and_samples_take_no_more_memory_than_they_may() {
    use std::mem::size_of_val;
    let mut world =
        World::of(&SampleModel::StillLife.mesh(3000), &WorldSettings::default()).unwrap();
    let place = world.grid().samples.places[100];
    world.pour(Pour::at(place, 60.0, 0.5, Recipe::of_slot(0))).unwrap();
    run(&mut world, 120);
    let mut bytes = 0;
    let mut particles = 0;
    for volume in world.volumes() {
        let Particles { places, velocities, samples } = &volume.particles;
        let along: usize =
            places.iter().chain(velocities).map(|along| size_of_val(&along[..])).sum();
        bytes += size_of_val(volume) + along + size_of_val(&samples[..]);
        particles += samples.len();
    }
    // We draw with four shells. Each has separate faces.
    let drawn = VolumeSurfaces::of(world.volumes());
    bytes += 4 * (size_of_val(&drawn.vertices[..]) + size_of_val(&drawn.triangles[..]));
    assert!(particles > 500 && bytes <= 400 * particles, "{} a particle", bytes / particles);
    let SurfaceSamples { places, normals, areas, triangles, cells, starts, bodies, .. } =
        &world.grid().samples;
    let vectors = size_of_val(&places[..]) + size_of_val(&normals[..]);
    let numbers = [triangles, cells, starts, bodies].map(|own| size_of_val(&own[..]));
    let bytes = vectors + size_of_val(&areas[..]) + numbers.iter().sum::<usize>();
    assert!(bytes <= 64 * places.len(), "{} a sample", bytes / places.len());
}

const WISH: &str = "a test";

/// Paint flows along a track, is lifted, pushed and kept in, beside a single volume and dry ones.
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
        // Births continue with the numbers of before.
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
    let mesh = SampleModel::Sphere.mesh(500);
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
    let wrong: [fn(&mut Volume); 4] = [
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
