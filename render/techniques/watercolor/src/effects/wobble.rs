//! Edges that follow the grain of the paper: the picture displaced by the paper's slopes.
//!
//! Bousseau et al. 2006, section 3.2: x is displaced by the horizontal gradient of the
//! paper's height and y by the vertical one. Colours are interpolated linearly between
//! pixels, weighted by coverage, so that the colour of bare paper never mixes in.
//!
//! Where the grain is too fine for the pixels of the picture, the paper may have a finer
//! grid: a pixel is then the mean of one displaced sample for each of its cells, so that
//! outlines are those of a larger picture that was reduced.

use pulp::Simd;
use rayon::prelude::*;

use graphics::compute::{ColorImage, Compute, GpuCompute, GreyImage, Image, Plane, assert_size};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use graphics::lanes::{greater, lesser, multiply_add};

/// Displaces `color` by `px_per_slope` times the slope of `heights`: the height to the right
/// minus that to the left, and below minus above. Beyond the borders both images continue
/// with their outermost pixels. A `px_per_slope` of 0 changes nothing. The heights have the
/// size of the picture, or a whole multiple of it.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
///
/// # Panics
/// If sizes differ, or another form of [`Compute`] made an image.
pub fn wobble(
    compute: &mut Compute,
    color: ColorImage,
    heights: &GreyImage,
    px_per_slope: f32,
) -> Result<ColorImage, DeviceError> {
    let factor = cells_per_pixel(heights.size(), color.size());
    let (width, height) = color.size();
    assert_size("the paper", heights.size(), (width * factor, height * factor));
    if px_per_slope == 0.0 {
        return Ok(color);
    }
    match compute {
        Compute::Cpu => Ok(wobble_on_cpu(color.into_host(), heights.host(), px_per_slope).into()),
        Compute::Gpu(gpu) => {
            wobble_on_gpu(gpu, color.plane(), heights.plane(), px_per_slope).map(Image::from)
        }
    }
}

/// Cells of a paper along each side of a pixel, at least 1.
fn cells_per_pixel((cells, _): (usize, usize), (pixels, _): (usize, usize)) -> usize {
    (cells / pixels.max(1)).max(1)
}

/// Rows that are displaced together.
const BAND: usize = 256;

/// [`wobble`] on the processor, in the memory of `color`: only rows that a band reaches are
/// copied.
fn wobble_on_cpu(
    mut color: Field<[f32; 4]>,
    heights: &Field<f32>,
    px_per_slope: f32,
) -> Field<[f32; 4]> {
    let width = color.width();
    let height = color.height();
    if width == 0 || height == 0 {
        return color;
    }
    if heights.width() > width {
        return reduced(&color, heights, px_per_slope);
    }
    let reach = reach(heights, px_per_slope).min(height);
    // Rows as they were, from `first` on.
    let mut before = Vec::new();
    let mut first = 0;
    for top in (0..height).step_by(BAND) {
        let bottom = (top + BAND).min(height);
        let least = top.saturating_sub(reach);
        before.drain(..(least - first) * width);
        first = least;
        let known = first * width + before.len();
        before.extend_from_slice(&color.values()[known..(bottom + reach).min(height) * width]);
        let source = Source { values: &before, first, width, height };
        let rows = color.values_mut()[top * width..bottom * width].par_chunks_mut(width);
        rows.enumerate().for_each_init(
            || vec![0.0; width + 2],
            |here, (row, out)| {
                let y = top + row;
                here[1..=width].copy_from_slice(heights.row(y, 0, width));
                (here[0], here[width + 1]) = (here[1], here[width]);
                graphics::lanes::vectorized(Row { source, heights, here, px_per_slope, y, out });
            },
        );
    }
    color
}

/// The number of rows above and below that a displaced pixel may come from.
fn reach(heights: &Field<f32>, px_per_slope: f32) -> usize {
    let width = heights.width();
    let height = heights.height();
    let steepest = |y: usize| {
        let above = heights.row(y.saturating_sub(1), 0, width);
        let below = heights.row((y + 1).min(height - 1), 0, width);
        above.iter().zip(below).map(|(a, b)| (b - a).abs()).fold(0.0, f32::max)
    };
    let steepest = (0..height).into_par_iter().map(steepest).reduce(|| 0.0, f32::max);
    (steepest * px_per_slope.abs()).ceil() as usize + 1
}

/// Rows of the picture before it was displaced.
#[derive(Clone, Copy)]
struct Source<'a> {
    values: &'a [[f32; 4]],
    /// Index of the first row of `values`.
    first: usize,
    /// Size of the whole picture.
    width: usize,
    height: usize,
}

