//! The minimum or maximum of the pixels under a structuring element, and the openings and closings
//! made of them. The processor works tile by tile. A device runs a kernel.

use pulp::Simd;
use rayon::prelude::*;

use super::{Extremum, StructuringElement};
use crate::compute::{ColorImage, Compute, GpuCompute, Image, Plane, assert_size};
use crate::field::Field;
use crate::gpu::{DeviceError, Kernel, Storage, layout};

/// The extremum of each channel under `element`, which is centred on each pixel in turn. This
/// ignores pixels outside the picture. If you no longer need an image of the same size, pass it as
/// `spare`, so that its memory can hold the result.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost, never on the processor.
///
/// # Panics
/// If `spare` has another size, or another form of [`Compute`] made an image.
pub fn extremum(
    compute: &mut Compute,
    color: &ColorImage,
    element: StructuringElement,
    which: Extremum,
    spare: Option<ColorImage>,
) -> Result<ColorImage, DeviceError> {
    if let Some(spare) = &spare {
        assert_size("spare memory", spare.size(), color.size());
    }
    match compute {
        Compute::Cpu => {
            let (width, height) = color.size();
            let mut result =
                spare.map_or_else(|| Field::filled(width, height, [0.0; 4]), Image::into_host);
            extremum_into(color.host(), element, which, &mut result);
            Ok(result.into())
        }
        Compute::Gpu(gpu) => extremum_on_gpu(gpu, color.plane(), element, which).map(Image::from),
    }
}

#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct ExtremumParams {
    size: [i32; 2],
    margin_in: i32,
    margin_out: i32,
    along: [i32; 2],
    across: [i32; 2],
    reach_along: i32,
    reach_across: i32,
    maximum: u32,
    spare: u32,
}

/// This kernel takes the minimum or maximum on two segments that cross.
pub static EXTREMUM: Kernel = Kernel {
    name: "extremum",
    source: include_str!("extremum.wgsl"),
    parameters: layout!(ExtremumParams {
        size,
        margin_in,
        margin_out,
        along,
        across,
        reach_along,
        reach_across,
        maximum,
        spare,
    }),
    structs: &[],
    storage: &[Storage::Read, Storage::Write],
};

fn extremum_on_gpu(
    gpu: &mut GpuCompute,
    color: &Plane<[f32; 4]>,
    element: StructuringElement,
    which: Extremum,
) -> Result<Plane<[f32; 4]>, DeviceError> {
    let (width, height) = color.size();
    let crossings = element.crossings();
    // We need intermediate results outside the picture too.
    let margin = element.reach() as usize;
    let mut current = color.clone();
    let mut margin_in = 0;
    for (i, crossing) in crossings.iter().enumerate() {
        let margin_out = if i + 1 == crossings.len() { 0 } else { margin };
        let [out_width, out_height] = [width, height].map(|side| side + 2 * margin_out);
        let out = gpu.plane(out_width, out_height)?;
        let params = ExtremumParams {
            size: [width as i32, height as i32],
            margin_in: margin_in as i32,
            margin_out: margin_out as i32,
            along: crossing.along,
            across: crossing.across,
            reach_along: crossing.reach_along as i32,
            reach_across: crossing.reach_across as i32,
            maximum: u32::from(which == Extremum::Maximum),
            spare: 0,
        };
        let buffers = [current.buffer(), out.buffer()];
        gpu.dispatch(&EXTREMUM, &params, &buffers, (out_width, out_height));
        (current, margin_in) = (out, margin_out);
    }
    Ok(current)
}

/// Removes light details that a round element of `radius_px` does not fit into. If you pass 0,
/// nothing changes. No pixel becomes lighter, and a second opening changes nothing.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost, never on the processor.
///
/// # Panics
/// If another form of [`Compute`] made the image.
pub fn opening(
    compute: &mut Compute,
    color: &ColorImage,
    radius_px: u32,
) -> Result<ColorImage, DeviceError> {
    let element = StructuringElement::round(radius_px);
    let eroded = extremum(compute, color, element, Extremum::Minimum, None)?;
    extremum(compute, &eroded, element, Extremum::Maximum, None)
}

