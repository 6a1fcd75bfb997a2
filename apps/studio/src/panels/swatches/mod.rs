//! The swatches panel: mixtures that the painter keeps.

mod colors;
mod grid;
mod chosen;
mod panel;

pub use panel::Swatches;
