//! Limits of a stroke.

/// Maximum number of sub-steps of a stroke.
pub const MOST_SUBSTEPS: u64 = 10_000_000;

/// Maximum distance of a sample from the origin of the canvas along each axis, in cells.
pub(super) const FARTHEST: f64 = 1e9;

/// Pressures of a dab, as fractions of the pressure of its sample: down, and up again
/// (chosen by eye).
pub(super) const DAB: [f64; 8] = [0.0, 0.25, 0.5, 0.75, 1.0, 0.67, 0.33, 0.0];
