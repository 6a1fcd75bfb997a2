//! A village on a hill: houses around a church, trees, a path.

use std::f32::consts::TAU;

use glam::{Quat, Vec2, Vec3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::surfaces::{GridSize, lathe, mix_colors, tint, unit_sphere};
use crate::mesh::model::{Material, Mesh};
use crate::smoothstep;

const LAND: u32 = 0;
const WALLS: [u32; 3] = [1, 2, 3];
const ROOFS: [u32; 2] = [4, 5];
const DARK: u32 = 6;
const LEAVES: u32 = 7;
const TRUNK: u32 = 8;

const RADIUS: f32 = 10.0;

/// Position of each house: angle around the church in radians, and distance from it.
const HOUSES: [[f32; 2]; 15] = [
    [0.3, 1.9],
    [1.1, 2.1],
    [1.9, 1.8],
    [2.8, 2.0],
    [3.7, 2.1],
    [4.5, 1.9],
    [5.5, 2.2],
    [0.0, 3.7],
    [0.8, 3.9],
    [1.6, 3.6],
    [2.4, 4.0],
    [3.9, 3.9],
    [4.8, 3.7],
    [5.4, 4.1],
    [1.25, 5.6],
];

/// A village of about `triangles` triangles, 20 wide and open below. You get at least about
/// 1,500.
pub(super) fn village(triangles: usize) -> Mesh {
    let materials = [
        ("land", [1.0, 1.0, 1.0]),
        ("wall", [0.91, 0.86, 0.76]),
        ("wall", [0.86, 0.76, 0.62]),
        ("wall", [0.90, 0.82, 0.78]),
        ("roof", [0.74, 0.42, 0.31]),
        ("roof", [0.62, 0.37, 0.33]),
        ("opening", [0.34, 0.36, 0.42]),
        ("leaves", [1.0, 1.0, 1.0]),
        ("wood", [0.42, 0.33, 0.26]),
    ]
    .map(|(name, color)| Material::named(name, color));
    let mut mesh = Mesh { materials: materials.to_vec(), ..Mesh::default() };
    add_land(&mut mesh, triangles * 45 / 100);
    add_church(&mut mesh);
    let mut rng = ChaCha8Rng::seed_from_u64(2006);
    for (i, [angle, distance]) in HOUSES.into_iter().enumerate() {
        let at = on_land(angle, distance);
        let size = Vec3::new(
            rng.random_range(0.5..0.68),
            rng.random_range(0.55..0.95),
            rng.random_range(0.62..0.9),
        );
        // Houses face along the slope.
        let turn = angle + rng.random_range(-0.25..0.25);
        let colors = [WALLS[i % 3], ROOFS[i * 7 % 2]];
        add_house(&mut mesh, at, turn, size, colors);
    }
    let trees = 46;
    let each = (triangles * 55 / 100).saturating_sub(HOUSES.len() * 60) / trees;
    let mut planted = 0;
    while planted < trees {
        let angle = rng.random_range(0.0..TAU);
        let distance = RADIUS * rng.random_range(0.2f32..0.92).sqrt();
        if HOUSES
            .iter()
            .any(|&[a, d]: &[f32; 2]| on_land(a, d).distance(on_land(angle, distance)) < 1.0)
            || distance < 1.6
            || on_path(on_land(angle, distance)) > 0.2
        {
            continue;
        }
        let height = rng.random_range(0.8..1.5);
        add_tree(&mut mesh, each, on_land(angle, distance), height, planted % 4 == 0);
        planted += 1;
    }
    mesh
}

fn height([x, z]: [f32; 2]) -> f32 {
    let distance = x.hypot(z);
    let hill = 2.3 * (-(distance / 4.6).powi(2)).exp();
    let waves = 0.35 * (0.55 * x + 1.0).sin() * (0.6 * z - 0.4).cos() + 0.14 * (1.3 * x - z).sin();
    hill + waves * smoothstep([1.5, 5.0], distance)
}

fn on_land(angle: f32, distance: f32) -> Vec3 {
    let (sin, cos) = angle.sin_cos();
    let [x, z] = [distance * sin, distance * cos];
    Vec3::new(x, height([x, z]), z)
}

/// Coverage by the path, 0..1. The path winds down from the church.
fn on_path(position: Vec3) -> f32 {
    let distance = position.x.hypot(position.z);
    let middle = 0.35 + 0.5 * (0.55 * distance).sin();
    let away = position.x.atan2(position.z) - middle;
    let across = distance * (away - TAU * (away / TAU).round()).abs();
    (1.0 - smoothstep([0.15, 0.42], across)) * smoothstep([0.9, 1.2], distance)
}

fn add_land(mesh: &mut Mesh, triangles: usize) {
    let first = mesh.positions.len();
    mesh.add_grid(GridSize::for_triangles(triangles, 2.2), LAND, |uv| {
        let angle = uv.x * TAU;
        let ragged = 1.0 + 0.05 * (5.0 * angle).sin() + 0.03 * (13.0 * angle + 1.0).sin();
        on_land(angle, RADIUS * ragged * uv.y)
    });
    tint(mesh, first, |position| {
        let meadow = (0.9 * position.x + 0.4).sin() * (0.7 * position.z).cos();
        let green = mix_colors([0.56, 0.66, 0.36], [0.76, 0.76, 0.44], 0.5 + 0.5 * meadow);
        let fields = smoothstep([5.0, 6.0], position.x - 0.4 * position.z);
        let sown = mix_colors(green, [0.84, 0.74, 0.44], 0.8 * fields);
        mix_colors(sown, [0.88, 0.80, 0.66], on_path(position))
    });
}

fn add_flat(mesh: &mut Mesh, corners: [Vec3; 4], material: u32) {
    let [a, b, c, d] = corners;
    mesh.add_grid(GridSize { columns: 1, rows: 1 }, material, |Vec2 { x, y }| {
        let above = a + (b - a) * x;
        let below = c + (d - c) * x;
        above + (below - above) * y
    });
}

/// A house with gables, an overhanging roof, windows and a chimney. `size` is half the
/// width, the height of the walls, and half the length.
fn add_house(mesh: &mut Mesh, at: Vec3, turn: f32, size: Vec3, [wall, roof]: [u32; 2]) {
    let turn = Quat::from_rotation_y(turn);
    let [w, h, l] = size.to_array();
    let foot = -0.8;
    let ridge = h + 1.05 * w;
    // The second side is the first turned by 180 degrees.
    for side in [1.0, -1.0] {
        let on = |x: f32, y: f32, z: f32| at + turn * Vec3::new(side * x, y, side * z);
        add_flat(mesh, [on(w, h, l), on(w, h, -l), on(w, foot, l), on(w, foot, -l)], wall);
        add_flat(mesh, [on(-w, h, l), on(w, h, l), on(-w, foot, l), on(w, foot, l)], wall);
        // The upper edge of the gable is a point.
        let top = on(0.0, ridge, l);
        add_flat(mesh, [top, top, on(-w, h, l), on(w, h, l)], wall);
        let out = w + 0.12;
        let low = h - 0.126;
        let end = l + 0.12;
        let eave = [on(out, low, end), on(out, low, -end)];
        let top = ridge + 0.02;
        add_flat(mesh, [on(0.0, top, end), on(0.0, top, -end), eave[0], eave[1]], roof);
        for [x, low, half, high] in [
            [-0.45 * w, 0.45 * h, 0.14 * w, 0.3 * h],
            [0.45 * w, 0.45 * h, 0.14 * w, 0.3 * h],
            [0.0, h + 0.2 * w, 0.11 * w, 0.25 * w],
        ] {
            let pane =
                [[x - half, low + high], [x + half, low + high], [x - half, low], [x + half, low]];
            add_flat(mesh, pane.map(|[x, y]| on(x, y, l + 0.012)), DARK);
        }
        for along in [-0.55, 0.0, 0.55] {
            let z = along * l;
            let x = w + 0.012;
            let [near, far] = [z + 0.11 * l, z - 0.11 * l];
            let [low, high] = [0.4 * h, 0.72 * h];
            let corners = [on(x, high, near), on(x, high, far), on(x, low, near), on(x, low, far)];
            add_flat(mesh, corners, DARK);
        }
    }
    let chimney = [0.3 * w, ridge - 0.35 * w, 0.4 * l];
    add_tower(
        mesh,
        &|position| at + turn * (position + Vec3::from(chimney)),
        [0.09, 0.5 * w],
        wall,
    );
}

fn add_tower(
    mesh: &mut Mesh,
    placed: &dyn Fn(Vec3) -> Vec3,
    [half, high]: [f32; 2],
    material: u32,
) {
    for quarter in 0..4 {
        let turn = Quat::from_rotation_y(quarter as f32 * TAU / 4.0);
        let wall = [[-half, high], [half, high], [-half, 0.0], [half, 0.0]];
        add_flat(mesh, wall.map(|[x, y]| placed(turn * Vec3::new(x, y, half))), material);
    }
    let lid = [[-half, -half], [half, -half], [-half, half], [half, half]];
    add_flat(mesh, lid.map(|[x, z]| placed(Vec3::new(x, high, z))), material);
}

fn add_church(mesh: &mut Mesh) {
    let at = on_land(0.0, 0.0);
    add_house(mesh, at, 0.5, Vec3::new(0.62, 1.25, 1.2), [WALLS[0], ROOFS[1]]);
    let turn = Quat::from_rotation_y(0.5);
    let tower = |position: Vec3| at + turn * (position + Vec3::new(0.0, -0.5, -1.3));
    add_tower(mesh, &tower, [0.42, 3.6], WALLS[0]);
    for quarter in 0..4 {
        let side = Quat::from_rotation_y(quarter as f32 * TAU / 4.0);
        let top = [0.0, 5.2, 0.0];
        let roof = [top, top, [-0.5, 3.58, 0.5], [0.5, 3.58, 0.5]];
        add_flat(mesh, roof.map(|corner| tower(side * Vec3::from(corner))), ROOFS[1]);
        let sound = [[-0.13, 3.2], [0.13, 3.2], [-0.13, 2.75], [0.13, 2.75]];
        add_flat(mesh, sound.map(|[x, y]| tower(side * Vec3::new(x, y, 0.432))), DARK);
    }
}

fn add_tree(mesh: &mut Mesh, triangles: usize, at: Vec3, height: f32, slim: bool) {
    let first = mesh.positions.len();
    let wide = if slim { 0.17 } else { 0.42 } * height;
    let middle = at + Vec3::Y * (if slim { 0.75 } else { 0.8 } * height);
    let tall = if slim { 0.72 } else { 0.46 } * height;
    let phase = at.x * 3.0 + at.z;
    mesh.add_grid(GridSize::for_triangles(triangles * 9 / 10, 1.6), LEAVES, |uv| {
        let ball = unit_sphere(uv);
        let lumps =
            (4.0 * ball.x + phase).sin() * (4.5 * ball.y).cos() * (4.0 * ball.z - phase).sin();
        let size = 1.0 + 0.16 * lumps;
        // A slim tree tapers like a flame.
        let taper = if slim { 1.0 - 0.45 * ball.y } else { 1.0 };
        middle + ball * Vec3::new(wide * taper, tall, wide * taper) * size
    });
    let own = 0.5 + 0.5 * (7.0 * phase).sin();
    let leaf = match slim {
        true => [0.30, 0.44, 0.34],
        false => mix_colors([0.38, 0.52, 0.26], [0.62, 0.62, 0.28], own),
    };
    tint(mesh, first, |position| {
        let light = smoothstep([middle.y - tall, middle.y + tall], position.y);
        mix_colors(leaf.map(|value| 0.85 * value), leaf, light)
    });
    let trunk = lathe(&[[0.0, 0.6], [0.05, 0.5], [0.055, 0.2], [0.09, -0.1], [0.0, -0.1]]);
    let size = Vec3::new(height, height, height);
    mesh.add_grid(GridSize::for_triangles(triangles / 10, 1.5), TRUNK, |uv| at + trunk(uv) * size);
}
