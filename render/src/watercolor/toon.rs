//! Toon shading: the colours of surfaces, deeper and paler by steps of light.
//!
//! Bousseau, Kaplan, Thollot and Sillion 2006, section 3.1: the diffuse term n . l
//! finds a grey in a texture of one dimension, and that changes the colour C of the
//! surface as everything in their watercolor does, by its density d:
//! `C (1 - (1 - C) (d - 1))`, here with `d = 1 + strength (0.5 - grey)` and at
//! least 0. So shade is thick paint, light is thin paint, and white stays white.

use std::sync::Arc;

use glam::Vec3;
use rayon::prelude::*;

use graphics::camera::Camera;
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, groups, layout};
use graphics::image::OnCpu;
use graphics::image::{CpuModel, GpuModel, Models};
use graphics::image::{OnGpu, Plane};
use graphics::surface::{Coating, NOTHING, PackedMesh, Seen, Vertex, Visible};
use graphics::tones::{TONES, ToneRamp};

/// How surfaces are lit.
#[derive(Debug, Clone, PartialEq)]
pub struct Toon {
    /// From where.
    pub light: Light,
    /// Grey by light.
    pub tones: ToneRamp,
    /// What density gains from grey 1 to grey 0; 0 shows colours as they are.
    pub strength: f32,
    /// Samples of a pixel along each side, 1 and up: what is seen was drawn so many
    /// times as wide and high.
    pub samples: usize,
}

/// Light from afar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Light {
    /// It goes along with the camera; towards it, x to the right in the picture, y
    /// upwards, z towards the viewer.
    WithCamera(Vec3),
    /// It stays where it is; towards it, in the axes of the model.
    WithModel(Vec3),
}

impl Light {
    /// Along with the camera: `azimuth_deg` clockwise from the top of the picture,
    /// `elevation_deg` from its plane (0) towards the viewer (90).
    #[must_use]
    pub fn with_camera(azimuth_deg: f32, elevation_deg: f32) -> Self {
        let (sin_a, cos_a) = azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = elevation_deg.to_radians().sin_cos();
        Self::WithCamera(Vec3::new(sin_a * cos_e, cos_a * cos_e, sin_e))
    }

    /// Towards it in the axes of the model, of length 1; zeros have no light.
    fn direction(self, camera: &Camera) -> Vec3 {
        let direction = match self {
            Self::WithModel(direction) => direction,
            Self::WithCamera(Vec3 { x, y, z }) => {
                let [right, up, back] = camera.axes();
                right * x + up * y + back * z
            }
        };
        direction.normalize_or_zero()
    }
}

impl Default for Toon {
    /// Four soft steps, lit from the upper left.
    fn default() -> Self {
        Self {
            light: Light::with_camera(315.0, 40.0),
            tones: ToneRamp::steps(4, 0.15),
            strength: 1.6,
            samples: 1,
        }
    }
}

/// Shades what is seen.
pub trait Shading: Models {
    /// The colours of what `camera` sees, encoded sRGB in 0..1, with the share of the
    /// pixel that surfaces cover; 1, 1, 1, 0 where there is none. The picture is
    /// `toon.samples` times smaller than `visible`.
    ///
    /// # Errors
    /// As [`super::Backend::color_of`].
    ///
    /// # Panics
    /// If `visible` is of another mesh, or no multiple of the samples.
    fn toon(
        &mut self,
        model: &Self::Model,
        visible: &Self::Visible,
        camera: &Camera,
        toon: &Toon,
    ) -> Result<Self::Color, DeviceError>;
}

/// The picture's size, of what is seen.
fn size(seen: (usize, usize), samples: usize) -> (usize, usize) {
    let whole = samples > 0 && seen.0.is_multiple_of(samples) && seen.1.is_multiple_of(samples);
    assert!(whole, "{} x {} seen, {samples} samples a pixel", seen.0, seen.1);
    (seen.0 / samples, seen.1 / samples)
}

/// What bare paper is.
const PAPER: [f32; 4] = [1.0, 1.0, 1.0, 0.0];

impl Shading for OnCpu {
    fn toon(
        &mut self,
        model: &CpuModel,
        visible: &Arc<Visible>,
        camera: &Camera,
        toon: &Toon,
    ) -> Result<Field<[f32; 4]>, DeviceError> {
        let (width, height) = size((visible.width(), visible.height()), toon.samples);
        let mut color = Field::filled(width, height, PAPER);
        if width == 0 {
            return Ok(color);
        }
        let light = toon.light.direction(camera);
        let shaded = Shaded { mesh: &model.mesh, eye: camera.eye, light, toon };
        color.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            if toon.samples == 1 {
                for (pixel, seen) in row.iter_mut().zip(visible.row(y, 0, width)) {
                    if seen.triangle != NOTHING {
                        *pixel = shaded.color(*seen).extend(1.0).into();
                    }
                }
                return;
            }
            for (x, pixel) in row.iter_mut().enumerate() {
                let mut sum = glam::Vec4::ZERO;
                for line in 0..toon.samples {
                    let y = y * toon.samples + line;
                    for seen in visible.row(y, x * toon.samples, toon.samples) {
                        if seen.triangle != NOTHING {
                            sum += shaded.color(*seen).extend(1.0);
                        }
                    }
                }
                if sum.w > 0.0 {
                    let share = sum.w / (toon.samples * toon.samples) as f32;
                    *pixel = (sum.truncate() / sum.w).extend(share).into();
                }
            }
        });
        Ok(color)
    }
}

/// What shades a pixel.
struct Shaded<'a> {
    mesh: &'a PackedMesh,
    eye: Vec3,
    light: Vec3,
    toon: &'a Toon,
}

impl Shaded<'_> {
    #[inline]
    fn color(&self, seen: Seen) -> Vec3 {
        let facet = self.mesh.facet(seen);
        let grey = self.toon.tones.grey(facet.normal(self.eye).dot(self.light));
        let excess = (self.toon.strength * (0.5 - grey)).max(-1.0);
        let albedo = facet.albedo();
        (albedo * (Vec3::ONE - (Vec3::ONE - albedo) * excess)).clamp(Vec3::ZERO, Vec3::ONE)
    }
}

/// What the kernel is told.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct ToonNow {
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
    parameters: layout!(ToonNow { eye, strength, light, samples, size, spare, greys }),
    structs: &[Vertex::LAYOUT, Coating::LAYOUT, Seen::LAYOUT],
    storage: &[
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Write,
    ],
};

impl Shading for OnGpu {
    fn toon(
        &mut self,
        model: &GpuModel,
        visible: &Plane,
        camera: &Camera,
        toon: &Toon,
    ) -> Result<Plane, DeviceError> {
        let (width, height) = size((visible.width(), visible.height()), toon.samples);
        let now = ToonNow {
            eye: camera.eye.into(),
            strength: toon.strength,
            light: toon.light.direction(camera).into(),
            samples: toon.samples as u32,
            size: [width as u32, height as u32],
            spare: [0; 2],
            greys: bytemuck::cast(*toon.tones.greys()),
        };
        let color = self.plane(width, height, size_of::<[f32; 4]>())?;
        let GpuModel { vertices, triangles, coatings, texels, .. } = model;
        let buffers = [vertices, triangles, coatings, texels, visible.buffer(), color.buffer()];
        self.recording.dispatch(&TOON, &now, &buffers, [groups(width), groups(height), 1]);
        Ok(color)
    }
}
