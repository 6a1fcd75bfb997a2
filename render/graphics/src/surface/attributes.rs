//! What the surface is like where a pixel sees it.

use glam::{Vec2, Vec3};

use super::packed::{Coating, PackedMesh, Vertex};
use super::visible::Seen;
use crate::mesh::Mesh;

/// The place in the model that a pixel sees.
///
/// # Panics
/// If it sees nothing, or a triangle that the mesh has not.
#[must_use]
pub fn position_at(mesh: &Mesh, seen: Seen) -> Vec3 {
    let corners = mesh.triangles[seen.triangle as usize].corners;
    between(seen, corners.map(|corner| Vec3::from(mesh.positions[corner as usize])))
}

/// What lies between the values of three corners.
#[inline(always)]
fn between(seen: Seen, [a, b, c]: [Vec3; 3]) -> Vec3 {
    a + (b - a) * seen.second + (c - a) * seen.third
}

/// The triangle that a pixel sees, with its corners.
#[derive(Debug, Clone, Copy)]
pub struct Facet<'a> {
    seen: Seen,
    corners: [&'a Vertex; 3],
    coating: &'a Coating,
    texels: &'a [u32],
}

impl PackedMesh {
    /// What a pixel sees.
    ///
    /// # Panics
    /// If it sees nothing, or a triangle that the mesh has not.
    #[must_use]
    #[inline]
    pub fn facet(&self, seen: Seen) -> Facet<'_> {
        let triangle = &self.triangles[seen.triangle as usize];
        Facet {
            seen,
            corners: triangle.corners.map(|corner| &self.vertices[corner as usize]),
            coating: &self.coatings[triangle.material as usize],
            texels: &self.texels,
        }
    }
}

impl Facet<'_> {
    /// The place in the model.
    #[must_use]
    #[inline]
    pub fn position(&self) -> Vec3 {
        between(self.seen, self.corners.map(|corner| corner.position.into()))
    }

    /// The smooth normal, of length 1, on the side that `eye` sees.
    #[must_use]
    #[inline]
    pub fn normal(&self, eye: Vec3) -> Vec3 {
        let [a, b, c] = self.corners.map(|corner| Vec3::from(corner.position));
        let faces_away = (b - a).cross(c - a).dot(eye - a) < 0.0;
        let normal = between(self.seen, self.corners.map(|corner| corner.normal.into()));
        let length = normal.length();
        let normal = if length > 0.0 { normal / length } else { Vec3::ZERO };
        if faces_away { -normal } else { normal }
    }

    /// The colour of the surface itself, encoded sRGB in 0..1: of the material times
    /// that of the vertices times its texture, which is bilinear and repeats.
    #[must_use]
    #[inline]
    pub fn albedo(&self) -> Vec3 {
        let color = Vec3::from(self.coating.color);
        let color = color * between(self.seen, self.corners.map(|corner| corner.color.into()));
        if self.coating.width == 0 {
            return color;
        }
        let [a, b, c] = self.corners.map(|corner| Vec2::new(corner.u, corner.v));
        color * self.textured(a + (b - a) * self.seen.second + (c - a) * self.seen.third)
    }

    /// The texture at `place`, (0, 0) its upper left corner and (1, 1) its lower right.
    fn textured(&self, place: Vec2) -> Vec3 {
        let (width, height) = (self.coating.width, self.coating.height);
        let place = place - place.floor();
        // Middles of texels lie at halves.
        let x = place.x * width as f32 - 0.5;
        let y = place.y * height as f32 - 0.5;
        let columns = [x, x + 1.0].map(|x| wrapped(x, width));
        let rows = [y, y + 1.0].map(|y| wrapped(y, height));
        let texel = |row: usize, column: usize| {
            let at = self.coating.first + rows[row] * width + columns[column];
            let [r, g, b, _] = self.texels[at as usize].to_le_bytes();
            Vec3::new(f32::from(r), f32::from(g), f32::from(b))
        };
        let (right, down) = (x - x.floor(), y - y.floor());
        let above = texel(0, 0) + (texel(0, 1) - texel(0, 0)) * right;
        let below = texel(1, 0) + (texel(1, 1) - texel(1, 0)) * right;
        (above + (below - above) * down) / 255.0
    }
}

/// The texel of `count` at `place`, from -1 to `count`, as if they repeated.
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
