//! Edges that follow the paper's grain: the picture displaced by its slopes.
//!
//! Bousseau et al. 2006, section 3.2: by the paper's gradient at the paper's own
//! resolution, x by the horizontal and y by the vertical one. Between pixels
//! colours are interpolated by straight lines, each by its coverage, so that the
//! colour of bare paper never mixes in.

use pulp::Simd;
use rayon::prelude::*;

use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, groups, layout};
use graphics::image::Backend;
use graphics::image::OnCpu;
use graphics::image::{OnGpu, Plane};
use graphics::lanes::{greater, lesser, multiply_add};

/// Displacing by slopes.
pub trait Wobble: Backend {
    /// `color` displaced by `px_per_slope` times the slope of `heights`, which is the
    /// height to the right less that to the left, and below less above; beyond
    /// the borders both go on as they end. 0 changes nothing.
    ///
    /// # Errors
    /// As [`Backend::color_of`].
    ///
    /// # Panics
    /// If sizes differ.
    fn wobbled(
        &mut self,
        color: Self::Color,
        heights: &Self::Grey,
        px_per_slope: f32,
    ) -> Result<Self::Color, DeviceError>;
}

impl Wobble for OnCpu {
    fn wobbled(
        &mut self,
        color: Field<[f32; 4]>,
        heights: &Field<f32>,
        px_per_slope: f32,
    ) -> Result<Field<[f32; 4]>, DeviceError> {
        let (width, height) = (color.width(), color.height());
        assert_eq!((heights.width(), heights.height()), (width, height), "the paper's size");
        if px_per_slope == 0.0 || width == 0 {
            return Ok(color);
        }
        let mut wobbled = Field::filled(width, height, [0.0; 4]);
        wobbled.values_mut().par_chunks_mut(width).enumerate().for_each_init(
            || vec![0.0; width + 2],
            |here, (y, out)| {
                here[1..=width].copy_from_slice(heights.row(y, 0, width));
                (here[0], here[width + 1]) = (here[1], here[width]);
                let row = Row { color: &color, heights, here, px_per_slope, y, out };
                pulp::Arch::new().dispatch(row);
            },
        );
        Ok(wobbled)
    }
}

struct Row<'a> {
    color: &'a Field<[f32; 4]>,
    heights: &'a Field<f32>,
    /// Heights of the row, its ends repeated.
    here: &'a [f32],
    px_per_slope: f32,
    y: usize,
    out: &'a mut [[f32; 4]],
}

/// Pixels whose places are found before their colours are fetched.
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

/// Four colours, each by its share and its coverage.
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
        // Rounding must not carry a white beyond 1.
        sum[i] = lesser(sum[i] * by[i], 1.0);
    }
    sum
}

/// What the kernel is told.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct WobbleNow {
    size: [u32; 2],
    px_per_slope: f32,
    spare: u32,
}

pub(super) static WOBBLE: Kernel = Kernel {
    name: "watercolor_wobble",
    source: include_str!("wobble.wgsl"),
    parameters: layout!(WobbleNow { size, px_per_slope, spare }),
    structs: &[],
    storage: &[Storage::Read, Storage::Read, Storage::Write],
};

impl Wobble for OnGpu {
    fn wobbled(
        &mut self,
        color: Plane,
        heights: &Plane,
        px_per_slope: f32,
    ) -> Result<Plane, DeviceError> {
        let (width, height) = (color.width(), color.height());
        assert_eq!((heights.width(), heights.height()), (width, height), "the paper's size");
        if px_per_slope == 0.0 {
            return Ok(color);
        }
        let wobbled = self.plane(width, height, size_of::<[f32; 4]>())?;
        let now = WobbleNow { size: [width as u32, height as u32], px_per_slope, spare: 0 };
        let buffers = [color.buffer(), heights.buffer(), wobbled.buffer()];
        self.recording.dispatch(&WOBBLE, &now, &buffers, [groups(width), groups(height), 1]);
        Ok(wobbled)
    }
}
