//! The paint engine offers one set of operations over both backends, for brushes, masks, tiles
//! saved for undo, dry layers and pictures.

use graphics::field::Field;
use graphics::gpu::{BackendChoice, Device, DeviceError, choose};
use graphics::tile::{Rect, Tile, TileSet};

use super::cpu::CpuPaint;
use super::gpu::GpuPaint;
use super::{BrushId, UndoSlot, View};
use crate::contact::Contact;
use crate::layer::Layer;
use crate::mask::Mask;
use crate::motion::MotionConstants;
use crate::optics::Scene;

/// The paint of one painting: the wet layer, dry layers, the paint on each brush, and pictures of
/// the canvas.
///
/// Every change is exact integer arithmetic, so both backends hold equal bits after equal calls. On
/// the processor operations do not fail. On a graphics device each returns [`DeviceError`] if you
/// lose the device, and those that allocate also return it if the device runs out of memory.
///
/// Rectangles, tiles, brushes and layers must exist on this canvas. If you name others, this is a
/// bug, and the call panics.
#[derive(Debug)]
pub enum PaintEngine {
    /// On the processor.
    Cpu(Box<CpuPaint>),
    /// On a graphics device.
    Gpu(Box<GpuPaint>),
}

/// An engine opened by [`PaintEngine::open`].
#[derive(Debug)]
pub struct OpenedEngine {
    /// The engine, without paint.
    pub engine: PaintEngine,
    /// Tells you why we use the processor although we found a device. This is `None` if we use the
    /// device or did not find one.
    pub device_error: Option<DeviceError>,
}

impl PaintEngine {
    /// A canvas without paint on the processor, over a ground of height `floor` in
    /// quanta (see [`crate::amount`]).
    #[must_use]
    pub fn on_cpu(floor: Field<i32>) -> Self {
        Self::Cpu(Box::new(CpuPaint::new(floor)))
    }

    /// A canvas without paint on `device`, over a ground of height `floor` in quanta.
    ///
    /// # Errors
    /// [`DeviceError::TooLarge`] if a buffer of the device cannot hold the canvas,
    /// [`DeviceError::OutOfMemory`] if its memory cannot.
    pub fn on_device(device: Device, floor: &Field<i32>) -> Result<Self, DeviceError> {
        Ok(Self::Gpu(Box::new(GpuPaint::new(device, floor)?)))
    }

    /// A canvas without paint on the backend that `choice` selects, over a ground of height `floor`
    /// in quanta. With [`BackendChoice::Auto`], you get the processor if the device cannot hold the
    /// canvas.
    ///
    /// # Errors
    /// With [`BackendChoice::Gpu`], [`DeviceError`] if there is no device or it cannot
    /// hold the canvas.
    pub fn open(choice: BackendChoice, floor: &Field<i32>) -> Result<OpenedEngine, DeviceError> {
        Self::open_on(choose(choice)?, choice, floor)
    }

    /// Like [`Self::open`], on a device that you opened by this `choice`. `None` is the processor.
    ///
    /// # Errors
    /// With [`BackendChoice::Gpu`], [`DeviceError`] if the device cannot hold the canvas.
    pub fn open_on(
        device: Option<Device>,
        choice: BackendChoice,
        floor: &Field<i32>,
    ) -> Result<OpenedEngine, DeviceError> {
        let Some(device) = device else {
            return Ok(OpenedEngine { engine: Self::on_cpu(floor.clone()), device_error: None });
        };
        match Self::on_device(device, floor) {
            Ok(engine) => Ok(OpenedEngine { engine, device_error: None }),
            Err(error) if choice == BackendChoice::Auto => {
                let engine = Self::on_cpu(floor.clone());
                Ok(OpenedEngine { engine, device_error: Some(error) })
            }
            Err(error) => Err(error),
        }
    }

