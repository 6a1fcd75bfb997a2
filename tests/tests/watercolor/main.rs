//! Watercolor: meshes and what is seen of them, abstraction, effects, noise that
//! stays on its object, and the verb.
//!
//! Where there is no adapter the tests that need one pass and say so. If the
//! variable `IMPASTO_GPU_TESTS` names a file, each adds a line to it: the
//! adapter it ran on, or `none`.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod cameras;

mod meshes;

mod seen;

mod shading;

mod effects;

mod abstraction;

mod coherence;

mod program;
