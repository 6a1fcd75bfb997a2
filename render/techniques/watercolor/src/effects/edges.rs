//! Edges of washes: dark where pigment gathers at their rim, and uneven where they follow the
//! grain of the paper (Bousseau et al. 2006, section 3.2).
//!
//! [`edges`] is the texture that makes rims denser. We take the symmetric gradient `|p(x-1) -
//! p(x+1)| + |p(y-1) - p(y+1)|` of the picture over white paper, averaged over red, green and blue.
//! You can blur the picture before, which widens edges. At the border between paint and bare paper
//! even pale pigment gathers, so there we use the gradient of the coverage if it is greater. Values
//! are 0 to 2. Outside the picture we repeat its outermost pixels.
//!
//! [`wobble`] displaces the picture by the slopes of the paper: x by the horizontal gradient of its
//! height and y by the vertical one. We interpolate colours linearly between pixels and weight them
//! by coverage, so that the colour of bare paper never mixes in. If the grain is too fine for the
//! pixels of the picture, you can give the paper a finer grid. A pixel is then the mean of one
//! displaced sample for each of its cells, as if we had reduced a larger picture.

use graphics::compute::{ColorImage, Compute, GpuCompute, GreyImage, Image, Plane, assert_size};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use graphics::lanes::{greater, lesser, multiply_add};
use pulp::Simd;
use rayon::prelude::*;

/// The strength of an edge at each pixel of `color`, 0 to 2, after a Gaussian blur of
/// standard deviation `width_px` (0 and up).
///
/// # Errors
/// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
/// processor.
///
/// # Panics
/// If another form of [`Compute`] made the image.
pub fn edges(
    compute: &mut Compute,
    color: &ColorImage,
    width_px: f32,
) -> Result<GreyImage, DeviceError> {
    match compute {
        Compute::Cpu => Ok(edges_on_cpu(color.host(), width_px).into()),
        Compute::Gpu(gpu) => edges_on_gpu(gpu, color.plane(), width_px).map(Image::from),
    }
}

/// Right half of a Gaussian kernel, centre first, out to 2.5 standard deviations. The full
/// symmetric kernel sums to 1.
fn half_gaussian(sigma: f32) -> Vec<f32> {
    let radius = (2.5 * sigma).ceil().max(0.0) as usize;
    let outer = (1..=radius).map(|i| (-0.5 * (i as f64 / f64::from(sigma)).powi(2)).exp());
    let half: Vec<f64> = std::iter::once(1.0).chain(outer).collect();
    let sum = 2.0 * half.iter().sum::<f64>() - 1.0;
    half.into_iter().map(|weight| (weight / sum) as f32).collect()
}

/// Rows that are processed together, so that intermediate rows stay in the cache.
const BAND: usize = 24;

/// [`edges`] on the processor.
pub(crate) fn edges_on_cpu(color: &Field<[f32; 4]>, width_px: f32) -> Field<f32> {
    let width = color.width();
    let height = color.height();
    let mut edges = Field::filled(width, height, 0.0);
    if width == 0 || height == 0 {
        return edges;
    }
    let half = half_gaussian(width_px);
    let bands = edges.values_mut().par_chunks_mut(width * BAND).enumerate();
    bands.for_each_init(Scratch::default, |scratch, (band, edges)| {
        let band = Band { color, half: &half, first: band * BAND, scratch, edges };
        graphics::lanes::vectorized(band);
    });
    edges
}

/// Intermediate rows. Their memory is reused from band to band.
#[derive(Default)]
struct Scratch {
    /// One row over white paper, its ends repeated.
    line: Vec<[f32; 4]>,
    sideways: Vec<[f32; 4]>,
    blurred: Vec<[f32; 4]>,
}

/// Some rows of the picture and of the result.
struct Band<'a> {
    color: &'a Field<[f32; 4]>,
    half: &'a [f32],
    /// Index of the first row.
    first: usize,
    scratch: &'a mut Scratch,
    edges: &'a mut [f32],
}

