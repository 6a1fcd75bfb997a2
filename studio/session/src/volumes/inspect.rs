//! What is at a place of a scene.

use render::amount::mm_from_quanta;
use render::layer::SLOTS;
use render::volumes::containing::Inside;
use render::volumes::painter::CELL_MM;
use render::volumes::pigments::{Film, FilmProfile, FilmScale, FilmSum, SampleLattice};
use render::volumes::volume::Volume;
use render::volumes::world::World;

use super::ray::Hit;

/// Volumes and paint at a place on a surface.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Found {
    /// Number of volumes that hold it.
    pub(super) volumes: usize,
    /// Index of the region of the last of them; none outside.
    pub(super) region: Option<usize>,
    /// Heights of the films by slot and, last, of vehicle, in mm.
    pub(super) heights_mm: [f64; SLOTS + 1],
}

/// Volumes of `world` that hold a place on its surface, and the films of their paint there.
pub(super) fn found_at(world: &World, hit: &Hit, profile: FilmProfile) -> Found {
    let Hit { place, normal } = *hit;
    let holding = world.volumes().iter().filter(|volume| Inside::of(volume).holds(place));
    let volumes: Vec<Volume> = holding.cloned().collect();
    let samples = &world.grid().samples;
    let lattice = SampleLattice::of(&samples.places, world.cell());
    let (quantum_mm3, unit_mm) = (world.quantum_mm3(), world.unit_mm());
    let scale = FilmScale { quantum_mm3, unit_mm, cell_mm: CELL_MM };
    let surface = (&samples.into(), &lattice);
    let films = Film::of_volumes(&volumes, profile, surface, &scale);
    let insides: Vec<Inside> = volumes.iter().map(Inside::of).collect();
    let heights = FilmSum { films: &films, insides: &insides }.at(place, normal);
    Found {
        volumes: volumes.len(),
        region: volumes.last().map(|volume| usize::from(volume.region)),
        heights_mm: heights.0.map(|quanta| mm_from_quanta(quanta.max(0) as u32, CELL_MM)),
    }
}
