//! Plans of swatches: recipes, predicted precision, and the fit of the measurement file once it is
//! filled in.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod painted;
mod designs;
mod page;
mod program;
