//! Drying on the device, and the floor's rise and fall with dry layers.

use graphics::gpu::{Kernel, Layout, Storage, layout};

/// Uniforms of [`DRY`] and [`MOVE_FLOOR`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct DryParams {
    /// Width and height of the canvas in cells.
    pub(super) canvas: [u32; 2],
    /// Share of the wet paint that dries, in parts of 65536.
    pub(super) share: u32,
    /// 1 when a dry layer is added, -1 when it is removed.
    pub(super) rise: i32,
}

const DRY_PARAMS: Layout = layout!(DryParams { canvas, share, rise });

const SOURCE: &str = concat!(
    include_str!("../../amount.wgsl"),
    include_str!("../../layer.wgsl"),
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