/// The colour of a pixel over white paper, with its coverage.
#[inline(always)]
fn over_white([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    let bare = 1.0 - a;
    [r * a + bare, g * a + bare, b * a + bare, a]
}

impl pulp::WithSimd for Band<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { color, half, first, scratch, edges } = self;
        let width = color.width();
        let last = color.height() as isize - 1;
        let rows = edges.len() / width;
        let radius = half.len() - 1;
        let Scratch { line, sideways, blurred } = scratch;
        line.resize(width + 2 * radius, [0.0; 4]);
        sideways.resize(width * (rows + 2 + 2 * radius), [0.0; 4]);
        blurred.resize(width * (rows + 2), [0.0; 4]);
        let top = first as isize - 1 - radius as isize;
        for (i, out) in sideways.chunks_exact_mut(width).enumerate() {
            let y = (top + i as isize).clamp(0, last) as usize;
            let row = color.row(y, 0, width);
            for (out, &pixel) in line[radius..].iter_mut().zip(row) {
                *out = over_white(pixel);
            }
            let left = line[radius];
            let right = line[radius + width - 1];
            line[..radius].fill(left);
            line[radius + width..].fill(right);
            mean::<S>(half, out, |tap| &line[radius.wrapping_add_signed(tap)..][..width]);
        }
        for (i, out) in blurred.chunks_exact_mut(width).enumerate() {
            mean::<S>(half, out, |tap| {
                &sideways[(radius + i).wrapping_add_signed(tap) * width..][..width]
            });
        }
        for (y, out) in edges.chunks_exact_mut(width).enumerate() {
            let is_first = first + y == 0;
            let is_last = (first + y) as isize == last;
            let [above, here, below] =
                [y + usize::from(is_first), y + 1, y + 2 - usize::from(is_last)]
                    .map(|y: usize| &blurred[y * width..][..width]);
            out[0] = edge([here[0], here[1.min(width - 1)]], [above[0], below[0]]);
            let end = width - 1;
            out[end] = edge([here[end.max(1) - 1], here[end]], [above[end], below[end]]);
            let middle = above.iter().zip(below).skip(1);
            for (out, (here, (&above, &below))) in
                out.iter_mut().skip(1).zip(here.windows(3).zip(middle))
            {
                *out = edge([here[0], here[2]], [above, below]);
            }
        }
    }
}

/// The weighted mean of the rows `taps(-radius)` to `taps(radius)`, into `out`.
#[inline(always)]
fn mean<'a, S: Simd>(half: &[f32], out: &mut [[f32; 4]], taps: impl Fn(isize) -> &'a [[f32; 4]]) {
    let middle = taps(0);
    for (out, pixel) in out.iter_mut().zip(middle) {
        *out = pixel.map(|value| half[0] * value);
    }
    for (tap, &weight) in half.iter().enumerate().skip(1) {
        let before = taps(-(tap as isize));
        let after = taps(tap as isize);
        for ((out, before), after) in out.iter_mut().zip(before).zip(after) {
            for i in 0..4 {
                out[i] = multiply_add::<S>(weight, before[i] + after[i], out[i]);
            }
        }
    }
}

/// The symmetric gradient from the pixels to the left and right, above and below.
#[inline(always)]
fn edge([left, right]: [[f32; 4]; 2], [above, below]: [[f32; 4]; 2]) -> f32 {
    let step: [f32; 4] =
        std::array::from_fn(|i| (left[i] - right[i]).abs() + (above[i] - below[i]).abs());
    greater((step[0] + step[1] + step[2]) / 3.0, step[3])
}

#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct EdgeBlurParams {
    size: [u32; 2],
    /// Direction of the blur: (1, 0) along rows, (0, 1) along columns.
    along: [u32; 2],
    /// Index of the first weight in the batch.
    first: u32,
    count: u32,
    /// 1 if the pixels have yet to be composited over white paper.
    bare: u32,
    spare: u32,
}

#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct EdgesParams {
    size: [u32; 2],
    spare: [u32; 2],
}

pub(crate) static EDGE_BLUR: Kernel = Kernel {
    name: "watercolor_edge_blur",
    source: include_str!("edges_blur.wgsl"),
    parameters: layout!(EdgeBlurParams { size, along, first, count, bare, spare }),
    structs: &[],
    storage: &[Storage::Batch, Storage::Read, Storage::Write],
};

pub(crate) static EDGES: Kernel = Kernel {
    name: "watercolor_edges",
    source: include_str!("edges.wgsl"),
    parameters: layout!(EdgesParams { size, spare }),
    structs: &[],
    storage: &[Storage::Read, Storage::Write],
};

