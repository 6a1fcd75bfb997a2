//! The paint engine on the processor, using all cores.
//!
//! The result does not depend on the number of threads. Memory: 44 bytes per canvas
//! cell (wet paint 36, its volume 4, floor 4), of which the first 40 are taken only where there
//! was paint; 4 for the ground once paint is dry; 4 more for each view that has been rendered, and 32
//! for each of its cells in tiles with dry paint; a dry layer takes 36 bytes for each cell
//! of its painted tiles.

mod columns;
mod bed;
mod below;
mod head_paint;
mod spans;
mod penetration;
mod step;
mod velocities;
mod cells;
mod inflow;
mod exchanges;
mod band;
mod wick;
mod sub_steps;
mod sparse;
mod baked_tiles;
mod render;
mod saved_tile;
mod cpu_paint;

#[cfg(test)]
mod reference;

#[cfg(test)]
mod tests;

pub use cpu_paint::CpuPaint;
