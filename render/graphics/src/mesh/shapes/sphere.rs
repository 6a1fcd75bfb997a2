//! A sphere and a torus knot.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use super::grid::GridSize;
use crate::mesh::model::{Material, Mesh};

impl Mesh {
    /// Sphere of radius 1 around the origin, of about `triangles` triangles.
    #[must_use]
    pub fn sphere(triangles: usize) -> Self {
        let mut mesh = Self::default();
        mesh.materials.push(Material::plain([0.72, 0.38, 0.30]));
        mesh.add_grid(GridSize::for_triangles(triangles, 2.0), 0, unit_sphere);
        mesh
    }

    /// Closed tube along a (2, 3) torus knot, about 3 wide, of about `triangles` triangles.
    #[must_use]
    pub fn torus_knot(triangles: usize) -> Self {
        let mut mesh = Self::default();
        mesh.materials.push(Material::plain([0.25, 0.47, 0.62]));
        mesh.add_grid(GridSize::for_triangles(triangles, 8.0), 0, |uv| {
            let along = uv.x * TAU;
            let forward = (knot(along + 1e-2) - knot(along - 1e-2)).normalize();
            let outward = (knot(along) - forward * knot(along).dot(forward)).normalize();
            let (sin, cos) = (uv.y * TAU).sin_cos();
            knot(along) + 0.32 * (outward * cos + forward.cross(outward) * sin)
        });
        mesh
    }
}

/// Point of the unit sphere; v = 0 is the north pole, v = 1 the south pole.
pub(super) fn unit_sphere(uv: Vec2) -> Vec3 {
    let (sin_u, cos_u) = (uv.x * TAU).sin_cos();
    let (sin_v, cos_v) = (uv.y * PI).sin_cos();
    Vec3::new(sin_u * sin_v, cos_v, cos_u * sin_v)
}

fn knot(along: f32) -> Vec3 {
    let radius = 1.0 + 0.4 * (3.0 * along).cos();
    let (sin, cos) = (2.0 * along).sin_cos();
    Vec3::new(radius * cos, radius * sin, 0.4 * (3.0 * along).sin())
}
