//! Blends the copies of a texture that follow particles, pixel by pixel.

use glam::Vec3;
use rayon::prelude::*;

use super::particles::{Anchor, Anchors, MOST_OCTAVES};
use crate::compute::{Compute, GpuCompute, GreyImage, Image, Plane, assert_size};
use crate::field::Field;
use crate::gpu::{DeviceError, Kernel, Storage, layout};

/// Draws a texture that follows particles: 0.5 plus the blended differences of its copies
/// from 0.5, clamped to 0..1. Pixels whose `depth` is 1 show no surface and get 0.5.
///
/// The weight of a copy is `(1 - (s - s_min) / reach)^2`, where s is the squared distance of
/// its particle from the position that the pixel shows and s_min that of the nearest one.
/// Blending lowers contrast; the sum is divided by the root of the sum of squared weights,
/// which restores it where copies are uncorrelated (Heeger and Bergen 1995).
///
/// # Errors
/// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
///
/// # Panics
/// If the width or height of the texture, which repeats, is not a power of two, if `depth`
/// does not have the size of the anchors' projection, or if another form of [`Compute`]
/// made an image.
pub fn draw_anchored(
    compute: &mut Compute,
    depth: &GreyImage,
    texture: &GreyImage,
    anchors: &Anchors,
) -> Result<GreyImage, DeviceError> {
    let (width, height) = texture.size();
    let repeats = width.is_power_of_two() && height.is_power_of_two();
    assert!(repeats, "a repeating texture has sides of powers of two, found {width} x {height}");
    assert_size("depth", depth.size(), (anchors.projection.width, anchors.projection.height));
    match compute {
        Compute::Cpu => Ok(draw_anchored_on_cpu(depth.host(), texture.host(), anchors).into()),
        Compute::Gpu(gpu) => {
            draw_anchored_on_gpu(gpu, depth.plane(), texture.plane(), anchors).map(Image::from)
        }
    }
}

/// The value of a repeating texture at (x, y), bilinear between its four nearest texels.
fn bilinear(texture: &Field<f32>, x: f32, y: f32) -> f32 {
    let left = x.floor();
    let top = y.floor();
    let right = x - left;
    let down = y - top;
    let columns = texture.width() - 1;
    let rows = texture.height() - 1;
    let i = left as i32 as usize;
    let j = top as i32 as usize;
    let values = texture.values();
    let upper = (j & rows) * texture.width();
    let lower = (j.wrapping_add(1) & rows) * texture.width();
    let (i, next) = (i & columns, i.wrapping_add(1) & columns);
    let above = values[upper + i] + (values[upper + next] - values[upper + i]) * right;
    let below = values[lower + i] + (values[lower + next] - values[lower + i]) * right;
    above + (below - above) * down
}

/// The difference of a copy from 0.5 at a pixel that is `right` and `down` of its anchor.
fn copy(texture: &Field<f32>, anchor: &Anchor, octaves: usize, right: f32, down: f32) -> f32 {
    let mut texels = anchor.texels;
    let mut sum = 0.0;
    for octave in 0..octaves {
        let x = right * texels + anchor.right[octave];
        let y = down * texels + anchor.down[octave];
        sum += anchor.weights[octave] * (bilinear(texture, x, y) - 0.5);
        texels *= 0.5;
    }
    sum
}

fn draw_anchored_on_cpu(depth: &Field<f32>, texture: &Field<f32>, anchors: &Anchors) -> Field<f32> {
    let width = depth.width();
    let height = depth.height();
    let mut blended = Field::filled(width, height, 0.5);
    let rows = blended.values_mut().par_chunks_mut(width.max(1)).enumerate();
    rows.for_each_init(
        || vec![0.0f32; anchors.each.len()],
        |distances, (y, values)| {
            let depths = depth.row(y, 0, width);
            for (x, (value, &depth)) in values.iter_mut().zip(depths).enumerate() {
                if depth < 1.0 {
                    let position = anchors.projection.unproject((x, y), depth);
                    let at = [x as f32 + 0.5, y as f32 + 0.5];
                    let sum = blend(texture, anchors, position, at, distances);
                    *value = (0.5 + sum).clamp(0.0, 1.0);
                }
            }
        },
    );
    blended
}

/// The blend of all copies at a pixel that shows `position`; `distances` is scratch memory,
/// one number for each anchor.
fn blend(
    texture: &Field<f32>,
    anchors: &Anchors,
    position: Vec3,
    at: [f32; 2],
    distances: &mut [f32],
) -> f32 {
    let mut nearest = f32::INFINITY;
    for (distance, anchor) in distances.iter_mut().zip(&anchors.each) {
        *distance = position.distance_squared(anchor.position.into());
        nearest = nearest.min(*distance);
    }
    let mut sum = 0.0;
    let mut squares = 0.0;
    for (distance, anchor) in distances.iter().zip(&anchors.each) {
        let near = 1.0 - (distance - nearest) / anchors.reach_squared;
        if near > 0.0 {
            let weight = near * near * anchor.presence;
            let right = at[0] - anchor.x;
            let down = at[1] - anchor.y;
            sum += weight * copy(texture, anchor, anchors.octaves, right, down);
            squares += weight * weight;
        }
    }
    sum / squares.sqrt()
}

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct AnchoredParams {
    model_from_clip: [[f32; 4]; 4],
    width: u32,
    height: u32,
    texture_width: u32,
    texture_height: u32,
    /// Index of the first anchor in the batch.
    first: u32,
    count: u32,
    octaves: u32,
    reach_squared: f32,
}

/// The kernel that blends the copies of a texture at each pixel.
pub static ANCHOR_TEXTURES: Kernel = Kernel {
    name: "anchor_textures",
    source: include_str!("anchored.wgsl"),
    parameters: layout!(AnchoredParams {
        model_from_clip,
        width,
        height,
        texture_width,
        texture_height,
        first,
        count,
        octaves,
        reach_squared,
    }),
    structs: &[layout!(Anchor { position, presence, x, y, texels, spare, weights, right, down })],
    storage: &[Storage::Read, Storage::Read, Storage::Batch, Storage::Write],
};

fn draw_anchored_on_gpu(
    gpu: &mut GpuCompute,
    depth: &Plane<f32>,
    texture: &Plane<f32>,
    anchors: &Anchors,
) -> Result<Plane<f32>, DeviceError> {
    let (width, height) = depth.size();
    let (texture_width, texture_height) = texture.size();
    let blended = gpu.plane(width, height)?;
    let params = AnchoredParams {
        model_from_clip: anchors.projection.model_from_clip().to_cols_array_2d(),
        width: width as u32,
        height: height as u32,
        texture_width: texture_width as u32,
        texture_height: texture_height as u32,
        first: gpu.batch(&anchors.each),
        count: anchors.each.len() as u32,
        octaves: anchors.octaves.min(MOST_OCTAVES) as u32,
        reach_squared: anchors.reach_squared,
    };
    let buffers = [depth.buffer(), texture.buffer(), blended.buffer()];
    gpu.dispatch(&ANCHOR_TEXTURES, &params, &buffers, (width, height));
    Ok(blended)
}
