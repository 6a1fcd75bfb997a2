//! The density of pigment: colours made deeper and paler.
//!
//! We follow Bousseau, Kaplan, Thollot and Sillion 2006, section 3.2. A colour C at density d
//! becomes `C (1 - (1 - C) (d - 1))`. For example, d = 1 keeps the colour and d = 2, two glazes,
//! squares it. A texture T sets the density `d = 1 + strength (T - pivot)`. The pivot is 0.5 for
//! textures that vary about their mean, and 0 for edges, which only add density. Densities below 0
//! count as 0.

use pulp::Simd;
use rayon::prelude::*;

use graphics::compute::{ColorImage, Compute, GpuCompute, GreyImage, Image, Plane, assert_size};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use graphics::lanes::{greater, lesser, multiply_add};

/// A texture that changes density.
#[derive(Debug, Clone, Copy)]
pub struct DensityLayer<'a> {
    /// The texture T.
    pub texture: &'a GreyImage,
    /// Density gained where T is 1 above the pivot. 0 changes nothing.
    pub strength: f32,
    /// The value of T that keeps the colour.
    pub pivot: f32,
}

/// Brings `color` to the density `overall` (0 and up, 1 keeps it), then applies `layers` one after
/// the other. Where you pass a `mask`, 0 to 1, it scales the change of each layer. Bare paper and
/// colours of density 1 keep their bits.
///
/// # Errors
/// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
/// processor.
///
/// # Panics
/// If sizes differ, or another form of [`Compute`] made an image.
pub fn apply_density(
    compute: &mut Compute,
    color: ColorImage,
    overall: f32,
    layers: &[DensityLayer<'_>],
    mask: Option<&GreyImage>,
) -> Result<ColorImage, DeviceError> {
    for layer in layers {
        assert_size("a texture of density", layer.texture.size(), color.size());
    }
    if let Some(mask) = mask {
        assert_size("the mask of density", mask.size(), color.size());
    }
    let layers: Vec<_> = layers.iter().filter(|layer| layer.strength != 0.0).copied().collect();
    match compute {
        Compute::Cpu => {
            let mask = mask.map(Image::host);
            Ok(apply_density_on_cpu(color.into_host(), overall, &layers, mask).into())
        }
        Compute::Gpu(gpu) => {
            let mask = mask.map(Image::plane);
            apply_density_on_gpu(gpu, color.plane().clone(), overall, &layers, mask)
                .map(Image::from)
        }
    }
}

/// The change of density d - 1 at a pixel, at least -1.
#[inline(always)]
fn density_excess(strength: f32, pivot: f32, texture: f32, mask: f32) -> f32 {
    greater(strength * (texture - pivot) * mask, -1.0)
}

fn apply_density_on_cpu(
    mut color: Field<[f32; 4]>,
    overall: f32,
    layers: &[DensityLayer<'_>],
    mask: Option<&Field<f32>>,
) -> Field<[f32; 4]> {
    let width = color.width();
    if width == 0 {
        return color;
    }
    let layers: Vec<_> =
        layers.iter().map(|layer| (layer.texture.host(), layer.strength, layer.pivot)).collect();
    color.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, colors)| {
        let mask = mask.map(|mask| mask.row(y, 0, width));
        if overall != 1.0 {
            graphics::lanes::vectorized(EvenRow { colors, excess: overall - 1.0 });
        }
        for &(texture, strength, pivot) in &layers {
            let texture = texture.row(y, 0, width);
            graphics::lanes::vectorized(Row { colors, texture, mask, strength, pivot });
        }
    });
    color
}

/// A row of pixels that all change density by the same amount.
struct EvenRow<'a> {
    colors: &'a mut [[f32; 4]],
    excess: f32,
}

impl pulp::WithSimd for EvenRow<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for color in self.colors {
            *color = at_density::<S>(*color, self.excess);
        }
    }
}

/// A row of pixels with the density of a texture.
struct Row<'a> {
    colors: &'a mut [[f32; 4]],
    texture: &'a [f32],
    mask: Option<&'a [f32]>,
    strength: f32,
    pivot: f32,
}

impl pulp::WithSimd for Row<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { colors, texture, mask, strength, pivot } = self;
        match mask {
            None => {
                for (color, &t) in colors.iter_mut().zip(texture) {
                    *color = at_density::<S>(*color, density_excess(strength, pivot, t, 1.0));
                }
            }
            Some(mask) => {
                for ((color, &t), &mask) in colors.iter_mut().zip(texture).zip(mask) {
                    *color = at_density::<S>(*color, density_excess(strength, pivot, t, mask));
                }
            }
        }
    }
}

/// A colour at density `1 + excess`, exact for an excess of 0 and 1. Coverage, the fourth
/// value, stays.
#[inline(always)]
fn at_density<S: Simd>(color: [f32; 4], excess: f32) -> [f32; 4] {
    let k = if color[3] > 0.0 { excess } else { 0.0 };
    let k = [k, k, k, 0.0];
    let mut out = [0.0; 4];
    for i in 0..4 {
        let kept = multiply_add::<S>(k[i], color[i], 1.0 - k[i]);
        out[i] = lesser(greater(color[i] * kept, 0.0), 1.0);
    }
    out
}

/// Number of textures that one dispatch applies.
const TEXTURES_PER_DISPATCH: usize = 4;

#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct DensityParams {
    strength: [f32; 4],
    pivot: [f32; 4],
    size: [u32; 2],
    layers: u32,
    masked: u32,
    /// The overall density minus 1.
    overall: f32,
    spare: u32,
    more: [u32; 2],
}

pub(crate) static DENSITY: Kernel = Kernel {
    name: "watercolor_density",
    source: include_str!("density.wgsl"),
    parameters: layout!(DensityParams {
        strength,
        pivot,
        size,
        layers,
        masked,
        overall,
        spare,
        more
    }),
    structs: &[],
    storage: &[
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Write,
    ],
};

fn apply_density_on_gpu(
    gpu: &mut GpuCompute,
    mut color: Plane<[f32; 4]>,
    overall: f32,
    layers: &[DensityLayer<'_>],
    mask: Option<&Plane<f32>>,
) -> Result<Plane<[f32; 4]>, DeviceError> {
    let (width, height) = color.size();
    let mut overall = overall - 1.0;
    let mut rest = layers;
    while overall != 0.0 || !rest.is_empty() {
        let (layers, after) = rest.split_at(rest.len().min(TEXTURES_PER_DISPATCH));
        let params = DensityParams {
            strength: std::array::from_fn(|i| layers.get(i).map_or(0.0, |layer| layer.strength)),
            pivot: std::array::from_fn(|i| layers.get(i).map_or(0.0, |layer| layer.pivot)),
            size: [width as u32, height as u32],
            layers: layers.len() as u32,
            masked: u32::from(mask.is_some()),
            overall,
            spare: 0,
            more: [0; 2],
        };
        // All bindings need a buffer, even those that the kernel does not read.
        let [first, second, third, fourth] = [0, 1, 2, 3].map(|i: usize| {
            layers.get(i).map_or(color.buffer(), |layer| layer.texture.plane().buffer())
        });
        let result = gpu.plane(width, height)?;
        let buffers = [
            color.buffer(),
            first,
            second,
            third,
            fourth,
            mask.map_or(first, Plane::buffer),
            result.buffer(),
        ];
        gpu.dispatch(&DENSITY, &params, &buffers, (width, height));
        color = result;
        (overall, rest) = (0.0, after);
    }
    Ok(color)
}
