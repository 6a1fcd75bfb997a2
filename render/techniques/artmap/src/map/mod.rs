//! Art maps: tiles of brushwork from dark to light, gathered from samples.

mod tile;
mod gathered;
mod art_map;
mod between;
pub mod file;
mod check;
mod sheet;

#[cfg(test)]
mod tests;

pub use art_map::{ArtMap, KeyMap};
pub use between::{Between, Transition};
pub use check::{BetweenFigures, KeyFigures, MapFault, MapFigures};
pub use tile::Tile;
