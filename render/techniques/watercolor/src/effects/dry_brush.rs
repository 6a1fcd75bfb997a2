//! A brush with little water. It touches the heights of the paper, and the hollows stay bare.
//!
//! We take a threshold of the paper's height (Bousseau et al. 2006, section 3.2). Below this
//! threshold paint fades out over a small band, so that its edge has no steps. Near outlines and in
//! dark washes the brush is wet, since a painter lays darks and contours with care.
//!
//! Use [`color_mask`] to limit the brush to pixels of about one colour.

use graphics::compute::{ColorImage, Compute, GpuCompute, GreyImage, Image, Plane, assert_size};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use graphics::lanes::{greater, lesser};
use rayon::prelude::*;
use spectra::color::{Rgb, RgbSpace};

/// The heights of the paper that a dry brush reaches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DryBrushReach {
    /// Height, 0 to 1, from which on the paint is complete. 0 changes nothing.
    pub threshold: f32,
    /// Range of heights below the threshold over which paint fades out, above 0.
    pub softness: f32,
    /// How much the dry brush keeps to patches, 0 to 1. At 0 it is dry everywhere. At 1 it is dry
    /// only where the wash flows thinly.
    pub patches: f32,
    /// How fast the brush becomes wet with the strength of an outline ([`super::edges`]). At 0
    /// it passes over outlines.
    pub outline: f32,
    /// Mean of red, green and blue, 0 to 1, up to which the brush is wet. From twice
    /// this value on it is fully dry. 0 sets no limit.
    pub darkest: f32,
}

/// A wash counts as thin below this value of the flow texture, which has a mean of 0.5 and
/// a standard deviation of 0.2. Chosen by eye.
const THIN_FLOW: f32 = 0.35;

/// The wash is fully thin this far below [`THIN_FLOW`]. Chosen by eye.
const THIN_FADE: f32 = 0.15;

impl DryBrushReach {
    /// Share of the paint that stays, 0 to 1, on paper of this `height`. The wash has the colour
    /// `[r, g, b, _]` and this `flow`. `mask` and `edge` (strength of the outline) scale
    /// [`Self::threshold`]: a small `mask` or a strong outline lowers it, and then more paint
    /// stays. Where `mask` is 0, all paint stays.
    #[inline(always)]
    fn kept(self, [r, g, b, _]: [f32; 4], height: f32, flow: f32, edge: f32, mask: f32) -> f32 {
        let thin = lesser(greater((THIN_FLOW - flow) / THIN_FADE, 0.0), 1.0);
        let inside = lesser(greater(1.0 - self.outline * edge, 0.0), 1.0);
        let light = match self.darkest > 0.0 {
            true => lesser(greater((r + g + b) / 3.0 / self.darkest - 1.0, 0.0), 1.0),
            false => 1.0,
        };
        let dry = mask * inside * light * (1.0 - self.patches * (1.0 - thin));
        let above = (height - self.threshold * dry) / self.softness;
        lesser(greater(1.0 + above, 0.0), 1.0)
    }
}

/// Reduces the coverage of `color` to the share that a dry brush leaves on paper of `heights`, from
/// 0 to 1, where the wash has this `flow`. The brush keeps away from the outlines in `edges`. If you
/// pass none, it passes over outlines. `mask`, 0 to 1, says where the brush is dry. If you pass
/// none, it is dry everywhere.
///
/// # Errors
/// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
/// processor.
///
/// # Panics
/// If sizes differ, or another form of [`Compute`] made an image.
pub fn apply_dry_brush(
    compute: &mut Compute,
    color: ColorImage,
    heights: &GreyImage,
    flow: &GreyImage,
    reach: DryBrushReach,
    edges: Option<&GreyImage>,
    mask: Option<&GreyImage>,
) -> Result<ColorImage, DeviceError> {
    assert_size("the paper", heights.size(), color.size());
    assert_size("the flow", flow.size(), color.size());
    for image in edges.into_iter().chain(mask) {
        assert_size("the outlines and mask of the dry brush", image.size(), color.size());
    }
    if reach.threshold <= 0.0 {
        return Ok(color);
    }
    match compute {
        Compute::Cpu => {
            let where_dry = (edges.map(Image::host), mask.map(Image::host));
            let paper = (heights.host(), flow.host());
            Ok(apply_dry_brush_on_cpu(color.into_host(), paper, reach, where_dry).into())
        }
        Compute::Gpu(gpu) => {
            let where_dry = (edges.map(Image::plane), mask.map(Image::plane));
            let paper = (heights.plane(), flow.plane());
            apply_dry_brush_on_gpu(gpu, color.plane(), paper, reach, where_dry).map(Image::from)
        }
    }
}

