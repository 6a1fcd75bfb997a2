//! The three passes on a graphics device: one kernel, a pixel an invocation.
//!
//! Lists of splats are made on the processor, as for its own form, and every pixel sums in their
//! order.

use graphics::compute::{GpuCompute, Plane};
use graphics::gpu::{DeviceError, Kernel, Storage, layout};

use super::device_tones::DeviceTones;
use super::divided::Divide;
use super::lists::Lists;
use super::settings::OverlapSettings;
use super::splat::StrokeSplat;

/// A splat as the kernel reads it.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct PackedStroke {
    at: [f32; 2],
    across: [f32; 2],
    along: [f32; 2],
    slope: [f32; 2],
    /// From the centre of the first texel, in widths of the map.
    offset: [f32; 2],
    extent: [f32; 2],
    depth: f32,
    /// 1 / tolerance.
    tightness: f32,
    weight: f32,
    /// Part in the cover for a weight of 1.
    cover: f32,
    /// Black for splats without colours of their own.
    color: [f32; 4],
    /// First texel of the tone, and width of the tile.
    texels: [u32; 2],
    spare: [u32; 2],
}

impl PackedStroke {
    fn new(splat: &StrokeSplat, tones: &DeviceTones, colored: bool) -> Self {
        let texels = tones.tile(splat.slice as usize, splat.halvings as usize);
        let [red, green, blue] = if colored { splat.color } else { [0.0; 3] };
        Self {
            at: [splat.x, splat.y],
            across: splat.across,
            along: splat.along,
            slope: splat.slope,
            offset: splat.offset.map(|at| at - 0.5 / texels[1] as f32),
            extent: splat.extent,
            depth: splat.depth,
            tightness: 1.0 / splat.tolerance,
            weight: splat.weight,
            cover: splat.cover / splat.weight,
            color: [red, green, blue, 0.0],
            texels,
            spare: [0; 2],
        }
    }
}

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct PassesParams {
    size: [u32; 2],
    /// Index in the batch at which the starts of the lists begin.
    starts: u32,
    /// Index in the batch at which the lists begin.
    lists: u32,
    squarings: u32,
    furrow: f32,
    overhang: f32,
    thin: f32,
    low: [f32; 4],
    step: [f32; 4],
    rgb_from_xyz: [[f32; 4]; 3],
    white: [f32; 3],
    coordinates: u32,
}

/// The kernel that weighs, sums and divides the strokes of each pixel.
pub(super) static PASSES: Kernel = Kernel {
    name: "painterly_passes",
    source: concat!(include_str!("passes.wgsl"), include_str!("divided.wgsl")),
    parameters: layout!(PassesParams {
        size,
        starts,
        lists,
        squarings,
        furrow,
        overhang,
        thin,
        low,
        step,
        rgb_from_xyz,
        white,
        coordinates,
    }),
    structs: &[layout!(PackedStroke {
        at,
        across,
        along,
        slope,
        offset,
        extent,
        depth,
        tightness,
        weight,
        cover,
        color,
        texels,
        spare,
    })],
    storage: &[
        Storage::Read,
        Storage::Read,
        Storage::Batch,
        Storage::Read,
        Storage::Read,
        Storage::Write,
        Storage::Write,
    ],
};

/// Encoded sRGB with cover, and heights in mm, of splats over a mesh of this depth. `tones` are
/// those that `divide` names, on this device.
pub(super) fn painted_on_device(
    gpu: &mut GpuCompute,
    tones: &DeviceTones,
    (depth, splats): (&Plane<f32>, &[StrokeSplat]),
    divide: &Divide<'_>,
    overlap: &OverlapSettings,
) -> Result<(Plane<[f32; 4]>, Plane<f32>), DeviceError> {
    let (width, height) = depth.size();
    let lists = Lists::new(width, height, splats);
    let colored = divide.coloring.of_model();
    let packed: Vec<PackedStroke> =
        splats.iter().map(|splat| PackedStroke::new(splat, tones, colored)).collect();
    // Rounded up, so that the strokes of the next frame fit the same memory.
    let strokes = gpu.plane(packed.len().max(1).next_power_of_two(), 1)?;
    gpu.write(&strokes, &packed)?;
    let colors = gpu.plane(width, height)?;
    let heights = gpu.plane(width, height)?;
    let coloring = divide.coloring;
    let params = PassesParams {
        size: [width as u32, height as u32],
        starts: gpu.batch(lists.starts()),
        lists: gpu.batch(lists.numbers()),
        squarings: overlap.sharpness.max(1).ilog2(),
        furrow: 1.0 - overlap.ridges,
        overhang: divide.overhang,
        thin: divide.thin,
        low: divide.tones.low,
        step: divide.tones.step,
        rgb_from_xyz: coloring.rgb_from_xyz.map(|[x, y, z]: [f32; 3]| [x, y, z, 0.0]),
        white: coloring.white,
        coordinates: coloring.coordinates as u32,
    };
    let buffers = [
        depth.buffer(),
        strokes.buffer(),
        tones.texels(),
        tones.encoded(),
        colors.buffer(),
        heights.buffer(),
    ];
    gpu.dispatch(&PASSES, &params, &buffers, (width, height));
    Ok((colors, heights))
}
