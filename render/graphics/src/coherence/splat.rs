//! Noise as a sum of round features that face the screen.
//!
//! On the processor and on a device alike, every pixel gathers from the features
//! near its square of 8 x 8, in one order: the sums do not depend on threads. A
//! feature adds to what lies on its own surface only. What is hidden so never
//! shows through, and where it comes into sight its features are there already.

use pulp::Simd;
use rayon::prelude::*;

use crate::field::Field;
use crate::gpu::{DeviceError, GROUP, Kernel, Storage, groups, layout};
use crate::image::Backend;
use crate::image::OnCpu;
use crate::image::{OnGpu, Plane};

/// A feature in the picture.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Splat {
    /// To the right from the left edge, in pixels.
    pub x: f32,
    /// Downwards from the upper edge, in pixels.
    pub y: f32,
    /// 1 / radius, in pixels; nothing is added beyond the radius.
    pub narrowness: f32,
    /// What its middle adds.
    pub amplitude: f32,
    /// Of its middle, 0 (near) to 1 (far).
    pub depth: f32,
    /// By how much depth grows on its surface, per pixel to the right.
    pub slope_x: f32,
    /// The same downwards.
    pub slope_y: f32,
    /// 1 / depth by which what still counts as its surface may be off the plane
    /// that it lies on; at twice as much nothing does.
    pub tightness: f32,
}

/// Draws features.
pub trait Splatting: Backend {
    /// 0.5 and all that features add, each `6 t^5 - 15 t^4 + 10 t^3` of its
    /// amplitude, t = 1 - distance / radius; cut off at 0 and 1. 0.5 where nothing
    /// is seen, which `depth` (0 near to 1, nothing) tells.
    ///
    /// # Errors
    /// [`DeviceError`] if the device has no room or is lost; never on the processor.
    fn splatted(&mut self, depth: &Self::Grey, splats: &[Splat])
    -> Result<Self::Grey, DeviceError>;
}

/// Side of a square of pixels that gathers from one list.
const SIDE: usize = GROUP as usize;

type Square = [[f32; SIDE]; SIDE];

/// For every square of pixels which features reach it, in their order.
struct Lists {
    /// Squares in a row.
    across: usize,
    /// Where the list of each square begins; one more for the end of the last.
    starts: Vec<u32>,
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

impl Splatting for OnCpu {
    fn splatted(
        &mut self,
        depth: &Field<f32>,
        splats: &[Splat],
    ) -> Result<Field<f32>, DeviceError> {
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
                let Some(range) = range_of(&depths) else { continue };
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
        Ok(sums)
    }
}

/// The least and the greatest depth of what is seen; none where nothing is.
fn range_of(depths: &Square) -> Option<[f32; 2]> {
    let seen = depths.iter().flatten().copied().filter(|&depth| depth < 1.0);
    let range = seen.fold([1.0, 0.0], |[low, high]: [f32; 2], at| [low.min(at), high.max(at)]);
    (range[0] < 1.0).then_some(range)
}

struct Gather<'a> {
    list: &'a [u32],
    splats: &'a [Splat],
    /// The middle of the first pixel.
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
            // Most of what is hidden is so for the whole square.
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
struct Gathering {
    width: u32,
    height: u32,
    /// Where in the batch the starts of lists begin, and the lists.
    starts: u32,
    lists: u32,
}

/// The kernel that sums the noise of all features at each pixel.
pub static GATHER_SPLATS: Kernel = Kernel {
    name: "gather_splats",
    source: include_str!("splat.wgsl"),
    parameters: layout!(Gathering { width, height, starts, lists }),
    structs: &[layout!(Splat { x, y, narrowness, amplitude, depth, slope_x, slope_y, tightness })],
    storage: &[Storage::Read, Storage::Read, Storage::Batch, Storage::Write],
};

impl Splatting for OnGpu {
    fn splatted(&mut self, depth: &Plane, splats: &[Splat]) -> Result<Plane, DeviceError> {
        let (width, height) = (depth.width(), depth.height());
        let lists = Lists::new(width, height, splats);
        let sums = self.plane(width, height, size_of::<f32>())?;
        // Room to spare, so that the next picture's features fit the same memory.
        let room = splats.len().max(1).next_power_of_two();
        let there = self.plane(room, 1, size_of::<Splat>())?;
        self.fill(&there, splats)?;
        let starts = self.recording.batch(&lists.starts);
        let lists = self.recording.batch(&lists.splats);
        self.recording.dispatch(
            &GATHER_SPLATS,
            &Gathering { width: width as u32, height: height as u32, starts, lists },
            &[depth.buffer(), there.buffer(), sums.buffer()],
            [groups(width), groups(height), 1],
        );
        Ok(sums)
    }
}
