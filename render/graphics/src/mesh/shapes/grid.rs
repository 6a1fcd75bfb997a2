//! Surfaces over a rectangle: a place for every two numbers.

use glam::{Vec2, Vec3};

use crate::mesh::model::{Mesh, Triangle};

/// Columns and rows of cells, each of two triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cells {
    /// Along the first number.
    pub columns: usize,
    /// Along the second number.
    pub rows: usize,
}

impl Cells {
    /// Cells for about `triangles` triangles, `aspect` times as many columns as
    /// rows; at least 3 x 2.
    #[must_use]
    pub fn of_about(triangles: usize, aspect: f64) -> Self {
        let rows = (triangles as f64 / 2.0 / aspect).sqrt();
        let at_least = |cells: f64, least| (cells.round() as usize).max(least);
        Self { columns: at_least(rows * aspect, 3), rows: at_least(rows, 2) }
    }
}

impl Mesh {
    /// Adds the surface `place(u, v)`, u and v from 0 to 1 (and a little beyond, for
    /// the normals), in one material and white: texture coordinates are u and v.
    /// Outside is where u runs to the right and v downwards. Edges that come to the
    /// same places are joined, and an edge that is one place is a pole.
    pub fn add_grid(&mut self, cells: Cells, material: u32, place: impl Fn(Vec2) -> Vec3) {
        let Cells { columns, rows } = cells;
        let first = self.positions.len();
        for row in 0..=rows {
            for column in 0..=columns {
                let uv = Vec2::new(column as f32 / columns as f32, row as f32 / rows as f32);
                self.positions.push(place(uv).into());
                self.normals.push(normal(uv, &place).into());
                self.texture_coordinates.push(uv.into());
                self.colors.push([1.0; 3]);
            }
        }
        join(&mut self.positions[first..], &mut self.normals[first..], cells);
        let vertex = |column: usize, row: usize| (first + row * (columns + 1) + column) as u32;
        for row in 0..rows {
            for column in 0..columns {
                let [a, b] = [vertex(column, row), vertex(column + 1, row)];
                let [c, d] = [vertex(column, row + 1), vertex(column + 1, row + 1)];
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

/// Makes places that differ by rounding only the same, at the edges of a grid; a pole
/// gets the mean of its normals.
fn join(places: &mut [[f32; 3]], normals: &mut [[f32; 3]], Cells { columns, rows }: Cells) {
    let size = places.iter().flatten().fold(0.0f32, |most, at| most.max(at.abs()));
    let near = |p: [f32; 3], q: [f32; 3]| Vec3::from(p).distance(Vec3::from(q)) < 1e-5 * size;
    let width = columns + 1;
    let last_row = rows * width;
    for row in 0..=rows {
        let [left, right] = [row * width, row * width + columns];
        if near(places[left], places[right]) {
            places[right] = places[left];
        }
    }
    if (0..width).all(|column| near(places[column], places[last_row + column])) {
        places.copy_within(..width, last_row);
    }
    for row in [0, last_row] {
        let edge = &mut places[row..row + width];
        if edge.iter().all(|&place| near(place, edge[0])) {
            edge.fill(edge[0]);
            let around = &normals[row..row + columns];
            let sum: Vec3 = around.iter().map(|&normal| Vec3::from(normal)).sum();
            normals[row..row + width].fill(sum.try_normalize().unwrap_or(Vec3::Y).into());
        }
    }
}

/// The normal of a surface, by its slopes; at a pole that a little beside it.
fn normal(uv: Vec2, place: &impl Fn(Vec2) -> Vec3) -> Vec3 {
    const STEP: f32 = 1e-3;
    let slopes = |at: Vec2| {
        let [along_u, along_v] =
            [Vec2::X, Vec2::Y].map(|axis| place(at + axis * STEP) - place(at - axis * STEP));
        [along_u, along_v]
    };
    let [along_u, along_v] = slopes(uv);
    let flat =
        along_u.length().min(along_v.length()) < 1e-3 * along_u.length().max(along_v.length());
    let [along_u, along_v] = match flat {
        true => slopes(uv + (Vec2::splat(0.5) - uv) * (8.0 * STEP)),
        false => [along_u, along_v],
    };
    along_v.cross(along_u).try_normalize().unwrap_or(Vec3::Y)
}
