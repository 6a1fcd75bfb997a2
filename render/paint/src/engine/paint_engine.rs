//! The paint engine: one set of operations over both backends, for brushes, masks, tiles saved for
//! undo, dry layers and pictures.

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

/// The paint of one painting: the wet layer, dry layers, the paint on each brush, and
/// pictures of the canvas.
///
/// Every change is exact integer arithmetic, so both backends hold the same bits after
/// the same calls. On the processor no operation fails. On a graphics device each
/// returns [`DeviceError`] if the device is lost, and those that allocate also if it has
/// no memory left.
///
/// Rectangles, tiles, brushes and layers must exist on this canvas: a caller that names
/// others has a bug, and the call panics.
#[derive(Debug)]
pub enum PaintEngine {
    /// In the machine's memory.
    Cpu(Box<CpuPaint>),
    /// On a graphics device.
    Gpu(Box<GpuPaint>),
}

/// An engine opened by [`PaintEngine::open`].
#[derive(Debug)]
pub struct OpenedEngine {
    /// The engine, without paint.
    pub engine: PaintEngine,
    /// Why the processor is used although a device was found. `None` if the device is
    /// used or there was none.
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

    /// A canvas without paint on the backend that `choice` selects, over a ground of
    /// height `floor` in quanta. With [`BackendChoice::Auto`], a device that cannot hold
    /// the canvas gives way to the processor.
    ///
    /// # Errors
    /// With [`BackendChoice::Gpu`], [`DeviceError`] if there is no device or it cannot
    /// hold the canvas.
    pub fn open(choice: BackendChoice, floor: &Field<i32>) -> Result<OpenedEngine, DeviceError> {
        let Some(device) = choose(choice)? else {
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

    /// The graphics device that computes. `None` on the processor.
    #[must_use]
    pub fn device(&self) -> Option<&Device> {
        match self {
            Self::Cpu(_) => None,
            Self::Gpu(paint) => Some(paint.device()),
        }
    }

    /// Waits until the device has done everything asked of it so far. Only needed for
    /// timing: reads always return the current state.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
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
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
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
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn add_brush(&mut self, width: usize, height: usize) -> Result<BrushId, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.add_brush(width, height)),
            Self::Gpu(paint) => paint.add_brush(width, height),
        }
    }

    /// Downloads the paint on a brush, over the cells of its head.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn brush_paint(&mut self, brush: BrushId) -> Result<Layer, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.brush_paint(brush)),
            Self::Gpu(paint) => paint.brush_paint(brush),
        }
    }

    /// Replaces the paint on a brush.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
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
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn wet(&mut self) -> Result<Layer, DeviceError> {
        self.wet_in(self.bounds())
    }

    /// Downloads the wet paint in `rect`. Time is proportional to the area of `rect`.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn wet_in(&mut self, rect: Rect) -> Result<Layer, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.wet_in(rect)),
            Self::Gpu(paint) => paint.wet_in(rect),
        }
    }

    /// Replaces the wet layer.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn set_wet(&mut self, layer: &Layer) -> Result<(), DeviceError> {
        self.set_wet_in(self.bounds(), layer)
    }

    /// Replaces the wet paint in `rect`. Time is proportional to the area of `rect`.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
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
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn wet_tiles(&mut self) -> Result<TileSet, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.wet_tiles()),
            Self::Gpu(paint) => paint.wet_tiles(),
        }
    }

    /// Downloads the floor: the height of ground plus dry paint, in quanta over the
    /// plane of the canvas.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn floor(&mut self) -> Result<Field<i32>, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.floor()),
            Self::Gpu(paint) => paint.floor(),
        }
    }

    /// Renders tiles of a view: `shown` tiles by compositing the wet layer over the
    /// baked reflectance of ground and dry layers, `baked` tiles by baking that first.
    /// Time is proportional to the number of tiles.
    ///
    /// The first call for a view must name all tiles. After a change of `scene` other than of
    /// its lamp all tiles must be baked. After a change of the surface's height all tiles within
    /// [`reach`](crate::shade::reach) of it must be shown.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
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
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn picture(&mut self) -> Result<Field<[f32; 4]>, DeviceError> {
        self.picture_in(View::First, self.bounds())
    }

    /// Downloads a view in `rect` as last rendered: linear sRGB with white at 1, and 1 as
    /// the fourth component. Black where nothing was rendered. Where paint changed since, either
    /// the earlier or the present paint is seen. Time is proportional to the
    /// area of `rect`.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn picture_in(&mut self, view: View, rect: Rect) -> Result<Field<[f32; 4]>, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.picture_in(view, rect)),
            Self::Gpu(paint) => paint.picture_in(view, rect),
        }
    }

    /// Frees the memory of a view. All its tiles must be baked before it is shown again.
    pub fn forget_view(&mut self, view: View) {
        match self {
            Self::Cpu(paint) => paint.forget_view(view),
            Self::Gpu(paint) => paint.forget_view(view),
        }
    }
}

