//! From photographs to pigments and to strokes: reading, separation, planning.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod choosing;
mod made;
mod painter;
mod pictures;
mod profiles;
mod program;
mod separation;
mod strokes;
