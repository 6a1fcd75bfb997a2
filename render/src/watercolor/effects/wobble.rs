//! Edges that follow the grain of the paper: the picture displaced by the paper's slopes.
//!
//! Bousseau et al. 2006, section 3.2: x is displaced by the horizontal gradient of the
//! paper's height and y by the vertical one. Colours are interpolated linearly between
//! pixels, weighted by coverage, so that the colour of bare paper never mixes in.

use pulp::Simd;
use rayon::prelude::*;

use graphics::compute::{ColorImage, Compute, GpuCompute, GreyImage, Image, Plane, assert_size};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use graphics::lanes::{greater, lesser, multiply_add};

/// Displaces `color` by `px_per_slope` times the slope of `heights`: the height to the right
/// minus that to the left, and below minus above. Beyond the borders both images continue
/// with their outermost pixels. A `px_per_slope` of 0 changes nothing.
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
    assert_size("the paper", heights.size(), color.size());
    if px_per_slope == 0.0 {
        return Ok(color);
    }
    match compute {
        Compute::Cpu => Ok(wobble_on_cpu(color.host(), heights.host(), px_per_slope).into()),
        Compute::Gpu(gpu) => {
            wobble_on_gpu(gpu, color.plane(), heights.plane(), px_per_slope).map(Image::from)
        }
    }
}

/// [`wobble`] on the processor.
pub(in crate::watercolor) fn wobble_on_cpu(
    color: &Field<[f32; 4]>,
    heights: &Field<f32>,
    px_per_slope: f32,
) -> Field<[f32; 4]> {
    if px_per_slope == 0.0 {
        return color.clone();
    }
    let (width, height) = (color.width(), color.height());
    let mut displaced = Field::filled(width, height, [0.0; 4]);
    displaced.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each_init(
        || vec![0.0; width + 2],
        |here, (y, out)| {
            here[1..=width].copy_from_slice(heights.row(y, 0, width));
            (here[0], here[width + 1]) = (here[1], here[width]);
            let row = Row { color, heights, here, px_per_slope, y, out };
            pulp::Arch::new().dispatch(row);
        },
    );
    displaced
}

/// One row of the result.
struct Row<'a> {
    color: &'a Field<[f32; 4]>,
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
        let Self { color, heights, here, px_per_slope, y, out } = self;
        let (width, height) = (color.width(), color.height());
        let (end, bottom) = ((width - 1) as f32, (height - 1) as f32);
        let above = heights.row(y.saturating_sub(1), 0, width);
        let below = heights.row((y + 1).min(height - 1), 0, width);
        let values = color.values();
        let (mut corners, mut shares) = ([[0_i32; 2]; BLOCK], [[0.0_f32; 2]; BLOCK]);
        for (block, out) in out.chunks_mut(BLOCK).enumerate() {
            let (first, count) = (block * BLOCK, out.len());
            let (left, right) = (&here[first..][..count], &here[first + 2..][..count]);
            let (above, below) = (&above[first..][..count], &below[first..][..count]);
            for i in 0..count {
                let x = multiply_add::<S>(px_per_slope, right[i] - left[i], (first + i) as f32);
                let y = multiply_add::<S>(px_per_slope, below[i] - above[i], y as f32);
                let (x, y) = (lesser(greater(x, 0.0), end), lesser(greater(y, 0.0), bottom));
                corners[i % BLOCK] = [x as i32, y as i32];
                shares[i % BLOCK] = [x - (x as i32) as f32, y - (y as i32) as f32];
            }
            for ((out, [x, y]), [a, b]) in out.iter_mut().zip(corners).zip(shares) {
                let (x, y) = (x as usize, y as usize);
                let corner = y * width + x;
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
    spare: u32,
}

pub(in crate::watercolor) static WOBBLE: Kernel = Kernel {
    name: "watercolor_wobble",
    source: include_str!("wobble.wgsl"),
    parameters: layout!(WobbleParams { size, px_per_slope, spare }),
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
    let params = WobbleParams { size: [width as u32, height as u32], px_per_slope, spare: 0 };
    let buffers = [color.buffer(), heights.buffer(), displaced.buffer()];
    gpu.dispatch(&WOBBLE, &params, &buffers, (width, height));
    Ok(displaced)
}
