//! Noise as a sum of round features (splats) that face the viewer.
//!
//! On the processor and on a graphics device alike, each pixel gathers from the features
//! near its square of 8 x 8 pixels in one fixed order, so that sums do not depend on
//! threads. A feature adds only to pixels at the depth of its own surface: hidden surfaces
//! never show through, and a surface that comes into sight has its features already.

use pulp::Simd;
use rayon::prelude::*;

use crate::compute::{Compute, GpuCompute, GreyImage, Image, Plane};
use crate::field::Field;
use crate::gpu::{DeviceError, GROUP, Kernel, Storage, layout};

/// A feature of noise, projected to the picture.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Splat {
    /// Distance of its centre from the left edge, in pixels.
    pub x: f32,
    /// Distance of its centre from the upper edge, in pixels.
    pub y: f32,
    /// 1 / radius, in 1 / pixels. The feature ends at the radius.
    pub narrowness: f32,
    /// Value added at the centre; negative for a hollow.
    pub amplitude: f32,
    /// Depth of the centre, 0 (near plane) to 1 (far plane).
    pub depth: f32,
    /// Change of depth on its surface per pixel to the right.
    pub slope_x: f32,
    /// Change of depth on its surface per pixel downwards.
    pub slope_y: f32,
    /// 1 / tolerance in depth. Pixels within the tolerance of the feature's plane get its
    /// full value; the value falls to 0 at twice the tolerance.
    pub tightness: f32,
}

/// Draws features: 0.5 plus the sum of all features at each pixel, clamped to 0..1. At a
/// distance d from its centre a feature adds its amplitude times
/// `6 t^5 - 15 t^4 + 10 t^3` with t = 1 - d / radius. Pixels whose `depth` is 1 show no
/// surface and get 0.5.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
///
/// # Panics
/// If another form of [`Compute`] made `depth`.
pub fn draw_splats(
    compute: &mut Compute,
    depth: &GreyImage,
    splats: &[Splat],
) -> Result<GreyImage, DeviceError> {
    match compute {
        Compute::Cpu => Ok(draw_splats_on_cpu(depth.host(), splats).into()),
        Compute::Gpu(gpu) => draw_splats_on_gpu(gpu, depth.plane(), splats).map(Image::from),
    }
}

/// Width and height of a square of pixels that gathers from one list.
const SIDE: usize = GROUP as usize;

type Square = [[f32; SIDE]; SIDE];

/// For each square of pixels the features that reach it, in the order of the features.
struct Lists {
    /// Number of squares in a row.
    across: usize,
    /// Index in `splats` at which the list of each square begins, then the end of the last.
    starts: Vec<u32>,
    /// Indices of features, list after list.
    splats: Vec<u32>,
}

impl Lists {
    fn new(width: usize, height: usize, splats: &[Splat]) -> Self {
        let (across, down) = (width.div_ceil(SIDE), height.div_ceil(SIDE));
        let range = |at: f32, radius: f32, count: usize| {
            let square = |at: f32| (at / SIDE as f32).floor() as i64;
            let last = (square(at + radius) + 1).clamp(0, count as i64) as usize;
            (square(at - radius).max(0) as usize).min(last)..last
        };
        let squares = |splat: &Splat| {
            let radius = 1.0 / splat.narrowness;
            let columns = range(splat.x, radius, across);
            let rows = range(splat.y, radius, down);
            rows.flat_map(move |row| columns.clone().map(move |column| row * across + column))
        };
        let mut starts = vec![0u32; across * down + 1];
        for square in splats.iter().flat_map(squares) {
            starts[square + 1] += 1;
        }
        for square in 0..across * down {
            starts[square + 1] += starts[square];
        }
        let mut lists = vec![0; starts[across * down] as usize];
        let mut next = starts.clone();
        for (splat, number) in splats.iter().zip(0..) {
            for square in squares(splat) {
                lists[next[square] as usize] = number;
                next[square] += 1;
            }
        }
        Self { across, starts, splats: lists }
    }

    fn of(&self, square: usize) -> &[u32] {
        &self.splats[self.starts[square] as usize..self.starts[square + 1] as usize]
    }
}

