//! Whole paintings: strokes, drying, light, undo, painting files, sessions and the program
//! `impasto`.
//!
//! Without a graphics adapter the checks on the GPU are skipped, with a note on stderr.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod studio;
mod conservation;
mod skin;
mod undo;
mod views;
mod expected_behavior;
mod program;
mod surfaces;
mod recording;
