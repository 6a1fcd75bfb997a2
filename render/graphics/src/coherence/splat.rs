//! Noise as a sum of round features (splats) that face the viewer.
//!
//! Each pixel gathers from the features near its square of 8 x 8 pixels in one fixed order, on the
//! processor and on a graphics device alike. So sums do not depend on threads. A feature adds only
//! to pixels at the depth of its own surface. This keeps hidden surfaces from showing through, and
//! a surface that comes into sight has its features already.

use std::ops::Range;

use pulp::Simd;
use rayon::prelude::*;

use super::depths::{DepthTiles, SIDE};
use crate::compute::{Compute, GpuCompute, GreyImage, Image, Plane};
use crate::field::Field;
use crate::gpu::{DeviceError, Kernel, Storage, layout};
use crate::lanes::{greater, lesser};

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
    /// Value added at the centre, negative for a hollow.
    pub amplitude: f32,
    /// Depth of the centre, 0 (near plane) to 1 (far plane).
    pub depth: f32,
    /// Change of depth on its surface per pixel to the right.
    pub slope_x: f32,
    /// Change of depth on its surface per pixel downwards.
    pub slope_y: f32,
    /// 1 / tolerance in depth. Pixels within the tolerance of the feature's plane get its full
    /// value. The value falls to 0 at twice the tolerance.
    pub tightness: f32,
}

/// Draws features. The result at each pixel is 0.5 plus the sum of all features there, clamped to
/// 0..1. At a distance d from its centre a feature adds its amplitude times `6 t^5 - 15 t^4 + 10
/// t^3` with t = 1 - d / radius. Pixels of `depth` 1 show no surface and get 0.5.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost, never on the processor.
///
/// # Panics
/// If another form of [`Compute`] made `depth`.
pub fn draw_splats(
    compute: &mut Compute,
    depth: &GreyImage,
    splats: &[Splat],
) -> Result<GreyImage, DeviceError> {
    match compute {
        Compute::Cpu => {
            let depth = depth.host();
            Ok(draw_splats_on_tiles(depth, &DepthTiles::new(depth), splats).into())
        }
        Compute::Gpu(gpu) => draw_splats_on_gpu(gpu, depth.plane(), splats).map(Image::from),
    }
}

type Square = [[f32; SIDE]; SIDE];

const PLACES: [f32; SIDE] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// Beyond this many tolerances a feature adds nothing. It includes a margin for rounding.
const REACH: f32 = 2.001;

impl Splat {
    /// Whether `surfaces` hide it from every pixel.
    pub(super) fn is_behind(&self, surfaces: &DepthTiles) -> bool {
        let radius = 1.0 / self.narrowness;
        let leaning = radius * self.slope_x.hypot(self.slope_y);
        let nearest = self.depth - leaning - REACH / self.tightness;
        fn limits(at: f32, radius: f32) -> [f32; 2] {
            [at - radius, at + radius]
        }
        nearest > surfaces.farthest(limits(self.x, radius), limits(self.y, radius))
    }

    /// Whether it may add to a pixel of the square that starts at this pixel and shows depths in
    /// this range.
    #[inline]
    fn reaches(&self, [column, row]: [usize; 2], [low, high]: [f32; 2]) -> bool {
        let radius = 1.0 / self.narrowness;
        fn overlap(first: usize, at: f32, radius: f32) -> [f32; 2] {
            let low = first as f32 + 0.5 - at;
            let high = (first + SIDE) as f32 - 0.5 - at;
            [low.max(-radius), high.min(radius)]
        }
        let [left, right] = overlap(column, self.x, radius);
        let [above, below] = overlap(row, self.y, radius);
        if left > right || above > below {
            return false;
        }
        let middle =
            self.depth + 0.5 * (self.slope_x * (left + right) + self.slope_y * (above + below));
        let around =
            0.5 * (self.slope_x.abs() * (right - left) + self.slope_y.abs() * (below - above));
        let off = (middle - high).max(low - middle) - around;
        let is_far = off * self.tightness >= REACH;
        // Near also for a depth that is not a number, which a pixel ignores.
        !is_far
    }

    /// The squares that it may touch in a row or column of `count` squares.
    fn squares(&self, at: f32, count: usize) -> Range<usize> {
        let radius = 1.0 / self.narrowness;
        let [from, to] = [at - radius, at + radius].map(|at| at / SIDE as f32);
        let last = if to >= 0.0 { (to as usize).saturating_add(1).min(count) } else { 0 };
        (from as usize).min(last)..last
    }
}

/// The features that touch each of several places, which are bands or squares. Features keep their
/// order.
#[derive(Debug, Clone, PartialEq, Default)]
struct Lists {
    /// Index in `splats` at which the list of each place begins, then the end of the last.
    starts: Vec<u32>,
    splats: Vec<u32>,
}

impl Lists {
    /// Builds the lists from `pairs` of a place (below `places`) and a feature.
    fn new(places: usize, pairs: &[[u32; 2]]) -> Self {
        let mut starts = vec![0u32; places + 1];
        for [place, _] in pairs {
            starts[*place as usize + 1] += 1;
        }
        for place in 0..places {
            starts[place + 1] += starts[place];
        }
        let mut next = starts.clone();
        let mut splats = vec![0; pairs.len()];
        for [place, splat] in pairs {
            let next = &mut next[*place as usize];
            splats[*next as usize] = *splat;
            *next += 1;
        }
        Self { starts, splats }
    }

