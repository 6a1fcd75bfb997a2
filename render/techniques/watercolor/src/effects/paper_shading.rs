//! The last step of a watercolor: paint composited on coloured paper, with its grain in
//! the light.
//!
//! Watercolor is transparent, so we multiply its colour with the paper's. Light comes from the
//! upper left. Slopes that face this light are brighter.

use rayon::prelude::*;

use graphics::compute::{ColorImage, Compute, GpuCompute, GreyImage, Image, Plane, assert_size};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};

/// The colour of paper, and how much the light shows its grain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaperShading {
    /// Encoded sRGB of the paper, 0..1.
    pub color: [f32; 3],
    /// A slope of 1 multiplies the light by 1 + `relief`. 0 shows no grain. The slope is the height
    /// to the right minus the height to the left, plus below minus above.
    pub relief: f32,
}

impl PaperShading {
    /// The colour seen of a pixel with this coverage and slope of the paper.
    #[inline(always)]
    fn shade(&self, [r, g, b, covered]: [f32; 4], slope: f32) -> [f32; 4] {
        let light = 1.0 + self.relief * slope;
        let bare = 1.0 - covered;
        let over_white = [r, g, b].map(|value| value * covered + bare);
        let [r, g, b]: [f32; 3] =
            std::array::from_fn(|i| (over_white[i] * self.color[i] * light).clamp(0.0, 1.0));
        [r, g, b, 1.0]
    }
}

/// Composites `color` on paper of `heights` and shades the grain of the paper. The result is
/// covered everywhere. White paper without relief keeps the bits of fully covered pixels.
///
/// # Errors
/// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
/// processor.
///
/// # Panics
/// If sizes differ, or another form of [`Compute`] made an image.
pub fn shade_paper(
    compute: &mut Compute,
    color: ColorImage,
    heights: &GreyImage,
    shading: PaperShading,
) -> Result<ColorImage, DeviceError> {
    assert_size("the paper", heights.size(), color.size());
    match compute {
        Compute::Cpu => Ok(shade_paper_on_cpu(color.into_host(), heights.host(), shading).into()),
        Compute::Gpu(gpu) => {
            shade_paper_on_gpu(gpu, color.plane(), heights.plane(), shading).map(Image::from)
        }
    }
}

fn shade_paper_on_cpu(
    mut color: Field<[f32; 4]>,
    heights: &Field<f32>,
    shading: PaperShading,
) -> Field<[f32; 4]> {
    let width = color.width();
    let height = color.height();
    color.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, colors)| {
        let here = heights.row(y, 0, width);
        let above = heights.row(y.saturating_sub(1), 0, width);
        let below = heights.row((y + 1).min(height - 1), 0, width);
        graphics::lanes::vectorized(Row { shading, here, above, below, colors });
    });
    color
}

/// One row of the picture with the paper around it.
struct Row<'a> {
    shading: PaperShading,
    here: &'a [f32],
    above: &'a [f32],
    below: &'a [f32],
    colors: &'a mut [[f32; 4]],
}

impl pulp::WithSimd for Row<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { shading, here, above, below, colors } = self;
        let end = colors.len() - 1;
        let mut shade = |x: usize, left: f32, right: f32| {
            let slope = (right - left) + (below[x] - above[x]);
            colors[x] = shading.shade(colors[x], slope);
        };
        shade(0, here[0], here[1.min(end)]);
        for x in 1..end {
            shade(x, here[x - 1], here[x + 1]);
        }
        if end > 0 {
            shade(end, here[end - 1], here[end]);
        }
    }
}

#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct PaperShadingParams {
    /// The colour of the paper, then its relief.
    paper: [f32; 4],
    size: [u32; 2],
    spare: [u32; 2],
}

pub(crate) static PAPER_SHADING: Kernel = Kernel {
    name: "watercolor_paper_shading",
    source: include_str!("paper_shading.wgsl"),
    parameters: layout!(PaperShadingParams { paper, size, spare }),
    structs: &[],
    storage: &[Storage::Read, Storage::Read, Storage::Write],
};

fn shade_paper_on_gpu(
    gpu: &mut GpuCompute,
    color: &Plane<[f32; 4]>,
    heights: &Plane<f32>,
    shading: PaperShading,
) -> Result<Plane<[f32; 4]>, DeviceError> {
    let (width, height) = color.size();
    let shaded = gpu.plane(width, height)?;
    let [r, g, b] = shading.color;
    let size = [width as u32, height as u32];
    let params = PaperShadingParams { paper: [r, g, b, shading.relief], size, spare: [0; 2] };
    let buffers = [color.buffer(), heights.buffer(), shaded.buffer()];
    gpu.dispatch(&PAPER_SHADING, &params, &buffers, (width, height));
    Ok(shaded)
}