impl PaintEngine {
    /// Covers cells of the canvas, or none: the contacts that follow change no paint of covered
    /// cells.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
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

    /// Notes the surface of the paint in a tile as it is now: loaded hair rides on it in the
    /// contacts that follow, until the tile is noted again. See [`bed`](crate::motion::bed). Before
    /// the first time it is unknown and bears nothing.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    ///
    /// # Panics
    /// If the tile lies outside the canvas.
    pub fn note_bed(&mut self, tile: Tile) -> Result<(), DeviceError> {
        let rect = tile.rect(self.bounds());
        match self {
            Self::Cpu(paint) => {
                paint.note_bed(rect);
                Ok(())
            }
            Self::Gpu(paint) => paint.note_bed(rect),
        }
    }

    /// Copies the wet paint of a tile to `slot`, within the engine's memory.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
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
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
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
    /// Dries a share of all wet paint, 0 to 65536 in parts of 65536. It becomes a new dry
    /// layer on top, and the floor rises by its height.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
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
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn dry_layer(&mut self, index: usize) -> Result<Layer, DeviceError> {
        self.dry_layer_in(index, self.bounds())
    }

    /// Downloads the paint of a dry layer in `rect`. Time is proportional to the area of
    /// `rect`.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn dry_layer_in(&mut self, index: usize, rect: Rect) -> Result<Layer, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.dry_layer_in(index, rect)),
            Self::Gpu(paint) => paint.dry_layer_in(index, rect),
        }
    }

    /// Adds a dry layer on top. The floor rises by its height.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn push_dry_layer(&mut self, layer: &Layer) -> Result<(), DeviceError> {
        self.insert_dry_layer(self.dry_layer_count(), layer)
    }

    /// Removes the topmost dry layer and returns it. The floor falls by its height.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn pop_dry_layer(&mut self) -> Result<Layer, DeviceError> {
        let top = self.dry_layer_count().checked_sub(1);
        self.remove_dry_layer(top.expect("the caller checks that there is a dry layer"))
    }

    /// Adds a dry layer at `index`. Those from there on move up by one. The floor rises by its
    /// height.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn insert_dry_layer(&mut self, index: usize, layer: &Layer) -> Result<(), DeviceError> {
        match self {
            Self::Cpu(paint) => {
                paint.insert_dry_layer(index, layer);
                Ok(())
            }
            Self::Gpu(paint) => paint.insert_dry_layer(index, layer),
        }
    }

    /// Removes a dry layer and returns it. Those above it move down by one. The floor falls by
    /// its height.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn remove_dry_layer(&mut self, index: usize) -> Result<Layer, DeviceError> {
        match self {
            Self::Cpu(paint) => Ok(paint.remove_dry_layer(index)),
            Self::Gpu(paint) => paint.remove_dry_layer(index),
        }
    }

    /// Moves a dry layer from one index to another. The layers between move by one. The floor
    /// stays, as heights add up in any order.
    pub fn move_dry_layer(&mut self, from: usize, to: usize) {
        match self {
            Self::Cpu(paint) => paint.move_dry_layer(from, to),
            Self::Gpu(paint) => paint.move_dry_layer(from, to),
        }
    }
}
