//! Kernels that change the paint on the device: a sub-step, drying, and tiles saved for undo.
//!
//! A sub-step is four kernels over the contact grown by 2 cells, and one along the hair of the
//! head. You get equal bits from these and from [`crate::motion`].

use graphics::gpu::{Device, DeviceError, Kernel, Layout, Storage, layout};
use graphics::tile::{Rect, TILE};

use super::buffers::PaintBuffers;
use crate::contact::{Contact, ExchangeRates, Touch};
use crate::motion::MotionConstants;

/// Uniforms of the four kernels. Rectangles are x, y, width, height in cells.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct SubStepParams {
    pub(super) motion: MotionConstants,
    pub(super) rates: ExchangeRates,
    /// The contact's rectangle grown by 2 within the canvas.
    pub(super) region: [u32; 4],
    pub(super) contact: [u32; 4],
    pub(super) canvas: [u32; 2],
    /// Index of the contact's first touch in the batch.
    pub(super) first_touch: u32,
    pub(super) brush_cells: u32,
    /// Index of the mask's first word in the buffer of the floor, 0 without a mask. Then the index of
    /// the first block's painted cells there. Then 1 if a cell of the region may have a skin.
    pub(super) mask: [u32; 4],
}

const SUB_STEP_PARAMS: Layout = layout!(SubStepParams {
    motion,
    rates,
    region,
    contact,
    canvas,
    first_touch,
    brush_cells,
    mask
});

const STRUCTS: &[Layout] = &[
    layout!(MotionConstants {
        push_share,
        squeeze_share,
        yield_quanta,
        levelling_share,
        adhesion_quanta,
        everywhere,
        skin_quanta,
        padding
    }),
    layout!(ExchangeRates {
        release,
        film,
        deposit,
        pick_up,
        mixing,
        sink,
        drag,
        bearing,
        shear,
        held,
        carried,
        padding
    }),
    layout!(Touch { height, brush_cell, velocity, weights }),
];

/// Joins the sources that all four kernels share with the sources of one kernel.
macro_rules! sub_step_source {
    ($($part:literal),*) => {
        concat!(
            include_str!("../../amount.wgsl"),
            include_str!("../../layer.wgsl"),
            include_str!("../../contact.wgsl"),
            include_str!("../../motion/constants.wgsl"),
            include_str!("../../motion/press.wgsl"),
            include_str!("../../motion/bed.wgsl"),
            include_str!("passes/sub_step.wgsl"),
            $(include_str!($part)),*
        )
    };
}

/// Computes penetration and volume of every cell and copies the head's cell above it.
pub(super) static BEGIN: Kernel = Kernel {
    name: "begin_cells",
    source: sub_step_source!("passes/begin.wgsl"),
    parameters: SUB_STEP_PARAMS,
    structs: STRUCTS,
    storage: &[
        Storage::Batch,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Write,
        Storage::Write,
    ],
};

/// Computes velocity and mobile share of every cell.
pub(super) static PRESS: Kernel = Kernel {
    name: "press_cells",
    source: sub_step_source!("../../motion/advect.wgsl", "passes/press.wgsl"),
    parameters: SUB_STEP_PARAMS,
    structs: STRUCTS,
    storage: &[Storage::Batch, Storage::Read, Storage::Write],
};

/// Computes the paint of every cell after advection.
pub(super) static ADVECT: Kernel = Kernel {
    name: "advect_cells",
    source: sub_step_source!("../../motion/advect.wgsl", "passes/advect.wgsl"),
    parameters: SUB_STEP_PARAMS,
    structs: STRUCTS,
    storage: &[Storage::Read, Storage::Read, Storage::Read, Storage::Write],
};

/// Transfers paint between canvas and head, and writes the canvas.
pub(super) static TRANSFER: Kernel = Kernel {
    name: "transfer_cells",
    source: sub_step_source!(
        "../../motion/transfer.wgsl",
        "../../motion/skin.wgsl",
        "passes/transfer.wgsl"
    ),
    parameters: SUB_STEP_PARAMS,
    structs: STRUCTS,
    storage: &[
        Storage::Batch,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Write,
        Storage::Write,
        Storage::Write,
        Storage::Write,
    ],
};

/// Uniforms of [`NOTE_BED`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct BedParams {
    /// x, y, width and height in cells of the canvas.
    pub(super) tile: [u32; 4],
    pub(super) canvas: [u32; 2],
    /// Height of a skin that stays, [`MotionConstants::skin_quanta`].
    pub(super) skin_quanta: u32,
    /// Index of the first block's painted cells in the buffer of the floor.
    pub(super) painted: u32,
}

/// Records the surface of the paint in a tile as the bed of a stroke, and settles its skins.
pub(super) static NOTE_BED: Kernel = Kernel {
    name: "note_bed",
    source: concat!(
        include_str!("../../amount.wgsl"),
        include_str!("../../layer.wgsl"),
        include_str!("../../contact.wgsl"),
        include_str!("../../motion/skin.wgsl"),
        include_str!("passes/note_bed.wgsl"),
    ),
    parameters: layout!(BedParams { tile, canvas, skin_quanta, painted }),
    structs: &[],
    storage: &[Storage::Write, Storage::Write, Storage::Write],
};

