//! Plans of swatches: that they tell what they promise, and that the empty file
//! goes through a fit once it is filled in.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod painted;

mod designs;
mod page;
mod sheets;
