//! How densely pigment lies: colours made deeper and paler.
//!
//! Bousseau, Kaplan, Thollot and Sillion 2006, section 3.2: a colour C of density
//! d becomes `C (1 - (1 - C) (d - 1))`, so that d = 2 is two glazes, its square.
//! Density follows a texture T: `d = 1 + strength (T - pivot)`, with a pivot of
//! 0.5 for textures about their mean and of 0 for edges, which only add. A density
//! below 0 counts as 0.

use pulp::Simd;
use rayon::prelude::*;

use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, groups, layout};
use graphics::image::Backend;
use graphics::image::OnCpu;
use graphics::image::{OnGpu, Plane};
use graphics::lanes::{greater, lesser, multiply_add};

/// A texture that changes density.
#[derive(Debug)]
pub struct DensityLayer<'a, Grey> {
    /// T of every pixel.
    pub texture: &'a Grey,
    /// What density gains where T is 1 above the pivot.
    pub strength: f32,
    /// The T that leaves colours as they are.
    pub pivot: f32,
}

/// Changes of density.
pub trait Density: Backend {
    /// `color` of an `overall` density, 0 and up, and then of all `layers`, one upon the
    /// other. `mask`, 0..1, tells how much of each layer's change takes place. Bare paper
    /// and colours of density 1 keep their bits.
    ///
    /// # Errors
    /// As [`Backend::color_of`].
    ///
    /// # Panics
    /// If sizes differ.
    fn densified(
        &mut self,
        color: Self::Color,
        overall: f32,
        layers: &[DensityLayer<'_, Self::Grey>],
        mask: Option<&Self::Grey>,
    ) -> Result<Self::Color, DeviceError>;
}

/// d - 1 of a pixel.
#[inline(always)]
pub(super) fn excess(strength: f32, pivot: f32, texture: f32, mask: f32) -> f32 {
    greater(strength * (texture - pivot) * mask, -1.0)
}

impl Density for OnCpu {
    fn densified(
        &mut self,
        mut color: Field<[f32; 4]>,
        overall: f32,
        layers: &[DensityLayer<'_, Field<f32>>],
        mask: Option<&Field<f32>>,
    ) -> Result<Field<[f32; 4]>, DeviceError> {
        let (width, height) = (color.width(), color.height());
        for grey in layers.iter().map(|layer| layer.texture).chain(mask) {
            assert_eq!((grey.width(), grey.height()), (width, height), "a texture's size");
        }
        if width == 0 {
            return Ok(color);
        }
        color.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, colors)| {
            let mask = mask.map(|mask| mask.row(y, 0, width));
            if overall != 1.0 {
                pulp::Arch::new().dispatch(Evenly { colors, excess: overall - 1.0 });
            }
            for layer in layers.iter().filter(|layer| layer.strength != 0.0) {
                let texture = layer.texture.row(y, 0, width);
                let (strength, pivot) = (layer.strength, layer.pivot);
                pulp::Arch::new().dispatch(Row { colors, texture, mask, strength, pivot });
            }
        });
        Ok(color)
    }
}

struct Evenly<'a> {
    colors: &'a mut [[f32; 4]],
    excess: f32,
}

impl pulp::WithSimd for Evenly<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for color in self.colors {
            *color = changed::<S>(*color, self.excess);
        }
    }
}

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
                    *color = changed::<S>(*color, excess(strength, pivot, t, 1.0));
                }
            }
            Some(mask) => {
                for ((color, &t), &mask) in colors.iter_mut().zip(texture).zip(mask) {
                    *color = changed::<S>(*color, excess(strength, pivot, t, mask));
                }
            }
        }
    }
}

/// A colour of density `1 + excess`; written so that an excess of 0 and 1 are
/// exact. The fourth value goes along unchanged.
#[inline(always)]
fn changed<S: Simd>(color: [f32; 4], excess: f32) -> [f32; 4] {
    let k = if color[3] > 0.0 { excess } else { 0.0 };
    let k = [k, k, k, 0.0];
    let mut out = [0.0; 4];
    for i in 0..4 {
        let kept = multiply_add::<S>(k[i], color[i], 1.0 - k[i]);
        out[i] = lesser(greater(color[i] * kept, 0.0), 1.0);
    }
    out
}

/// Textures of one dispatch.
const AT_ONCE: usize = 4;

/// What the kernel is told.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct DensityNow {
    strength: [f32; 4],
    pivot: [f32; 4],
    size: [u32; 2],
    layers: u32,
    masked: u32,
    /// d - 1 of all.
    overall: f32,
    spare: u32,
    more: [u32; 2],
}

pub(super) static DENSITY: Kernel = Kernel {
    name: "watercolor_density",
    source: include_str!("density.wgsl"),
    parameters: layout!(DensityNow { strength, pivot, size, layers, masked, overall, spare, more }),
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

impl Density for OnGpu {
    fn densified(
        &mut self,
        mut color: Plane,
        overall: f32,
        layers: &[DensityLayer<'_, Plane>],
        mask: Option<&Plane>,
    ) -> Result<Plane, DeviceError> {
        let (width, height) = (color.width(), color.height());
        for grey in layers.iter().map(|layer| layer.texture).chain(mask) {
            assert_eq!((grey.width(), grey.height()), (width, height), "a texture's size");
        }
        let layers: Vec<_> = layers.iter().filter(|layer| layer.strength != 0.0).collect();
        let mut overall = overall - 1.0;
        let mut rest = &layers[..];
        while overall != 0.0 || !rest.is_empty() {
            let (some, after) = rest.split_at(rest.len().min(AT_ONCE));
            let of = |i: usize| some.get(i);
            let now = DensityNow {
                strength: std::array::from_fn(|i| of(i).map_or(0.0, |layer| layer.strength)),
                pivot: std::array::from_fn(|i| of(i).map_or(0.0, |layer| layer.pivot)),
                size: [width as u32, height as u32],
                layers: some.len() as u32,
                masked: u32::from(mask.is_some()),
                overall,
                spare: 0,
                more: [0; 2],
            };
            // Places that are not read are bound to the colours.
            let texture = |i: usize| of(i).map_or(color.buffer(), |l| l.texture.buffer());
            let changed = self.plane(width, height, size_of::<[f32; 4]>())?;
            let buffers = [
                color.buffer(),
                texture(0),
                texture(1),
                texture(2),
                texture(3),
                mask.map_or(texture(0), Plane::buffer),
                changed.buffer(),
            ];
            let groups = [groups(width), groups(height), 1];
            self.recording.dispatch(&DENSITY, &now, &buffers, groups);
            color = changed;
            (overall, rest) = (0.0, after);
        }
        Ok(color)
    }
}
