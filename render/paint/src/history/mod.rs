//! Undo and redo by tiles.
//!
//! Before an action changes paint, the history saves the wet paint of each tile concerned
//! (in the engine's memory), the paint of brushes, removed dry layers, and a value of the
//! caller's. Undo swaps all of that with the present state, so redo is the same swap once
//! more, and both are exact to the bit.
//!
//! Memory: [`TILE_BYTES`] per tile, 36 bytes per cell of brushes and dry layers. All of it
//! counts towards the limit, which is exceeded at most during one call.

mod action;
mod undo_history;

#[cfg(test)]
mod tests;

pub use action::{Restored, TILE_BYTES};
pub use undo_history::{CommitOutcome, History};
