//! The edges of washes, as the texture that makes them denser.
//!
//! Bousseau et al. 2006, section 3.2: the symmetric gradient
//! `|p(x-1) - p(x+1)| + |p(y-1) - p(y+1)|` of the picture over white paper, averaged over
//! red, green and blue. The picture may be blurred before, which widens edges. At the
//! border between paint and bare paper even pale pigment gathers, so the gradient of the
//! coverage replaces that of the colour where it is greater. Values are 0 to 2. Outside the
//! picture, its outermost pixels are repeated.

use pulp::Simd;
use rayon::prelude::*;

use graphics::compute::{ColorImage, Compute, GpuCompute, GreyImage, Image, Plane};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use graphics::lanes::{greater, multiply_add};

/// The strength of an edge at each pixel of `color`, 0 to 2, after a Gaussian blur of
/// standard deviation `width_px` (0 and up).
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
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
    let weight = |i: usize| match i {
        0 => 1.0,
        _ => (-0.5 * (i as f64 / f64::from(sigma)).powi(2)).exp(),
    };
    let half: Vec<f64> = (0..=radius).map(weight).collect();
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

/// Intermediate rows; the memory is reused from band to band.
#[derive(Default)]
struct Scratch {
    /// One row over white paper, its ends repeated.
    line: Vec<[f32; 4]>,
    /// Rows blurred horizontally.
    sideways: Vec<[f32; 4]>,
    /// Rows blurred in both directions.
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
            let row = |y: usize| &blurred[y * width..][..width];
            let is_first = first + y == 0;
            let is_last = (first + y) as isize == last;
            let above = row(y + usize::from(is_first));
            let here = row(y + 1);
            let below = row(y + 2 - usize::from(is_last));
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
    /// Number of weights.
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
