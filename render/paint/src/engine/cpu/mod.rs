//! The paint engine on the processor, using all cores.
//!
//! The result does not depend on the number of threads. This takes 44 bytes of memory per cell of
//! the canvas: 36 for wet paint, 4 for its volume, 4 for the floor. The system takes the first 40
//! only where there was paint. Where wet paint has a skin, it takes 40 more. The ground takes 4 more
//! once you dry paint. Each view that you render takes 4, and 32 for each of its cells in tiles with
//! dry paint. A dry layer takes 36 bytes for each cell of its painted tiles, 72 with a skin.

mod columns;
mod penetration;
mod velocities;
mod wick;
mod sub_steps;
mod render;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use graphics::field::Field;
use graphics::lanes::vector_instructions;
use graphics::tile::{Rect, Tile, TileSet};

use crate::contact::Contact;
use crate::engine::{BrushId, UndoSlot, View};
use crate::layer::Layer;
use crate::mask::Mask;
use crate::motion::MotionConstants;
use crate::motion::skin::{drying, settling};
use crate::optics::Scene;
use columns::{Columns, HeadPaint, SavedTile, SparseLayer};
use penetration::{Bed, Below};
use render::{PaintLayers, RenderedView};
use sub_steps::SubStepRunner;

/// The paint of one painting in the machine's memory. You use this through
/// [`PaintEngine`](crate::engine::PaintEngine), which documents its operations.
#[derive(Debug)]
pub struct CpuPaint {
    /// Height of the ground in quanta.
    ground: Arc<Field<i32>>,
    /// Height of ground and dry paint in quanta. Until paint dries, this shares its memory with
    /// `ground`.
    floor: Arc<Field<i32>>,
    wet: Columns,
    bed: Bed,
    mask: Option<Mask>,
    brushes: Vec<HeadPaint>,
    dry: Vec<SparseLayer>,
    saved_tiles: Vec<Option<SavedTile>>,
    /// One for each [`View`], by its number.
    views: [RenderedView; 2],
    runner: SubStepRunner,
}

impl CpuPaint {
    /// A canvas without paint over a ground of height `floor`, in quanta.
    pub(crate) fn new(floor: Field<i32>) -> Self {
        let floor = Arc::new(floor);
        Self {
            wet: Columns::new(Layer::empty(floor.width(), floor.height())),
            bed: Bed::unknown(floor.bounds()),
            mask: None,
            ground: Arc::clone(&floor),
            floor,
            brushes: Vec::new(),
            dry: Vec::new(),
            saved_tiles: Vec::new(),
            views: Default::default(),
            runner: SubStepRunner::default(),
        }
    }

    pub(crate) fn name(&self) -> String {
        let threads = rayon::current_num_threads();
        let threads = if threads == 1 { "1 thread".into() } else { format!("{threads} threads") };
        match vector_instructions() {
            Some(vectors) => format!("the processor, {threads}, {vectors}"),
            None => format!("the processor, {threads}"),
        }
    }

    pub(crate) fn bounds(&self) -> Rect {
        self.floor.bounds()
    }

    pub(crate) fn apply_contacts(
        &mut self,
        brush: BrushId,
        motion: &MotionConstants,
        contacts: &[Contact],
    ) {
        let brush = &mut self.brushes[brush.0];
        let below = Below { floor: &self.floor, bed: &self.bed, mask: self.mask.as_ref() };
        self.runner.apply(motion, contacts, below, &mut self.wet, brush);
    }

    pub(crate) fn set_mask(&mut self, mask: Option<&Mask>) {
        self.mask = mask.cloned();
    }

    pub(crate) fn add_brush(&mut self, width: usize, height: usize) -> BrushId {
        self.brushes.push(HeadPaint::new(Layer::empty(width, height)));
        BrushId(self.brushes.len() - 1)
    }

    pub(crate) fn brush_paint(&self, brush: BrushId) -> Layer {
        self.brushes[brush.0].cells.layer().clone()
    }

    pub(crate) fn set_brush_paint(&mut self, brush: BrushId, paint: &Layer) {
        let brush = &mut self.brushes[brush.0];
        let cells = brush.cells.layer().vehicle.bounds();
        assert_eq!(paint.vehicle.bounds(), cells, "paint must cover the brush's cells");
        *brush = HeadPaint::new(paint.clone());
    }

    pub(crate) fn wet_in(&self, rect: Rect) -> Layer {
        self.wet.part(rect)
    }

    pub(crate) fn set_wet_in(&mut self, rect: Rect, paint: &Layer) {
        let size = (paint.width(), paint.height());
        assert_eq!(size, (rect.width, rect.height), "paint must cover {rect:?}");
        self.wet.put((rect.x, rect.y), paint);
    }

    pub(crate) fn has_skin(&self, rect: Rect) -> bool {
        self.wet.has_skin(rect)
    }

    pub(crate) fn note_bed(&mut self, rect: Rect, motion: &MotionConstants) {
        let bounds = self.bounds();
        if self.bed.note(rect, &self.floor, &self.wet) {
            self.wet.begin_skin();
        }
        if !self.wet.has_skin(rect) {
            return;
        }
        for index in 0..rect.width * rect.height {
            let at = canvas_index(rect, index, bounds);
            if self.wet.skin_volume().is_some_and(|volume| volume[at] > 0) {
                let [body, skin] = self.wet.films(at);
                let joined = skin.share_of_65536(settling(&body, &skin, motion.skin_quanta));
                self.wet.set_films(at, [body.plus(&joined), skin.minus(&joined)]);
            }
        }
    }

