//! The dry layers of an engine: drying, reading, and changes of their stack.

use super::paint_engine::PaintEngine;
use crate::layer::Layer;
use graphics::gpu::DeviceError;
use graphics::tile::Rect;

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

    /// Adds a dry layer on top; the floor rises by its height.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn push_dry_layer(&mut self, layer: &Layer) -> Result<(), DeviceError> {
        self.insert_dry_layer(self.dry_layer_count(), layer)
    }

    /// Removes the topmost dry layer and returns it; the floor falls by its height.
    ///
    /// # Errors
    /// [`DeviceError`] of the device.
    pub fn pop_dry_layer(&mut self) -> Result<Layer, DeviceError> {
        let top = self.dry_layer_count().checked_sub(1);
        self.remove_dry_layer(top.expect("the caller checks that there is a dry layer"))
    }

    /// Adds a dry layer at `index`; those from there on move up by one. The floor rises by its
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

    /// Removes a dry layer and returns it; those above it move down by one. The floor falls by
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

    /// Moves a dry layer from one index to another; the layers between move by one. The floor
    /// stays, as heights add up in any order.
    pub fn move_dry_layer(&mut self, from: usize, to: usize) {
        match self {
            Self::Cpu(paint) => paint.move_dry_layer(from, to),
            Self::Gpu(paint) => paint.move_dry_layer(from, to),
        }
    }
}
