//! The places of a scene that a picture shows.

use glam::Vec3;
use graphics::field::Field;
use graphics::surface::{NO_TRIANGLE, PackedMesh, SurfacePoint, VisibilityBuffer};
use rayon::prelude::*;

/// A thread works on at least this many pixels.
const PIXELS: usize = 8192;

/// Normals of the triangles of a scene. They do not depend on the view, so you need them once.
#[derive(Debug, Clone)]
pub struct Facets {
    /// Of length 1, on the side of the normals of the corners. Triangles without area have zero.
    normals: Vec<Vec3>,
    /// Numbers of their bodies. Beyond the end, they are 0.
    bodies: Vec<u32>,
}

impl Facets {
    /// The normals of all triangles of `mesh`.
    #[must_use]
    pub fn of(mesh: &PackedMesh) -> Self {
        let triangles = mesh.triangles.par_iter().with_min_len(PIXELS);
        let normals = triangles
            .map(|triangle| triangle.corners)
            .map(|corners: [u32; 3]| {
                let corners = corners.map(|corner| &mesh.vertices[corner as usize]);
                let [a, b, c] = corners.map(|corner| Vec3::from(corner.position));
                let facet = (b - a).cross(c - a).normalize_or_zero();
                let side: Vec3 = corners.iter().map(|corner| Vec3::from(corner.normal)).sum();
                if side.dot(facet) < 0.0 { -facet } else { facet }
            })
            .collect();
        Self { normals, bodies: Vec::new() }
    }

    /// Sets the body of each triangle. Use 0 for triangles that films of all bodies lie on.
    pub fn tell_bodies(&mut self, bodies: &[u32]) {
        if self.bodies != bodies {
            self.bodies = bodies.to_vec();
        }
    }

    /// The normal of each triangle. It has length 1, or is zero if the triangle has no area.
    #[must_use]
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }
}

/// The place and the triangle that each pixel shows.
#[derive(Debug, Clone)]
pub struct SeenPlaces<'a> {
    /// Places in the unit of the scene. They are NaN where nothing is seen.
    pub places: Field<Vec3>,
    visible: &'a VisibilityBuffer,
    facets: &'a Facets,
}

impl<'a> SeenPlaces<'a> {
    /// Finds the places of `mesh` that `visible` shows. Pass the facets of this mesh.
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

    /// The buffer that shows these places.
    #[must_use]
    pub fn visible(&self) -> &'a VisibilityBuffer {
        self.visible
    }

    /// The normal of the triangle that the pixel with this index shows. It is zero where there is
    /// no triangle.
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

    /// Place and normal of the triangle that a pixel shows. Pixels count row by row. The place is
    /// NaN where nothing is seen.
    #[must_use]
    #[inline]
    pub fn at(&self, pixel: usize) -> (Vec3, Vec3) {
        (self.places.values()[pixel], self.normal(pixel))
    }
}
