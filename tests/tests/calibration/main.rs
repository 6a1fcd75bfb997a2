//! Tests of fits: known K and S are recovered, error limits on the Van Gogh oils are met, and
//! unknowns that the data do not determine are reported.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
mod cards;
mod disorder;
mod known_paint;
mod left_out;
mod oils;
mod prior;