    /// Name of the processor or device that computes, for display.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Cpu(paint) => paint.name(),
            Self::Gpu(paint) => paint.name(),
        }
    }

    /// Name of the device that computes the light. Pictures of two devices may differ in their last digits. On
    /// the processor the number of threads changes nothing, so the name does not hold it.
    #[must_use]
    pub fn device_name(&self) -> String {
        match self {
            Self::Cpu(_) => "the processor".to_owned(),
            Self::Gpu(paint) => paint.name(),
        }
    }

    /// The graphics device that computes. `None` on the processor.
    #[must_use]
    pub fn device(&self) -> Option<&Device> {
        match self {
            Self::Cpu(_) => None,
            Self::Gpu(paint) => Some(paint.device()),
        }
    }

    /// Waits until the device has done everything that you asked of it. You need this only for
    /// timing: reads always return the current state.
    pub fn finish(&mut self) -> Result<(), DeviceError> {
        match self {
            Self::Cpu(_) => Ok(()),
            Self::Gpu(paint) => paint.finish(),
        }
    }

    /// The canvas in cells, with its origin at (0, 0).
    #[must_use]
    pub fn bounds(&self) -> Rect {
        match self {
            Self::Cpu(paint) => paint.bounds(),
            Self::Gpu(paint) => paint.bounds(),
        }
    }

    /// Applies one sub-step of `brush` for each contact, in order. See
    /// [`crate::motion`].
    pub fn apply_contacts(
        &mut self,
        brush: BrushId,
        motion: &MotionConstants,
        contacts: &[Contact],
    ) -> Result<(), DeviceError> {
        match self {
            Self::Cpu(paint) => {
                paint.apply_contacts(brush, motion, contacts);
                Ok(())
            }
            Self::Gpu(paint) => paint.apply_contacts(brush, motion, contacts),
        }
    }

    /// Adds a brush whose head has `width` x `height` cells, without paint.
    pub fn add_brush(&mut self, width: usize, height: usize) -> Result<BrushId, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.add_brush(width, height)),
            Self::Gpu(paint) => paint.add_brush(width, height),
        }
    }

    /// Downloads the paint on a brush, over the cells of its head.
    pub fn brush_paint(&mut self, brush: BrushId) -> Result<Layer, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.brush_paint(brush)),
            Self::Gpu(paint) => paint.brush_paint(brush),
        }
    }

    /// Replaces the paint on a brush.
    pub fn set_brush_paint(&mut self, brush: BrushId, layer: &Layer) -> Result<(), DeviceError> {
        match self {
            Self::Cpu(paint) => {
                paint.set_brush_paint(brush, layer);
                Ok(())
            }
            Self::Gpu(paint) => paint.set_brush_paint(brush, layer),
        }
    }

    /// Downloads the wet layer.
    pub fn wet(&mut self) -> Result<Layer, DeviceError> {
        self.wet_in(self.bounds())
    }

    /// Downloads the wet paint in `rect`. Time is proportional to the area of `rect`.
    pub fn wet_in(&mut self, rect: Rect) -> Result<Layer, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.wet_in(rect)),
            Self::Gpu(paint) => paint.wet_in(rect),
        }
    }

    /// Replaces the wet layer.
    pub fn set_wet(&mut self, layer: &Layer) -> Result<(), DeviceError> {
        self.set_wet_in(self.bounds(), layer)
    }

    /// Replaces the wet paint in `rect`. Time is proportional to the area of `rect`.
    pub fn set_wet_in(&mut self, rect: Rect, layer: &Layer) -> Result<(), DeviceError> {
        match self {
            Self::Cpu(paint) => {
                paint.set_wet_in(rect, layer);
                Ok(())
            }
            Self::Gpu(paint) => paint.set_wet_in(rect, layer),
        }
    }

    /// The tiles that have wet paint.
    pub fn wet_tiles(&mut self) -> Result<TileSet, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.wet_tiles()),
            Self::Gpu(paint) => paint.wet_tiles(),
        }
    }

    /// Downloads the floor: the height of ground plus dry paint, in quanta over the
    /// plane of the canvas.
    pub fn floor(&mut self) -> Result<Field<i32>, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.floor()),
            Self::Gpu(paint) => paint.floor(),
        }
    }

    /// Renders tiles of a view. For `shown` tiles, we composite the wet layer over the baked
    /// reflectance of ground and dry layers. For `baked` tiles, we bake this reflectance first. The
    /// time grows with the number of tiles.
    ///
    /// When you first call this for a view, name all tiles. If you change `scene` beyond its lamp,
    /// bake all tiles. If you change the surface's height, show all tiles within
    /// [`reach`](crate::shade::reach) of the change.
    pub fn render(
        &mut self,
        view: View,
        scene: &Scene,
        baked: &TileSet,
        shown: &TileSet,
    ) -> Result<(), DeviceError> {
        match self {
            Self::Cpu(paint) => {
                paint.render(view, scene, baked, shown);
                Ok(())
            }
            Self::Gpu(paint) => paint.render(view, scene, baked, shown),
        }
    }

    /// Downloads the first view as last rendered. See [`PaintEngine::picture_in`].
    pub fn picture(&mut self) -> Result<Field<[f32; 4]>, DeviceError> {
        self.picture_in(View::First, self.bounds())
    }

    /// Downloads a view in `rect` from its last rendering: linear sRGB with white at 1, and 1 as
    /// the fourth component. It is black where you rendered nothing. If paint has changed since,
    /// you see either the earlier or the present paint. The time grows with the area of `rect`.
    pub fn picture_in(&mut self, view: View, rect: Rect) -> Result<Field<[f32; 4]>, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.picture_in(view, rect)),
            Self::Gpu(paint) => paint.picture_in(view, rect),
        }
    }

    /// Frees the memory of a view. Before you show it again, you must bake all its tiles.
    pub fn forget_view(&mut self, view: View) {
        match self {
            Self::Cpu(paint) => paint.forget_view(view),
            Self::Gpu(paint) => paint.forget_view(view),
        }
    }
}

