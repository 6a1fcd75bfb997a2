//! Light, texture and hatching: the colour of every sample, with its grey beside it.

use glam::Vec3;
use rayon::prelude::*;

use graphics::camera::Camera;
use graphics::compute::{ColorImage, Compute, GpuCompute, Image, Plane};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use graphics::surface::{
    DeviceModel, Fragment, Model, NO_TRIANGLE, PackedMaterial, PackedMesh, SurfacePoint, Vertex,
    VisibilityBuffer,
};
use graphics::tones::TONES;

use super::error::DrawingError;
use super::grey::{GreyWeights, Transfer};
use super::look::DrawingLook;
use crate::hatching::{Coordinates, DIRECTIONS_MEET, Hatching, Inking, Placing};

/// Shades what `camera` sees of `model`, which was drawn into `visible`: for each sample its
/// encoded sRGB in 0..1, lit, textured and hatched, and as the fourth value the grey of that
/// colour, both in one pass (ten Bosch 2005). Where no surface is seen all four are 1; coverage
/// is told by `visible`.
///
/// # Errors
/// [`DrawingError::Setting`] for a setting out of range; [`DrawingError::Device`] if a device has
/// no memory left or was lost.
///
/// # Panics
/// If `visible` is of another mesh, or another form of [`Compute`] made an input.
pub fn shade(
    compute: &mut Compute,
    model: &Model,
    visible: &Image<Fragment>,
    camera: &Camera,
    look: &DrawingLook,
    hatching: &Hatching,
) -> Result<ColorImage, DrawingError> {
    look.check()?;
    let height_px = visible.height() / look.samples;
    let of_mesh = (hatching.mesh_is_useful, hatching.bounds);
    let placing = Placing::new(&look.hatching, of_mesh, camera, height_px);
    match compute {
        Compute::Cpu => {
            let shader = Shader::new(model.host().mesh(), look, camera, placing, hatching);
            Ok(shader.picture(visible.host()).into())
        }
        Compute::Gpu(gpu) => {
            let model = model.device();
            let params = ShadeParams::new(look, &placing, camera, visible.size());
            let planes = (visible.plane(), hatching.quads.plane());
            Ok(shade_on_gpu(gpu, model, planes, &params)?.into())
        }
    }
}

/// Shades like [`shade`], but keeps colour and hatching apart, for pictures that lay them in paint:
/// for each sample its colour, lit and textured, with the grey of that colour as the fourth value;
/// and the ink of the strokes at full strength, 0 to 1. On the processor. Where no surface is seen
/// the colour is white, without ink.
///
/// # Errors
/// [`DrawingError::Setting`] for a setting out of range.
///
/// # Panics
/// If `visible` is of another mesh, or `hatching` is in the memory of a device.
pub fn shade_apart(
    mesh: &PackedMesh,
    visible: &VisibilityBuffer,
    camera: &Camera,
    look: &DrawingLook,
    hatching: &Hatching,
) -> Result<(Field<[f32; 4]>, Field<f32>), DrawingError> {
    look.check()?;
    let height_px = visible.height() / look.samples;
    let of_mesh = (hatching.mesh_is_useful, hatching.bounds);
    let placing = Placing::new(&look.hatching, of_mesh, camera, height_px);
    let shader = Shader::new(mesh, look, camera, placing, hatching);
    let width = visible.width();
    let height = visible.height();
    let mut colors = Field::filled(width, height, [1.0; 4]);
    let mut inks = Field::filled(width, height, 0.0);
    let width = width.max(1);
    let rows = colors.values_mut().par_chunks_mut(width);
    let rows = rows.zip(inks.values_mut().par_chunks_mut(width));
    rows.zip(visible.values().par_chunks(width)).for_each(|((colors, inks), seen)| {
        for ((color, ink), fragment) in colors.iter_mut().zip(inks).zip(seen) {
            if fragment.triangle != NO_TRIANGLE {
                (*color, *ink) = shader.apart(*fragment);
            }
        }
    });
    Ok((colors, inks))
}

/// Shades single fragments on the processor.
struct Shader<'a> {
    mesh: &'a PackedMesh,
    look: &'a DrawingLook,
    /// Direction towards the light in model coordinates, of length 1.
    light: Vec3,
    placing: Placing,
    inking: Inking<'a>,
    transfer: &'a Transfer,
}

impl<'a> Shader<'a> {
    fn new(
        mesh: &'a PackedMesh,
        look: &'a DrawingLook,
        camera: &Camera,
        placing: Placing,
        hatching: &'a Hatching,
    ) -> Self {
        let quads = hatching.quads.host().values();
        let inking = Inking::new(quads, look.hatching.softness, look.hatching.width_px);
        let light = look.light.direction(camera);
        Self { mesh, look, light, placing, inking, transfer: Transfer::get() }
    }

