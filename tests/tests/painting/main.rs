//! Whole paintings: strokes, drying, light, undo, files and the program, as they
//! work together.
//!
//! Where there is no graphics adapter the tests that need one pass and say so.

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

mod laws;

mod program;

mod hostile;

mod killed;

mod painted_sessions;

mod surfaces;

mod recording;

mod script_surfaces;
