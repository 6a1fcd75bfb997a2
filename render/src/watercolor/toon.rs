//! Toon shading: surfaces in a few steps of light.
//!
//! Bousseau, Kaplan, Thollot and Sillion 2006, section 3.1: the diffuse term n . l selects a
//! grey from a one-dimensional texture, and the grey sets the density d at which the colour
//! C of the surface is painted, as all of their watercolor does:
//! `C (1 - (1 - C) (d - 1))` with `d = 1 + strength (0.5 - grey)`, at least 0. So shade is
//! thick paint, light is thin paint, and white stays white.

use glam::Vec3;
use rayon::prelude::*;

use graphics::camera::Camera;
use graphics::compute::{ColorImage, Compute, GpuCompute, Image, Plane};
use graphics::distant_light::DistantLight;
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use graphics::surface::{
    DeviceModel, Fragment, Model, NO_TRIANGLE, PackedMaterial, PackedMesh, SurfacePoint, Vertex,
    VisibilityBuffer,
};
use graphics::tones::{TONES, ToneRamp};

/// How surfaces are lit.
#[derive(Debug, Clone, PartialEq)]
pub struct Toon {
    /// Direction of the light.
    pub light: DistantLight,
    /// Grey by the cosine between light and surface.
    pub tones: ToneRamp,
    /// Density gained from grey 1 to grey 0; 0 shows colours without light.
    pub strength: f32,
    /// Samples along each side of a pixel, 1 and up. The visibility buffer is this many
    /// times as wide and high as the picture.
    pub samples: usize,
}

impl Default for Toon {
    /// Four soft steps, lit from the upper left.
    fn default() -> Self {
        Self {
            light: DistantLight::with_camera(315.0, 40.0),
            tones: ToneRamp::steps(4, 0.15),
            strength: 1.6,
            samples: 1,
        }
    }
}

/// Shades what `camera` sees of `model`, which was drawn into `visible`: encoded sRGB in
/// 0..1, with the share of the pixel that surfaces cover, and (1, 1, 1, 0) where there are
/// none. The picture is `toon.samples` times smaller than `visible`.
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
///
/// # Panics
/// If `visible` is of another mesh, its size is no multiple of the samples, or another form
/// of [`Compute`] made an input.
pub fn shade_toon(
    compute: &mut Compute,
    model: &Model,
    visible: &Image<Fragment>,
    camera: &Camera,
    toon: &Toon,
) -> Result<ColorImage, DeviceError> {
    let ((width, height), samples) = (visible.size(), toon.samples);
    let whole = samples > 0 && width.is_multiple_of(samples) && height.is_multiple_of(samples);
    assert!(whole, "a visibility buffer of {width} x {height} for {samples} samples a pixel");
    let size = (width / samples, height / samples);
    match compute {
        Compute::Cpu => {
            let mesh = model.host().mesh();
            Ok(shade_toon_on_cpu(mesh, visible.host(), size, camera, toon).into())
        }
        Compute::Gpu(gpu) => {
            shade_toon_on_gpu(gpu, model.device(), visible.plane(), size, camera, toon)
                .map(Image::from)
        }
    }
}

/// A pixel that shows bare paper.
const PAPER: [f32; 4] = [1.0, 1.0, 1.0, 0.0];

fn shade_toon_on_cpu(
    mesh: &PackedMesh,
    visible: &VisibilityBuffer,
    (width, height): (usize, usize),
    camera: &Camera,
    toon: &Toon,
) -> Field<[f32; 4]> {
    let mut color = Field::filled(width, height, PAPER);
    let light = toon.light.direction(camera);
    let shader = Shader { mesh, eye: camera.eye, light, toon };
    color.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        if toon.samples == 1 {
            for (pixel, fragment) in row.iter_mut().zip(visible.row(y, 0, width)) {
                if fragment.triangle != NO_TRIANGLE {
                    *pixel = shader.color(*fragment).extend(1.0).into();
                }
            }
            return;
        }
        for (x, pixel) in row.iter_mut().enumerate() {
            let mut sum = glam::Vec4::ZERO;
            for line in 0..toon.samples {
                let y = y * toon.samples + line;
                for fragment in visible.row(y, x * toon.samples, toon.samples) {
                    if fragment.triangle != NO_TRIANGLE {
                        sum += shader.color(*fragment).extend(1.0);
                    }
                }
            }
            if sum.w > 0.0 {
                let share = sum.w / (toon.samples * toon.samples) as f32;
                *pixel = (sum.truncate() / sum.w).extend(share).into();
            }
        }
    });
    color
}

/// Shades single fragments on the processor.
struct Shader<'a> {
    mesh: &'a PackedMesh,
    eye: Vec3,
    /// Direction towards the light in model coordinates, of length 1.
    light: Vec3,
    toon: &'a Toon,
}

impl Shader<'_> {
    #[inline]
    fn color(&self, fragment: Fragment) -> Vec3 {
        let point = SurfacePoint::new(self.mesh, fragment);
        let grey = self.toon.tones.grey(point.normal(self.eye).dot(self.light));
        let excess = (self.toon.strength * (0.5 - grey)).max(-1.0);
        let albedo = point.albedo();
        (albedo * (Vec3::ONE - (Vec3::ONE - albedo) * excess)).clamp(Vec3::ZERO, Vec3::ONE)
    }
}

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct ToonParams {
    eye: [f32; 3],
    strength: f32,
    light: [f32; 3],
    samples: u32,
    size: [u32; 2],
    spare: [u32; 2],
    greys: [[f32; 4]; TONES / 4],
}

pub(super) static TOON: Kernel = Kernel {
    name: "watercolor_toon",
    source: include_str!("toon.wgsl"),
    parameters: layout!(ToonParams { eye, strength, light, samples, size, spare, greys }),
    structs: &[Vertex::LAYOUT, PackedMaterial::LAYOUT, Fragment::LAYOUT],
    storage: &[
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Write,
    ],
};

fn shade_toon_on_gpu(
    gpu: &mut GpuCompute,
    model: &DeviceModel,
    visible: &Plane<Fragment>,
    (width, height): (usize, usize),
    camera: &Camera,
    toon: &Toon,
) -> Result<Plane<[f32; 4]>, DeviceError> {
    let params = ToonParams {
        eye: camera.eye.into(),
        strength: toon.strength,
        light: toon.light.direction(camera).into(),
        samples: toon.samples as u32,
        size: [width as u32, height as u32],
        spare: [0; 2],
        greys: bytemuck::cast(*toon.tones.greys()),
    };
    let color = gpu.plane(width, height)?;
    let DeviceModel { vertices, triangles, materials, texels, .. } = model;
    let buffers = [vertices, triangles, materials, texels, visible.buffer(), color.buffer()];
    gpu.dispatch(&TOON, &params, &buffers, (width, height));
    Ok(color)
}
