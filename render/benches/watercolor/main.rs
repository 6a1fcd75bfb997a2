//! How fast watercolor is: what of a mesh is seen, abstraction, effects, noise.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

mod coherence;

mod effects;

mod frame;

mod segmentation;

mod shading;

fn main() {
    divan::main();
}
