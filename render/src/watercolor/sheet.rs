//! The picture on its sheet: paint over coloured paper, whose grain shows in the
//! light.
//!
//! Watercolor is clear: over coloured paper its colour is multiplied with the
//! paper's. Light comes from the upper left: slopes that face it are lighter.

use rayon::prelude::*;

use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, groups, layout};
use graphics::image::Backend;
use graphics::image::OnCpu;
use graphics::image::{OnGpu, Plane};

/// A sheet of paper, and light on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sheet {
    /// Encoded sRGB of the paper, 0..1.
    pub color: [f32; 3],
    /// What the sum of both slopes (height to the right less that to the left, and
    /// below less above) adds to a light of 1; 0 is flat.
    pub relief: f32,
}

impl Sheet {
    #[inline(always)]
    fn seen(&self, [r, g, b, covered]: [f32; 4], slope: f32) -> [f32; 4] {
        let light = 1.0 + self.relief * slope;
        let bare = 1.0 - covered;
        let seen = [r, g, b].map(|value| value * covered + bare);
        let [r, g, b]: [f32; 3] =
            std::array::from_fn(|i| (seen[i] * self.color[i] * light).clamp(0.0, 1.0));
        [r, g, b, 1.0]
    }
}

/// Laying a picture on its sheet.
pub trait OnSheet: Backend {
    /// What is seen of `color` on a sheet of `heights`; covered everywhere. White
    /// paper without relief keeps the bits of whole paint.
    ///
    /// # Errors
    /// As [`Backend::color_of`].
    ///
    /// # Panics
    /// If sizes differ.
    fn on_sheet(
        &mut self,
        color: Self::Color,
        heights: &Self::Grey,
        sheet: Sheet,
    ) -> Result<Self::Color, DeviceError>;
}

impl OnSheet for OnCpu {
    fn on_sheet(
        &mut self,
        mut color: Field<[f32; 4]>,
        heights: &Field<f32>,
        sheet: Sheet,
    ) -> Result<Field<[f32; 4]>, DeviceError> {
        let (width, height) = (color.width(), color.height());
        assert_eq!((heights.width(), heights.height()), (width, height), "the paper's size");
        if width == 0 {
            return Ok(color);
        }
        color.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, colors)| {
            let here = heights.row(y, 0, width);
            let above = heights.row(y.saturating_sub(1), 0, width);
            let below = heights.row((y + 1).min(height - 1), 0, width);
            let row = Row { sheet, here, above, below, colors };
            pulp::Arch::new().dispatch(row);
        });
        Ok(color)
    }
}

struct Row<'a> {
    sheet: Sheet,
    here: &'a [f32],
    above: &'a [f32],
    below: &'a [f32],
    colors: &'a mut [[f32; 4]],
}

impl pulp::WithSimd for Row<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { sheet, here, above, below, colors } = self;
        let end = colors.len() - 1;
        let mut lay = |x: usize, left: f32, right: f32| {
            let slope = (right - left) + (below[x] - above[x]);
            colors[x] = sheet.seen(colors[x], slope);
        };
        lay(0, here[0], here[1.min(end)]);
        for x in 1..end {
            lay(x, here[x - 1], here[x + 1]);
        }
        if end > 0 {
            lay(end, here[end - 1], here[end]);
        }
    }
}

/// What the kernel is told.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct SheetNow {
    /// The paper's colour, then its relief.
    paper: [f32; 4],
    size: [u32; 2],
    spare: [u32; 2],
}

pub(super) static SHEET: Kernel = Kernel {
    name: "watercolor_sheet",
    source: include_str!("sheet.wgsl"),
    parameters: layout!(SheetNow { paper, size, spare }),
    structs: &[],
    storage: &[Storage::Read, Storage::Read, Storage::Write],
};

impl OnSheet for OnGpu {
    fn on_sheet(
        &mut self,
        color: Plane,
        heights: &Plane,
        sheet: Sheet,
    ) -> Result<Plane, DeviceError> {
        let (width, height) = (color.width(), color.height());
        assert_eq!((heights.width(), heights.height()), (width, height), "the paper's size");
        let seen = self.plane(width, height, size_of::<[f32; 4]>())?;
        let [r, g, b] = sheet.color;
        let size = [width as u32, height as u32];
        let now = SheetNow { paper: [r, g, b, sheet.relief], size, spare: [0; 2] };
        let buffers = [color.buffer(), heights.buffer(), seen.buffer()];
        self.recording.dispatch(&SHEET, &now, &buffers, [groups(width), groups(height), 1]);
        Ok(seen)
    }
}
