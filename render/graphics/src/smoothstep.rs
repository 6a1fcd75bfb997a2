//! A soft step between two limits.

use std::ops::{Div, Mul, Sub};

/// Rises from 0 at the first limit and below to 1 at the second and above, with slope 0 at both.
#[must_use]
pub fn smoothstep<T>([low, high]: [T; 2], value: T) -> T
where
    T: Copy + PartialOrd + From<f32> + Sub<Output = T> + Mul<Output = T> + Div<Output = T>,
{
    let [zero, one] = [0.0, 1.0].map(T::from);
    let t = match (value - low) / (high - low) {
        t if t < zero => zero,
        t if t > one => one,
        t => t,
    };
    t * t * (T::from(3.0) - T::from(2.0) * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_flat_outside_of_its_limits_and_half_in_their_middle() {
        assert_eq!(
            [0.5, 1.0, 2.0, 3.0, 9.0].map(|at| smoothstep([1.0_f32, 3.0], at))[..2],
            [0.0; 2]
        );
        assert_eq!([2.0, 3.0, 9.0].map(|at| smoothstep([1.0_f64, 3.0], at)), [0.5, 1.0, 1.0]);
        let slope =
            |at: f64| (smoothstep([0.0, 1.0], at + 1e-4) - smoothstep([0.0, 1.0], at)) / 1e-4;
        assert!(slope(0.0) < 1e-3 && slope(0.9999) < 1e-3 && (slope(0.5) - 1.5).abs() < 1e-3);
        // Limits may fall.
        assert_eq!(smoothstep([1.0_f32, 0.0], 0.25), smoothstep([0.0, 1.0], 0.75));
    }
}