fn edges_on_gpu(
    gpu: &mut GpuCompute,
    color: &Plane<[f32; 4]>,
    width_px: f32,
) -> Result<Plane<f32>, DeviceError> {
    let (width, height) = color.size();
    let half = half_gaussian(width_px);
    let first = gpu.batch(&half);
    let size = [width as u32, height as u32];
    let rows =
        EdgeBlurParams { size, along: [1, 0], first, count: half.len() as u32, bare: 1, spare: 0 };
    let mut blurred: Plane<[f32; 4]> = gpu.plane(width, height)?;
    let buffers = [color.buffer(), blurred.buffer()];
    gpu.dispatch(&EDGE_BLUR, &rows, &buffers, (width, height));
    if half.len() > 1 {
        let columns = EdgeBlurParams { along: [0, 1], bare: 0, ..rows };
        let both = gpu.plane(width, height)?;
        let buffers = [blurred.buffer(), both.buffer()];
        gpu.dispatch(&EDGE_BLUR, &columns, &buffers, (width, height));
        blurred = both;
    }
    let edges = gpu.plane(width, height)?;
    let params = EdgesParams { size, spare: [0; 2] };
    gpu.dispatch(&EDGES, &params, &[blurred.buffer(), edges.buffer()], (width, height));
    Ok(edges)
}

/// Displaces `color` by `px_per_slope` times the slope of `heights`. This slope is the height to
/// the right minus the height to the left, and below minus above. Beyond the borders both images
/// continue with their outermost pixels. If you pass a `px_per_slope` of 0, nothing changes. The
/// heights have the size of the picture, or a whole multiple of it.
///
/// # Errors
/// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
/// processor.
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
const WOBBLE_BAND: usize = 256;

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
    for top in (0..height).step_by(WOBBLE_BAND) {
        let bottom = (top + WOBBLE_BAND).min(height);
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
    let steepest = (0..height).into_par_iter().map(|y| {
        let above = heights.row(y.saturating_sub(1), 0, width);
        let below = heights.row((y + 1).min(height - 1), 0, width);
        above.iter().zip(below).map(|(a, b)| (b - a).abs()).fold(0.0, f32::max)
    });
    (steepest.reduce(|| 0.0, f32::max) * px_per_slope.abs()).ceil() as usize + 1
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
    let factor = heights.width() / width;
    let share = 1.0 / (factor * factor) as f32;
    let mut means = Field::filled(width, color.height(), [0.0; 4]);
    means.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, out)| {
        for (x, out) in out.iter_mut().enumerate() {
            let mut sum = [0.0; 4];
            for cell in 0..factor * factor {
                let cell = (x * factor + cell % factor, y * factor + cell / factor);
                let found = displaced_cell(color, heights, px_per_slope, cell);
                sum.iter_mut().zip(found).for_each(|(sum, value)| *sum += value);
            }
            let by = if sum[3] > 0.0 { 1.0 / sum[3] } else { 0.0 };
            let [r, g, b, covered] = sum;
            *out = [r * by, g * by, b * by, covered * share].map(|value| value.min(1.0));
        }
    });
    means
}

/// The colour that a cell of a finer paper is displaced from, weighted by coverage, and its coverage.
fn displaced_cell(
    color: &Field<[f32; 4]>,
    heights: &Field<f32>,
    px_per_slope: f32,
    (column, row): (usize, usize),
) -> [f32; 4] {
    let width = color.width();
    let height = color.height();
    let per_cell = 1.0 / (heights.width() / width) as f32;
    let left = column.saturating_sub(1);
    let right = (column + 1).min(heights.width() - 1);
    let above = row.saturating_sub(1);
    let below = (row + 1).min(heights.height() - 1);
    let across = heights[(right, row)] - heights[(left, row)];
    let down = heights[(column, below)] - heights[(column, above)];
    let x = (column as f32 + 0.5) * per_cell - 0.5 + px_per_slope * across;
    let y = (row as f32 + 0.5) * per_cell - 0.5 + px_per_slope * down;
    let place = [x.clamp(0.0, (width - 1) as f32), y.clamp(0.0, (height - 1) as f32)];
    let [x, y] = place.map(|at| at as usize);
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

/// Number of pixels for which we find the sources before we fetch their colours.
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
