//! Parts of the pictures of a painting that are out of date.

use std::sync::Arc;

use crate::document::Lighting;
use crate::light::Light;
use crate::shade::reach;
use graphics::tile::{Rect, Tile, TileSet};

/// Tiles of one picture that are out of date or were not reported.
#[derive(Debug, Default)]
pub(super) struct PendingTiles {
    /// Tiles whose ground and dry paint must be baked again.
    pub(super) dry: TileSet,
    /// Tiles whose wet paint must be rendered.
    pub(super) wet: TileSet,
    /// Tiles rendered since changes were last reported.
    pub(super) unreported: TileSet,
}

/// A second light and the state of its picture.
#[derive(Debug)]
pub(super) struct SecondLight {
    pub(super) lighting: Lighting,
    pub(super) light: Arc<Light>,
    pub(super) pending: PendingTiles,
}

/// State of the pictures of a painting.
#[derive(Debug)]
pub(super) struct Views {
    bounds: Rect,
    /// How far shading looks, in cells.
    reach: usize,
    pub(super) first: PendingTiles,
    pub(super) second: Option<SecondLight>,
}

impl PendingTiles {
    /// All tiles of a canvas of `bounds`.
    pub(super) fn all(bounds: Rect) -> Self {
        let all = TileSet::all(bounds);
        Self { dry: all.clone(), wet: all, unreported: TileSet::default() }
    }

    /// Marks dry and wet paint of all tiles.
    pub(super) fn mark_all(&mut self, bounds: Rect) {
        self.dry = TileSet::all(bounds);
        self.wet = TileSet::all(bounds);
    }
}

impl Views {
    /// One picture that was not rendered yet.
    pub(super) fn new(bounds: Rect, cell_mm: f64) -> Self {
        Self { bounds, reach: reach(cell_mm), first: PendingTiles::all(bounds), second: None }
    }

    fn each(&mut self) -> impl Iterator<Item = &mut PendingTiles> {
        let second = self.second.as_mut().map(|second| &mut second.pending);
        std::iter::once(&mut self.first).chain(second)
    }

    /// Marks `rect` after its wet paint changed.
    pub(super) fn mark_wet(&mut self, rect: Rect) {
        let reach = rect.grown(self.reach, self.bounds);
        self.each().for_each(|pending| pending.wet.insert(reach));
    }

    /// Marks `tile` after its wet paint changed.
    pub(super) fn mark_wet_tile(&mut self, tile: Tile) {
        self.mark_wet(tile.rect(self.bounds));
    }

    /// Marks `tile` after its dry paint changed.
    pub(super) fn mark_dry_tile(&mut self, tile: Tile) {
        self.each().for_each(|pending| _ = pending.dry.insert_tile(tile));
    }

    /// Marks all tiles after dry paint or a pigment changed everywhere.
    pub(super) fn mark_all(&mut self) {
        let bounds = self.bounds;
        self.each().for_each(|pending| pending.mark_all(bounds));
    }

    /// Marks the wet paint of all tiles after the gloss changed.
    pub(super) fn mark_all_wet(&mut self) {
        let bounds = self.bounds;
        self.each().for_each(|pending| pending.wet = TileSet::all(bounds));
    }
}
