//! A scene whose counts are compared with the oracle.

use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use super::shapes::Surfaces;
use super::winding::{Solid, View};
use crate::camera::Camera;
use crate::field::Field;
use crate::mesh::{Mesh, Triangle};
use crate::surface::{Count, Crossings, Fragment, NO_TRIANGLE, VisibilityBuffer, visible};

/// A picture of a scene with closed surfaces.
pub(crate) struct Scene {
    pub(crate) mesh: Mesh,
    pub(crate) surfaces: Surfaces,
    pub(crate) camera: Camera,
    pub(crate) size: (usize, usize),
}

/// Findings of a comparison.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Found {
    /// Pixels that show the scene.
    pub(super) samples: usize,
    /// The greatest count of the oracle.
    pub(super) most: i32,
    /// Samples whose count is not the oracle's.
    pub(super) differ: usize,
    /// Those of them that are farther than half a pixel from every outline and than a
    /// thousandth of the radius from every skin.
    pub(super) wrong: usize,
}

impl Scene {
    pub(crate) fn visible(&self) -> VisibilityBuffer {
        visible(&self.mesh, &self.camera, self.size.0, self.size.1)
    }

    pub(crate) fn counts(&self) -> Field<i32> {
        Crossings::default().sum(&Count, self.surfaces.closed(), &self.camera, &self.visible())
    }

    fn view(&self) -> View {
        let [right, up, back] = self.camera.axes().map(Vec3::as_dvec3);
        let middle = DVec2::new(self.size.0 as f64, self.size.1 as f64) / 2.0;
        let half = f64::from(self.camera.field_of_view_deg.to_radians() / 2.0).tan();
        let eye = self.camera.eye.as_dvec3();
        let near = f64::from(self.camera.near);
        View { eye, right, up, forward: -back, near, focal_px: middle.y / half, middle }
    }

    /// The place that a pixel shows, in f64.
    fn place(&self, seen: Fragment) -> DVec3 {
        let corners = self.mesh.triangles[seen.triangle as usize].corners;
        let [a, b, c] = corners.map(|at| Vec3::from(self.mesh.positions[at as usize]).as_dvec3());
        a + (b - a) * f64::from(seen.second) + (c - a) * f64::from(seen.third)
    }

    /// Compares the counts with winding numbers at every pixel that shows the scene.
    pub(super) fn compared(&self) -> Found {
        let visible = self.visible();
        let counts = self.counts();
        let view = self.view();
        let surfaces = &self.surfaces;
        let solids: Vec<_> = (0..surfaces.count).map(|i| Solid::new(surfaces.faces(i))).collect();
        let pixels = visible.values().par_iter().zip(counts.values()).enumerate();
        let found = pixels.map(|(pixel, (&seen, &count))| {
            if seen.triangle == NO_TRIANGLE {
                assert_eq!(count, 0, "nothing is seen at {pixel}");
                return Found::default();
            }
            let place = self.place(seen);
            let expected = solids.iter().filter(|solid| solid.holds(place)).count() as i32;
            let at = [pixel % self.size.0, pixel / self.size.0].map(|at| at as f64 + 0.5);
            let undecided = || {
                solids.iter().any(|solid| {
                    solid.has_skin_at(place, 1e-3) || solid.has_outline_at(at.into(), 0.5, &view)
                })
            };
            let differs = count != expected;
            let wrong = usize::from(differs && !undecided());
            Found { samples: 1, most: expected, differ: usize::from(differs), wrong }
        });
        found.reduce(Found::default, Found::and)
    }
}

impl Found {
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            samples: self.samples + other.samples,
            most: self.most.max(other.most),
            differ: self.differ + other.differ,
            wrong: self.wrong + other.wrong,
        }
    }
}

/// Mesh of loose triangles, for pictures alone.
pub(crate) fn mesh_of(triangles: &[[Vec3; 3]]) -> Mesh {
    let positions: Vec<_> = triangles.iter().flatten().map(Vec3::to_array).collect();
    let corners = (0..positions.len() as u32).step_by(3).map(|i| [i, i + 1, i + 2]);
    let triangles = corners.map(|corners| Triangle { corners, material: 0 }).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}

/// The square wall z = `z` from -`half` to `half`, of `2 * cells * cells` triangles.
pub(crate) fn wall(z: f32, half: f32, cells: usize) -> Mesh {
    let at = |i: usize| half * (2.0 * i as f32 / cells as f32 - 1.0);
    let triangles = (0..cells * cells).flat_map(|cell| {
        let [x, y] = [cell % cells, cell / cells];
        let corner = |right: usize, up: usize| Vec3::new(at(x + right), at(y + up), z);
        let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        [[a, b, c], [a, c, d]]
    });
    mesh_of(&triangles.collect::<Vec<_>>())
}

/// A camera at `eye` that looks at `target`.
pub(crate) fn camera(eye: Vec3, target: Vec3) -> Camera {
    Camera { eye, target, up: Vec3::Y, field_of_view_deg: 50.0, near: 0.05, far: 20.0 }
}
