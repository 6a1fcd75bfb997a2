//! Tests of the worker thread, driven by commands as a window does.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod window;
mod strokes;
mod replay;
mod layers;
mod volumes;