/// The means of the displaced samples of all cells of a finer paper.
fn reduced(color: &Field<[f32; 4]>, heights: &Field<f32>, px_per_slope: f32) -> Field<[f32; 4]> {
    let width = color.width();
    let height = color.height();
    let cells = heights.width();
    let rows = heights.height();
    let factor = cells / width;
    let end = (width - 1) as f32;
    let bottom = (height - 1) as f32;
    let per_cell = 1.0 / factor as f32;
    let share = 1.0 / (factor * factor) as f32;
    let sample = |column: usize, row: usize| -> [f32; 4] {
        let left = column.saturating_sub(1);
        let right = (column + 1).min(cells - 1);
        let above = row.saturating_sub(1);
        let below = (row + 1).min(rows - 1);
        let across = heights[(right, row)] - heights[(left, row)];
        let down = heights[(column, below)] - heights[(column, above)];
        let x = (column as f32 + 0.5) * per_cell - 0.5 + px_per_slope * across;
        let y = (row as f32 + 0.5) * per_cell - 0.5 + px_per_slope * down;
        let x = x.clamp(0.0, end);
        let y = y.clamp(0.0, bottom);
        let place = [x, y];
        let x = x as usize;
        let y = y as usize;
        let a = place[0] - x as f32;
        let b = place[1] - y as f32;
        let far_x = (x + 1).min(width - 1);
        let far_y = (y + 1).min(height - 1);
        let corners = [(x, y), (far_x, y), (x, far_y), (far_x, far_y)];
        let shares = [(1.0 - a) * (1.0 - b), a * (1.0 - b), (1.0 - a) * b, a * b];
        let mut sum = [0.0; 4];
        for (corner, share) in corners.into_iter().zip(shares) {
            let [r, g, b, covered] = color[corner];
            let weight = share * covered;
            for (sum, value) in sum.iter_mut().zip([r, g, b, 1.0]) {
                *sum += weight * value;
            }
        }
        sum
    };
    let mut means = Field::filled(width, height, [0.0; 4]);
    means.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, out)| {
        for (x, out) in out.iter_mut().enumerate() {
            let mut sum = [0.0; 4];
            for cell in 0..factor * factor {
                let found = sample(x * factor + cell % factor, y * factor + cell / factor);
                sum.iter_mut().zip(found).for_each(|(sum, value)| *sum += value);
            }
            let by = if sum[3] > 0.0 { 1.0 / sum[3] } else { 0.0 };
            let [r, g, b, covered] = sum;
            *out = [r * by, g * by, b * by, covered * share].map(|value| value.min(1.0));
        }
    });
    means
}

/// One row of the result.
struct Row<'a> {
    source: Source<'a>,
    heights: &'a Field<f32>,
    /// Heights of the row, with the first and last value repeated.
    here: &'a [f32],
    px_per_slope: f32,
    y: usize,
    out: &'a mut [[f32; 4]],
}

/// Number of pixels whose source positions are computed before their colours are fetched.
const BLOCK: usize = 64;

impl pulp::WithSimd for Row<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { source, heights, here, px_per_slope, y, out } = self;
        let Source { values, first: first_row, width, height } = source;
        let end = (width - 1) as f32;
        let bottom = (height - 1) as f32;
        let above = heights.row(y.saturating_sub(1), 0, width);
        let below = heights.row((y + 1).min(height - 1), 0, width);
        let mut corners = [[0_i32; 2]; BLOCK];
        let mut shares = [[0.0_f32; 2]; BLOCK];
        for (block, out) in out.chunks_mut(BLOCK).enumerate() {
            let first = block * BLOCK;
            let count = out.len();
            let left = &here[first..][..count];
            let right = &here[first + 2..][..count];
            let above = &above[first..][..count];
            let below = &below[first..][..count];
            for i in 0..count {
                let x = multiply_add::<S>(px_per_slope, right[i] - left[i], (first + i) as f32);
                let y = multiply_add::<S>(px_per_slope, below[i] - above[i], y as f32);
                let x = lesser(greater(x, 0.0), end);
                let y = lesser(greater(y, 0.0), bottom);
                corners[i % BLOCK] = [x as i32, y as i32];
                shares[i % BLOCK] = [x - (x as i32) as f32, y - (y as i32) as f32];
            }
            for ((out, [x, y]), [a, b]) in out.iter_mut().zip(corners).zip(shares) {
                let x = x as usize;
                let y = y as usize;
                let corner = (y - first_row) * width + x;
                let right = usize::from(x + 1 < width);
                let down = if y + 1 < height { width } else { 0 };
                let colors = [corner, corner + right, corner + down, corner + down + right];
                let shares = [(1.0 - a) * (1.0 - b), a * (1.0 - b), (1.0 - a) * b, a * b];
                *out = mixed::<S>(colors.map(|i| values[i]), shares);
            }
        }
    }
}

/// The mean of four colours, weighted by share and coverage.
#[inline(always)]
fn mixed<S: Simd>(colors: [[f32; 4]; 4], shares: [f32; 4]) -> [f32; 4] {
    let mut sum = [0.0; 4];
    for (color, share) in colors.into_iter().zip(shares) {
        let weight = share * color[3];
        let color = [color[0], color[1], color[2], 1.0];
        for i in 0..4 {
            sum[i] = multiply_add::<S>(weight, color[i], sum[i]);
        }
    }
    let covered = sum[3];
    let by = if covered > 0.0 { 1.0 / covered } else { 0.0 };
    let by = [by, by, by, 1.0];
    for i in 0..4 {
        // Rounding must not raise white above 1.
        sum[i] = lesser(sum[i] * by[i], 1.0);
    }
    sum
}

#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct WobbleParams {
    size: [u32; 2],
    px_per_slope: f32,
    /// Cells of the paper along each side of a pixel.
    factor: u32,
}

pub(crate) static WOBBLE: Kernel = Kernel {
    name: "watercolor_wobble",
    source: include_str!("wobble.wgsl"),
    parameters: layout!(WobbleParams { size, px_per_slope, factor }),
    structs: &[],
    storage: &[Storage::Read, Storage::Read, Storage::Write],
};

fn wobble_on_gpu(
    gpu: &mut GpuCompute,
    color: &Plane<[f32; 4]>,
    heights: &Plane<f32>,
    px_per_slope: f32,
) -> Result<Plane<[f32; 4]>, DeviceError> {
    let (width, height) = color.size();
    let displaced = gpu.plane(width, height)?;
    let factor = cells_per_pixel(heights.size(), color.size()) as u32;
    let params = WobbleParams { size: [width as u32, height as u32], px_per_slope, factor };
    let buffers = [color.buffer(), heights.buffer(), displaced.buffer()];
    gpu.dispatch(&WOBBLE, &params, &buffers, (width, height));
    Ok(displaced)
}