fn draw_splats_on_cpu(depth: &Field<f32>, splats: &[Splat]) -> Field<f32> {
    let (width, height) = (depth.width(), depth.height());
    let mut sums = Field::filled(width, height, 0.5);
    let lists = Lists::new(width, height, splats);
    let bands = sums.values_mut().par_chunks_mut((SIDE * width).max(1)).enumerate();
    bands.for_each(|(band, rows)| {
        for square in 0..lists.across {
            let (x, y) = (square * SIDE, band * SIDE);
            let columns = SIDE.min(width - x);
            let mut depths = [[1.0; SIDE]; SIDE];
            for (row, depths) in depths.iter_mut().enumerate().take(height - y) {
                depths[..columns].copy_from_slice(depth.row(y + row, x, columns));
            }
            let Some(range) = depth_range(&depths) else { continue };
            let list = lists.of(band * lists.across + square);
            let first = [x as f32 + 0.5, y as f32 + 0.5];
            let mut sum = [[0.0; SIDE]; SIDE];
            let gather = Gather { list, splats, first, depths: &depths, range, sum: &mut sum };
            pulp::Arch::new().dispatch(gather);
            for ((row, sum), depths) in rows.chunks_mut(width).zip(&sum).zip(&depths) {
                let row = row[x..x + columns].iter_mut().zip(sum).zip(depths);
                for ((value, sum), _) in row.filter(|(_, depth)| **depth < 1.0) {
                    *value = (0.5 + sum).clamp(0.0, 1.0);
                }
            }
        }
    });
    sums
}

/// Least and greatest depth of the pixels that show something. `None` if none does.
fn depth_range(depths: &Square) -> Option<[f32; 2]> {
    let seen = depths.iter().flatten().copied().filter(|&depth| depth < 1.0);
    let range = seen.fold([1.0, 0.0], |[low, high]: [f32; 2], at| [low.min(at), high.max(at)]);
    (range[0] < 1.0).then_some(range)
}

struct Gather<'a> {
    list: &'a [u32],
    splats: &'a [Splat],
    /// Centre of the first pixel.
    first: [f32; 2],
    depths: &'a Square,
    range: [f32; 2],
    sum: &'a mut Square,
}

impl pulp::WithSimd for Gather<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { list, splats, first, depths, range, sum } = self;
        const HALF: f32 = (SIDE - 1) as f32 / 2.0;
        for &index in list {
            let splat = splats[index as usize];
            let (left, above) = (first[0] - splat.x, first[1] - splat.y);
            // Most hidden features are hidden for the whole square.
            let middle =
                splat.depth + splat.slope_x * (left + HALF) + splat.slope_y * (above + HALF);
            let off = (middle - range[1]).max(range[0] - middle)
                - HALF * (splat.slope_x.abs() + splat.slope_y.abs());
            if off * splat.tightness >= 2.0 {
                continue;
            }
            for (row, (sums, depths)) in sum.iter_mut().zip(depths).enumerate() {
                let down = above + row as f32;
                let squared = down * down * splat.narrowness * splat.narrowness;
                if squared >= 1.0 {
                    continue;
                }
                let own = splat.depth + splat.slope_y * down;
                for (column, (sum, depth)) in sums.iter_mut().zip(depths).enumerate() {
                    let right = left + column as f32;
                    let away = right * splat.narrowness;
                    let away = (away * away + squared).sqrt();
                    let t = if away < 1.0 { 1.0 - away } else { 0.0 };
                    let off = (own + splat.slope_x * right - depth).abs();
                    let share = 2.0 - off * splat.tightness;
                    let share = if share < 1.0 { share } else { 1.0 };
                    let share = if share > 0.0 { share } else { 0.0 };
                    let bump = t * t * t * (t * (6.0 * t - 15.0) + 10.0);
                    *sum += splat.amplitude * share * bump;
                }
            }
        }
    }
}

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct SplatParams {
    width: u32,
    height: u32,
    /// Index in the batch at which [`Lists::starts`] begins.
    starts: u32,
    /// Index in the batch at which [`Lists::splats`] begins.
    lists: u32,
}

/// The kernel that sums all features at each pixel.
pub static GATHER_SPLATS: Kernel = Kernel {
    name: "gather_splats",
    source: include_str!("splat.wgsl"),
    parameters: layout!(SplatParams { width, height, starts, lists }),
    structs: &[layout!(Splat { x, y, narrowness, amplitude, depth, slope_x, slope_y, tightness })],
    storage: &[Storage::Read, Storage::Read, Storage::Batch, Storage::Write],
};

fn draw_splats_on_gpu(
    gpu: &mut GpuCompute,
    depth: &Plane<f32>,
    splats: &[Splat],
) -> Result<Plane<f32>, DeviceError> {
    let (width, height) = depth.size();
    let lists = Lists::new(width, height, splats);
    let sums = gpu.plane(width, height)?;
    // Rounded up, so that the features of the next frame fit the same memory.
    let capacity = splats.len().max(1).next_power_of_two();
    let features = gpu.plane(capacity, 1)?;
    gpu.write(&features, splats)?;
    let starts = gpu.batch(&lists.starts);
    let lists = gpu.batch(&lists.splats);
    let params = SplatParams { width: width as u32, height: height as u32, starts, lists };
    let buffers = [depth.buffer(), features.buffer(), sums.buffer()];
    gpu.dispatch(&GATHER_SPLATS, &params, &buffers, (width, height));
    Ok(sums)
}