impl PaintEngine {
    /// Covers the cells of `mask`, or no cell if you pass `None`. The contacts that follow do not
    /// change the paint of covered cells.
    ///
    /// # Panics
    /// If the mask is of another canvas.
    pub fn set_mask(&mut self, mask: Option<&Mask>) -> Result<(), DeviceError> {
        let bounds = self.bounds();
        assert!(mask.is_none_or(|mask| mask.bounds() == bounds), "a mask must cover {bounds:?}");
        match self {
            Self::Cpu(paint) => {
                paint.set_mask(mask);
                Ok(())
            }
            Self::Gpu(paint) => paint.set_mask(mask),
        }
    }

    /// Whether a cell of the tile may have a skin. On the processor this is exact.
    ///
    /// # Panics
    /// If the tile lies outside the canvas.
    #[must_use]
    pub fn may_have_skin(&self, tile: Tile) -> bool {
        let rect = tile.rect(self.bounds());
        match self {
            Self::Cpu(paint) => paint.has_skin(rect),
            Self::Gpu(paint) => paint.may_have_skin(rect),
        }
    }

    /// Records the surface of the paint in a tile. In the contacts that follow, loaded hair rides
    /// on this surface until you record the tile again. See [`bed`](crate::motion::bed). A tile
    /// that you never recorded does not bear hair.
    ///
    /// The contacts that follow lay paint as a skin where the tile has wet paint now. Skins that it has
    /// already are settled, see [`skin`](crate::motion::skin). This changes the paint, so save a tile that
    /// [may have a skin](Self::may_have_skin) before.
    ///
    /// # Panics
    /// If the tile lies outside the canvas.
    pub fn note_bed(&mut self, tile: Tile, motion: &MotionConstants) -> Result<(), DeviceError> {
        let rect = tile.rect(self.bounds());
        match self {
            Self::Cpu(paint) => {
                paint.note_bed(rect, motion);
                Ok(())
            }
            Self::Gpu(paint) => paint.note_bed(rect, motion),
        }
    }

