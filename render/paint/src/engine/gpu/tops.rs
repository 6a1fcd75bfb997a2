//! Heights of the surface of the paint, which shading reads around every cell. They belong to the
//! paint, so they are computed again only where it changed and serve all views.

use super::buffers::PaintBuffers;
use super::render::{MAX_TILES, columns_and_rows, workgroups};
use graphics::gpu::{Buffer, Device, DeviceError, Kernel, Layout, Recording, Storage, layout};
use graphics::tile::{Rect, TileSet};

/// Uniforms of [`RAISE`].
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct RaiseParams {
    /// Width and height of the canvas in cells.
    canvas: [u32; 2],
    /// Index of the first tile in the batch.
    first_tile: u32,
    padding: u32,
}

/// Adds up the heights of floor and wet paint.
pub(super) static RAISE: Kernel = Kernel {
    name: "raise_tiles",
    source: concat!(
        include_str!("../../amount.wgsl"),
        include_str!("../../layer.wgsl"),
        include_str!("passes/raise_tiles.wgsl"),
    ),
    parameters: PARAMS,
    structs: &[],
    storage: &[Storage::Batch, Storage::Read, Storage::Read, Storage::Read, Storage::Write],
};

const PARAMS: Layout = layout!(RaiseParams { canvas, first_tile, padding });

/// Height of the surface of each cell in quanta.
#[derive(Debug)]
pub(super) struct Tops {
    bounds: Rect,
    /// Allocated when first rendered.
    heights: Option<Buffer>,
    /// Tiles whose paint changed since their heights were computed.
    stale: TileSet,
}

impl Tops {
    /// Heights of a canvas of `bounds`, none of which is computed yet.
    pub(super) fn new(bounds: Rect) -> Self {
        Self { bounds, heights: None, stale: TileSet::all(bounds) }
    }

    /// Notes that the paint in `rect` changes.
    pub(super) fn change(&mut self, rect: Rect) {
        self.stale.insert(rect);
    }

    /// Notes that the paint may change everywhere.
    pub(super) fn change_all(&mut self) {
        self.stale = TileSet::all(self.bounds);
    }

    /// Records the computation of changed heights from wet paint and floor, and returns all
    /// heights. The handle is cheap to clone.
    pub(super) fn record(
        &mut self,
        device: &Device,
        recording: &mut Recording,
        wet: &PaintBuffers,
        floor: &Buffer,
    ) -> Result<Buffer, DeviceError> {
        let cells = self.bounds.width * self.bounds.height;
        let heights = match self.heights.take() {
            Some(heights) => heights,
            None => device.buffer("the surface of the paint", 4 * cells as u64)?,
        };
        self.heights = Some(heights.clone());
        let canvas = [self.bounds.width as u32, self.bounds.height as u32];
        for tiles in columns_and_rows(&self.stale.take()).chunks(MAX_TILES) {
            let params = RaiseParams { canvas, first_tile: recording.batch(tiles), padding: 0 };
            let buffers = [&wet.pigments, &wet.vehicle, floor, &heights];
            recording.dispatch(&RAISE, &params, &buffers, workgroups(tiles, 1));
        }
        Ok(heights)
    }
}
