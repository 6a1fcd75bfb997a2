//! Surfaces for tests.

use graphics::mesh::{Material, Mesh, Triangle};

/// A mesh of plain triangles whose normals point up.
pub(crate) fn bare(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Mesh {
    let count = positions.len();
    Mesh {
        positions: positions.to_vec(),
        normals: vec![[0.0, 1.0, 0.0]; count],
        texture_coordinates: vec![[0.0; 2]; count],
        colors: vec![[1.0; 3]; count],
        triangles: triangles.iter().map(|&corners| Triangle { corners, material: 0 }).collect(),
        materials: vec![Material::plain([1.0; 3])],
    }
}

/// A sheet of `squares` by `squares` squares: the places of `at(u, v)` for u and v in 0..1.
pub(crate) fn sheet(squares: u32, at: impl Fn(f32, f32) -> [f32; 3]) -> Mesh {
    let row = squares + 1;
    let share = |i: u32| i as f32 / squares as f32;
    let points: Vec<_> = (0..row * row).map(|i| at(share(i % row), share(i / row))).collect();
    let firsts = (0..squares * squares).map(|i| i / squares * row + i % squares);
    let triangles: Vec<[u32; 3]> =
        firsts.flat_map(|a| [[a, a + row + 1, a + 1], [a, a + row, a + row + 1]]).collect();
    bare(&points, &triangles)
}

/// Both meshes as one.
pub(crate) fn joined(mut one: Mesh, other: &Mesh) -> Mesh {
    let first = one.positions.len() as u32;
    one.positions.extend(&other.positions);
    one.normals.extend(&other.normals);
    one.texture_coordinates.extend(&other.texture_coordinates);
    one.colors.extend(&other.colors);
    one.triangles.extend(other.triangles.iter().map(|triangle| Triangle {
        corners: triangle.corners.map(|corner| corner + first),
        material: triangle.material,
    }));
    one
}
