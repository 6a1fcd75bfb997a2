//! Limits of a stroke.

/// Maximum number of sub-steps of a stroke.
pub const MOST_SUBSTEPS: u64 = 10_000_000;

/// Maximum distance of a sample from the origin of the canvas along each axis, in cells.
pub(super) const FARTHEST: f64 = 1e9;
