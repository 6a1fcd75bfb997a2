//! Paint that dries within a reach.

use glam::Vec3;

use super::tests::{flat, is_exact, run, single};
use super::*;
use crate::volume::Volume;

/// A flat world with 1 mm3 of paint in the middle that has spread.
fn spread() -> World {
    let mut world = flat();
    world.pour(Pour::at(Vec3::ZERO, 2.0, 0.5, Recipe::of_slot(0))).unwrap();
    run(&mut world, 360);
    assert!(world.volumes().len() > 30, "{}", world.volumes().len());
    world
}

/// The volumes that are dry, or those that are wet.
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
    // Cells of 1 mm: 12 have their middle below, and paint in others may lie near.
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
