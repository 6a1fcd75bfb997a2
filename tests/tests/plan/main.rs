//! Plans of swatches: recipes, predicted precision, and the fit of the filled-in measurement file.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
mod designs;
mod program;
