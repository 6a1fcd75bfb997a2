//! What the surface is like where a pixel sees it.

use glam::Vec3;

use super::visible::Seen;
use crate::mesh::Mesh;

/// The place in the model that a pixel sees.
///
/// # Panics
/// If it sees nothing, or a triangle that the mesh has not.
#[must_use]
pub fn position_at(mesh: &Mesh, seen: Seen) -> Vec3 {
    let corners = mesh.triangles[seen.triangle as usize].corners;
    let [a, b, c] = corners.map(|corner| Vec3::from(mesh.positions[corner as usize]));
    a + (b - a) * seen.second + (c - a) * seen.third
}
