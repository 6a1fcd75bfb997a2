//! Watercolour: meshes, their visibility and shading, abstraction of photographs, effects, coherent
//! noise, and the command `impasto watercolor`.
//!
//! Without a graphics adapter the tests that need one pass, with a note on stderr. If the
//! environment variable
//! `IMPASTO_GPU_TESTS` names a file, each of them appends a line to it: the name of its adapter, or `none`.

#![expect(clippy::unwrap_used, reason = "a test may panic")]
mod meshes;
mod seen;
mod shading;
mod effects;
mod abstraction;
mod coherence;
mod program;
