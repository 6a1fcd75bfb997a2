//! Volumes, paint and colour at a place of a scene.

use glam::Vec3;
use graphics::field::Field;
use paint::amount::mm_from_quanta;
use paint::document::Slots;
use paint::layer::SLOTS;
use spectra::color::{ColorCode, Rgb};
use volumes::containing::Inside;
use volumes::painter::CELL_MM;
use volumes::pigments::{Film, FilmProfile, FilmScale, FilmSum, SampleLattice};
use volumes::script::RegionTable;
use volumes::volume::Volume;
use volumes::world::World;

use super::event::Here;
use super::ray::Hit;
use crate::event::PickedLayer;

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
    let nearest = world.grid().nearest(place);
    let body = nearest.map_or(0, |(sample, _)| world.grid().samples.bodies[sample]);
    let own = world
        .volumes()
        .iter()
        .filter(|volume: &&Volume| volume.body == 0 || body == 0 || volume.body == body);
    let holding = own.filter(|volume| Inside::of(volume).holds(place));
    let volumes: Vec<Volume> = holding.cloned().collect();
    let samples = &world.grid().samples;
    let lattice = SampleLattice::of(&samples.places, world.cell());
    let quantum_mm3 = world.quantum_mm3();
    let unit_mm = world.unit_mm();
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

/// Colour of a picture at a share of its width and height.
pub(super) fn color_at(picture: &Field<[f32; 4]>, at: [f32; 2]) -> [u8; 3] {
    let sides = [picture.width(), picture.height()];
    let index = |axis: usize| {
        let place = (at[axis] * sides[axis] as f32).max(0.0) as usize;
        place.min(sides[axis].saturating_sub(1))
    };
    let [red, green, blue, _] = picture[(index(0), index(1))];
    [red, green, blue].map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8)
}

/// The answer to the painter: what was found at a place, if there is a surface, and the colour
/// shown there. `slots` are the pigments of the volumes.
pub(super) fn told(
    found: Option<(Vec3, Found)>,
    srgb: [u8; 3],
    slots: Slots,
    regions: &[RegionTable],
) -> Here {
    let rgb = Rgb(srgb.map(|channel| f64::from(channel) / 255.0));
    let lab = ColorCode::Srgb(rgb).lab();
    let lab = [lab.lightness, lab.a, lab.b];
    let Some((place, found)) = found else {
        return Here { place: None, volumes: 0, region: None, paint: None, lab, srgb };
    };
    let amounts_mm = found.heights_mm;
    let has_paint = amounts_mm.iter().any(|height_mm| *height_mm > 0.0);
    let label = "Paint".to_owned();
    let paint = has_paint.then_some(PickedLayer { label, slots, amounts_mm, opacity: 1.0 });
    let region = found.region.and_then(|index| Some(regions.get(index)?.name.clone()));
    Here { place: Some(place), volumes: found.volumes, region, paint, lab, srgb }
}
