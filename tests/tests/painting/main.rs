//! Tests of whole paintings: strokes, drying, light, undo, painting files, sessions and the
//! program `impasto`.
//!
//! Without a graphics adapter the checks on the GPU are skipped, with a note on stderr.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod studio;
mod conservation;
mod backends;
mod undo;
mod pieces;
mod views;
mod places;
mod tubes;
mod adjusting;
mod keeping;
mod changes;
mod expected_behavior;
mod stiffness;
mod program;
mod timelapse;
mod hostile;
mod killed;
mod painted_sessions;
mod surfaces;
mod recording;
mod script_surfaces;
