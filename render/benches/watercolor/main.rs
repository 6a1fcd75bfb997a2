//! How fast watercolor is: what of a mesh is seen, abstraction, effects, noise.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

mod effects;

mod segmentation;

fn main() {
    divan::main();
}
