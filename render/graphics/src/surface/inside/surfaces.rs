//! Closed surfaces as lists of vertices and triangles.

use crate::mesh::Triangle;

/// Closed surfaces, which may overlap. Each is closed, does not intersect itself, and its
/// triangles are counter-clockwise seen from outside.
#[derive(Debug)]
pub struct ClosedSurfaces<'a, V> {
    /// The vertices of all surfaces, in the unit of the model.
    pub vertices: &'a [V],
    /// The triangles of all surfaces; [`Triangle::material`] is the index of the surface.
    pub triangles: &'a [Triangle],
}

impl<V> Clone for ClosedSurfaces<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V> Copy for ClosedSurfaces<'_, V> {}
