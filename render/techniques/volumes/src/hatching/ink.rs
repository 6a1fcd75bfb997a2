//! The ink that hatching puts on a point of a surface. Also hatching in the memory of a
//! [`Compute`]. `ink.wgsl` is the twin of this file in WGSL.

use glam::Vec3;
use graphics::compute::{Compute, Image};
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::surface::PackedMesh;

use super::coordinates::{Patch, has_useful_coordinates};
use super::strokes::{SIDE, WIDTH_TEXELS};
use super::threshold::{SLICES, ThresholdTexture};

/// Below this tone, we lay strokes across over the strokes along. These are the two darkest of six
/// tones.
pub const DIRECTIONS_MEET: f32 = 0.4;

/// Least and greatest octave of the density of strokes. Beyond them we do not scale the coordinates
/// further.
const OCTAVES: [i32; 2] = [-8, 14];

const SECOND: f32 = std::f32::consts::SQRT_2;

/// Offset in the texture of the strokes across, so that they differ from the strokes along.
const ACROSS_FROM: f32 = 0.37;

/// Tones of the strokes along and across. Together they leave the share `tone` of bare paper,
/// which is the product of what each leaves. Both rise with the tone.
#[must_use]
#[inline(always)]
pub fn crossed_tones(tone: f32) -> [f32; 2] {
    if tone >= DIRECTIONS_MEET {
        return [tone, 1.0];
    }
    let part = if tone > 0.0 { tone / DIRECTIONS_MEET } else { 0.0 };
    let root = part.sqrt();
    let fourth = root.sqrt();
    [DIRECTIONS_MEET * fourth, root * fourth]
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Inking<'a> {
    quads: &'a [u32],
    sharpness: f32,
    scale: f32,
}

impl<'a> Inking<'a> {
    /// # Panics
    /// If `quads` does not hold all texels of all slices.
    pub(crate) fn new(quads: &'a [u32], softness: f32, width_px: f32) -> Self {
        assert_eq!(quads.len(), SLICES * SIDE * SIDE, "texels of a threshold texture");
        Self { quads, sharpness: 0.5 / softness, scale: Self::scale(width_px) }
    }

    /// Tiles per pixel at which strokes of the first slice are `width_px` wide.
    pub(crate) fn scale(width_px: f32) -> f32 {
        WIDTH_TEXELS / (width_px * SIDE as f32)
    }

    /// Ink of a tone (0 dark, 1 bare paper) on a patch of a surface, 0 to 1.
    #[inline(always)]
    pub(crate) fn ink(&self, patch: &Patch, tone: f32) -> f32 {
        if tone >= 1.0 {
            return 0.0;
        }
        let [along, across] = crossed_tones(tone);
        let ink = self.strokes([patch.u, patch.v], patch.v_per_px, along);
        if across >= 1.0 {
            return ink;
        }
        let crossed = self.strokes(
            [patch.u - 2.0 * patch.v + ACROSS_FROM, 2.0 * patch.u + patch.v],
            patch.across_per_px,
            across,
        );
        1.0 - (1.0 - ink) * (1.0 - crossed)
    }

    /// Ink of strokes along the first coordinate. The second one changes by `per_px` from pixel to
    /// pixel.
    #[inline(always)]
    fn strokes(&self, at: [f32; 2], per_px: f32, tone: f32) -> f32 {
        // Density of strokes. It is 1 in the first slice with unscaled coordinates.
        let density = (self.scale / per_px.max(1e-12)).to_bits();
        let octave = (density >> 23) as i32 - 127;
        let part = f32::from_bits((density & 0x7f_ffff) | 0x3f80_0000);
        // A slice gives way to the next all the time, because you do not see slow change.
        let (slice, passed) = match part < SECOND {
            true => (0, (part - 1.0) / (SECOND - 1.0)),
            false => (1, (part - SECOND) / (2.0 - SECOND)),
        };
        let ink = self.inked(self.threshold(at, octave, slice), tone);
        let next = self.inked(self.threshold(at, octave + slice as i32, 1 - slice), tone);
        let ink = ink + (next - ink) * passed;
        // We fade the lightest tones, so that light itself is bare paper.
        ink * ((1.0 - tone) * self.sharpness * 4.0).min(1.0)
    }

    /// The threshold, 0 to 1, at a place of the tile, in a slice and an octave of density.
    #[inline(always)]
    fn threshold(&self, at: [f32; 2], octave: i32, slice: usize) -> f32 {
        let octave = octave.clamp(OCTAVES[0], OCTAVES[1]);
        // 2^octave tiles in one.
        let texels = f32::from_bits(((octave + 127) as u32) << 23) * SIDE as f32;
        let [x, y] = at.map(|at| at * texels - 0.5);
        let [column, row] = [x, y].map(floor);
        let [right, down] = [x - column as f32, y - row as f32].map(|part| part.clamp(0.0, 1.0));
        let mask = SIDE as i32 - 1;
        let texel = (row & mask) as usize * SIDE + (column & mask) as usize;
        let quad = self.quads[slice * SIDE * SIDE + texel];
        let [a, b, c, d] = quad.to_le_bytes().map(f32::from);
        let above = a + (b - a) * right;
        let below = c + (d - c) * right;
        (above + (below - above) * down) * (1.0 / 255.0)
    }

    /// Ink of a texel, 0 to 1. It rises from 0 to 1 while the tone falls from just above the
    /// threshold of the texel to just below it (Webb et al. 2002).
    #[inline(always)]
    fn inked(&self, threshold: f32, tone: f32) -> f32 {
        let at = ((tone - threshold) * self.sharpness + 0.5).clamp(0.0, 1.0);
        1.0 - at * at * (3.0 - 2.0 * at)
    }
}