    fn of(&self, place: usize) -> &[u32] {
        &self.splats[self.starts[place] as usize..self.starts[place + 1] as usize]
    }
}

/// Features by bands, which are rows of squares.
struct Bands<'a> {
    splats: &'a [Splat],
    across: usize,
    lists: Lists,
}

impl<'a> Bands<'a> {
    fn new(width: usize, height: usize, splats: &'a [Splat]) -> Self {
        let down = height.div_ceil(SIDE);
        let bands = splats.par_iter().zip(0u32..splats.len() as u32).flat_map_iter(|(splat, i)| {
            splat.squares(splat.y, down).map(move |band| [band as u32, i])
        });
        let pairs: Vec<_> = bands.collect();
        Self { splats, across: width.div_ceil(SIDE), lists: Lists::new(down, &pairs) }
    }

    /// For each square of a band the features that touch it. If you give `surfaces`, this leaves
    /// out features that are hidden there.
    fn squares(&self, band: usize, surfaces: Option<&DepthTiles>) -> Lists {
        let ranges: Option<Vec<_>> = surfaces
            .map(|surfaces| (0..self.across).map(|column| surfaces.range(column, band)).collect());
        let mut pairs = Vec::new();
        for &index in self.lists.of(band) {
            let splat = &self.splats[index as usize];
            let mut squares = splat.squares(splat.x, self.across);
            match &ranges {
                None => pairs.extend(squares.map(|square| [square as u32, index])),
                Some(ranges) => pairs.extend(
                    squares
                        .by_ref()
                        .filter(|&square| {
                            let at = [square * SIDE, band * SIDE];
                            ranges[square].is_some_and(|range| splat.reaches(at, range))
                        })
                        .map(|square| [square as u32, index]),
                ),
            }
        }
        Lists::new(self.across, &pairs)
    }

    fn all(&self) -> Lists {
        let down = self.lists.starts.len() - 1;
        let bands: Vec<_> =
            (0..down).into_par_iter().map(|band| self.squares(band, None)).collect();
        let mut all = Lists { starts: vec![0], splats: Vec::new() };
        for band in &bands {
            let before = all.splats.len() as u32;
            all.starts.extend(band.starts[1..].iter().map(|start| before + start));
            all.splats.extend_from_slice(&band.splats);
        }
        all
    }
}

/// [`draw_splats`] on the processor. `surfaces` are made from `depth`.
pub(super) fn draw_splats_on_tiles(
    depth: &Field<f32>,
    surfaces: &DepthTiles,
    splats: &[Splat],
) -> Field<f32> {
    let width = depth.width();
    let height = depth.height();
    let mut sums = Field::filled(width, height, 0.5);
    let bands = Bands::new(width, height, splats);
    let rows = sums.values_mut().par_chunks_mut((SIDE * width).max(1)).enumerate();
    rows.for_each(|(band, rows)| {
        let lists = bands.squares(band, Some(surfaces));
        for square in 0..bands.across {
            let list = lists.of(square);
            if list.is_empty() {
                continue;
            }
            let x = square * SIDE;
            let y = band * SIDE;
            let columns = SIDE.min(width - x);
            let mut depths = [[1.0; SIDE]; SIDE];
            for (row, depths) in depths.iter_mut().enumerate().take(height - y) {
                depths[..columns].copy_from_slice(depth.row(y + row, x, columns));
            }
            let first = [x as f32 + 0.5, y as f32 + 0.5];
            let mut sum = [[0.0; SIDE]; SIDE];
            let gather = Gather { list, splats, first, depths: &depths, sum: &mut sum };
            crate::lanes::vectorized(gather);
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

struct Gather<'a> {
    list: &'a [u32],
    splats: &'a [Splat],
    first: [f32; 2],
    depths: &'a Square,
    sum: &'a mut Square,
}

impl pulp::WithSimd for Gather<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { list, splats, first, depths, sum } = self;
        for &index in list {
            let splat = splats[index as usize];
            let left = first[0] - splat.x;
            let above = first[1] - splat.y;
            for ((down, sums), depths) in PLACES.iter().zip(sum.iter_mut()).zip(depths) {
                let down = above + down;
                let squared = down * down * splat.narrowness * splat.narrowness;
                if squared >= 1.0 {
                    continue;
                }
                let own = splat.depth + splat.slope_y * down;
                // We copy the row and loop over numbers, which compilers vectorise.
                let mut row = *sums;
                for column in 0..SIDE {
                    let right = left + PLACES[column];
                    let away = right * splat.narrowness;
                    let away = (away * away + squared).sqrt();
                    let t = if away < 1.0 { 1.0 - away } else { 0.0 };
                    let off = (own + splat.slope_x * right - depths[column]).abs();
                    let share = lesser(2.0 - off * splat.tightness, 1.0);
                    let bump = t * t * t * (t * (6.0 * t - 15.0) + 10.0);
                    row[column] += splat.amplitude * greater(share, 0.0) * bump;
                }
                *sums = row;
            }
        }
    }
}

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct SplatParams {
    width: u32,
    height: u32,
    starts: u32,
    lists: u32,
}

/// This kernel sums all features at each pixel.
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
    let lists = Bands::new(width, height, splats).all();
    let sums = gpu.plane(width, height)?;
    // We round up, so that the features of the next frame fit the same memory.
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
