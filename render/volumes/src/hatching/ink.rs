//! The ink that hatching puts on a point; the twin in WGSL is `ink.wgsl`.

use super::coordinates::Patch;
use super::threshold::{COARSEST_SIDE, LEVELS};

/// Tone below which strokes across are laid over those along: the two darkest of six tones.
pub const DIRECTIONS_MEET: f32 = 1.0 / 3.0;

/// Width of a stroke of the texture in texels.
const WIDTH_TEXELS: f32 = 2.8;

/// Powers of two of the density beyond which coordinates are no longer scaled.
const DENSITIES: [i32; 2] = [-8, 14];

/// Quarter octaves between which one density of strokes gives way to the next: 2^(1/4) and the
/// inverse of 2^(3/4) - 2^(1/4).
const GIVES_WAY: [f32; 2] = [1.189_207_1, 2.031_087_6];

/// Where the strokes across are taken from the texture, so that they are not those along again.
const ACROSS_FROM: f32 = 0.37;

/// Tones of the strokes along and across that together leave the share `tone` of bare paper:
/// the product of what each leaves. Both rise with the tone.
#[must_use]
#[inline(always)]
pub fn crossed_tones(tone: f32) -> [f32; 2] {
    if tone >= DIRECTIONS_MEET {
        return [tone, 1.0];
    }
    let tone = if tone > 0.0 { tone } else { 0.0 };
    [(tone * DIRECTIONS_MEET).sqrt(), (tone / DIRECTIONS_MEET).sqrt()]
}

/// Strokes and figures that ink a point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inking<'a> {
    /// [`super::ThresholdTexture::quads`].
    quads: &'a [u32],
    /// Inverse of the range of tone over which a texel takes ink.
    sharpness: f32,
    /// Tiles of the coarsest level per texel on the screen, in pixels.
    scale: f32,
}

impl<'a> Inking<'a> {
    /// # Panics
    /// If there are not the quads of all levels.
    pub(crate) fn new(quads: &'a [u32], softness: f32, width_px: f32) -> Self {
        let texels = (0..LEVELS).map(|level| (COARSEST_SIDE << level).pow(2)).sum::<usize>();
        assert_eq!(quads.len(), texels, "texels of a threshold texture");
        Self { quads, sharpness: 0.5 / softness, scale: Self::scale(width_px) }
    }

    /// Side of the coarsest level in pixels where its strokes are `width_px` wide, inverted.
    pub(crate) fn scale(width_px: f32) -> f32 {
        WIDTH_TEXELS / (width_px * COARSEST_SIDE as f32)
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
        let crossed = self.strokes([patch.v + ACROSS_FROM, patch.u], patch.u_per_px, across);
        1.0 - (1.0 - ink) * (1.0 - crossed)
    }

    /// Ink of strokes along the first coordinate, where the second changes by `per_px` from
    /// pixel to pixel.
    #[inline(always)]
    fn strokes(&self, at: [f32; 2], per_px: f32, tone: f32) -> f32 {
        // Density of strokes, 1 at the coarsest level and coordinates as they are.
        let density = (self.scale / per_px.max(1e-12)).to_bits();
        let octave = (density >> 23) as i32 - 127;
        let part = f32::from_bits((density & 0x7f_ffff) | 0x3f80_0000);
        let passed = ((part - GIVES_WAY[0]) * GIVES_WAY[1]).clamp(0.0, 1.0);
        let mut ink = 0.0;
        if passed < 1.0 {
            ink = self.inked(self.threshold(at, octave), tone);
        }
        if passed > 0.0 {
            let finer = self.inked(self.threshold(at, octave + 1), tone);
            ink += (finer - ink) * passed;
        }
        // The lightest tones fade, so that light itself is bare paper.
        ink * ((1.0 - tone) * self.sharpness * 4.0).min(1.0)
    }