/// Rounds down to a whole number. Numbers beyond the range of i32 become its limits.
#[inline(always)]
fn floor(value: f32) -> i32 {
    let whole = value as i32;
    whole.wrapping_sub(i32::from(whole as f32 > value))
}

/// Strokes in the memory of a [`Compute`], and how they lie on one model. You make this once for a
/// model.
#[derive(Debug, Clone)]
pub struct Hatching {
    pub(crate) quads: Image<u32>,
    pub(crate) mesh_is_useful: bool,
    pub(crate) bounds: [Vec3; 2],
}

impl Hatching {
    /// Copies the strokes of `texture` into the memory of `compute`, for `mesh`.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
    pub fn new(
        compute: &mut Compute,
        texture: &ThresholdTexture,
        mesh: &PackedMesh,
    ) -> Result<Self, DeviceError> {
        let quads = texture.quads().to_vec();
        let quads = Field::from_values(SIDE, quads.len() / SIDE, quads);
        Ok(Self {
            quads: compute.upload(&quads)?,
            mesh_is_useful: has_useful_coordinates(mesh),
            bounds: mesh.bounds,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hatching::{ThresholdTexture, sample_texture};

    const SOFTNESS: f32 = 0.12;

    /// Side of the texture on the screen in the first slice, for strokes 2.8 pixels wide.
    const TEXTURE_PX: f32 = 2.8 * SIDE as f32 / WIDTH_TEXELS;

    fn inking(texture: &ThresholdTexture) -> Inking<'_> {
        Inking::new(texture.quads(), SOFTNESS, 2.8)
    }

    /// The patch at (x, y) of a tile. You see the side of the tile in `side_px` pixels.
    fn patch([x, y]: [f32; 2], side_px: f32) -> Patch {
        let [u, v] = [x, y].map(|at| at / side_px);
        let per_px = 1.0 / side_px;
        Patch { u, v, across_per_px: 5.0_f32.sqrt() * per_px, v_per_px: per_px, weight: 1.0 }
    }

    #[test]
    fn ink_of_a_tone_is_part_of_that_of_every_darker_one() {
        let inking = inking(sample_texture());
        for y in 0..256 {
            for x in 0..256 {
                let patch = patch([x as f32 + 0.5, y as f32 + 0.5], 280.0);
                let mut before = 1.0;
                for tone in 0..=64 {
                    let ink = inking.ink(&patch, tone as f32 / 64.0);
                    assert!(ink <= before, "{x} {y} {tone}: {ink} {before}");
                    before = ink;
                }
                assert_eq!(before, 0.0);
            }
        }
    }

    #[test]
    fn mean_ink_is_the_tone_at_every_zoom() {
        let inking = inking(sample_texture());
        for side_px in [32.0, 45.0, 100.0, 256.0, 300.0, 700.0, 1500.0] {
            let pixels = 160;
            // We take all of the texture. A tile of the model is a part of it, or contains it many
            // times.
            let whole = side_px * (TEXTURE_PX / side_px).log2().ceil().exp2();
            for tone in 0..=64 {
                let tone = tone as f32 / 64.0;
                let mut sum = 0.0;
                for y in 0..pixels {
                    for x in 0..pixels {
                        let at = [x, y].map(|at: i32| (at as f32 + 0.5) / pixels as f32 * whole);
                        let ink = inking.ink(&patch(at, side_px), tone);
                        sum += f64::from(ink);
                    }
                }
                let mean = sum / f64::from(pixels * pixels);
                assert!((mean - f64::from(1.0 - tone)).abs() < 0.03, "{side_px} {tone}: {mean}");
            }
        }
    }

    #[test]
    fn strokes_keep_their_width_on_the_screen() {
        let inking = inking(sample_texture());
        // Tiles of 37 to 1500 px, through all slices of all octaves between.
        for zoom in 0..=48 {
            let side_px = 37.0 * (1500.0_f32 / 37.0).powf(zoom as f32 / 48.0);
            for tone in [0.8, 0.7, 0.6] {
                let mut inked = 0.0;
                let mut runs = 0.0;
                for column in 0..160 {
                    let mut last = 0.0;
                    for row in 0..480 {
                        let at = [column as f32 * 4.0 + 0.5, row as f32 + 0.5];
                        let dark = inking.ink(&patch(at, side_px), tone) > 0.5;
                        let ink = f32::from(u8::from(dark));
                        inked += ink;
                        runs += f32::from(u8::from(ink > last));
                        last = ink;
                    }
                }
                let width = inked / runs;
                assert!((2.0..4.0).contains(&width), "{side_px} px, tone {tone}: {width}");
            }
        }
    }

    #[test]
    fn the_two_darkest_of_six_tones_are_crossed() {
        for tone in 0..=600 {
            let tone = tone as f32 / 600.0;
            let [along, across] = crossed_tones(tone);
            assert_eq!(across < 1.0, tone < DIRECTIONS_MEET, "{tone}");
            assert!((along * across - tone).abs() < 1e-6, "{tone}");
        }
        assert_eq!(crossed_tones(-1.0), [0.0; 2]);
    }

    #[test]
    fn strange_coordinates_take_ink_of_0_to_1() {
        let inking = inking(sample_texture());
        let numbers = [0.0, -0.0, 1e-30, -3.7, 1e9, -1e30, f32::MAX];
        for u in numbers {
            for per_px in [0.0, 1e-30, 1e-3, 1.0, 1e9, f32::INFINITY] {
                let patch =
                    Patch { u, v: -u, across_per_px: per_px, v_per_px: per_px, weight: 1.0 };
                let ink = inking.ink(&patch, 0.2);
                assert!((0.0..=1.0).contains(&ink), "{u} {per_px}: {ink}");
            }
        }
    }
}
