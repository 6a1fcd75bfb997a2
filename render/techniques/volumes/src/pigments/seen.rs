//! The places of a scene that a picture shows.

use glam::Vec3;
use graphics::field::Field;
use graphics::surface::{NO_TRIANGLE, PackedMesh, SurfacePoint, VisibilityBuffer};
use rayon::prelude::*;

/// Pixels that share the work of one thread at least.
const PIXELS: usize = 8192;

/// Normals of the triangles of a scene, which do not depend on the view.
#[derive(Debug, Clone)]
pub struct Facets {
    /// Of length 1, on the side of the normals of the corners; zero for triangles without area.
    normals: Vec<Vec3>,
    /// Numbers of their bodies; 0 beyond the end.
    bodies: Vec<u32>,
}

impl Facets {
    /// The normals of all triangles of `mesh`.
    #[must_use]
    pub fn of(mesh: &PackedMesh) -> Self {
        let normal = |corners: [u32; 3]| {
            let corners = corners.map(|corner| &mesh.vertices[corner as usize]);
            let [a, b, c] = corners.map(|corner| Vec3::from(corner.position));
            let facet = (b - a).cross(c - a).normalize_or_zero();
            let side: Vec3 = corners.iter().map(|corner| Vec3::from(corner.normal)).sum();
            if side.dot(facet) < 0.0 { -facet } else { facet }
        };
        let triangles = mesh.triangles.par_iter().with_min_len(PIXELS);
        let normals = triangles.map(|triangle| normal(triangle.corners)).collect();
        Self { normals, bodies: Vec::new() }
    }

    /// Tells the body of each triangle, 0 for those that films of all bodies lie on.
    pub fn tell_bodies(&mut self, bodies: &[u32]) {
        if self.bodies != bodies {
            self.bodies = bodies.to_vec();
        }
    }

    /// The normal of each triangle: of length 1, or zero for one without area.
    #[must_use]
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }
}

/// The place and the triangle that each pixel shows.
#[derive(Debug, Clone)]
pub struct SeenPlaces<'a> {
    /// Places in the unit of the scene; no numbers where nothing is seen.
    pub places: Field<Vec3>,
    visible: &'a VisibilityBuffer,
    facets: &'a Facets,
}

impl<'a> SeenPlaces<'a> {
    /// The places of `mesh`, whose normals are `facets`, that `visible` shows.
    ///
    /// # Panics
    /// If `visible` shows a triangle that the mesh does not have.
    #[must_use]
    pub fn of(mesh: &PackedMesh, facets: &'a Facets, visible: &'a VisibilityBuffer) -> Self {
        let places = visible
            .values()
            .par_iter()
            .with_min_len(PIXELS)
            .map(|fragment: &graphics::surface::Fragment| match fragment.triangle {
                NO_TRIANGLE => Vec3::NAN,
                _ => SurfacePoint::new(mesh, *fragment).position(),
            })
            .collect();
        let places = Field::from_values(visible.width(), visible.height(), places);
        Self { places, visible, facets }
    }

    /// The buffer that shows them.
    #[must_use]
    pub fn visible(&self) -> &'a VisibilityBuffer {
        self.visible
    }

    /// The normal of the triangle that the pixel with this index shows; zero where there is none.
    #[must_use]
    #[inline]
    pub fn normal(&self, pixel: usize) -> Vec3 {
        let triangle = self.visible.values()[pixel].triangle as usize;
        self.facets.normals.get(triangle).copied().unwrap_or(Vec3::ZERO)
    }

    /// The body of the triangle that the pixel with this index shows, 0 for all.
    #[must_use]
    #[inline]
    pub fn body(&self, pixel: usize) -> u32 {
        let triangle = self.visible.values()[pixel].triangle as usize;
        self.facets.bodies.get(triangle).copied().unwrap_or(0)
    }

    /// Place and normal of the triangle that the pixel with this index, counted row by row, shows.
    /// The place is no number where nothing is seen.
    #[must_use]
    #[inline]
    pub fn at(&self, pixel: usize) -> (Vec3, Vec3) {
        (self.places.values()[pixel], self.normal(pixel))
    }
}
