//! The thread that owns the paint, asked as a window asks it.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod window;

mod pen;

mod pictures;

mod strokes;

mod replay;

mod layers;

mod picking;

mod room;

mod messages;