    /// Copies the wet paint of a tile to `slot`, within the engine's memory.
    pub fn save_tile(&mut self, tile: Tile, slot: UndoSlot) -> Result<(), DeviceError> {
        match self {
            Self::Cpu(paint) => {
                paint.save_tile(tile, slot);
                Ok(())
            }
            Self::Gpu(paint) => paint.save_tile(tile, slot),
        }
    }

    /// Swaps the wet paint of a tile with that saved in `slot`.
    pub fn swap_tile(&mut self, tile: Tile, slot: UndoSlot) -> Result<(), DeviceError> {
        match self {
            Self::Cpu(paint) => {
                paint.swap_tile(tile, slot);
                Ok(())
            }
            Self::Gpu(paint) => paint.swap_tile(tile, slot),
        }
    }
}

impl PaintEngine {
    /// Dries a share of all wet paint, 0 to 65536 in parts of 65536. This becomes a new dry layer
    /// on top, and the floor rises by its height.
    pub fn dry(&mut self, share: u32) -> Result<(), DeviceError> {
        match self {
            Self::Cpu(paint) => {
                paint.dry(share);
                Ok(())
            }
            Self::Gpu(paint) => paint.dry(share),
        }
    }

    /// Number of dry layers.
    #[must_use]
    pub fn dry_layer_count(&self) -> usize {
        match self {
            Self::Cpu(paint) => paint.dry_layer_count(),
            Self::Gpu(paint) => paint.dry_layer_count(),
        }
    }

    /// Downloads a dry layer, counted from the lowest, which is 0.
    pub fn dry_layer(&mut self, index: usize) -> Result<Layer, DeviceError> {
        self.dry_layer_in(index, self.bounds())
    }

    /// Downloads the paint of a dry layer in `rect`. Time is proportional to the area of
    /// `rect`.
    pub fn dry_layer_in(&mut self, index: usize, rect: Rect) -> Result<Layer, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.dry_layer_in(index, rect)),
            Self::Gpu(paint) => paint.dry_layer_in(index, rect),
        }
    }

    /// Adds a dry layer on top. The floor rises by its height.
    pub fn push_dry_layer(&mut self, layer: &Layer) -> Result<(), DeviceError> {
        self.insert_dry_layer(self.dry_layer_count(), layer)
    }

    /// Removes the topmost dry layer and returns it. The floor falls by its height.
    pub fn pop_dry_layer(&mut self) -> Result<Layer, DeviceError> {
        let top = self.dry_layer_count().checked_sub(1);
        self.remove_dry_layer(top.expect("the caller checks that there is a dry layer"))
    }

    /// Adds a dry layer at `index`. The layers from there on move up by one. The floor rises by its
    /// height.
    pub fn insert_dry_layer(&mut self, index: usize, layer: &Layer) -> Result<(), DeviceError> {
        match self {
            Self::Cpu(paint) => {
                paint.insert_dry_layer(index, layer);
                Ok(())
            }
            Self::Gpu(paint) => paint.insert_dry_layer(index, layer),
        }
    }

    /// Removes a dry layer and returns it. The layers above it move down by one. The floor falls by
    /// its height.
    pub fn remove_dry_layer(&mut self, index: usize) -> Result<Layer, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.remove_dry_layer(index)),
            Self::Gpu(paint) => paint.remove_dry_layer(index),
        }
    }

    /// Moves a dry layer from one index to another. The layers between move by one. The floor
    /// stays, because heights add up in any order.
    pub fn move_dry_layer(&mut self, from: usize, to: usize) {
        match self {
            Self::Cpu(paint) => paint.move_dry_layer(from, to),
            Self::Gpu(paint) => paint.move_dry_layer(from, to),
        }
    }
}
