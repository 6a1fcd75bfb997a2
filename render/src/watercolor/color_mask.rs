//! Where a picture is of about one colour.

use rayon::prelude::*;
use spectra::color::{Rgb, RgbSpace};

use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, groups, layout};
use graphics::image::Backend;
use graphics::image::OnCpu;
use graphics::image::{OnGpu, Plane};

/// A colour and what counts as like it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorRange {
    /// CIELAB, seen under D65.
    pub lab: [f32; 3],
    /// Up to this difference (CIE 1976) a colour is alike; at 1.5 times as much it is
    /// not any more. Above 0.
    pub tolerance: f32,
}

/// Rows of XYZ, relative to the white, by linear red, green and blue.
fn relative_xyz() -> [[f32; 3]; 3] {
    let white = RgbSpace::Srgb.white().to_array();
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .map(|rgb| RgbSpace::Srgb.xyz_from_linear().apply(rgb));
    std::array::from_fn(|i| std::array::from_fn(|j| (columns[j][i] / white[i]) as f32))
}

impl ColorRange {
    /// Around an encoded sRGB colour.
    #[must_use]
    pub fn around(color: Rgb, tolerance: f32) -> Self {
        let lab = lab(&relative_xyz(), color.0.map(|value| value as f32));
        Self { lab, tolerance }
    }

    fn holds(&self, matrix: &[[f32; 3]; 3], [r, g, b, _]: [f32; 4]) -> f32 {
        let found = lab(matrix, [r, g, b]);
        let squared: f32 = found.iter().zip(&self.lab).map(|(a, b)| (a - b) * (a - b)).sum();
        (3.0 - 2.0 * squared.sqrt() / self.tolerance).clamp(0.0, 1.0)
    }
}

/// CIELAB of encoded sRGB (IEC 61966-2-1, CIE 15).
fn lab(matrix: &[[f32; 3]; 3], encoded: [f32; 3]) -> [f32; 3] {
    let linear =
        encoded.map(|v| if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) });
    let [x, y, z] = matrix.map(|row| {
        let t: f32 = row.iter().zip(linear).map(|(m, v)| m * v).sum();
        if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Masks by colour.
pub trait ColorMask: Backend {
    /// 1 where `color` is alike, 0 where it is not, by straight lines between; times
    /// `mask`.
    ///
    /// # Errors
    /// As [`Backend::color_of`].
    ///
    /// # Panics
    /// If sizes differ.
    fn color_mask(
        &mut self,
        color: &Self::Color,
        range: ColorRange,
        mask: Option<&Self::Grey>,
    ) -> Result<Self::Grey, DeviceError>;
}

impl ColorMask for OnCpu {
    fn color_mask(
        &mut self,
        color: &Field<[f32; 4]>,
        range: ColorRange,
        mask: Option<&Field<f32>>,
    ) -> Result<Field<f32>, DeviceError> {
        let (width, height) = (color.width(), color.height());
        let matrix = relative_xyz();
        let held = |&color: &[f32; 4]| range.holds(&matrix, color);
        let mut found: Vec<f32> = color.values().par_iter().with_min_len(1024).map(held).collect();
        if let Some(mask) = mask {
            assert_eq!((mask.width(), mask.height()), (width, height), "a mask's size");
            found.iter_mut().zip(mask.values()).for_each(|(found, mask)| *found *= mask);
        }
        Ok(Field::from_values(width, height, found))
    }
}

/// What the kernel is told.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct ColorMaskNow {
    /// Columns of relative XYZ, by red, green and blue.
    xyz: [[f32; 4]; 3],
    /// CIELAB, then the tolerance.
    range: [f32; 4],
    size: [u32; 2],
    masked: u32,
    spare: u32,
}

pub(super) static COLOR_MASK: Kernel = Kernel {
    name: "watercolor_colour_mask",
    source: include_str!("color_mask.wgsl"),
    parameters: layout!(ColorMaskNow { xyz, range, size, masked, spare }),
    structs: &[],
    storage: &[Storage::Read, Storage::Read, Storage::Write],
};

impl ColorMask for OnGpu {
    fn color_mask(
        &mut self,
        color: &Plane,
        range: ColorRange,
        mask: Option<&Plane>,
    ) -> Result<Plane, DeviceError> {
        let (width, height) = (color.width(), color.height());
        let rows = relative_xyz();
        let found = self.plane(width, height, size_of::<f32>())?;
        let [l, a, b] = range.lab;
        let now = ColorMaskNow {
            xyz: std::array::from_fn(|j| [rows[0][j], rows[1][j], rows[2][j], 0.0]),
            range: [l, a, b, range.tolerance],
            size: [width as u32, height as u32],
            masked: u32::from(mask.is_some()),
            spare: 0,
        };
        if let Some(mask) = mask {
            assert_eq!((mask.width(), mask.height()), (width, height), "a mask's size");
        }
        let buffers = [color.buffer(), mask.unwrap_or(color).buffer(), found.buffer()];
        self.recording.dispatch(&COLOR_MASK, &now, &buffers, [groups(width), groups(height), 1]);
        Ok(found)
    }
}
