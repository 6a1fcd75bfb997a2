//! `impasto map`: pigments found in scans with known shares, runs that are refused or continued, and
//! simulated scans with their truth.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
mod program;
mod simulated;
