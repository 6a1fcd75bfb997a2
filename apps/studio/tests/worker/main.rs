//! Tests of the worker thread, driven by commands as a window does.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod window;
mod pen;
mod pictures;
mod strokes;
mod groups;
mod tools;
mod replay;
mod layers;
mod table;
mod shots;
mod picking;
mod free_space;
mod messages;
mod kept;
mod volumes;
