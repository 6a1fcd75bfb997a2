//! What a potter's wheel makes, and what is rolled by hand.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

/// A smooth curve through points, even in their number (Catmull and Rom 1974); `at`
/// from 0 to 1.
pub(super) fn through(points: &[Vec3], at: f32) -> Vec3 {
    let spans = points.len() - 1;
    let at = at.clamp(0.0, 1.0) * spans as f32;
    let first = (at as usize).min(spans - 1);
    let t = at - first as f32;
    let point = |i: usize| points[i.min(spans)];
    let (b, c) = (point(first), point(first + 1));
    let a = if first == 0 { b * 2.0 - c } else { point(first - 1) };
    let d = if first + 2 > spans { c * 2.0 - b } else { point(first + 2) };
    let quadratic = a * 2.0 - b * 5.0 + c * 4.0 - d;
    let cubic = b * 3.0 - a - c * 3.0 + d;
    b + ((c - a) * t + quadratic * (t * t) + cubic * (t * t * t)) / 2.0
}

/// A body turned about the vertical axis, its outline given from above to below as
/// radius and height; a hollow one begins at the bottom inside.
pub(super) fn turned(outline: &[[f32; 2]]) -> impl Fn(Vec2) -> Vec3 + use<> {
    let points: Vec<Vec3> = outline.iter().map(|&[r, y]| Vec3::new(r, y, 0.0)).collect();
    move |uv| {
        let at = through(&points, uv.y);
        let (sin, cos) = (uv.x * TAU).sin_cos();
        Vec3::new(at.x.max(0.0) * sin, at.y, at.x.max(0.0) * cos)
    }
}

/// A roll along points, `thickness(v)` from its middle to its outside; closed where
/// that is 0 at the ends.
pub(super) fn rolled(points: &[Vec3], thickness: impl Fn(f32) -> f32) -> impl Fn(Vec2) -> Vec3 {
    let points = points.to_vec();
    move |uv| {
        let v = uv.y.clamp(0.0, 1.0);
        let forward = through(&points, v + 1e-2) - through(&points, v - 1e-2);
        let forward = forward.normalize_or(Vec3::Y);
        let aside = forward.any_orthonormal_vector();
        // A fixed side, where the roll does not run along it, keeps it untwisted.
        let side = (Vec3::Z - forward * forward.z).try_normalize().unwrap_or(aside);
        let (sin, cos) = (uv.x * TAU).sin_cos();
        through(&points, v) + (side * cos + side.cross(forward) * sin) * thickness(v)
    }
}

/// 0 below `low`, 1 above `high`, smooth between.
pub(super) fn rising(low: f32, high: f32, at: f32) -> f32 {
    let t = ((at - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// From one colour to another.
pub(super) fn mixed(from: [f32; 3], to: [f32; 3], share: f32) -> [f32; 3] {
    [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * share)
}
