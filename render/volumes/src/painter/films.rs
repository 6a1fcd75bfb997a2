//! Volumes in measured pigments: what is prepared once for all pictures.

use std::sync::Arc;

use glam::Vec3;
use graphics::camera::Camera;
use graphics::field::Field;
use graphics::surface::{ClosedSurfaces, Crossings};
use paint::document::{Lighting, Slots};
use paint::ground::GroundSpec;
use pigment::PigmentLibrary;

use super::error::PaintingError;
use super::looks::{self, RegionLook};
use super::region_counts::Volumes;
use crate::pigments::{
    Density, Film, FilmHeights, FilmMaterial, FilmOnSurface, FilmPainter, FilmPainterSettings,
    FilmScale, FilmThrough, FilmView, SampleLattice, SeenPlaces,
};
use crate::settings::{self, Settings};
use crate::surfaces::VolumeSurfaces;
use crate::volume::Volume;
use crate::world::World;

/// Width of a cell of a painting in mm.
pub const CELL_MM: f64 = 0.2;

/// Pigments, ground and light of a painting of volumes.
#[derive(Debug, Clone)]
pub struct VolumePigments {
    /// Library of the pigments.
    pub library: Arc<PigmentLibrary>,
    /// Pigments of the volumes by slot.
    pub slots: Slots,
    /// Pigments for the colours of the scene; those of the volumes if left out.
    pub own_colors: Option<Slots>,
    /// The ground under all films.
    pub ground: GroundSpec,
    /// Light that the painting is viewed under.
    pub lighting: Lighting,
}

/// Films of all volumes for one painter.
#[derive(Debug)]
pub(super) struct Films {
    pub(super) painter: FilmPainter,
    pub(super) view: FilmView,
    lattice: Option<SampleLattice>,
    surfaces: VolumeSurfaces,
}

impl Films {
    pub(super) fn new(
        pigments: VolumePigments,
        settings: &Settings,
        regions: &[RegionLook],
    ) -> Result<Self, PaintingError> {
        let VolumePigments { library, slots, own_colors, ground, lighting } = pigments;
        let material = FilmMaterial::new(library, ground, lighting.clone())?;
        let usual = FilmPainterSettings::default();
        let painter = FilmPainterSettings {
            under: looks::under(settings),
            inside: looks::inside(regions),
            pencil: settings.hatching.pencil,
            cell_mm: CELL_MM,
            ..usual
        };
        let painter = FilmPainter::new(material, slots, own_colors, painter)?;
        let view = FilmView::new(&painter, &lighting)?;
        Ok(Self { painter, view, lattice: None, surfaces: VolumeSurfaces::default() })
    }

    /// Heights of the films at what each pixel shows. Volumes of regions without films have none.
    pub(super) fn heights(
        &mut self,
        world: &World,
        regions: &[RegionLook],
        settings: &Settings,
        crossings: &mut Crossings,
        (seen, camera): (&SeenPlaces<'_>, &Camera),
    ) -> Field<FilmHeights> {
        let facing = world.facing();
        let all = Volumes { volumes: world.volumes(), facing: &facing };
        let (volumes, facing) = filmed(all, regions);
        self.surfaces.update(&volumes);
        let closed = ClosedSurfaces {
            vertices: &self.surfaces.vertices,
            triangles: &self.surfaces.triangles,
        };
        let scale = FilmScale {
            quantum_mm3: world.quantum_mm3(),
            unit_mm: world.unit_mm(),
            cell_mm: CELL_MM,
        };
        let visible = seen.visible();
        match settings.drawing.film {
            settings::Film::Surface => {
                let samples = &world.grid().samples;
                let lattice = self
                    .lattice
                    .get_or_insert_with(|| SampleLattice::of(&samples.places, world.cell()));
                let surface = (&samples.into(), &*lattice);
                let profile = looks::profile(settings);
                let films = Film::of_volumes(&volumes, &facing, profile, surface, &scale);
                let on_surface = FilmOnSurface { films: &films, seen };
                crossings.sum(&on_surface, closed, camera, visible)
            }
            settings::Film::Through => {
                let densities: Vec<Density> =
                    volumes.iter().map(|volume| Density::of(volume, &scale)).collect();
                let through = FilmThrough::new(&densities, camera, &seen.places, false);
                crossings.sum(&through, closed, camera, visible)
            }
        }
    }
}

/// The volumes of regions with films, with the normals of their cells.
fn filmed(all: Volumes<'_>, regions: &[RegionLook]) -> (Vec<Volume>, Vec<Vec3>) {
    let has_films = |volume: &Volume| {
        regions
            .get(usize::from(volume.region))
            .is_some_and(|region| looks::has_films(region.inside))
    };
    let pairs = all.volumes.iter().zip(all.facing);
    pairs.filter(|(volume, _)| has_films(volume)).map(|(volume, &to)| (volume.clone(), to)).unzip()
}
