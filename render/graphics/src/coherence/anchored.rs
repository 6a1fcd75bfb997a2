//! Textures that follow particles, blended pixel by pixel.

use glam::Vec3;
use rayon::prelude::*;

use super::particles::{Anchor, Anchors, MOST_OCTAVES};
use crate::field::Field;
use crate::gpu::{DeviceError, Kernel, Storage, groups, layout};
use crate::image::Backend;
use crate::image::OnCpu;
use crate::image::{OnGpu, Plane};

/// Draws textures that follow particles.
pub trait Anchoring: Backend {
    /// 0.5 and what the copies of `texture` differ from it, cut off at 0 and 1; 0.5
    /// where nothing is seen, which `depth` (0 near to 1, nothing) of the picture
    /// tells.
    ///
    /// A copy's weight falls with the square s of its distance from the place that
    /// the pixel sees, as `(1 - (s - s of the nearest) / reach)^2`. Blending takes
    /// contrast away; it is given back by the root of the sum of squared weights,
    /// which is right where copies do not resemble each other (Heeger and Bergen
    /// 1995).
    ///
    /// # Errors
    /// [`DeviceError`] if the device has no room or is lost; never on the processor.
    ///
    /// # Panics
    /// If the sides of the texture, which repeats, are not powers of two, or
    /// `depth` is not of the anchors' picture.
    fn anchored(
        &mut self,
        depth: &Self::Grey,
        texture: &Self::Grey,
        anchors: &Anchors,
    ) -> Result<Self::Grey, DeviceError>;
}

fn check(depth: (usize, usize), texture: (usize, usize), anchors: &Anchors) {
    let (width, height) = texture;
    let repeats = width.is_power_of_two() && height.is_power_of_two();
    assert!(repeats, "a texture of {width} x {height}");
    let picture = (anchors.sight.width, anchors.sight.height);
    assert_eq!(depth, picture, "depth of another picture");
}

/// The value at a place of a texture that repeats, between its four nearest.
fn bilinear(texture: &Field<f32>, x: f32, y: f32) -> f32 {
    let (left, top) = (x.floor(), y.floor());
    let (right, down) = (x - left, y - top);
    let (columns, rows) = (texture.width() - 1, texture.height() - 1);
    let (i, j) = (left as i32 as usize, top as i32 as usize);
    let values = texture.values();
    let upper = (j & rows) * texture.width();
    let lower = (j.wrapping_add(1) & rows) * texture.width();
    let (i, next) = (i & columns, i.wrapping_add(1) & columns);
    let above = values[upper + i] + (values[upper + next] - values[upper + i]) * right;
    let below = values[lower + i] + (values[lower + next] - values[lower + i]) * right;
    above + (below - above) * down
}

/// By how much a copy differs from 0.5 at a pixel, `right` and `down` of its anchor.
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

impl Anchoring for OnCpu {
    fn anchored(
        &mut self,
        depth: &Field<f32>,
        texture: &Field<f32>,
        anchors: &Anchors,
    ) -> Result<Field<f32>, DeviceError> {
        let size = (depth.width(), depth.height());
        check(size, (texture.width(), texture.height()), anchors);
        let mut blended = Field::filled(size.0, size.1, 0.5);
        let rows = blended.values_mut().par_chunks_mut(size.0.max(1)).enumerate();
        rows.for_each_init(
            || vec![0.0f32; anchors.each.len()],
            |distances, (y, values)| {
                let depths = depth.row(y, 0, size.0);
                for (x, (value, &depth)) in values.iter_mut().zip(depths).enumerate() {
                    if depth < 1.0 {
                        let place = anchors.sight.place((x, y), depth);
                        let at = [x as f32 + 0.5, y as f32 + 0.5];
                        let sum = blend(texture, anchors, place, at, distances);
                        *value = (0.5 + sum).clamp(0.0, 1.0);
                    }
                }
            },
        );
        Ok(blended)
    }
}

fn blend(
    texture: &Field<f32>,
    anchors: &Anchors,
    place: Vec3,
    at: [f32; 2],
    distances: &mut [f32],
) -> f32 {
    let mut nearest = f32::INFINITY;
    for (distance, anchor) in distances.iter_mut().zip(&anchors.each) {
        *distance = place.distance_squared(anchor.place.into());
        nearest = nearest.min(*distance);
    }
    let (mut sum, mut squares) = (0.0, 0.0);
    for (distance, anchor) in distances.iter().zip(&anchors.each) {
        let near = 1.0 - (distance - nearest) / anchors.reach_squared;
        if near > 0.0 {
            let weight = near * near * anchor.presence;
            let (right, down) = (at[0] - anchor.x, at[1] - anchor.y);
            sum += weight * copy(texture, anchor, anchors.octaves, right, down);
            squares += weight * weight;
        }
    }
    sum / squares.sqrt()
}

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Anchored {
    model_from_clip: [[f32; 4]; 4],
    width: u32,
    height: u32,
    texture_width: u32,
    texture_height: u32,
    /// Of the anchors in the batch.
    first: u32,
    count: u32,
    octaves: u32,
    reach_squared: f32,
}

/// The kernel of textures that follow particles.
pub static ANCHOR_TEXTURES: Kernel = Kernel {
    name: "anchor_textures",
    source: include_str!("anchored.wgsl"),
    parameters: layout!(Anchored {
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
    structs: &[layout!(Anchor { place, presence, x, y, texels, spare, weights, right, down })],
    storage: &[Storage::Read, Storage::Read, Storage::Batch, Storage::Write],
};

impl Anchoring for OnGpu {
    fn anchored(
        &mut self,
        depth: &Plane,
        texture: &Plane,
        anchors: &Anchors,
    ) -> Result<Plane, DeviceError> {
        let (width, height) = (depth.width(), depth.height());
        check((width, height), (texture.width(), texture.height()), anchors);
        let blended = self.plane(width, height, size_of::<f32>())?;
        let parameters = Anchored {
            model_from_clip: anchors.sight.model_from_clip().to_cols_array_2d(),
            width: width as u32,
            height: height as u32,
            texture_width: texture.width() as u32,
            texture_height: texture.height() as u32,
            first: self.recording.batch(&anchors.each),
            count: anchors.each.len() as u32,
            octaves: anchors.octaves.min(MOST_OCTAVES) as u32,
            reach_squared: anchors.reach_squared,
        };
        self.recording.dispatch(
            &ANCHOR_TEXTURES,
            &parameters,
            &[depth.buffer(), texture.buffer(), blended.buffer()],
            [groups(width), groups(height), 1],
        );
        Ok(blended)
    }
}
