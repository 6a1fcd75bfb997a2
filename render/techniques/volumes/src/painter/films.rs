//! Volumes in measured pigments. This prepares once what all pictures need.

use std::sync::Arc;

use glam::Vec3;
use graphics::camera::Camera;
use graphics::field::Field;
use graphics::surface::{PackedMesh, VisibilityBuffer};
use paint::document::{Lighting, Slots};
use paint::ground::GroundSpec;
use pigment::PigmentLibrary;

use super::error::PaintingError;
use super::in_sight::{self, InSight, RegionLook};
use crate::pigments::{
    FilmCounter, FilmHeights, FilmKind, FilmMaterial, FilmPainter, FilmPainterSettings, FilmScale,
    FilmView,
};
use crate::settings::Settings;
use crate::volume::Volume;
use crate::wetting::Grid;
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
    /// Pigments for the colours of the scene. If you leave them out, these are the pigments of the
    /// volumes.
    pub own_colors: Option<Slots>,
    /// The ground under all films.
    pub ground: GroundSpec,
    /// Light under which you view the painting. Without relief ([`Lighting::relief`] 0) pictures
    /// are fast enough for an animation.
    pub lighting: Lighting,
}

#[derive(Debug)]
pub(super) struct Films {
    pub(super) painter: FilmPainter,
    pub(super) view: FilmView,
    /// The counter, with the grid for which it was made.
    counter: Option<(Arc<Grid>, FilmCounter)>,
}

impl Films {
    pub(super) fn new(
        pigments: VolumePigments,
        settings: &Settings,
        regions: &[RegionLook],
    ) -> Result<Self, PaintingError> {
        let VolumePigments { library, slots, own_colors, ground, lighting } = pigments;
        let material = FilmMaterial::new(library, ground, lighting.clone())?;
        let own = FilmPainterSettings {
            under: settings.drawing.under,
            inside: in_sight::inside(regions),
            neutral: settings.drawing.neutral,
            pencil: settings.hatching.pencil,
            cell_mm: CELL_MM,
            ..FilmPainterSettings::default()
        };
        let painter = FilmPainter::new(material, slots, own_colors, own)?;
        let view = FilmView::new(&painter, &lighting)?;
        Ok(Self { painter, view, counter: None })
    }

    /// Heights of the films at the point of `scene` that each pixel shows. We leave out the volumes
    /// of regions without films.
    pub(super) fn heights(
        &mut self,
        world: &World,
        (regions, settings): (&[RegionLook], &Settings),
        (scene, visible, in_sight, camera): (&PackedMesh, &VisibilityBuffer, &InSight, &Camera),
    ) -> Field<FilmHeights> {
        let surface = (&world.grid().samples).into();
        let profile = in_sight::profile(settings);
        let scale = FilmScale {
            quantum_mm3: world.quantum_mm3(),
            unit_mm: world.unit_mm(),
            cell_mm: CELL_MM,
        };
        let grid = world.shared_grid();
        self.counter.take_if(|(made_for, _)| !Arc::ptr_eq(made_for, grid));
        let (_, counter) = self.counter.get_or_insert_with(|| {
            let counter = FilmCounter::new(scene, &surface, world.cell(), profile, scale);
            (Arc::clone(grid), counter)
        });
        (counter.profile, counter.scale) = (profile, scale);
        counter.tell_bodies(&grid.bodies.of_triangles);
        let kind = settings.drawing.film;
        let volumes = world.volumes().iter().zip(world.facing());
        let volumes = volumes.filter(|(volume, _)| {
            let region = regions.get(usize::from(volume.region));
            // You see films through volumes before surfaces too.
            region.is_some_and(|region| region.inside.has_films())
                && (kind == FilmKind::Through || in_sight.may_hold(volume))
        });
        // Films stay on what the cells of their volumes face, as colours do.
        let volumes: Vec<Volume> = volumes
            .map(|(volume, normal): (&Volume, Vec3)| Volume { normal, ..volume.clone() })
            .collect();
        counter.heights((scene, &surface), &volumes, kind, camera, visible)
    }
}
