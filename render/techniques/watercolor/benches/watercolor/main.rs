//! Benchmarks of watercolour: visibility and shading of meshes, abstraction, effects, coherent
//! noise, and whole frames.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

mod coherence;
mod effects;
mod frame;
mod segmentation;
mod shading;

fn main() {
    divan::main();
}
