//! Undo and redo, by tiles.
