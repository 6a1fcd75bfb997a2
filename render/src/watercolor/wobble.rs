//! Edges that follow the paper's grain: the picture displaced by its slopes.
//!
//! Bousseau et al. 2006, section 3.2: by the paper's gradient at the paper's own
//! resolution, x by the horizontal and y by the vertical one. Between pixels
//! colours are interpolated by straight lines, each by its coverage, so that the
//! colour of bare paper never mixes in.

use pulp::Simd;
use rayon::prelude::*;

use super::backend::Backend;
use super::on_cpu::OnCpu;
use super::on_gpu::{OnGpu, Plane};
use crate::field::Field;
use crate::gpu::{GpuError, Kernel, Storage, groups, layout};
use crate::optics::{greater, lesser, multiply_add};

/// Displacing by slopes.
pub trait Wobble: Backend {
    /// `colour` displaced by `px_per_slope` times the slope of `heights`, which is the
    /// height to the right less that to the left, and below less above; beyond
    /// the borders both go on as they end. 0 changes nothing.
    ///
    /// # Errors
    /// As [`Backend::colour_of`].
    ///
    /// # Panics
    /// If sizes differ.
    fn wobbled(
        &mut self,
        colour: Self::Colour,
        heights: &Self::Grey,
        px_per_slope: f32,
    ) -> Result<Self::Colour, GpuError>;
}

impl Wobble for OnCpu {
    fn wobbled(
        &mut self,
        colour: Field<[f32; 4]>,
        heights: &Field<f32>,
        px_per_slope: f32,
    ) -> Result<Field<[f32; 4]>, GpuError> {
        let (width, height) = (colour.width(), colour.height());
        assert_eq!((heights.width(), heights.height()), (width, height), "the paper's size");
        if px_per_slope == 0.0 || width == 0 {
            return Ok(colour);
        }
        let mut wobbled = Field::filled(width, height, [0.0; 4]);
        wobbled.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, out)| {
            let row = Row { colour: &colour, heights, px_per_slope, y, out };
            pulp::Arch::new().dispatch(row);
        });
        Ok(wobbled)
    }
}

struct Row<'a> {
    colour: &'a Field<[f32; 4]>,
    heights: &'a Field<f32>,
    px_per_slope: f32,
    y: usize,
    out: &'a mut [[f32; 4]],
}

impl pulp::WithSimd for Row<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { colour, heights, px_per_slope, y, out } = self;
        let (width, height) = (colour.width(), colour.height());
        let (end, bottom) = ((width - 1) as f32, (height - 1) as f32);
        let here = heights.row(y, 0, width);
        let above = heights.row(y.saturating_sub(1), 0, width);
        let below = heights.row((y + 1).min(height - 1), 0, width);
        let values = colour.values();
        for (x, out) in out.iter_mut().enumerate() {
            let slope_x = here[(x + 1).min(width - 1)] - here[x.saturating_sub(1)];
            let slope_y = below[x] - above[x];
            let from_x = multiply_add::<S>(px_per_slope, slope_x, x as f32);
            let from_y = multiply_add::<S>(px_per_slope, slope_y, y as f32);
            let from_x = lesser(greater(from_x, 0.0), end);
            let from_y = lesser(greater(from_y, 0.0), bottom);
            let (left, top) = (from_x as i32 as usize, from_y as i32 as usize);
            let (share_x, share_y) = (from_x - left as f32, from_y - top as f32);
            let (right, low) = ((left + 1).min(width - 1), (top + 1).min(height - 1));
            let (upper, lower) = (&values[top * width..][..width], &values[low * width..][..width]);
            *out = mixed::<S>(
                [upper[left], upper[right], lower[left], lower[right]],
                [
                    (1.0 - share_x) * (1.0 - share_y),
                    share_x * (1.0 - share_y),
                    (1.0 - share_x) * share_y,
                    share_x * share_y,
                ],
            );
        }
    }
}

/// Four colours, each by its share and its coverage.
#[inline(always)]
fn mixed<S: Simd>(colours: [[f32; 4]; 4], shares: [f32; 4]) -> [f32; 4] {
    let mut sum = [0.0; 4];
    for (colour, share) in colours.into_iter().zip(shares) {
        let weight = share * colour[3];
        let colour = [colour[0], colour[1], colour[2], 1.0];
        for i in 0..4 {
            sum[i] = multiply_add::<S>(weight, colour[i], sum[i]);
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
        colour: Plane,
        heights: &Plane,
        px_per_slope: f32,
    ) -> Result<Plane, GpuError> {
        let (width, height) = (colour.width(), colour.height());
        assert_eq!((heights.width(), heights.height()), (width, height), "the paper's size");
        if px_per_slope == 0.0 {
            return Ok(colour);
        }
        let wobbled = self.plane(width, height, size_of::<[f32; 4]>())?;
        let now = WobbleNow { size: [width as u32, height as u32], px_per_slope, spare: 0 };
        let buffers = [colour.buffer(), heights.buffer(), wobbled.buffer()];
        self.recording.dispatch(&WOBBLE, &now, &buffers, [groups(width), groups(height), 1]);
        Ok(wobbled)
    }
}
