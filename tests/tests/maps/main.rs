//! `impasto map`: pigments found in scans with known shares, and runs that are refused or continued.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod scan;

mod program;

mod residuals;
