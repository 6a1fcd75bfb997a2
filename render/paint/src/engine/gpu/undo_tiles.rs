//! Tiles of wet paint saved on the device for undo.

use super::buffers::PaintBuffers;
use graphics::gpu::{Device, DeviceError, Kernel, Storage, layout};
use graphics::tile::TILE;

/// Number of cells of a tile.
const TILE_CELLS: usize = TILE * TILE;

/// Number of tiles in one block of memory.
const TILES_PER_BLOCK: usize = 64;

/// Uniforms of [`UNDO_TILE`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct UndoTileParams {
    /// x, y, width and height in cells of the canvas.
    pub(super) tile: [u32; 4],
    /// Width and height of the canvas in cells.
    pub(super) canvas: [u32; 2],
    /// Index of the slot's first cell in its block.
    pub(super) first_cell: u32,
    /// 0 to save the tile, 1 to swap it with the saved one.
    pub(super) swap: u32,
}

/// Saves a tile to its slot, or swaps the two.
pub(super) static UNDO_TILE: Kernel = Kernel {
    name: "undo_tile",
    source: concat!(
        include_str!("../../amount.wgsl"),
        include_str!("../../layer.wgsl"),
        include_str!("passes/undo_tile.wgsl"),
    ),
    parameters: layout!(UndoTileParams { tile, canvas, first_cell, swap }),
    structs: &[],
    storage: &[Storage::Write; 4],
};

/// Memory for saved tiles, allocated in blocks as slots come into use.
#[derive(Debug, Default)]
pub(super) struct UndoTiles {
    blocks: Vec<PaintBuffers>,
}

impl UndoTiles {
    /// The block that holds slot number `slot`, and the index of the slot's first cell
    /// in it. Allocates the block if needed.
    pub(super) fn place(
        &mut self,
        device: &Device,
        slot: usize,
    ) -> Result<(PaintBuffers, u32), DeviceError> {
        while self.blocks.len() <= slot / TILES_PER_BLOCK {
            let cells = TILES_PER_BLOCK * TILE_CELLS;
            self.blocks.push(PaintBuffers::empty(device, "the undo history", cells)?);
        }
        let first_cell = slot % TILES_PER_BLOCK * TILE_CELLS;
        Ok((self.blocks[slot / TILES_PER_BLOCK].clone(), first_cell as u32))
    }
}
