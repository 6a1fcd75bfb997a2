//! Paint at rest on the device: drying, and tiles kept for undo.

use graphics::gpu::{Kernel, Layout, Storage, layout};

/// What the kernels of drying are told.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct Drying {
    pub(super) canvas: [u32; 2],
    /// Of 65536 parts.
    pub(super) parts: u32,
    /// 1 for a layer put on, -1 for one taken away.
    pub(super) rise: i32,
}

const DRYING: Layout = layout!(Drying { canvas, parts, rise });

const DRY_SOURCE: &str = concat!(
    include_str!("../amount.wgsl"),
    include_str!("../layer.wgsl"),
    include_str!("passes/dry.wgsl"),
);

const DRY_STORAGE: &[Storage] = &[Storage::Write; 5];

/// A share of the wet paint becomes a layer.
pub(super) static DRY: Kernel = Kernel {
    name: "dry_cells",
    source: DRY_SOURCE,
    parameters: DRYING,
    structs: &[],
    storage: DRY_STORAGE,
};

/// The floor rises or falls by a layer.
pub(super) static RAISE: Kernel = Kernel {
    name: "raise_ground",
    source: DRY_SOURCE,
    parameters: DRYING,
    structs: &[],
    storage: DRY_STORAGE,
};

/// What keeping a tile is told.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct Keeping {
    /// x, y, width, height in cells.
    pub(super) tile: [u32; 4],
    pub(super) canvas: [u32; 2],
    /// Of the slot, in its store.
    pub(super) first_cell: u32,
    /// 0 to keep, 1 to exchange.
    pub(super) exchange: u32,
}

/// A tile into its slot, or the two exchanged.
pub(super) static KEEP: Kernel = Kernel {
    name: "keep_tile",
    source: concat!(
        include_str!("../amount.wgsl"),
        include_str!("../layer.wgsl"),
        include_str!("passes/keep.wgsl"),
    ),
    parameters: layout!(Keeping { tile, canvas, first_cell, exchange }),
    structs: &[],
    storage: &[Storage::Write; 4],
};