/// Removes dark details that a round element of `radius_px` does not fit into. If you pass 0,
/// nothing changes. No pixel becomes darker, and a second closing changes nothing.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost, never on the processor.
///
/// # Panics
/// If another form of [`Compute`] made the image.
pub fn closing(
    compute: &mut Compute,
    color: &ColorImage,
    radius_px: u32,
) -> Result<ColorImage, DeviceError> {
    let element = StructuringElement::round(radius_px);
    let dilated = extremum(compute, color, element, Extremum::Maximum, None)?;
    extremum(compute, &dilated, element, Extremum::Minimum, None)
}

/// An [`opening`] followed by a [`closing`]. Use this instead of both calls: it takes three passes
/// rather than four.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost, never on the processor.
///
/// # Panics
/// If another form of [`Compute`] made the image.
pub fn opening_then_closing(
    compute: &mut Compute,
    color: &ColorImage,
    radius_px: u32,
) -> Result<ColorImage, DeviceError> {
    let element = StructuringElement::round(radius_px);
    let eroded = extremum(compute, color, element, Extremum::Minimum, None)?;
    // The last pass of the opening and the first of the closing are one dilation.
    let dilated = extremum(compute, &eroded, element.twice(), Extremum::Maximum, None)?;
    extremum(compute, &dilated, element, Extremum::Minimum, Some(eroded))
}

const TILE: (usize, usize) = (192, 96);

const CHANNELS: usize = 4;

/// Computes the extremum under the element for each pixel and channel. Writes it into `result`,
/// which must have the size of `field`. This ignores pixels outside the picture.
///
/// We work tile by tile and in place: each pixel gathers only from pixels after it, which have not
/// been overwritten yet.
pub(super) fn extremum_into(
    field: &Field<[f32; 4]>,
    element: StructuringElement,
    which: Extremum,
    result: &mut Field<[f32; 4]>,
) {
    let width = field.width();
    let height = field.height();
    let found = (result.width(), result.height());
    assert_eq!(found, (width, height), "the result must have the size of the picture");
    if width == 0 {
        return;
    }
    if element.reach() == 0 {
        result.values_mut().copy_from_slice(field.values());
        return;
    }
    let tile = Tile::new(element, width.min(TILE.0), height.min(TILE.1));
    let bands = result.values_mut().par_chunks_mut(width * tile.height).enumerate();
    bands.for_each_init(Vec::new, |cells, (band, rows)| {
        for left in (0..width).step_by(tile.width) {
            tile.load(field, (left, band * tile.height), which, cells);
            match which {
                Extremum::Minimum => run::<false>(&tile, cells),
                Extremum::Maximum => run::<true>(&tile, cells),
            }
            tile.store(cells, left, width, rows);
        }
    });
}

/// A tile of the picture with a margin around it, and the gathers that process it.
struct Tile {
    width: usize,
    height: usize,
    reach: usize,
    stride: usize,
    first: usize,
    gathers: Vec<Gather>,
}

/// Replaces each pixel by the extremum of itself and some pixels after it.
#[derive(Debug, Clone, Copy)]
struct Gather {
    /// Offsets of the gathered pixels, rising from 0.
    offsets: [usize; Self::MAX_COUNT],
    count: usize,
}

impl Gather {
    const MAX_COUNT: usize = 5;

    fn new(offsets: &[usize]) -> Self {
        let mut all = [0; Self::MAX_COUNT];
        all[..offsets.len()].copy_from_slice(offsets);
        Self { offsets: all, count: offsets.len() }
    }

    /// Adds the gathers for a segment of `pixels` pixels, `step` apart. The first gather joins up
    /// to 5 pixels, each further one up to 5 results of the one before.
    fn segment(step: usize, pixels: usize, gathers: &mut Vec<Self>) {
        let mut done = 1;
        while done < pixels {
            let next = (done * Self::MAX_COUNT).min(pixels);
            let count = next.div_ceil(done);
            let offsets: Vec<usize> =
                (0..count).map(|i| step * (i * done).min(next - done)).collect();
            gathers.push(Self::new(&offsets));
            done = next;
        }
    }
}

