//! Worlds without room for more volumes, and worlds at rest.

use glam::Vec3;
use graphics::mesh::SampleModel;

use super::tests::{flat, is_exact, run, single};
use super::*;
use crate::surfaces::VolumeSurfaces;
use crate::volume::Particles;
use crate::wetting::SurfaceSamples;

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
    // Drawn with four shells, each with faces of its own.
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
