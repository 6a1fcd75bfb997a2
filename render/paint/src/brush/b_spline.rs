//! The basis of the surfaces of heads.

/// Weights of the uniform cubic B-spline.
pub(super) fn b_spline(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    let inner = |t: f32, s: f32| 4.0 * s * s * s + 12.0 * s * s * t + 6.0 * s * t * t;
    [s * s * s, inner(t, s) + t * t * t, inner(s, t) + s * s * s, t * t * t].map(|w| w / 6.0)
}
