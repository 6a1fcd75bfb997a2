//! Simple surfaces: grids, a sphere and a torus knot, sweeps along curves, and a photograph as a
//! flat model.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use crate::field::Field;
use crate::mesh::model::{Material, Mesh, Texture, Triangle};

/// Resolution of a grid. Each cell becomes two triangles, so for example 3 x 2 cells give 12.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GridSize {
    /// Number of cells along u.
    pub columns: usize,
    /// Number of cells along v.
    pub rows: usize,
}

impl GridSize {
    /// Grid of about `triangles` triangles with `aspect` times as many columns as rows. You get at
    /// least 3 x 2 cells.
    #[must_use]
    pub fn for_triangles(triangles: usize, aspect: f64) -> Self {
        let rows = (triangles as f64 / 2.0 / aspect).sqrt();
        fn at_least(cells: f64, least: usize) -> usize {
            (cells.round() as usize).max(least)
        }
        Self { columns: at_least(rows * aspect, 3), rows: at_least(rows, 2) }
    }
}

impl Mesh {
    /// Appends the parametric surface `position(u, v)` for u and v in 0..1, white and with one
    /// material. To find normals, this calls `position` slightly beyond that range. Texture
    /// coordinates are (u, v). Seen from outside, u increases to the right and v downwards. This
    /// joins edges that coincide. If an edge collapses to a point, it becomes a pole.
    pub fn add_grid(&mut self, cells: GridSize, material: u32, position: impl Fn(Vec2) -> Vec3) {
        let GridSize { columns, rows } = cells;
        let first = self.positions.len();
        for row in 0..=rows {
            for column in 0..=columns {
                let uv = Vec2::new(column as f32 / columns as f32, row as f32 / rows as f32);
                self.positions.push(position(uv).into());
                self.normals.push(normal(uv, &position).into());
                self.texture_coordinates.push(uv.into());
                self.colors.push([1.0; 3]);
            }
        }
        join(&mut self.positions[first..], &mut self.normals[first..], cells);
        fn vertex(column: usize, row: usize, columns: usize, first: usize) -> u32 {
            (first + row * (columns + 1) + column) as u32
        }
        for row in 0..rows {
            for column in 0..columns {
                let [a, b] =
                    [vertex(column, row, columns, first), vertex(column + 1, row, columns, first)];
                let [c, d] = [
                    vertex(column, row + 1, columns, first),
                    vertex(column + 1, row + 1, columns, first),
                ];
                for corners in [[a, c, d], [a, d, b]] {
                    let [p, q, r] = corners.map(|corner| self.positions[corner as usize]);
                    if p != q && q != r && r != p {
                        self.triangles.push(Triangle { corners, material });
                    }
                }
            }
        }
    }
}

/// Makes positions at the edges of a grid equal if they differ by rounding only. This gives a pole
/// the mean of its normals.
fn join(
    positions: &mut [[f32; 3]],
    normals: &mut [[f32; 3]],
    GridSize { columns, rows }: GridSize,
) {
    let size = positions.iter().flatten().fold(0.0f32, |most, at| most.max(at.abs()));
    fn near(p: [f32; 3], q: [f32; 3], size: f32) -> bool {
        Vec3::from(p).distance(Vec3::from(q)) < 1e-5 * size
    }
    let width = columns + 1;
    let last_row = rows * width;
    for row in 0..=rows {
        let [left, right] = [row * width, row * width + columns];
        if near(positions[left], positions[right], size) {
            positions[right] = positions[left];
        }
    }
    if (0..width).all(|column| near(positions[column], positions[last_row + column], size)) {
        positions.copy_within(..width, last_row);
    }
    for row in [0, last_row] {
        let edge = &mut positions[row..row + width];
        if edge.iter().all(|&position| near(position, edge[0], size)) {
            edge.fill(edge[0]);
            let around = &normals[row..row + columns];
            let sum: Vec3 = around.iter().map(|&normal| Vec3::from(normal)).sum();
            normals[row..row + width].fill(sum.try_normalize().unwrap_or(Vec3::Y).into());
        }
    }
}

/// Normal of the surface by central differences. At a pole, this is the normal of a point slightly
/// beside it.
fn normal(uv: Vec2, position: &impl Fn(Vec2) -> Vec3) -> Vec3 {
    const STEP: f32 = 1e-3;
    fn slopes(at: Vec2, position: &impl Fn(Vec2) -> Vec3) -> [Vec3; 2] {
        [Vec2::X, Vec2::Y].map(|axis| position(at + axis * STEP) - position(at - axis * STEP))
    }
    let [along_u, along_v] = slopes(uv, position);
    let flat =
        along_u.length().min(along_v.length()) < 1e-3 * along_u.length().max(along_v.length());
    let [along_u, along_v] = match flat {
        true => slopes(uv + (Vec2::splat(0.5) - uv) * (8.0 * STEP), position),
        false => [along_u, along_v],
    };
    along_v.cross(along_u).try_normalize().unwrap_or(Vec3::Y)
}

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

/// Point of the unit sphere. v = 0 is the north pole, v = 1 the south pole.
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

/// Catmull-Rom spline (1974) through evenly spaced points, at parameter 0 to 1.
fn catmull_rom(points: &[Vec3], at: f32) -> Vec3 {
    let spans = points.len() - 1;
    let at = at.clamp(0.0, 1.0) * spans as f32;
    let first = (at as usize).min(spans - 1);
    let t = at - first as f32;
    fn point(i: usize, points: &[Vec3], spans: usize) -> Vec3 {
        points[i.min(spans)]
    }
    let b = point(first, points, spans);
    let c = point(first + 1, points, spans);
    let a = if first == 0 { b * 2.0 - c } else { point(first - 1, points, spans) };
    let d = if first + 2 > spans { c * 2.0 - b } else { point(first + 2, points, spans) };
    let quadratic = a * 2.0 - b * 5.0 + c * 4.0 - d;
    let cubic = b * 3.0 - a - c * 3.0 + d;
    b + ((c - a) * t + quadratic * (t * t) + cubic * (t * t * t)) / 2.0
}

