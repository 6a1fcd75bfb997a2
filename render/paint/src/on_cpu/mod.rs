//! Painting on the processor.
//!
//! Follows the specification of [`super::motion`] on all cores; the result does
//! not depend on how many there are. Memory: 44 bytes a cell of the canvas (wet
//! paint 36, its volume 4, floor 4) and 4 for the ground, 48 more once it has
//! been lit, and again under a second light; a dry layer 36 bytes for each cell of its painted tiles.

mod columns;

mod pressed;

mod band;

mod play;

mod sparse;

mod lighting;

#[cfg(test)]
mod reference;

#[cfg(test)]
mod laws;

#[cfg(test)]
mod keeping;

use self::columns::Columns;
use self::lighting::Lit;
use self::play::Player;
use self::sparse::SparseLayer;
use super::contact::Contact;
use super::engine::{BrushId, Engine, Slot, View};
use super::motion::Motion;
use crate::layer::Layer;
use crate::optics::Scene;
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::tile::{Rect, Tile, TileSet};

/// The paint of one painting, in the machine's memory.
#[derive(Debug)]
pub struct OnCpu {
    ground: Field<i32>,
    floor: Field<i32>,
    wet: Columns,
    brushes: Vec<Columns>,
    dry: Vec<SparseLayer>,
    slots: Vec<Option<Layer>>,
    lit: [Lit; 2],
    player: Player,
}

impl OnCpu {
    /// A canvas without paint on a ground of the height `floor`, in quanta.
    #[must_use]
    pub fn new(floor: Field<i32>) -> Self {
        Self {
            wet: Columns::new(Layer::empty(floor.width(), floor.height())),
            ground: floor.clone(),
            floor,
            brushes: Vec::new(),
            dry: Vec::new(),
            slots: Vec::new(),
            lit: Default::default(),
            player: Player::default(),
        }
    }
}

impl Engine for OnCpu {
    fn name(&self) -> String {
        let threads = rayon::current_num_threads();
        let threads = if threads == 1 { "1 thread".into() } else { format!("{threads} threads") };
        let wide = !matches!(pulp::Arch::new(), pulp::Arch::Scalar);
        format!("the processor, {threads}{}", if wide { ", AVX2" } else { "" })
    }

    fn bounds(&self) -> Rect {
        self.floor.bounds()
    }

    fn play(
        &mut self,
        brush: BrushId,
        motion: &Motion,
        contacts: &[Contact],
    ) -> Result<(), DeviceError> {
        let brush = &mut self.brushes[brush.0];
        self.player.play(motion, contacts, &self.floor, &mut self.wet, brush);
        Ok(())
    }

    fn add_brush(&mut self, width: usize, height: usize) -> Result<BrushId, DeviceError> {
        self.brushes.push(Columns::new(Layer::empty(width, height)));
        Ok(BrushId(self.brushes.len() - 1))
    }

    fn brush(&mut self, brush: BrushId) -> Result<Layer, DeviceError> {
        Ok(self.brushes[brush.0].layer().clone())
    }

    fn set_brush(&mut self, brush: BrushId, paint: &Layer) -> Result<(), DeviceError> {
        let brush = &mut self.brushes[brush.0];
        assert_eq!(paint.vehicle.bounds(), brush.layer().vehicle.bounds(), "cells of the brush");
        *brush = Columns::new(paint.clone());
        Ok(())
    }

    fn wet_in(&mut self, rect: Rect) -> Result<Layer, DeviceError> {
        Ok(self.wet.layer().part(rect))
    }

    fn set_wet_in(&mut self, rect: Rect, paint: &Layer) -> Result<(), DeviceError> {
        assert_eq!((paint.width(), paint.height()), (rect.width, rect.height), "cells of {rect:?}");
        self.wet.put((rect.x, rect.y), paint);
        Ok(())
    }

    fn painted(&mut self) -> Result<TileSet, DeviceError> {
        Ok(TileSet::with(self.bounds(), |index| self.wet.volume()[index] > 0))
    }

