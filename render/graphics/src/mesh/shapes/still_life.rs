//! A still life: a jug, pears, a lemon and an orange on a striped cloth.

use std::f32::consts::TAU;

use glam::{Quat, Vec3};

use super::surfaces::{GridSize, lathe, mix_colors, tint, tube, unit_sphere};
use crate::mesh::model::{Material, Mesh, Texture};
use crate::smoothstep;

const CLOTH: u32 = 0;
const GLAZE: u32 = 1;
const FRUIT: u32 = 2;
const WOOD: u32 = 3;

const CLOTH_RADIUS: f32 = 2.95;

const TABLE_RADIUS: f32 = 2.05;

/// A still life of about `triangles` triangles, about 5 wide, with the table top at y = 0. The
/// cloth is open below. Use this to try materials, a texture and vertex colours.
pub(super) fn still_life(triangles: usize) -> Mesh {
    let materials = vec![
        Material { texture: Some(stripes()), ..Material::named("cloth", [1.0; 3]) },
        Material::named("jug", [1.0; 3]),
        Material::named("fruit", [1.0; 3]),
        Material::named("wood", [0.42, 0.30, 0.20]),
    ];
    let mut mesh = Mesh { materials, ..Mesh::default() };
    fn share(percent: usize, triangles: usize) -> usize {
        triangles * percent / 100
    }
    add_cloth(&mut mesh, share(26, triangles));
    add_jug(&mut mesh, share(22, triangles), Vec3::new(-0.75, 0.0, -0.35));
    for (x, z, lean, turn, size) in [(0.62, 0.05, 0.10, 0.4, 1.0), (1.35, -0.55, -0.16, 2.2, 0.92)]
    {
        let pose = Quat::from_rotation_y(turn) * Quat::from_rotation_x(lean);
        add_pear(&mut mesh, share(13, triangles), Vec3::new(x, 0.02, z), pose, size);
    }
    let down = Quat::from_rotation_y(0.5) * Quat::from_rotation_z(1.45);
    add_pear(&mut mesh, share(13, triangles), Vec3::new(0.75, 0.41, 0.95), down, 0.9);
    add_lemon(&mut mesh, share(6, triangles), Vec3::new(-0.72, 0.29, 1.28));
    add_orange(&mut mesh, share(7, triangles), Vec3::new(-1.35, 0.43, 0.75));
    mesh
}

fn stripes() -> Texture {
    fn texel(x: u32) -> u32 {
        let blue = (8..16).contains(&(x % 32));
        let red = (19..21).contains(&(x % 32));
        let [r, g, b] = match (blue, red) {
            (true, _) => [104, 138, 178],
            (_, true) => [186, 98, 92],
            _ => [238, 230, 214],
        };
        u32::from_le_bytes([r, g, b, 255])
    }
    Texture { width: 64, height: 2, texels: (0..128).map(|i| texel(i % 64)).collect() }
}

/// A round cloth, flat on the table and hanging in folds beyond its edge.
fn add_cloth(mesh: &mut Mesh, triangles: usize) {
    let first = mesh.positions.len();
    mesh.add_grid(GridSize::for_triangles(triangles, 3.0), CLOTH, |uv| {
        let angle = uv.x * TAU;
        let along = CLOTH_RADIUS * uv.y;
        let hanging = (along - TABLE_RADIUS).max(0.0);
        let folds = smoothstep([0.0, 0.9], hanging);
        let fold = (7.0 * angle + 0.8 * (2.0 * angle).sin()).sin() + 0.4 * (11.0 * angle).sin();
        // Around the edge of the table, then straight down.
        let bend = (hanging / 0.35).min(1.5);
        let beyond = 0.35 * bend.sin() + 0.13 * fold * folds;
        let radius = along.min(TABLE_RADIUS) + beyond;
        let drop = 0.35 * (1.0 - bend.cos()) + (hanging - 0.525).max(0.0);
        let (sin, cos) = angle.sin_cos();
        Vec3::new(radius * sin, -drop, radius * cos)
    });
    for at in first..mesh.positions.len() {
        // The stripes follow the flat cloth, not the view from above.
        let [u, v] = mesh.texture_coordinates[at];
        let (sin, cos) = (u * TAU + 0.5).sin_cos();
        mesh.texture_coordinates[at] =
            [0.62 * CLOTH_RADIUS * v * sin, 0.62 * CLOTH_RADIUS * v * cos];
    }
}

