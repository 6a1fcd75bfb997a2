//! A ball and a knot.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use super::grid::Cells;
use crate::mesh::model::{Material, Mesh};

impl Mesh {
    /// A ball of radius 1 about the origin, of about `triangles` triangles.
    #[must_use]
    pub fn sphere(triangles: usize) -> Self {
        let mut mesh = Self::default();
        mesh.materials.push(Material::plain([0.72, 0.38, 0.30]));
        mesh.add_grid(Cells::of_about(triangles, 2.0), 0, on_ball);
        mesh
    }

    /// A closed tube along a knot of type (2, 3), about 3 across, of about
    /// `triangles` triangles.
    #[must_use]
    pub fn torus_knot(triangles: usize) -> Self {
        let mut mesh = Self::default();
        mesh.materials.push(Material::plain([0.25, 0.47, 0.62]));
        mesh.add_grid(Cells::of_about(triangles, 8.0), 0, |uv| {
            let along = uv.x * TAU;
            let forward = (knot(along + 1e-2) - knot(along - 1e-2)).normalize();
            let outward = (knot(along) - forward * knot(along).dot(forward)).normalize();
            let (sin, cos) = (uv.y * TAU).sin_cos();
            knot(along) + 0.32 * (outward * cos + forward.cross(outward) * sin)
        });
        mesh
    }
}

/// The unit sphere; the poles are v = 0 (up) and 1.
pub(super) fn on_ball(uv: Vec2) -> Vec3 {
    let ((sin_u, cos_u), (sin_v, cos_v)) = ((uv.x * TAU).sin_cos(), (uv.y * PI).sin_cos());
    Vec3::new(sin_u * sin_v, cos_v, cos_u * sin_v)
}

fn knot(along: f32) -> Vec3 {
    let radius = 1.0 + 0.4 * (3.0 * along).cos();
    let (sin, cos) = (2.0 * along).sin_cos();
    Vec3::new(radius * cos, radius * sin, 0.4 * (3.0 * along).sin())
}
