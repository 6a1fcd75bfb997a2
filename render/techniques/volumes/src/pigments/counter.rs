//! Heights of films at all pixels of a picture, frame after frame.

use graphics::camera::Camera;
use graphics::field::Field;
use graphics::surface::{Crossings, PackedMesh, VisibilityBuffer};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::film::{Film, FilmHeights, FilmScale};
use super::film_profile::FilmProfile;
use super::lattice::{SampleLattice, SampledSurface};
use super::on_surface::FilmOnSurface;
use super::seen::{Facets, SeenPlaces};
use super::through::{Density, FilmThrough};
use crate::surfaces::VolumeSurfaces;
use crate::volume::Volume;

/// Where the paint of a volume is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FilmKind {
    /// On the surfaces that it holds: the same from all sides, and as much as was poured.
    #[default]
    Surface,
    /// All through it: a film is as high as the eye ray is long inside of it.
    Through,
}

/// A scene prepared for counting films of volumes on it.
#[derive(Debug, Clone)]
pub struct FilmCounter {
    facets: Facets,
    lattice: SampleLattice,
    /// Profile of films on surfaces.
    pub profile: FilmProfile,
    /// Lengths that paint is measured by.
    pub scale: FilmScale,
    surfaces: VolumeSurfaces,
    crossings: Crossings,
}

impl FilmCounter {
    /// Prepares the scene `mesh` with the samples of its surface, which are sorted into cubes with
    /// sides of `side`, about the radius of most volumes.
    ///
    /// # Panics
    /// If `side` is not above 0.
    #[must_use]
    pub fn new(
        mesh: &PackedMesh,
        surface: &SampledSurface<'_>,
        side: f32,
        profile: FilmProfile,
        scale: FilmScale,
    ) -> Self {
        let facets = Facets::of(mesh);
        let lattice = SampleLattice::of(surface.places, side);
        let surfaces = VolumeSurfaces::default();
        let crossings = Crossings::default();
        Self { facets, lattice, profile, scale, surfaces, crossings }
    }

    /// Tells the body of each triangle, 0 for those that films of all bodies lie on.
    pub fn tell_bodies(&mut self, bodies: &[u32]) {
        self.facets.tell_bodies(bodies);
    }

    /// Heights of the films of `volumes` at each pixel of `visible`, which is what `camera` sees of
    /// `mesh`. `mesh` and `surface` are those that the counter was made with.
    ///
    /// # Panics
    /// If `visible` shows a triangle that the mesh does not have.
    #[must_use]
    pub fn heights(
        &mut self,
        (mesh, surface): (&PackedMesh, &SampledSurface<'_>),
        volumes: &[Volume],
        kind: FilmKind,
        camera: &Camera,
        visible: &VisibilityBuffer,
    ) -> Field<FilmHeights> {
        let Self { facets, lattice, profile, scale, surfaces, crossings } = self;
        surfaces.update(volumes);
        let seen = SeenPlaces::of(mesh, facets, visible);
        match kind {
            FilmKind::Surface => {
                let samples = (surface, &*lattice);
                let films = Film::of_volumes(volumes, *profile, samples, scale);
                let films = FilmOnSurface { films: &films, seen: &seen };
                crossings.sum(&films, surfaces.closed(), camera, visible)
            }
            FilmKind::Through => {
                let densities = volumes.par_iter().map(|volume| Density::of(volume, scale));
                let densities: Vec<Density> = densities.collect();
                let films = FilmThrough::new(&densities, camera, &seen.places, false);
                crossings.sum(&films, surfaces.closed(), camera, visible)
            }
        }
    }
}

#[cfg(test)]
mod tests;
