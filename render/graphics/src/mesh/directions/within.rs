//! Directions between the corners of a triangle.

use glam::{DVec2, DVec3};

use crate::mesh::tangent_plane::{TangentPlane, carried};

/// Unit line at a point of a triangle, from the normals and unit lines at its corners, whose
/// weights are not negative and add up to 1. The lines are carried to the plane of the interpolated
/// normal and averaged as squares, so their signs do not matter, and two triangles agree along the
/// edge that they share.
pub(super) fn line_within(normals: [DVec3; 3], lines: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    let plane = TangentPlane::of_normal(normal_within(normals, weights));
    let mut sum = DVec2::ZERO;
    for i in 0..3 {
        if let Some(line) = carried(lines[i], normals[i], plane.normal) {
            let flat = plane.projected(line);
            sum += weights[i] * flat.rotate(flat);
        }
    }
    plane.along(sum)
}

/// Tangent vector at a point of a triangle, from the normals and tangent vectors at its corners.
pub(super) fn vector_within(normals: [DVec3; 3], vectors: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    let normal = normal_within(normals, weights);
    let parts = (0..3).filter_map(|i| Some(weights[i] * carried(vectors[i], normals[i], normal)?));
    parts.sum()
}

/// Interpolated unit normal; that of the heaviest corner if they cancel out.
fn normal_within(normals: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    let sum: DVec3 = (0..3).map(|i| weights[i] * normals[i]).sum();
    let heaviest = (1..3).fold(0, |most, i| if weights[i] > weights[most] { i } else { most });
    sum.try_normalize().unwrap_or(normals[heaviest])
}
