//! The history panel: list of actions with pictures, undo, redo and memory.

mod pictures;
mod panel;

pub use panel::History;
