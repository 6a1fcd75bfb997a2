//! State of the pictures of a painting: the tiles of each that are out of date, and a second light.

use std::sync::Arc;

use graphics::gpu::DeviceError;
use graphics::tile::{Rect, Tile, TileSet};

use crate::document::Lighting;
use crate::engine::{PaintEngine, View};
use crate::light::Light;
use crate::optics::Scene;
use crate::shade::reach;

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

    /// The tiles of one picture.
    ///
    /// # Panics
    /// For the second picture, if there is no second light.
    pub(super) fn pending_of(&mut self, view: View) -> &mut PendingTiles {
        match view {
            View::First => &mut self.first,
            View::Second => &mut self.second.as_mut().expect(SECOND).pending,
        }
    }

    /// Renders the tiles of one picture that are out of date.
    pub(super) fn render(
        &mut self,
        engine: &mut PaintEngine,
        view: View,
        scene: &Scene,
    ) -> Result<(), DeviceError> {
        let pending = self.pending_of(view);
        engine.render(view, scene, &pending.dry, &pending.wet)?;
        let dry = std::mem::take(&mut pending.dry);
        let wet = std::mem::take(&mut pending.wet);
        for tile in dry.iter().chain(wet.iter()) {
            pending.unreported.insert_tile(tile);
        }
        Ok(())
    }

    /// Sets the second light. If only the lamp differs, the dry paint of its picture stays.
    pub(super) fn set_second(&mut self, lighting: Lighting, light: Arc<Light>) {
        let bounds = self.bounds;
        let pending = match self.second.take() {
            Some(SecondLight { light: before, mut pending, .. })
                if Arc::ptr_eq(&before, &light) =>
            {
                pending.wet = TileSet::all(bounds);
                pending
            }
            _ => PendingTiles::all(bounds),
        };
        self.second = Some(SecondLight { lighting, light, pending });
    }
}

/// Message for a bug: nobody asks for a second picture without a second light.
pub(super) const SECOND: &str = "the painting has a second light";

/// The picture under the light of the painting or, if `second` is true, under the second one.
pub(super) fn view(second: bool) -> View {
    if second { View::Second } else { View::First }
}