    /// The threshold, 0 to 1, at a place of the tile, for strokes of a density in octaves.
    #[inline(always)]
    fn threshold(&self, at: [f32; 2], octave: i32) -> f32 {
        let octave = octave.clamp(DENSITIES[0], DENSITIES[1]);
        let level = octave.clamp(0, LEVELS as i32 - 1);
        let side = (COARSEST_SIDE as i32) << level;
        // 2^(octave - level) tiles in one.
        let texels = f32::from_bits(((octave - level + 127) as u32) << 23) * side as f32;
        let [x, y] = at.map(|at| at * texels - 0.5);
        let [column, row] = [x, y].map(floor);
        let [right, down] = [x - column as f32, y - row as f32].map(|part| part.clamp(0.0, 1.0));
        let mask = side - 1;
        let first = (side * side - (COARSEST_SIDE * COARSEST_SIDE) as i32) / 3;
        let quad = self.quads[(first + (row & mask) * side + (column & mask)) as usize];
        let [a, b, c, d] = quad.to_le_bytes().map(f32::from);
        let above = a + (b - a) * right;
        let below = c + (d - c) * right;
        (above + (below - above) * down) * (1.0 / 255.0)
    }

    /// Webb et al. 2002: a texel takes ink while the tone falls past its threshold.
    #[inline(always)]
    fn inked(&self, threshold: f32, tone: f32) -> f32 {
        let at = ((tone - threshold) * self.sharpness + 0.5).clamp(0.0, 1.0);
        1.0 - at * at * (3.0 - 2.0 * at)
    }
}

/// The largest whole number that is not greater; far numbers end at the range of i32.
#[inline(always)]
fn floor(value: f32) -> i32 {
    let whole = value as i32;
    whole.wrapping_sub(i32::from(whole as f32 > value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hatching::ThresholdTexture;

    const SOFTNESS: f32 = 0.12;

    fn inking(texture: &ThresholdTexture) -> Inking<'_> {
        Inking::new(texture.quads(), SOFTNESS, 2.8)
    }

    /// The patch at (x, y) of a tile whose side is shown in `side_px` pixels.
    fn patch([x, y]: [f32; 2], side_px: f32) -> Patch {
        let [u, v] = [x, y].map(|at| at / side_px);
        Patch { u, v, u_per_px: 1.0 / side_px, v_per_px: 1.0 / side_px, weight: 1.0 }
    }

    #[test]
    fn ink_of_a_tone_is_part_of_that_of_every_darker_one() {
        let texture = ThresholdTexture::new(1);
        let inking = inking(&texture);
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
        let texture = ThresholdTexture::new(1);
        let inking = inking(&texture);
        for side_px in [32.0, 45.0, 100.0, 256.0, 300.0, 700.0] {
            let pixels = 160;
            for tone in 0..=64 {
                let tone = tone as f32 / 64.0;
                let mut sum = 0.0;
                for y in 0..pixels {
                    for x in 0..pixels {
                        let share = |at: i32| (at as f32 + 0.5) / pixels as f32 * side_px;
                        let ink = inking.ink(&patch([share(x), share(y)], side_px), tone);
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
        let texture = ThresholdTexture::new(1);
        let inking = inking(&texture);
        // The tile is zoomed to eight times its size, through all levels.
        for zoom in 0..=24 {
            let side_px = 36.0 * 8.0_f32.powf(zoom as f32 / 24.0);
            let (mut inked, mut runs) = (0.0, 0.0);
            for column in 0..160 {
                let mut last = 0.0;
                for row in 0..320 {
                    let at = [column as f32 * 3.0 + 0.5, row as f32 + 0.5];
                    let ink = f32::from(u8::from(inking.ink(&patch(at, side_px), 0.8) > 0.5));
                    inked += ink;
                    runs += f32::from(u8::from(ink > last));
                    last = ink;
                }
            }
            let width = inked / runs;
            assert!((2.0..4.0).contains(&width), "side of {side_px} px: {width}");
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
        let texture = ThresholdTexture::new(1);
        let inking = inking(&texture);
        let numbers = [0.0, -0.0, 1e-30, -3.7, 1e9, -1e30, f32::MAX];
        for u in numbers {
            for per_px in [0.0, 1e-30, 1e-3, 1.0, 1e9, f32::INFINITY] {
                let patch = Patch { u, v: -u, u_per_px: per_px, v_per_px: per_px, weight: 1.0 };
                let ink = inking.ink(&patch, 0.2);
                assert!((0.0..=1.0).contains(&ink), "{u} {per_px}: {ink}");
            }
        }
    }
}
