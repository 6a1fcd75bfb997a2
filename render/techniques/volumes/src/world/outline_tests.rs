//! The outline of paint on a level sheet in its first seconds.

use glam::Vec3;

use super::tests::{flat, level, run};
use super::*;
use crate::containing::Inside;
use crate::motion::MotionSettings;

/// Places along each side of the sheet at which it is looked at.
const SIDE: usize = 240;

/// The wet part of the sheet at a moment.
struct Outline {
    /// Share of the wet area that is not joined to where paint is poured.
    apart: f64,
    /// Distances of the nearest dry and the farthest wet place from where paint is poured, over
    /// the radius of a circle of the same area.
    rim: [f64; 2],
    /// Wet area by the area that its paint covers as a film.
    area: f64,
}

fn outline(world: &World, from: Vec3) -> Outline {
    let insides: Vec<Inside> = world.volumes().iter().map(Inside::of).collect();
    let width = 12.0 / SIDE as f32;
    let place = |at: usize| {
        let along = |index: usize| (index as f32 + 0.5) * width - 6.0;
        Vec3::new(along(at % SIDE), 0.0, along(at / SIDE))
    };
    let places = 0..SIDE * SIDE;
    let wet: Vec<bool> =
        places.clone().map(|at| insides.iter().any(|inside| inside.holds(place(at)))).collect();
    let area = wet.iter().filter(|wet| **wet).count();
    // Flooded from the wet place nearest to the source.
    let distance = |at: &usize| place(*at).distance(from);
    let nearest = |is_wet: bool| {
        let all = places.clone().filter(|at| wet[*at] == is_wet);
        all.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
    };
    let mut joined = vec![false; wet.len()];
    let mut waiting = vec![nearest(true)];
    joined[waiting[0]] = true;
    while let Some(at) = waiting.pop() {
        for next in [at.wrapping_sub(1), at + 1, at.wrapping_sub(SIDE), at + SIDE] {
            if wet.get(next) == Some(&true) && !std::mem::replace(&mut joined[next], true) {
                waiting.push(next);
            }
        }
    }
    let held = joined.iter().filter(|joined| **joined).count();
    let farthest = places.clone().filter(|at| wet[*at]).map(|at| distance(&at)).fold(0.0, f32::max);
    let equal = f64::from(width) * (area as f64 / std::f64::consts::PI).sqrt();
    let rim = [distance(&nearest(false)), farthest].map(|at| f64::from(at) / equal);
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
    // A rim is made of whole cells, so it is the rounder the more cells it is away.
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
