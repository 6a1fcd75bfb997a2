//! The mask of a canvas, and copies of a tile from before its paint changes: of its heights, for
//! the bed of a stroke, and of its paint, for undo.

use super::ids::UndoSlot;
use super::paint_engine::PaintEngine;
use crate::mask::Mask;
use graphics::gpu::DeviceError;
use graphics::tile::Tile;

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
    /// contacts that follow, until the tile is noted again; see [`bed`](crate::motion::bed). Before
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