/// Surface of revolution about the y axis. The profile is given from top to bottom as (radius,
/// height). A hollow body starts at the bottom of its inside.
pub(super) fn lathe(outline: &[[f32; 2]]) -> impl Fn(Vec2) -> Vec3 + use<> {
    let points: Vec<Vec3> = outline.iter().map(|&[r, y]| Vec3::new(r, y, 0.0)).collect();
    move |uv| {
        let at = catmull_rom(&points, uv.y);
        let (sin, cos) = (uv.x * TAU).sin_cos();
        Vec3::new(at.x.max(0.0) * sin, at.y, at.x.max(0.0) * cos)
    }
}

/// Tube along a spline, with radius `thickness(v)`. If this is 0 at the ends, the tube is closed
/// there.
pub(super) fn tube(points: &[Vec3], thickness: impl Fn(f32) -> f32) -> impl Fn(Vec2) -> Vec3 {
    let points = points.to_vec();
    move |uv| {
        let v = uv.y.clamp(0.0, 1.0);
        let forward = catmull_rom(&points, v + 1e-2) - catmull_rom(&points, v - 1e-2);
        let forward = forward.normalize_or(Vec3::Y);
        let aside = forward.any_orthonormal_vector();
        // A fixed reference direction keeps the tube from twisting.
        let side = (Vec3::Z - forward * forward.z).try_normalize().unwrap_or(aside);
        let (sin, cos) = (uv.x * TAU).sin_cos();
        catmull_rom(&points, v) + (side * cos + side.cross(forward) * sin) * thickness(v)
    }
}

pub(super) fn mix_colors(from: [f32; 3], to: [f32; 3], share: f32) -> [f32; 3] {
    [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * share)
}

/// Sets the colours of the vertices from index `first` on, by their position.
pub(super) fn tint(mesh: &mut Mesh, first: usize, color: impl Fn(Vec3) -> [f32; 3]) {
    for (position, found) in mesh.positions[first..].iter().zip(&mut mesh.colors[first..]) {
        *found = color(Vec3::from(*position));
    }
}

impl Mesh {
    /// A picture, encoded sRGB with opacity in 0..1, as a rectangle of two triangles in the plane
    /// z = 0 around the origin, towards +z. Its longer side is 1. Transparent parts are white. Use
    /// the cameras of [`camera::PictureView`](crate::camera::PictureView) to see it.
    ///
    /// # Panics
    /// If the picture has no pixels, or a side of 2^32 or more.
    #[must_use]
    pub fn of_picture(picture: &Field<[f32; 4]>) -> Self {
        let width = picture.width();
        let height = picture.height();
        assert!(width > 0 && height > 0, "a picture of {width} x {height} pixels");
        let texture = Texture {
            width: u32::try_from(width).unwrap_or(u32::MAX),
            height: u32::try_from(height).unwrap_or(u32::MAX),
            texels: picture
                .values()
                .iter()
                .map(|&[r, g, b, opacity]: &[f32; 4]| {
                    fn channel(value: f32, opacity: f32) -> u8 {
                        ((value * opacity + 1.0 - opacity).clamp(0.0, 1.0) * 255.0).round() as u8
                    }
                    u32::from_le_bytes([
                        channel(r, opacity),
                        channel(g, opacity),
                        channel(b, opacity),
                        u8::MAX,
                    ])
                })
                .collect(),
        };
        let material = Material { texture: Some(texture), ..Material::plain([1.0; 3]) };
        let mut mesh = Self { materials: vec![material], ..Self::default() };
        let sides = Vec2::new(width as f32, height as f32) / width.max(height) as f32;
        mesh.add_grid(GridSize { columns: 1, rows: 1 }, 0, |uv| {
            let at = (uv - 0.5) * sides;
            Vec3::new(at.x, -at.y, 0.0)
        });
        // Textures repeat, so we put corners on the middles of the outer texels.
        let half = Vec2::new(0.5 / width as f32, 0.5 / height as f32);
        for at in &mut mesh.texture_coordinates {
            *at = Vec2::from(*at).clamp(half, Vec2::ONE - half).to_array();
        }
        mesh
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_lies_upright_with_its_pixels_in_order() {
        let picture = Field::from_values(
            6,
            4,
            (0..24)
                .map(|i: usize| [(i % 6) as f32 / 5.0, (i / 6) as f32 / 3.0, 0.2, 1.0])
                .collect(),
        );
        let mesh = Mesh::of_picture(&picture);
        assert_eq!(mesh.check(), Ok(()));
        let upper_left = mesh.positions.iter().position(|&[x, y, _]| x < 0.0 && y > 0.0).unwrap();
        assert_eq!(mesh.positions[upper_left], [-0.5, 2.0 / 6.0, 0.0]);
        assert_eq!(mesh.texture_coordinates[upper_left], [0.5 / 6.0, 0.5 / 4.0]);
        assert!(mesh.normals.iter().all(|&normal| Vec3::from(normal).distance(Vec3::Z) < 1e-5));
        let texture = mesh.materials[0].texture.as_ref().unwrap();
        assert_eq!(texture.texels[6 + 5].to_le_bytes(), [255, 85, 51, 255]);
        let clear = Mesh::of_picture(&Field::filled(1, 1, [0.0; 4]));
        let texture = clear.materials[0].texture.as_ref().unwrap();
        assert_eq!(texture.texels, [u32::MAX]);
    }
}