    pub(crate) fn wet_tiles(&self) -> TileSet {
        TileSet::with(self.bounds(), |index| self.wet.volume()[index] > 0)
    }

    pub(crate) fn dry(&mut self, share: u32) {
        let bounds = self.bounds();
        let mut layer = SparseLayer::empty(bounds);
        for tile in self.wet_tiles().iter() {
            let rect = tile.rect(bounds);
            let mut part = Layer::empty(rect.width, rect.height);
            for index in 0..rect.width * rect.height {
                let at = canvas_index(rect, index, bounds);
                let [body, skin] = self.wet.films(at);
                let shares = drying(share, body.volume(), skin.volume());
                let dried = [body.share_of_65536(shares[0]), skin.share_of_65536(shares[1])];
                part.set_films(index, dried);
                self.wet.set_films(at, [body.minus(&dried[0]), skin.minus(&dried[1])]);
            }
            layer.set_tile(tile, part);
        }
        self.insert_sparse(self.dry.len(), layer);
    }

    pub(crate) fn dry_layer_count(&self) -> usize {
        self.dry.len()
    }

    pub(crate) fn dry_layer_in(&self, index: usize, rect: Rect) -> Layer {
        let bounds = self.bounds();
        assert_eq!(rect.intersection(bounds), rect, "a rectangle must lie within {bounds:?}");
        self.dry[index].part(rect)
    }

    pub(crate) fn insert_dry_layer(&mut self, index: usize, layer: &Layer) {
        assert_eq!(layer.vehicle.bounds(), self.bounds(), "a dry layer must cover the canvas");
        self.insert_sparse(index, SparseLayer::from_layer(layer));
    }

    pub(crate) fn remove_dry_layer(&mut self, index: usize) -> Layer {
        let layer = self.dry.remove(index);
        let floor = Arc::make_mut(&mut self.floor);
        layer.for_each_column(floor, |floor, volume| floor - volume as i32);
        layer.part(self.bounds())
    }

    pub(crate) fn move_dry_layer(&mut self, from: usize, to: usize) {
        let layer = self.dry.remove(from);
        self.dry.insert(to, layer);
    }

    pub(crate) fn floor(&self) -> Field<i32> {
        Field::clone(&self.floor)
    }

    pub(crate) fn save_tile(&mut self, tile: Tile, slot: UndoSlot) {
        let rect = self.rect_of(tile);
        self.saved_tiles.resize(self.saved_tiles.len().max(slot.0 + 1), None);
        self.saved_tiles[slot.0] = Some(SavedTile::of(&self.wet.part(rect)));
    }

    pub(crate) fn swap_tile(&mut self, tile: Tile, slot: UndoSlot) {
        let rect = self.rect_of(tile);
        let bounds = self.bounds();
        let saved = self.saved_tiles.get_mut(slot.0).and_then(Option::as_mut);
        let saved = saved.expect("a tile is saved to a slot before it is swapped with it");
        let size = (rect.width, rect.height);
        assert_eq!(saved.size(), size, "{tile:?} was not saved to {slot:?}");
        let now = SavedTile::of(&self.wet.part(rect));
        let before = std::mem::replace(saved, now);
        for index in 0..rect.width * rect.height {
            self.wet.set_films(canvas_index(rect, index, bounds), before.films(index));
        }
    }

    pub(crate) fn render(&mut self, view: View, scene: &Scene, baked: &TileSet, shown: &TileSet) {
        let Self { ground, floor, wet, dry, views, .. } = self;
        views[view as usize].render(scene, &PaintLayers { ground, floor, wet, dry }, baked, shown);
    }

    pub(crate) fn picture_in(&self, view: View, rect: Rect) -> Field<[f32; 4]> {
        let bounds = self.bounds();
        assert_eq!(rect.intersection(bounds), rect, "a rectangle must lie within {bounds:?}");
        let Self { ground, floor, wet, dry, views, .. } = self;
        views[view as usize].picture_in(&PaintLayers { ground, floor, wet, dry }, rect)
    }

    pub(crate) fn forget_view(&mut self, view: View) {
        self.views[view as usize] = RenderedView::default();
    }

    fn rect_of(&self, tile: Tile) -> Rect {
        let rect = tile.rect(self.bounds());
        assert!(!rect.is_empty(), "{tile:?} lies outside {:?}", self.bounds());
        rect
    }

    /// Adds a dry layer and raises the floor by its height.
    fn insert_sparse(&mut self, index: usize, layer: SparseLayer) {
        let floor = Arc::make_mut(&mut self.floor);
        layer.for_each_column(floor, |floor, volume| floor + volume as i32);
        self.dry.insert(index, layer);
    }
}

/// Converts `index`, counted row by row within `rect`, to the index of that cell within the canvas
/// `bounds`.
fn canvas_index(rect: Rect, index: usize, bounds: Rect) -> usize {
    (rect.y + index / rect.width) * bounds.width + rect.x + index % rect.width
}
