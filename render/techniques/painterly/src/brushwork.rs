//! Maps and regions, with which a subject is painted.

use artmap::map::ArtMap;

use super::error::PainterError;
use super::regions::Regions;

/// Maps with their names, and the regions that are painted with one or another.
#[derive(Debug, Clone)]
pub struct Brushwork<'a> {
    /// At least one; the first is that of everything that no region covers.
    pub maps: Vec<(&'a str, &'a ArtMap)>,
    /// Regions, which call maps by their names.
    pub regions: Regions,
}

impl<'a> Brushwork<'a> {
    /// One map everywhere.
    #[must_use]
    pub fn of(map: &'a ArtMap) -> Self {
        Self { maps: vec![("", map)], regions: Regions::default() }
    }

    /// Checks that there is a map, and that each has a tile.
    pub(super) fn check(&self) -> Result<(), PainterError> {
        let bare = |map: &ArtMap| map.keys.is_empty() || map.size() == 0;
        match self.maps.is_empty() || self.maps.iter().any(|(_, map)| bare(map)) {
            true => Err(PainterError::NoTile),
            false => Ok(()),
        }
    }

    pub(super) fn names(&self) -> Vec<&'a str> {
        self.maps.iter().map(|(name, _)| *name).collect()
    }

    pub(super) fn art_maps(&self) -> Vec<&'a ArtMap> {
        self.maps.iter().map(|(_, map)| *map).collect()
    }
}
