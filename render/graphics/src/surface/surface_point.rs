//! Position, normal and colour of a mesh at the pixel that shows it.

use glam::{Vec2, Vec3};

use super::packed::{PackedMaterial, PackedMesh, Vertex};
use super::visibility::Fragment;
use crate::mesh::Mesh;

/// The position that a pixel shows, in the unit of the model.
///
/// # Panics
/// If the fragment shows no triangle, or one that the mesh does not have.
#[must_use]
pub fn position_at(mesh: &Mesh, fragment: Fragment) -> Vec3 {
    let corners = mesh.triangles[fragment.triangle as usize].corners;
    between(fragment, corners.map(|corner| Vec3::from(mesh.positions[corner as usize])))
}

/// Interpolates the values of a triangle's corners.
#[inline(always)]
fn between(fragment: Fragment, [a, b, c]: [Vec3; 3]) -> Vec3 {
    a + (b - a) * fragment.second + (c - a) * fragment.third
}

/// A point on a mesh that a pixel shows, with the corners of its triangle.
#[derive(Debug, Clone, Copy)]
pub struct SurfacePoint<'a> {
    fragment: Fragment,
    corners: [&'a Vertex; 3],
    material: &'a PackedMaterial,
    texels: &'a [u32],
}

impl<'a> SurfacePoint<'a> {
    /// The point of `mesh` that a pixel shows.
    ///
    /// # Panics
    /// If the fragment shows no triangle, or one that the mesh does not have.
    #[must_use]
    #[inline]
    pub fn new(mesh: &'a PackedMesh, fragment: Fragment) -> Self {
        let triangle = &mesh.triangles[fragment.triangle as usize];
        Self {
            fragment,
            corners: triangle.corners.map(|corner| &mesh.vertices[corner as usize]),
            material: &mesh.materials[triangle.material as usize],
            texels: &mesh.texels,
        }
    }

    /// Points of one triangle: that of the first fragment.
    #[inline]
    pub(super) fn on_one_triangle<const N: usize>(
        mesh: &'a PackedMesh,
        fragments: [Fragment; N],
    ) -> [Self; N] {
        match fragments.first() {
            Some(&first) => {
                let point = Self::new(mesh, first);
                fragments.map(|fragment| Self { fragment, ..point })
            }
            None => fragments.map(|fragment| Self::new(mesh, fragment)),
        }
    }

    /// The corners of its triangle.
    #[inline]
    pub(super) fn corners(&self) -> [&'a Vertex; 3] {
        self.corners
    }

    /// The material of its triangle.
    #[inline]
    pub(super) fn material(&self) -> &'a PackedMaterial {
        self.material
    }

    /// Whether the outer side of its triangle faces away from `eye`.
    #[inline]
    pub(super) fn faces_away(&self, eye: Vec3) -> bool {
        let [a, b, c] = self.corners.map(|corner| Vec3::from(corner.position));
        (b - a).cross(c - a).dot(eye - a) < 0.0
    }

    /// Position in the unit of the model.
    #[must_use]
    #[inline]
    pub fn position(&self) -> Vec3 {
        between(self.fragment, self.corners.map(|corner| corner.position.into()))
    }

    /// The interpolated normal, of length 1 (or 0 if the mesh has none), on the side of
    /// the surface that faces `eye`.
    #[must_use]
    #[inline]
    pub fn normal(&self, eye: Vec3) -> Vec3 {
        let normal = between(self.fragment, self.corners.map(|corner| corner.normal.into()));
        let length = normal.length();
        let normal = if length > 0.0 { normal / length } else { Vec3::ZERO };
        if self.faces_away(eye) { -normal } else { normal }
    }

    /// The colour of the surface without light, encoded sRGB in 0..1: the colours of
    /// material, vertices and texture multiplied. The texture is bilinear and repeats.
    #[must_use]
    #[inline]
    pub fn albedo(&self) -> Vec3 {
        let color = Vec3::from(self.material.color);
        let color = color * between(self.fragment, self.corners.map(|corner| corner.color.into()));
        if self.material.width == 0 {
            return color;
        }
        let [a, b, c] = self.corners.map(|corner| Vec2::new(corner.u, corner.v));
        color * self.textured(a + (b - a) * self.fragment.second + (c - a) * self.fragment.third)
    }

    /// The texture's colour at `place`, where (0, 0) is its upper left corner and (1, 1)
    /// its lower right.
    fn textured(&self, place: Vec2) -> Vec3 {
        let width = self.material.width;
        let height = self.material.height;
        let place = place - place.floor();
        // Centres of texels lie at halves.
        let x = place.x * width as f32 - 0.5;
        let y = place.y * height as f32 - 0.5;
        let columns = [x, x + 1.0].map(|x| wrapped(x, width));
        let rows = [y, y + 1.0].map(|y| wrapped(y, height));
        let texel = |row: usize, column: usize| {
            let at = self.material.first + rows[row] * width + columns[column];
            let [r, g, b, _] = self.texels[at as usize].to_le_bytes();
            Vec3::new(f32::from(r), f32::from(g), f32::from(b))
        };
        let right = x - x.floor();
        let down = y - y.floor();
        let above = texel(0, 0) + (texel(0, 1) - texel(0, 0)) * right;
        let below = texel(1, 0) + (texel(1, 1) - texel(1, 0)) * right;
        (above + (below - above) * down) / 255.0
    }
}

/// The index of the texel at `place`, which is -1 to `count`, in a row of `count` texels
/// that repeats.
fn wrapped(place: f32, count: u32) -> u32 {
    let place = place.floor();
    if place < 0.0 {
        count - 1
    } else if place >= count as f32 {
        0
    } else {
        place as u32
    }
}
