//! Comparison of numbers within a tolerance.

use std::fmt::Display;

/// Asserts that each value of `got` differs from the value of `wanted` at the same index by at most
/// `tolerance` (absolute). `case` names the compared values in the message.
///
/// # Panics
/// If the lengths differ, a value is not finite, or a difference exceeds `tolerance`.
#[track_caller]
pub fn assert_near(case: impl Display, got: &[f64], wanted: &[f64], tolerance: f64) {
    assert_eq!(got.len(), wanted.len(), "{case}: number of values");
    for (index, (got, wanted)) in got.iter().zip(wanted).enumerate() {
        // Infinities and NaN fail with a message of their own: their difference means nothing.
        assert!(got.is_finite() && wanted.is_finite(), "{case} [{index}]: {got} for {wanted}");
        assert!(
            (got - wanted).abs() <= tolerance,
            "{case} [{index}]: {got} for {wanted}, off by more than {tolerance:e}"
        );
    }
}
