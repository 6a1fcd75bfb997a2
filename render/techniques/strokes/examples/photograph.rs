//! Makes the picture that the README paints: two pears and a plum on a table in the light of a
//! window, ray traced. CC0-1.0.
//!
//! `cargo run --release -p impasto-strokes --example photograph -- docs/images/still-life.png`
//! gives the same bytes every time.

use std::error::Error;

use graphics::export::png8;
use graphics::field::Field;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const WIDTH: usize = 400;
const HEIGHT: usize = 300;
/// Rays per pixel, and shadow rays to the window per ray.
const RAYS: usize = 24;

type Vector = [f64; 3];

/// A ball. Coordinates: x to the right, y upwards, z away from the viewer. `shine` is the gloss.
struct Ball {
    middle: Vector,
    radius: f64,
    color: Vector,
    shine: f64,
}

/// The still life: a plum of one ball, two pears of a row of balls each, with stalks.
fn balls() -> Vec<Ball> {
    let plum = [0.16, 0.035, 0.09];
    let mut balls =
        vec![Ball { middle: [1.55, 0.52, -0.35], radius: 0.52, color: plum, shine: 0.3 }];
    for (x, z, lean, color) in
        [(-0.85, 0.25, -0.18, [0.62, 0.52, 0.09]), (0.35, 0.75, 0.12, [0.66, 0.3, 0.07])]
    {
        for step in 0..24 {
            let t = f64::from(step) / 23.0;
            let radius = 0.78 - 0.48 * t * t * (3.0 - 2.0 * t);
            let middle = [x + lean * t, 0.78 + 1.2 * t, z];
            balls.push(Ball { middle, radius, color, shine: 0.12 });
        }
        for step in 0..10 {
            let t = f64::from(step) / 9.0;
            let middle = [x + lean * (1.0 + 0.6 * t) + 0.06 * t, 2.2 + 0.35 * t, z];
            balls.push(Ball { middle, radius: 0.045, color: [0.09, 0.05, 0.02], shine: 0.0 });
        }
    }
    balls
}

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn along(from: Vector, way: Vector, far: f64) -> Vector {
    std::array::from_fn(|i| from[i] + far * way[i])
}

fn unit(v: Vector) -> Vector {
    v.map(|side| side / dot(v, v).sqrt())
}

/// Distance and ball of the first hit of a ray.
fn met(balls: &[Ball], from: Vector, way: Vector) -> Option<(f64, &Ball)> {
    let hits = balls.iter().filter_map(|ball| {
        let off: Vector = std::array::from_fn(|i| from[i] - ball.middle[i]);
        let half = dot(off, way);
        let root = half * half - dot(off, off) + ball.radius * ball.radius;
        let far = -half - root.max(0.0).sqrt();
        (root > 0.0 && far > 1e-6).then_some((far, ball))
    });
    hits.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The first hit of a ray: position, normal, colour, shine. `None` if it is the wall.
fn seen(balls: &[Ball], from: Vector, way: Vector) -> Option<(Vector, Vector, Vector, f64)> {
    let table = if way[1] < 0.0 { -from[1] / way[1] } else { f64::INFINITY };
    if let Some((far, ball)) = met(balls, from, way).filter(|(far, _)| *far < table) {
        let place = along(from, way, far);
        let normal = unit(std::array::from_fn(|i| place[i] - ball.middle[i]));
        // The right side of a ball is redder.
        let blush = (0.5 + 0.5 * normal[0]).powi(3);
        let [red, green, blue] = ball.color;
        return Some((place, normal, [red, green * (1.0 - 0.45 * blush), blue], ball.shine));
    }
    let place = along(from, way, table);
    (place[2] < 3.2).then(|| {
        let fold = 0.06 * (3.0 * place[0] + 2.2 * place[2]).sin();
        (place, unit([fold, 1.0, 0.6 * fold]), [0.5, 0.42, 0.3], 0.0)
    })
}

fn shaded(balls: &[Ball], from: Vector, way: Vector, random: &mut ChaCha8Rng) -> Vector {
    let Some((place, normal, color, shine)) = seen(balls, from, way) else {
        // The wall, lighter towards the window.
        let light = 0.5 + 0.5 * (0.45 * way[0] - 1.4 * way[1]).sin();
        return [0.05 + 0.07 * light, 0.08 + 0.1 * light, 0.1 + 0.11 * light];
    };
    let mut light = 0.0;
    let mut mirrored = 0.0;
    let start = along(place, normal, 1e-4);
    for _ in 0..RAYS {
        let window =
            [-4.5, 4.2 + random.random_range(-1.0..1.0), -2.5 + random.random_range(-1.0..1.0)];
        let lamp = unit(std::array::from_fn(|i| window[i] - place[i]));
        if met(balls, start, lamp).is_none() {
            let bounced: Vector = std::array::from_fn(|i| lamp[i] - way[i]);
            light += dot(normal, lamp).max(0.0);
            mirrored += dot(normal, unit(bounced)).max(0.0).powi(60);
        }
    }
    let light = light / RAYS as f64;
    let mirrored = shine * mirrored / RAYS as f64;
    // Ambient light of the room, and warm light reflected by the table.
    let room = 0.1 + 0.06 * normal[1];
    let table = 0.08 * (0.5 - 0.5 * normal[1]);
    let glow = [1.0, 0.85, 0.6].map(|warm| room + warm * table);
    std::array::from_fn(|i| color[i] * ([1.25, 1.15, 0.98][i] * light + glow[i]) + mirrored)
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("name the file: docs/images/still-life.png")?;
    let balls = balls();
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut picture = Field::filled(WIDTH, HEIGHT, [0.0, 0.0, 0.0, 1.0]);
    let eye = [0.25, 2.3, -6.5];
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let mut sum = [0.0; 3];
            for _ in 0..RAYS {
                let right = (x as f64 + random.random_range(0.0..1.0)) / WIDTH as f64 - 0.5;
                let down = (y as f64 + random.random_range(0.0..1.0)) / WIDTH as f64 - 0.375;
                let way = unit([0.72 * right, -0.72 * down - 0.2, 1.0]);
                let color = shaded(&balls, eye, way, &mut random);
                sum.iter_mut().zip(color).for_each(|(sum, value)| *sum += value / RAYS as f64);
            }
            let [red, green, blue] = sum.map(|value| value as f32);
            picture[(x, y)] = [red, green, blue, 1.0];
        }
    }
    std::fs::write(path, png8(&picture, 1.0)?.bytes)?;
    Ok(())
}