fn add_jug(mesh: &mut Mesh, triangles: usize, at: Vec3) {
    let first = mesh.positions.len();
    let body = lathe(&[
        [0.0, 0.10],
        [0.40, 0.12],
        [0.62, 0.45],
        [0.60, 0.80],
        [0.42, 1.20],
        [0.33, 1.50],
        [0.37, 1.74],
        [0.43, 1.86],
        [0.47, 1.86],
        [0.42, 1.70],
        [0.38, 1.50],
        [0.48, 1.20],
        [0.66, 0.80],
        [0.68, 0.45],
        [0.50, 0.10],
        [0.44, 0.01],
        [0.40, 0.0],
        [0.0, 0.0],
    ]);
    let spout = Quat::from_rotation_y(-1.0);
    mesh.add_grid(GridSize::for_triangles(triangles * 3 / 4, 1.2), GLAZE, |uv| {
        let position = body(uv);
        let beside = (uv.x * TAU).sin().atan2((uv.x * TAU).cos());
        let out = 0.2 * (-(beside * beside) / 0.1).exp() * smoothstep([1.45, 1.86], position.y);
        let (sin, cos) = (uv.x * TAU).sin_cos();
        at + spout * (position + Vec3::new(out * sin, 0.3 * out, out * cos))
    });
    let handle = [[-0.38, 1.66], [-0.72, 1.72], [-0.92, 1.40], [-0.84, 0.95], [-0.58, 0.70]];
    let points = handle.map(|[z, y]| Vec3::new(z, y, 0.0));
    // Both ends lie inside the body.
    fn thickness(v: f32) -> f32 {
        (0.085 - 0.02 * v) * smoothstep([0.0, 0.04], v.min(1.0 - v))
    }
    let handle = tube(&points, thickness);
    let turn = spout * Quat::from_rotation_y(-TAU / 4.0);
    mesh.add_grid(GridSize::for_triangles(triangles / 4, 0.5), GLAZE, |uv| at + turn * handle(uv));
    tint(mesh, first, |position| {
        // The foot is bare clay. A band stays pale.
        let band =
            smoothstep([0.84, 0.88], position.y) * (1.0 - smoothstep([1.08, 1.12], position.y));
        let glazed = mix_colors([0.36, 0.54, 0.68], [0.84, 0.86, 0.84], band);
        mix_colors([0.68, 0.47, 0.35], glazed, smoothstep([0.10, 0.16], position.y))
    });
}

fn add_pear(mesh: &mut Mesh, triangles: usize, at: Vec3, pose: Quat, size: f32) {
    let first = mesh.positions.len();
    let body = lathe(&[
        [0.0, 1.12],
        [0.10, 1.14],
        [0.19, 1.05],
        [0.23, 0.88],
        [0.30, 0.70],
        [0.43, 0.47],
        [0.46, 0.27],
        [0.36, 0.08],
        [0.14, 0.0],
        [0.0, 0.05],
    ]);
    mesh.add_grid(GridSize::for_triangles(triangles * 9 / 10, 1.1), FRUIT, |uv| {
        let position = body(uv);
        // The neck leans sideways.
        let lean = 0.09 * smoothstep([0.5, 1.1], position.y);
        at + pose * ((position + Vec3::new(lean, 0.0, 0.4 * lean)) * size)
    });
    let turned_back = pose.inverse();
    tint(mesh, first, |position| {
        let own = turned_back * (position - at) / size;
        let ripe =
            mix_colors([0.58, 0.64, 0.24], [0.90, 0.76, 0.30], smoothstep([0.0, 0.9], own.y));
        mix_colors(ripe, [0.80, 0.40, 0.24], 0.75 * smoothstep([0.05, 0.42], own.x + 0.3 * own.z))
    });
    let stem = [[0.08, 1.06, 0.03], [0.10, 1.22, 0.04], [0.16, 1.36, 0.06]].map(Vec3::from);
    let stem = tube(&stem, |v| 0.03 * smoothstep([0.0, 0.1], v.min(1.0 - v)));
    mesh.add_grid(GridSize::for_triangles(triangles / 10, 0.5), WOOD, |uv| {
        at + pose * (stem(uv) * size)
    });
}

fn add_lemon(mesh: &mut Mesh, triangles: usize, at: Vec3) {
    let first = mesh.positions.len();
    let body = lathe(&[
        [0.0, 0.46],
        [0.05, 0.45],
        [0.09, 0.39],
        [0.22, 0.27],
        [0.29, 0.0],
        [0.23, -0.25],
        [0.12, -0.36],
        [0.06, -0.43],
        [0.0, -0.44],
    ]);
    let pose = Quat::from_rotation_y(0.8) * Quat::from_rotation_z(1.5);
    mesh.add_grid(GridSize::for_triangles(triangles, 1.3), FRUIT, |uv| at + pose * body(uv));
    tint(mesh, first, |position| {
        mix_colors(
            [0.80, 0.72, 0.22],
            [0.96, 0.86, 0.30],
            smoothstep([-0.2, 0.2], position.y - at.y),
        )
    });
}

fn add_orange(mesh: &mut Mesh, triangles: usize, at: Vec3) {
    let first = mesh.positions.len();
    mesh.add_grid(GridSize::for_triangles(triangles, 2.0), FRUIT, |uv| {
        let ball = unit_sphere(uv);
        // Dent at the stalk.
        at + ball * (0.43 - 0.05 * (-(ball.x * ball.x + ball.z * ball.z) / 0.02).exp())
    });
    tint(mesh, first, |position| {
        mix_colors(
            [0.86, 0.44, 0.16],
            [0.93, 0.58, 0.20],
            smoothstep([-0.4, 0.4], position.y - at.y),
        )
    });
}
