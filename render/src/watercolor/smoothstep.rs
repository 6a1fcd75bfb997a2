//! A soft step between two limits.

/// Rises from 0 at the first limit to 1 at the second with slope 0 at both.
pub(super) fn smoothstep([low, high]: [f32; 2], value: f32) -> f32 {
    let t = ((value - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