    fn dry(&mut self, share: u32) -> Result<(), DeviceError> {
        let bounds = self.bounds();
        let mut layer = SparseLayer::empty(bounds);
        for tile in self.painted()?.iter() {
            let rect = tile.rect(bounds);
            let mut part = Layer::empty(rect.width, rect.height);
            for index in 0..rect.width * rect.height {
                let at = index_in(rect, index, bounds);
                let cell = self.wet.cell(at);
                let dried = cell.share(share);
                part.set_cell(index, dried);
                self.wet.set_cell(at, cell.minus(&dried));
            }
            layer.set_tile(tile, part);
        }
        self.lay(layer);
        Ok(())
    }

    fn dry_count(&self) -> usize {
        self.dry.len()
    }

    fn dry_in(&mut self, index: usize, rect: Rect) -> Result<Layer, DeviceError> {
        let bounds = self.bounds();
        assert_eq!(rect.intersection(bounds), rect, "cells of {bounds:?}");
        Ok(self.dry[index].part(rect))
    }

    fn push_dry(&mut self, layer: &Layer) -> Result<(), DeviceError> {
        assert_eq!(layer.vehicle.bounds(), self.bounds(), "cells of the canvas");
        self.lay(SparseLayer::from_layer(layer));
        Ok(())
    }

    fn pop_dry(&mut self) -> Result<Layer, DeviceError> {
        let layer = self.dry.pop().expect("a dry layer is there, as the caller must know");
        layer.on_floor(&mut self.floor, |floor, volume| floor - volume as i32);
        Ok(layer.part(self.bounds()))
    }

    fn floor(&mut self) -> Result<Field<i32>, DeviceError> {
        Ok(self.floor.clone())
    }

    fn save(&mut self, tile: Tile, slot: Slot) -> Result<(), DeviceError> {
        let rect = self.rect_of(tile);
        self.slots.resize(self.slots.len().max(slot.0 + 1), None);
        self.slots[slot.0] = Some(self.wet.layer().part(rect));
        Ok(())
    }

    fn swap(&mut self, tile: Tile, slot: Slot) -> Result<(), DeviceError> {
        let (rect, bounds) = (self.rect_of(tile), self.bounds());
        let kept = self.slots.get_mut(slot.0).and_then(Option::as_mut);
        let kept = kept.expect("a slot is saved to before it is exchanged");
        assert_eq!((kept.width(), kept.height()), (rect.width, rect.height), "{tile:?} {slot:?}");
        for index in 0..rect.width * rect.height {
            let at = index_in(rect, index, bounds);
            let cell = self.wet.cell(at);
            self.wet.set_cell(at, kept.cell(index));
            kept.set_cell(index, cell);
        }
        Ok(())
    }

    fn light(
        &mut self,
        view: View,
        scene: &Scene,
        baked: &TileSet,
        shown: &TileSet,
    ) -> Result<(), DeviceError> {
        let Self { ground, floor, wet, dry, lit, .. } = self;
        lit[view as usize].light(
            scene,
            &lighting::Painting { ground, floor, wet, dry },
            baked,
            shown,
        );
        Ok(())
    }

    fn picture_in(&mut self, view: View, rect: Rect) -> Result<Field<[f32; 4]>, DeviceError> {
        let bounds = self.bounds();
        Ok(self.lit[view as usize].picture(bounds).part(rect))
    }

    fn forget_view(&mut self, view: View) {
        self.lit[view as usize] = Lit::default();
    }
}

impl OnCpu {
    fn rect_of(&self, tile: Tile) -> Rect {
        let rect = tile.rect(self.bounds());
        assert!(!rect.is_empty(), "{tile:?} on a canvas of {:?}", self.bounds());
        rect
    }

    /// Puts a dry layer on top; the floor rises by it.
    fn lay(&mut self, layer: SparseLayer) {
        layer.on_floor(&mut self.floor, |floor, volume| floor + volume as i32);
        self.dry.push(layer);
    }
}

/// The index on a canvas of `bounds` of the cell that has `index` in `rect`.
fn index_in(rect: Rect, index: usize, bounds: Rect) -> usize {
    (rect.y + index / rect.width) * bounds.width + rect.x + index % rect.width
}
