//! Comparison within a tolerance.

use std::fmt::Display;

/// Asserts that every value of `got` is within `tolerance` of its partner in
/// `wanted`; `case` says what is compared.
///
/// # Panics
/// If a value is off or not finite, with the case.
#[track_caller]
pub fn assert_near(case: impl Display, got: &[f64], wanted: &[f64], tolerance: f64) {
    assert_eq!(got.len(), wanted.len(), "{case}: number of values");
    for (index, (got, wanted)) in got.iter().zip(wanted).enumerate() {
        // A difference of infinities or of NaN compares as nothing at all.
        assert!(got.is_finite() && wanted.is_finite(), "{case} [{index}]: {got} for {wanted}");
        assert!(
            (got - wanted).abs() <= tolerance,
            "{case} [{index}]: {got} for {wanted}, off by more than {tolerance:e}"
        );
    }
}