    fn picture(&self, visible: &VisibilityBuffer) -> Field<[f32; 4]> {
        let width = visible.width();
        let height = visible.height();
        let mut shaded = Field::filled(width, height, [1.0; 4]);
        shaded.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
            for (shaded, fragment) in row.iter_mut().zip(visible.row(y, 0, width)) {
                if fragment.triangle != NO_TRIANGLE {
                    *shaded = self.shaded(*fragment);
                }
            }
        });
        shaded
    }

    #[inline(always)]
    fn shaded(&self, fragment: Fragment) -> [f32; 4] {
        let (look, hatching) = (self.look, &self.look.hatching);
        let (color, ink) = self.lit(fragment, hatching.inside.max(hatching.outside) > 0.0);
        let ink = ink * (1.0 - hatching.pencil);
        let inside = color * (1.0 - ink * hatching.inside);
        let outside = color * (1.0 - ink * hatching.outside);
        let grey = if look.pale > 0.0 {
            let bare = self.transfer.grey(color, look.weights);
            (bare + (1.0 - bare) * look.pale) * (1.0 - ink * hatching.outside)
        } else {
            self.transfer.grey(outside, look.weights)
        };
        inside.extend(grey).into()
    }

    /// The colour, with its grey, and the ink at full strength.
    fn apart(&self, fragment: Fragment) -> ([f32; 4], f32) {
        let look = self.look;
        let (color, ink) = self.lit(fragment, true);
        let grey = self.transfer.grey(color, look.weights);
        (color.extend(grey + (1.0 - grey) * look.pale).into(), ink)
    }

    /// Colour under the light, and the ink of the strokes there if these are wanted.
    #[inline(always)]
    fn lit(&self, fragment: Fragment, hatched: bool) -> (Vec3, f32) {
        let point = SurfacePoint::new(self.mesh, fragment);
        let look = self.look;
        let normal = point.normal(self.placing.eye);
        let color = point.albedo();
        let (color, light) = if look.lit {
            let light = look.tones.grey(normal.dot(self.light));
            (color * (1.0 - look.shade * (1.0 - light)), light)
        } else {
            (color, look.tones.grey(lifted(self.transfer.grey(color, look.weights))))
        };
        let ink = match hatched {
            true => self.ink(fragment, point.position(), normal, light),
            false => 0.0,
        };
        (color, ink)
    }

    /// Ink of the strokes on a point, 0 to 1.
    #[inline(always)]
    fn ink(&self, fragment: Fragment, position: Vec3, normal: Vec3, light: f32) -> f32 {
        let hatching = &self.look.hatching;
        let tone = hatching.darkest + (1.0 - hatching.darkest) * light;
        if tone >= 1.0 {
            return 0.0;
        }
        let crossed = tone < DIRECTIONS_MEET;
        let mut ink = 0.0;
        for patch in self.placing.patches(self.mesh, fragment, (position, normal), crossed) {
            if patch.weight > 0.0 {
                ink += patch.weight * self.inking.ink(&patch, tone);
            }
        }
        ink.min(1.0)
    }
}

/// Light by the grey of a colour that is not lit: lighter between black and white, as the colour
/// that is seen between the strokes is dark itself.
#[inline(always)]
pub(super) fn lifted(grey: f32) -> f32 {
    grey * (2.0 - grey)
}

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct ShadeParams {
    eye: [f32; 3],
    pixel: f32,
    light: [f32; 3],
    lit: u32,
    origin: [f32; 3],
    tiles: f32,
    size: [u32; 2],
    turn: [f32; 2],
    shade: f32,
    rec601: u32,
    three_planes: u32,
    darkest: f32,
    inside: f32,
    outside: f32,
    pencil: f32,
    softness: f32,
    scale: f32,
    pale: f32,
    padding: [f32; 2],
    greys: [[f32; 4]; TONES / 4],
}

impl ShadeParams {
    fn new(look: &DrawingLook, placing: &Placing, camera: &Camera, size: (usize, usize)) -> Self {
        let hatching = &look.hatching;
        Self {
            eye: placing.eye.into(),
            pixel: placing.pixel,
            light: look.light.direction(camera).into(),
            lit: look.lit.into(),
            origin: placing.origin.into(),
            tiles: placing.tiles,
            size: [size.0 as u32, size.1 as u32],
            turn: placing.turn.into(),
            shade: look.shade,
            rec601: (look.weights == GreyWeights::Rec601).into(),
            three_planes: (placing.coordinates == Coordinates::ThreePlanes).into(),
            darkest: hatching.darkest,
            inside: hatching.inside,
            outside: hatching.outside,
            pencil: hatching.pencil,
            softness: hatching.softness,
            scale: Inking::scale(hatching.width_px),
            pale: look.pale,
            padding: [0.0; 2],
            greys: bytemuck::cast(*look.tones.greys()),
        }
    }
}

pub(crate) static SHADE: Kernel = Kernel {
    name: "volumes_shade",
    source: concat!(include_str!("../hatching/ink.wgsl"), include_str!("shade.wgsl")),
    parameters: layout!(ShadeParams {
        eye,
        pixel,
        light,
        lit,
        origin,
        tiles,
        size,
        turn,
        shade,
        rec601,
        three_planes,
        darkest,
        inside,
        outside,
        pencil,
        softness,
        scale,
        pale,
        padding,
        greys
    }),
    structs: &[Vertex::LAYOUT, PackedMaterial::LAYOUT, Fragment::LAYOUT],
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

fn shade_on_gpu(
    gpu: &mut GpuCompute,
    model: &DeviceModel,
    (visible, quads): (&Plane<Fragment>, &Plane<u32>),
    params: &ShadeParams,
) -> Result<Plane<[f32; 4]>, DeviceError> {
    let (width, height) = visible.size();
    let shaded = gpu.plane(width, height)?;
    let DeviceModel { vertices, triangles, materials, texels, .. } = model;
    let visible = visible.buffer();
    let quads = quads.buffer();
    let buffers = [vertices, triangles, materials, texels, visible, quads, shaded.buffer()];
    gpu.dispatch(&SHADE, params, &buffers, (width, height));
    Ok(shaded)
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod stroke_widths;
