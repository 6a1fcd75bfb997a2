//! Position, normal and colour of a mesh at the pixel that shows it. You can take one point, or
//! four points on one triangle at once, for example the samples of a pixel.

use glam::{Vec2, Vec3, Vec4};

use super::{Fragment, NO_TRIANGLE, PackedMaterial, PackedMesh, Vertex};
use crate::mesh::Mesh;

/// The position that a pixel shows, in the unit of the model.
///
/// # Panics
/// If the fragment shows no triangle, or one that the mesh does not have.
#[must_use]
pub fn position_at(mesh: &Mesh, fragment: Fragment) -> Vec3 {
    let corners = mesh.triangles[fragment.triangle as usize].corners;
    interpolated(fragment, corners.map(|corner| Vec3::from(mesh.positions[corner as usize])))
}

#[inline(always)]
fn interpolated(fragment: Fragment, [a, b, c]: [Vec3; 3]) -> Vec3 {
    a + (b - a) * fragment.second + (c - a) * fragment.third
}

/// A point on a mesh that a pixel shows. It knows the corners of its triangle.
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

    /// Points on the triangle that the first fragment shows. All `fragments` must show it.
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

    #[inline]
    pub(super) fn corners(&self) -> [&'a Vertex; 3] {
        self.corners
    }

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
        interpolated(self.fragment, self.corners.map(|corner| corner.position.into()))
    }

    /// The interpolated normal on the side of the surface that faces `eye`, of length 1. If the
    /// mesh has no normal there, this is 0.
    #[must_use]
    #[inline]
    pub fn normal(&self, eye: Vec3) -> Vec3 {
        let normal = interpolated(self.fragment, self.corners.map(|corner| corner.normal.into()));
        let length = normal.length();
        let normal = if length > 0.0 { normal / length } else { Vec3::ZERO };
        if self.faces_away(eye) { -normal } else { normal }
    }

    /// The colour of the surface without light, encoded sRGB in 0..1: the colours of material,
    /// vertices and texture multiplied. We sample the texture bilinearly and repeat it.
    #[must_use]
    #[inline]
    pub fn albedo(&self) -> Vec3 {
        let color = Vec3::from(self.material.color);
        let color =
            color * interpolated(self.fragment, self.corners.map(|corner| corner.color.into()));
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
        let right = x - x.floor();
        let down = y - y.floor();
        let [above, below] = rows.map(|row| {
            let [start, end] = columns.map(|column| {
                let at = self.material.first + row * width + column;
                let [r, g, b, _] = self.texels[at as usize].to_le_bytes();
                Vec3::new(f32::from(r), f32::from(g), f32::from(b))
            });
            start + (end - start) * right
        });
        (above + (below - above) * down) / 255.0
    }
}

/// The index of the texel at `place` in a row of `count` texels that repeats. Pass a place from -1
/// to `count`.
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

/// Three numbers of each of four points: all first numbers, then all second ones, then all third
/// ones.
pub type FourVectors = [Vec4; 3];

/// Four points on one triangle of a mesh. You get the same numbers as from four [`SurfacePoint`]s,
/// bit for bit.
#[derive(Debug, Clone, Copy)]
pub struct FourPoints<'a> {
    points: [SurfacePoint<'a>; 4],
    second: Vec4,
    third: Vec4,
}

impl<'a> FourPoints<'a> {
    /// The points that four pixels show. `None` unless all show the same triangle.
    ///
    /// # Panics
    /// If they show a triangle that the mesh does not have.
    #[must_use]
    #[inline]
    pub fn new(mesh: &'a PackedMesh, fragments: [Fragment; 4]) -> Option<Self> {
        let [first, rest @ ..] = &fragments;
        let one = rest.iter().all(|own| own.triangle == first.triangle);
        if !one || first.triangle == NO_TRIANGLE {
            return None;
        }
        let second = Vec4::from_array(fragments.map(|own| own.second));
        let third = Vec4::from_array(fragments.map(|own| own.third));
        let points = SurfacePoint::on_one_triangle(mesh, fragments);
        Some(Self { points, second, third })
    }