impl Tile {
    fn new(element: StructuringElement, width: usize, height: usize) -> Self {
        let reach = element.reach() as usize;
        let stride = width + 2 * reach;
        let mut gathers = Vec::new();
        for _ in 0..element.crosses() {
            gathers.push(Gather::new(&[0, stride - 1, stride, stride + 1, 2 * stride]));
        }
        let diagonal = element.diagonal() as usize;
        let square = element.square() as usize;
        Gather::segment(stride + 1, 2 * diagonal + 1, &mut gathers);
        Gather::segment(stride - 1, 2 * diagonal + 1, &mut gathers);
        Gather::segment(1, 2 * square + 1, &mut gathers);
        Gather::segment(stride, 2 * square + 1, &mut gathers);
        Self { width, height, reach, stride, first: reach - square, gathers }
    }

    /// Copies the part of the picture at `(left, top)` with its margin into `cells`. Cells outside
    /// the picture get a value that is never the extremum.
    fn load(
        &self,
        field: &Field<[f32; 4]>,
        (left, top): (usize, usize),
        which: Extremum,
        cells: &mut Vec<f32>,
    ) {
        let nothing = match which {
            Extremum::Minimum => f32::INFINITY,
            Extremum::Maximum => f32::NEG_INFINITY,
        };
        let rows = self.height + 2 * self.reach;
        // SIMD vectors read a little beyond the last row.
        cells.resize((self.stride * rows + Gather::MAX_COUNT) * CHANNELS, nothing);
        let from = left.saturating_sub(self.reach);
        let to = (left + self.width + self.reach).min(field.width());
        let skipped = (from + self.reach - left) * CHANNELS;
        for (row, cells) in cells.chunks_mut(self.stride * CHANNELS).take(rows).enumerate() {
            let inside = (top + row).checked_sub(self.reach).filter(|y| *y < field.height());
            let Some(y) = inside else {
                cells.fill(nothing);
                continue;
            };
            let source: &[f32] = bytemuck::cast_slice(field.row(y, from, to - from));
            cells[..skipped].fill(nothing);
            cells[skipped..][..source.len()].copy_from_slice(source);
            cells[skipped + source.len()..].fill(nothing);
        }
    }

    /// Copies the results into `rows`, from column `left` on. The rows are whole, `width` pixels
    /// each.
    fn store(&self, cells: &[f32], left: usize, width: usize, rows: &mut [[f32; 4]]) {
        let count = self.width.min(width - left);
        for (row, cells) in rows.chunks_mut(width).zip(cells.chunks(self.stride * CHANNELS)) {
            let found = &cells[self.first * CHANNELS..][..count * CHANNELS];
            row[left..left + count].copy_from_slice(bytemuck::cast_slice(found));
        }
    }
}

fn run<const MAXIMUM: bool>(tile: &Tile, cells: &mut [f32]) {
    struct Run<'a, const MAXIMUM: bool>(&'a Tile, &'a mut [f32]);

    impl<const MAXIMUM: bool> pulp::WithSimd for Run<'_, MAXIMUM> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            let Self(tile, cells) = self;
            let mut last = tile.stride * (tile.height + 2 * tile.reach) * CHANNELS;
            for gather in &tile.gathers {
                let offsets = gather.offsets.map(|offset| offset * CHANNELS);
                last -= offsets[gather.count - 1];
                match gather.count {
                    2 => gathered::<S, MAXIMUM, 2>(simd, cells, last, offsets),
                    3 => gathered::<S, MAXIMUM, 3>(simd, cells, last, offsets),
                    4 => gathered::<S, MAXIMUM, 4>(simd, cells, last, offsets),
                    _ => gathered::<S, MAXIMUM, 5>(simd, cells, last, offsets),
                }
            }
        }
    }

    crate::lanes::vectorized(Run::<MAXIMUM>(tile, cells));
}

#[inline(always)]
fn gathered<S: Simd, const MAXIMUM: bool, const COUNT: usize>(
    simd: S,
    cells: &mut [f32],
    last: usize,
    offsets: [usize; Gather::MAX_COUNT],
) {
    for at in (0..last).step_by(S::F32_LANES) {
        let mut found = S::as_simd_f32s(&cells[at..at + S::F32_LANES]).0[0];
        for offset in &offsets[1..COUNT] {
            let other = S::as_simd_f32s(&cells[at + offset..][..S::F32_LANES]).0[0];
            found = match MAXIMUM {
                true => simd.max_f32s(found, other),
                false => simd.min_f32s(found, other),
            };
        }
        S::as_mut_simd_f32s(&mut cells[at..at + S::F32_LANES]).0[0] = found;
    }
}
