//! A mask of the pixels of about one colour.

use rayon::prelude::*;
use spectra::color::{Rgb, RgbSpace};

use graphics::compute::{ColorImage, Compute, GpuCompute, GreyImage, Image, Plane, assert_size};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};

/// A colour, and how far a similar colour may differ from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorRange {
    /// The colour in CIELAB under D65.
    pub lab: [f32; 3],
    /// The mask is 1 up to this colour difference (CIE 1976) and falls to 0 at 1.5 times
    /// it. Above 0.
    pub tolerance: f32,
}

/// The matrix from linear sRGB to XYZ relative to the white, row by row.
fn relative_xyz_from_linear() -> [[f32; 3]; 3] {
    let white = RgbSpace::Srgb.white().to_array();
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .map(|rgb| RgbSpace::Srgb.xyz_from_linear().apply(rgb));
    std::array::from_fn(|i| std::array::from_fn(|j| (columns[j][i] / white[i]) as f32))
}

impl ColorRange {
    /// The range around an encoded sRGB colour.
    #[must_use]
    pub fn around(color: Rgb, tolerance: f32) -> Self {
        let encoded = color.0.map(|value| value as f32);
        Self { lab: lab_from_encoded(&relative_xyz_from_linear(), encoded), tolerance }
    }

    /// The mask's value, 0 to 1, for an encoded colour.
    fn membership(&self, xyz_from_linear: &[[f32; 3]; 3], [r, g, b, _]: [f32; 4]) -> f32 {
        let lab = lab_from_encoded(xyz_from_linear, [r, g, b]);
        let squared: f32 = lab.iter().zip(&self.lab).map(|(a, b)| (a - b) * (a - b)).sum();
        (3.0 - 2.0 * squared.sqrt() / self.tolerance).clamp(0.0, 1.0)
    }
}

/// CIELAB of encoded sRGB (IEC 61966-2-1, CIE 15).
fn lab_from_encoded(xyz_from_linear: &[[f32; 3]; 3], encoded: [f32; 3]) -> [f32; 3] {
    let linear =
        encoded.map(|v| if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) });
    let [x, y, z] = xyz_from_linear.map(|row| {
        let t: f32 = row.iter().zip(linear).map(|(m, v)| m * v).sum();
        if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// A mask that is 1 where `color` is within `range`, 0 where it is far from it and linear
/// between, multiplied by `mask`.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
///
/// # Panics
/// If sizes differ, or another form of [`Compute`] made an image.
pub fn color_mask(
    compute: &mut Compute,
    color: &ColorImage,
    range: ColorRange,
    mask: Option<&GreyImage>,
) -> Result<GreyImage, DeviceError> {
    if let Some(mask) = mask {
        assert_size("the mask", mask.size(), color.size());
    }
    match compute {
        Compute::Cpu => Ok(color_mask_on_cpu(color.host(), range, mask.map(Image::host)).into()),
        Compute::Gpu(gpu) => {
            color_mask_on_gpu(gpu, color.plane(), range, mask.map(Image::plane)).map(Image::from)
        }
    }
}

/// [`color_mask`] on the processor.
fn color_mask_on_cpu(
    color: &Field<[f32; 4]>,
    range: ColorRange,
    mask: Option<&Field<f32>>,
) -> Field<f32> {
    let matrix = relative_xyz_from_linear();
    let membership = |&color: &[f32; 4]| range.membership(&matrix, color);
    let pixels = color.values().par_iter().with_min_len(1024);
    let mut values: Vec<f32> = pixels.map(membership).collect();
    if let Some(mask) = mask {
        values.iter_mut().zip(mask.values()).for_each(|(value, mask)| *value *= mask);
    }
    Field::from_values(color.width(), color.height(), values)
}

#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct ColorMaskParams {
    /// Columns of the matrix from linear sRGB to relative XYZ.
    xyz: [[f32; 4]; 3],
    /// CIELAB of the colour, then the tolerance.
    range: [f32; 4],
    size: [u32; 2],
    masked: u32,
    spare: u32,
}

pub(crate) static COLOR_MASK: Kernel = Kernel {
    name: "watercolor_color_mask",
    source: include_str!("color_mask.wgsl"),
    parameters: layout!(ColorMaskParams { xyz, range, size, masked, spare }),
    structs: &[],
    storage: &[Storage::Read, Storage::Read, Storage::Write],
};

fn color_mask_on_gpu(
    gpu: &mut GpuCompute,
    color: &Plane<[f32; 4]>,
    range: ColorRange,
    mask: Option<&Plane<f32>>,
) -> Result<Plane<f32>, DeviceError> {
    let (width, height) = color.size();
    let rows = relative_xyz_from_linear();
    let result = gpu.plane(width, height)?;
    let [l, a, b] = range.lab;
    let params = ColorMaskParams {
        xyz: std::array::from_fn(|j| [rows[0][j], rows[1][j], rows[2][j], 0.0]),
        range: [l, a, b, range.tolerance],
        size: [width as u32, height as u32],
        masked: u32::from(mask.is_some()),
        spare: 0,
    };
    // The binding needs a buffer even if the kernel does not read it.
    let mask = mask.map_or(color.buffer(), Plane::buffer);
    let buffers = [color.buffer(), mask, result.buffer()];
    gpu.dispatch(&COLOR_MASK, &params, &buffers, (width, height));
    Ok(result)
}