/// Uniforms of [`WICK`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct WickParams {
    pub(super) size: [u32; 2],
    /// Share of each surplus that moves, in parts of 65536.
    pub(super) wicking: u32,
    pub(super) first_row: u32,
    /// Number of hairs in a group.
    pub(super) hairs: u32,
    /// Number of hairs that the first group lacks.
    pub(super) shift: u32,
    /// Number of flows until all groups have had their turn.
    pub(super) turns: u32,
    /// Number of this flow among the `turns` flows, from 0.
    pub(super) turn: u32,
}

/// Lets paint flow over a head. One invocation computes a group of hairs.
pub(super) static WICK: Kernel = Kernel {
    name: "wick_hairs",
    source: concat!(
        include_str!("../../amount.wgsl"),
        include_str!("../../layer.wgsl"),
        include_str!("../../motion/wick.wgsl"),
        include_str!("passes/wick.wgsl"),
    ),
    parameters: layout!(WickParams { size, wicking, first_row, hairs, shift, turns, turn }),
    structs: &[],
    storage: &[Storage::Write, Storage::Write],
};

/// Panics if a contact names cells of the canvas or of the head that do not exist.
pub(super) fn check_contact(contact: &Contact, bounds: Rect, brush_cells: u32) {
    let Contact { rect, touches, .. } = contact;
    assert_eq!(rect.intersection(bounds), *rect, "a contact must lie within {bounds:?}");
    assert_eq!(touches.len(), rect.width * rect.height, "a contact has a touch per cell");
    let outside =
        touches.iter().find(|touch| touch.brush_cell >= brush_cells && touch.height < i32::MAX);
    assert!(outside.is_none(), "a touch must lie within the head's {brush_cells}: {outside:?}");
}

/// Uniforms of [`DRY`] and [`MOVE_FLOOR`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct DryParams {
    pub(super) canvas: [u32; 2],
    /// Share of the wet paint that dries, in parts of 65536.
    pub(super) share: u32,
    /// 1 when a dry layer is added, -1 when it is removed.
    pub(super) rise: i32,
    /// 2 if the dry layer has a skin, else 1.
    pub(super) films: u32,
    pub(super) padding: [u32; 3],
}

const DRY_PARAMS: Layout = layout!(DryParams { canvas, share, rise, films, padding });

const SOURCE: &str = concat!(
    include_str!("../../amount.wgsl"),
    include_str!("../../layer.wgsl"),
    include_str!("../../contact.wgsl"),
    include_str!("../../motion/skin.wgsl"),
    include_str!("passes/dry.wgsl"),
);

const STORAGE: &[Storage] = &[Storage::Write; 5];

/// Moves a share of the wet paint to a new dry layer and raises the floor.
pub(super) static DRY: Kernel = Kernel {
    name: "dry_cells",
    source: SOURCE,
    parameters: DRY_PARAMS,
    structs: &[],
    storage: STORAGE,
};

/// Raises or lowers the floor by the height of a dry layer.
pub(super) static MOVE_FLOOR: Kernel = Kernel {
    name: "move_floor",
    source: SOURCE,
    parameters: DRY_PARAMS,
    structs: &[],
    storage: STORAGE,
};

const TILE_CELLS: usize = TILE * TILE;

/// Number of tiles in one block of memory.
const TILES_PER_BLOCK: usize = 64;

/// Uniforms of [`UNDO_TILE`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct UndoTileParams {
    /// x, y, width and height in cells of the canvas.
    pub(super) tile: [u32; 4],
    pub(super) canvas: [u32; 2],
    /// Index of the slot's first cell in its block.
    pub(super) first_cell: u32,
    /// 0 to save the tile, 1 to swap it with the saved one.
    pub(super) swap: u32,
    /// Number of cells from a saved body to its skin.
    pub(super) saved_skin: u32,
    pub(super) padding: [u32; 3],
}

/// Saves a tile to its slot, or swaps the two.
pub(super) static UNDO_TILE: Kernel = Kernel {
    name: "undo_tile",
    source: concat!(
        include_str!("../../amount.wgsl"),
        include_str!("../../layer.wgsl"),
        include_str!("passes/undo_tile.wgsl"),
    ),
    parameters: layout!(UndoTileParams { tile, canvas, first_cell, swap, saved_skin, padding }),
    structs: &[],
    storage: &[Storage::Write; 4],
};

/// Memory for saved tiles. We allocate it in blocks when you first use a slot.
#[derive(Debug, Default)]
pub(super) struct UndoTiles {
    blocks: Vec<PaintBuffers>,
}

impl UndoTiles {
    /// The block that holds slot number `slot`, and the index of the slot's first cell in it. This
    /// allocates the block if needed.
    pub(super) fn place(
        &mut self,
        device: &Device,
        slot: usize,
    ) -> Result<(PaintBuffers, u32), DeviceError> {
        while self.blocks.len() <= slot / TILES_PER_BLOCK {
            let cells = TILES_PER_BLOCK * TILE_CELLS;
            self.blocks.push(PaintBuffers::empty(device, "the undo history", cells, true)?);
        }
        let first_cell = slot % TILES_PER_BLOCK * TILE_CELLS;
        Ok((self.blocks[slot / TILES_PER_BLOCK].clone(), first_cell as u32))
    }
}
