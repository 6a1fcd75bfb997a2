//! What of the pictures is out of date.

use std::sync::Arc;

use crate::document::Lighting;
use crate::light::Light;
use graphics::tile::{Rect, Tile, TileSet};

/// What of one picture was not yet computed, and not yet told.
#[derive(Debug, Default)]
pub(super) struct Unseen {
    /// Tiles whose dry paint was not yet seen under this light.
    pub(super) baked: TileSet,
    /// Tiles whose wet paint was not yet seen.
    pub(super) shown: TileSet,
    /// Tiles computed since changes were last told.
    pub(super) untold: TileSet,
}

/// A second light, and what of its picture is out of date.
#[derive(Debug)]
pub(super) struct SecondLight {
    pub(super) lighting: Lighting,
    pub(super) light: Arc<Light>,
    pub(super) unseen: Unseen,
}

/// All pictures of a painting.
#[derive(Debug)]
pub(super) struct Views {
    bounds: Rect,
    pub(super) first: Unseen,
    pub(super) second: Option<SecondLight>,
}

impl Unseen {
    /// Nothing of a canvas of `bounds` was seen.
    pub(super) fn all(bounds: Rect) -> Self {
        let all = TileSet::all(bounds);
        Self { baked: all.clone(), shown: all, untold: TileSet::default() }
    }

    /// After the light changed.
    pub(super) fn unbake(&mut self, bounds: Rect) {
        self.baked = TileSet::all(bounds);
        self.shown = TileSet::all(bounds);
    }
}

impl Views {
    /// One picture, of which nothing was seen.
    pub(super) fn new(bounds: Rect) -> Self {
        Self { bounds, first: Unseen::all(bounds), second: None }
    }

    fn each(&mut self) -> impl Iterator<Item = &mut Unseen> {
        let second = self.second.as_mut().map(|second| &mut second.unseen);
        std::iter::once(&mut self.first).chain(second)
    }

    /// After the wet paint in `rect` changed.
    pub(super) fn touch(&mut self, rect: Rect) {
        // The relief of a cell reaches to its neighbours.
        let reach = rect.grown(1, self.bounds);
        self.each().for_each(|unseen| unseen.shown.insert(reach));
    }

    /// After the wet paint of `tile` changed.
    pub(super) fn touch_tile(&mut self, tile: Tile) {
        self.touch(tile.rect(self.bounds));
    }

    /// After the dry paint of `tile` changed.
    pub(super) fn touch_dry(&mut self, tile: Tile) {
        self.each().for_each(|unseen| _ = unseen.baked.insert_tile(tile));
    }

    /// After what is dry, or a pigment, changed everywhere.
    pub(super) fn unseen(&mut self) {
        let bounds = self.bounds;
        self.each().for_each(|unseen| unseen.unbake(bounds));
    }

    /// After the shine of paint changed.
    pub(super) fn unshown(&mut self) {
        let bounds = self.bounds;
        self.each().for_each(|unseen| unseen.shown = TileSet::all(bounds));
    }
}