fn apply_dry_brush_on_cpu(
    mut color: Field<[f32; 4]>,
    (heights, flow): (&Field<f32>, &Field<f32>),
    reach: DryBrushReach,
    (edges, mask): (Option<&Field<f32>>, Option<&Field<f32>>),
) -> Field<[f32; 4]> {
    let width = color.width();
    color.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, colors)| {
        let [edges, mask] = [edges, mask].map(|field| field.map(|field| field.row(y, 0, width)));
        let paper = heights.row(y, 0, width).iter().zip(flow.row(y, 0, width));
        for (x, (color, (&height, &flow))) in colors.iter_mut().zip(paper).enumerate() {
            let edge = edges.map_or(0.0, |edges| edges[x]);
            let mask = mask.map_or(1.0, |mask| mask[x]);
            color[3] *= reach.kept(*color, height, flow, edge, mask);
        }
    });
    color
}

#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct DryBrushParams {
    size: [u32; 2],
    threshold: f32,
    softness: f32,
    masked: u32,
    patches: f32,
    thin: f32,
    thin_fade: f32,
    /// 0 without edges.
    outline: f32,
    darkest: f32,
    spare: [u32; 2],
}

pub(crate) static DRY_BRUSH: Kernel = Kernel {
    name: "watercolor_dry_brush",
    source: include_str!("dry_brush.wgsl"),
    parameters: layout!(DryBrushParams {
        size,
        threshold,
        softness,
        masked,
        patches,
        thin,
        thin_fade,
        outline,
        darkest,
        spare
    }),
    structs: &[],
    storage: &[
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Write,
    ],
};

fn apply_dry_brush_on_gpu(
    gpu: &mut GpuCompute,
    color: &Plane<[f32; 4]>,
    (heights, flow): (&Plane<f32>, &Plane<f32>),
    reach: DryBrushReach,
    (edges, mask): (Option<&Plane<f32>>, Option<&Plane<f32>>),
) -> Result<Plane<[f32; 4]>, DeviceError> {
    let (width, height) = color.size();
    let brushed = gpu.plane(width, height)?;
    let params = DryBrushParams {
        size: [width as u32, height as u32],
        threshold: reach.threshold,
        softness: reach.softness,
        masked: u32::from(mask.is_some()),
        patches: reach.patches,
        thin: THIN_FLOW,
        thin_fade: THIN_FADE,
        outline: if edges.is_some() { reach.outline } else { 0.0 },
        darkest: reach.darkest,
        spare: [0; 2],
    };
    // The bindings need a buffer even if the kernel does not read it.
    let [edges, mask] = [edges, mask].map(|plane| plane.unwrap_or(heights).buffer());
    let heights = heights.buffer();
    let flow = flow.buffer();
    let buffers = [color.buffer(), heights, flow, edges, mask, brushed.buffer()];
    gpu.dispatch(&DRY_BRUSH, &params, &buffers, (width, height));
    Ok(brushed)
}

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
/// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
/// processor.
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
    let pixels = color.values().par_iter().with_min_len(1024);
    let mut values: Vec<f32> = pixels.map(|&color| range.membership(&matrix, color)).collect();
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
