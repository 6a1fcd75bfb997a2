//! Fits: known K and S are recovered, the figures to meet on real oils are met,
//! and what the data cannot tell is said.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod absolute;
mod known_paint;
mod oils;
mod quadrature;
mod swatches;
