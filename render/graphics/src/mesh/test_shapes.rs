//! Meshes with known curvatures, for the tests of this folder.

use std::f32::consts::{PI, TAU};

use glam::{Quat, Vec2, Vec3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::model::{Material, Mesh, Triangle};
use super::shapes::GridSize;

fn surface(cells: GridSize, position: impl Fn(Vec2) -> Vec3) -> Mesh {
    let mut mesh = Mesh { materials: vec![Material::plain([0.5; 3])], ..Mesh::default() };
    mesh.add_grid(cells, 0, position);
    mesh
}

/// Torus about the z axis of about `triangles` triangles.
pub(super) fn torus(triangles: usize, ring: f32, tube: f32) -> Mesh {
    surface(GridSize::for_triangles(triangles, f64::from(ring / tube)), |uv| {
        let outward = Vec2::from_angle(uv.x * TAU).extend(0.0);
        let around = Vec2::from_angle(uv.y * TAU);
        // Forward times outward points down.
        ring * outward + tube * (outward * around.x - Vec3::Z * around.y)
    })
}

/// Open cylinder about the y axis, 2 long.
pub(super) fn cylinder(triangles: usize, radius: f32) -> Mesh {
    surface(GridSize::for_triangles(triangles, f64::from(PI * radius)), |uv| {
        let around = Vec2::from_angle(uv.x * TAU);
        Vec3::new(radius * around.y, 1.0 - 2.0 * uv.y, radius * around.x)
    })
}

/// Ellipsoid with these half axes.
pub(super) fn ellipsoid(triangles: usize, axes: Vec3) -> Mesh {
    surface(GridSize::for_triangles(triangles, 2.0), |uv| {
        let around = Vec2::from_angle(uv.x * TAU);
        let down = Vec2::from_angle(uv.y * PI);
        axes * Vec3::new(around.y * down.y, down.x, around.x * down.y)
    })
}

/// Square in the plane z = 0 from -1 to 1, seen from +z.
pub(super) fn square(triangles: usize) -> Mesh {
    surface(GridSize::for_triangles(triangles, 1.0), |uv| {
        Vec3::new(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, 0.0)
    })
}

/// A round ridge along the diagonal x = y of that square.
pub(super) fn ridge(triangles: usize, height: f32) -> Mesh {
    surface(GridSize::for_triangles(triangles, 1.0), |uv| {
        let x = 2.0 * uv.x - 1.0;
        let y = 1.0 - 2.0 * uv.y;
        let across = ((x - y) / 0.4).clamp(-1.0, 1.0);
        Vec3::new(x, y, height * (1.0 - across * across).powi(3))
    })
}

pub(super) fn bare(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Mesh {
    let count = positions.len();
    let mut mesh = Mesh {
        positions: positions.to_vec(),
        normals: vec![[0.0, 1.0, 0.0]; count],
        texture_coordinates: vec![[0.0; 2]; count],
        colors: vec![[1.0; 3]; count],
        triangles: triangles.iter().map(|&corners| Triangle { corners, material: 0 }).collect(),
        materials: vec![Material::plain([0.5; 3])],
    };
    mesh.normals = mesh.vertex_normals();
    mesh
}

/// Gives every triangle three vertices of its own.
pub(super) fn ragged(mesh: &Mesh) -> Mesh {
    let corners: Vec<usize> =
        mesh.triangles.iter().flat_map(|one| one.corners.map(|at| at as usize)).collect();
    let triangles = (0..corners.len() as u32).step_by(3);
    Mesh {
        positions: corners.iter().map(|&at| mesh.positions[at]).collect(),
        normals: corners.iter().map(|&at| mesh.normals[at]).collect(),
        texture_coordinates: vec![[0.0; 2]; corners.len()],
        colors: vec![[1.0; 3]; corners.len()],
        triangles: triangles
            .map(|first| Triangle { corners: [first, first + 1, first + 2], material: 0 })
            .collect(),
        materials: vec![Material::plain([0.5; 3])],
    }
}

/// Moves every place along its normal by up to `height`, at random, and computes the normals.
pub(super) fn rough(mesh: &Mesh, height: f32) -> Mesh {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let (welded, count) = mesh.weld();
    let moves: Vec<f32> = (0..count).map(|_| height * random.random_range(-1.0..1.0)).collect();
    let mut rough = mesh.clone();
    let mut moved: Vec<Option<[f32; 3]>> = vec![None; count];
    for (vertex, &place) in welded.iter().enumerate() {
        let [position, normal] = [mesh.positions[vertex], mesh.normals[vertex]].map(Vec3::from);
        let to = (position + normal * moves[place as usize]).to_array();
        rough.positions[vertex] = *moved[place as usize].get_or_insert(to);
    }
    rough.normals = rough.vertex_normals();
    rough
}

pub(super) fn turned(mesh: &Mesh, turn: Quat) -> Mesh {
    let [positions, normals] = [&mesh.positions, &mesh.normals].map(|vectors| {
        vectors.iter().map(|&vector| (turn * Vec3::from(vector)).to_array()).collect()
    });
    Mesh { positions, normals, ..mesh.clone() }
}

/// Angle between two unit directions of arbitrary sign, in degrees.
pub(super) fn degrees_between(a: [f32; 3], b: Vec3) -> f32 {
    let a = Vec3::from(a);
    a.cross(b).length().atan2(a.dot(b).abs()).to_degrees()
}
