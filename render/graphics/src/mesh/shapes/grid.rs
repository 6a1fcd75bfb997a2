//! Parametric surfaces over a rectangular grid.

use glam::{Vec2, Vec3};

use crate::mesh::model::{Mesh, Triangle};

/// Resolution of a grid; each cell becomes two triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GridSize {
    /// Number of cells along u.
    pub columns: usize,
    /// Number of cells along v.
    pub rows: usize,
}

impl GridSize {
    /// Grid of about `triangles` triangles with `aspect` times as many columns as rows; at
    /// least 3 x 2 cells.
    #[must_use]
    pub fn for_triangles(triangles: usize, aspect: f64) -> Self {
        let rows = (triangles as f64 / 2.0 / aspect).sqrt();
        let at_least = |cells: f64, least| (cells.round() as usize).max(least);
        Self { columns: at_least(rows * aspect, 3), rows: at_least(rows, 2) }
    }
}

impl Mesh {
    /// Appends the parametric surface `position(u, v)` for u and v in 0..1 (evaluated
    /// slightly beyond for the normals), white and with one material. Texture coordinates are
    /// (u, v). Seen from outside, u increases to the right and v downwards. Edges that
    /// coincide are joined; an edge that collapses to a point becomes a pole.
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

/// Makes positions at the edges of a grid equal if they differ by rounding only; a pole
/// gets the mean of its normals.
fn join(
    positions: &mut [[f32; 3]],
    normals: &mut [[f32; 3]],
    GridSize { columns, rows }: GridSize,
) {
    let size = positions.iter().flatten().fold(0.0f32, |most, at| most.max(at.abs()));
    let near = |p: [f32; 3], q: [f32; 3]| Vec3::from(p).distance(Vec3::from(q)) < 1e-5 * size;
    let width = columns + 1;
    let last_row = rows * width;
    for row in 0..=rows {
        let [left, right] = [row * width, row * width + columns];
        if near(positions[left], positions[right]) {
            positions[right] = positions[left];
        }
    }
    if (0..width).all(|column| near(positions[column], positions[last_row + column])) {
        positions.copy_within(..width, last_row);
    }
    for row in [0, last_row] {
        let edge = &mut positions[row..row + width];
        if edge.iter().all(|&position| near(position, edge[0])) {
            edge.fill(edge[0]);
            let around = &normals[row..row + columns];
            let sum: Vec3 = around.iter().map(|&normal| Vec3::from(normal)).sum();
            normals[row..row + width].fill(sum.try_normalize().unwrap_or(Vec3::Y).into());
        }
    }
}

/// Normal of the surface by central differences; at a pole, that of a point slightly
/// beside it.
fn normal(uv: Vec2, position: &impl Fn(Vec2) -> Vec3) -> Vec3 {
    const STEP: f32 = 1e-3;
    let slopes = |at: Vec2| {
        let [along_u, along_v] =
            [Vec2::X, Vec2::Y].map(|axis| position(at + axis * STEP) - position(at - axis * STEP));
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
