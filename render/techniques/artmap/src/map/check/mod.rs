//! Check of a map by figures that need its tiles alone, not the samples.

mod figures;
mod fault;

#[cfg(test)]
mod tests;

pub use fault::MapFault;
pub use figures::{BetweenFigures, KeyFigures, MapFigures};

use super::art_map::ArtMap;

impl ArtMap {
    /// Faults of the map: tiles that do not cohere with the first one or show a seam, tones too
    /// close or in the wrong order, in-betweens that lose contrast or lightness. An empty list for
    /// a good map.
    #[must_use]
    pub fn faults(&self) -> Vec<MapFault> {
        self.figures().faults()
    }
}