    /// One of the points, 0 to 3.
    ///
    /// # Panics
    /// If there is no such point.
    #[must_use]
    #[inline]
    pub fn point(&self, index: usize) -> &SurfacePoint<'a> {
        &self.points[index]
    }

    /// The [`SurfacePoint::normal`] of each point.
    #[must_use]
    #[inline]
    pub fn normals(&self, eye: Vec3) -> FourVectors {
        let [x, y, z] = self.interpolated(|corner| corner.normal);
        let length = dot_products([x, y, z], [x, y, z]).to_array().map(f32::sqrt);
        if !length.iter().all(|&length| length > 0.0) {
            let normals = self.points.map(|point| point.normal(eye));
            return [0, 1, 2].map(|axis| Vec4::from_array(normals.map(|normal| normal[axis])));
        }
        let length = Vec4::from_array(length);
        let normal = [x / length, y / length, z / length];
        if self.points[0].faces_away(eye) { normal.map(|axis| -axis) } else { normal }
    }

    /// The [`SurfacePoint::albedo`] of each point.
    #[must_use]
    #[inline]
    pub fn albedo(&self) -> FourVectors {
        let material = self.points[0].material();
        if material.width > 0 {
            let colors = self.points.map(|point| point.albedo());
            return [0, 1, 2].map(|channel| Vec4::from_array(colors.map(|color| color[channel])));
        }
        let [red, green, blue] = self.interpolated(|corner| corner.color);
        let [own_red, own_green, own_blue] = material.color;
        [red * own_red, green * own_green, blue * own_blue]
    }

    #[inline(always)]
    fn interpolated(&self, value: impl Fn(&Vertex) -> [f32; 3]) -> FourVectors {
        let [a, b, c] = self.points[0].corners().map(value);
        [0, 1, 2].map(|axis| {
            let [b, c] = [b[axis] - a[axis], c[axis] - a[axis]];
            Vec4::splat(a[axis]) + self.second * b + self.third * c
        })
    }
}

/// The dot product of each of four pairs of vectors.
#[must_use]
#[inline(always)]
pub fn dot_products([x, y, z]: FourVectors, [a, b, c]: FourVectors) -> Vec4 {
    x * a + y * b + z * c
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Material, Mesh, Texture};

    /// A ball in which every third triangle has a texture, and one vertex has no normal.
    fn ball() -> PackedMesh {
        let mut mesh = Mesh::sphere(60);
        mesh.materials[0].color = [0.9, 0.35, 0.6];
        let texels = (0..12).map(|i| u32::from_le_bytes([i * 20, 255 - i * 9, 77, 255])).collect();
        let texture = Texture { width: 4, height: 3, texels };
        mesh.materials.push(Material { texture: Some(texture), ..Material::plain([0.8; 3]) });
        for (i, triangle) in mesh.triangles.iter_mut().enumerate() {
            triangle.material = u32::from(i % 3 == 0);
        }
        for (i, color) in mesh.colors.iter_mut().enumerate() {
            *color = [0.3 + 0.01 * i as f32, 0.9, 0.5];
        }
        mesh.normals[5] = [0.0; 3];
        PackedMesh::new(&mesh)
    }

    #[test]
    fn four_points_have_the_numbers_of_single_ones() {
        let mesh = ball();
        let eyes = [Vec3::new(2.0, 1.0, -1.5), Vec3::new(0.1, 0.0, 0.2)];
        fn bits(four: FourVectors, lane: usize) -> [u32; 3] {
            four.map(|axis| axis[lane].to_bits())
        }
        for triangle in 0..mesh.triangles.len() as u32 {
            let fragments = [0.0, 0.13, 0.31, 0.5].map(|second| {
                let third = (0.9 - second) * 0.37 * (triangle % 3) as f32 / 2.0;
                Fragment { triangle, second, third, depth: 0.5 }
            });
            let four = FourPoints::new(&mesh, fragments).unwrap();
            for (lane, fragment) in fragments.into_iter().enumerate() {
                let point = SurfacePoint::new(&mesh, fragment);
                fn own(vector: Vec3) -> [u32; 3] {
                    vector.to_array().map(f32::to_bits)
                }
                assert_eq!(bits(four.albedo(), lane), own(point.albedo()), "{triangle}");
                for eye in eyes {
                    let normal = point.normal(eye);
                    assert_eq!(bits(four.normals(eye), lane), own(normal), "{triangle} {lane}");
                }
                assert_eq!(four.point(lane).position(), point.position());
            }
        }
    }

    #[test]
    fn pixels_of_several_triangles_or_none_are_not_four_points_of_one() {
        let mesh = ball();
        fn seen(triangle: u32) -> Fragment {
            Fragment { triangle, ..Fragment::EMPTY }
        }
        assert!(FourPoints::new(&mesh, [3; 4].map(seen)).is_some());
        assert!(FourPoints::new(&mesh, [3, 3, 3, 4].map(seen)).is_none());
        assert!(FourPoints::new(&mesh, [NO_TRIANGLE; 4].map(seen)).is_none());
    }
}
