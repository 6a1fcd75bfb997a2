//! From photographs to pigments and strokes: reading, separation, planning.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
mod made;
mod pictures;
mod program;
mod separation;
mod strokes;
