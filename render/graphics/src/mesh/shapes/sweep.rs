//! Curves and sweeps that sample models are made of.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

/// Catmull-Rom spline (1974) through evenly spaced points, at parameter 0 to 1.
pub(super) fn catmull_rom(points: &[Vec3], at: f32) -> Vec3 {
    let spans = points.len() - 1;
    let at = at.clamp(0.0, 1.0) * spans as f32;
    let first = (at as usize).min(spans - 1);
    let t = at - first as f32;
    let point = |i: usize| points[i.min(spans)];
    let b = point(first);
    let c = point(first + 1);
    let a = if first == 0 { b * 2.0 - c } else { point(first - 1) };
    let d = if first + 2 > spans { c * 2.0 - b } else { point(first + 2) };
    let quadratic = a * 2.0 - b * 5.0 + c * 4.0 - d;
    let cubic = b * 3.0 - a - c * 3.0 + d;
    b + ((c - a) * t + quadratic * (t * t) + cubic * (t * t * t)) / 2.0
}

/// Surface of revolution about the y axis. The profile is given from top to bottom as
/// (radius, height); a hollow body starts at the bottom of its inside.
pub(super) fn lathe(outline: &[[f32; 2]]) -> impl Fn(Vec2) -> Vec3 + use<> {
    let points: Vec<Vec3> = outline.iter().map(|&[r, y]| Vec3::new(r, y, 0.0)).collect();
    move |uv| {
        let at = catmull_rom(&points, uv.y);
        let (sin, cos) = (uv.x * TAU).sin_cos();
        Vec3::new(at.x.max(0.0) * sin, at.y, at.x.max(0.0) * cos)
    }
}

/// Tube along a spline, with radius `thickness(v)`; closed where that is 0 at the ends.
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

/// Linear blend of two colours.
pub(super) fn mix_colors(from: [f32; 3], to: [f32; 3], share: f32) -> [f32; 3] {
    [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * share)
}
