//! The heights of paper, 0..1, generated or scanned, and where a dry brush touches them: on
//! the heights, and in streaks along the strokes.

use std::path::Path;

use documents::hint::Explain;
use graphics::field::Field;
use graphics::noise::{Hills, random};
use graphics::picture::{Photograph, PhotographError};
use graphics::picture_formats::NAMES;
use paint::amount::QUANTA_PER_CELL;
use paint::ground::{GroundError, Paper, PaperFinish};
use rayon::prelude::*;
use spectra::color::{Rgb, RgbSpace};

use super::noise::Quantiles;
use crate::settings::{DryBrushSettings, PaperSettings};

/// Usual width of the bumps of cold-pressed paper in mm. It relates pixels to mm.
const BUMP_MM: f64 = 1.3;

/// Standard deviation of the heights of cold-pressed paper and of scans. Chosen by eye.
const SPREAD: f64 = 0.18;

/// Height difference between black and white of a scan in mm. We assume this. It is close to the
/// relief of cold-pressed paper.
const SCAN_MM: f64 = 0.1;

/// Largest width or height of a scaled scan in pixels.
const LARGEST: usize = 16384;

/// Heights of a paper, with the measures that effects need.
#[derive(Debug, Clone, PartialEq)]
pub struct PaperTexture {
    /// Heights in 0..1, with a mean of 0.5. The standard deviation is 0.18 for cold-pressed paper
    /// and for scans. For other papers it is proportional to their relief in mm. We clip values
    /// outside 0..1.
    pub heights: Field<f32>,
    /// Width of a pixel in mm.
    pub px_mm: f64,
    /// Height in mm of the value 1.
    unit_mm: f64,
    /// Relief relative to cold-pressed paper.
    depth: f32,
    /// Root mean square length of the gradient (right minus left, below minus above).
    slope: f32,
    quantiles: Quantiles,
    /// Heights on a finer grid for outlines, in pictures too small for the grain.
    fine: Option<FineHeights>,
}

/// Heights of a paper on a finer grid than its picture has.
#[derive(Debug, Clone, PartialEq)]
pub struct FineHeights {
    /// Heights in 0..1 of [`FineHeights::factor`] times as many columns and rows.
    pub heights: Field<f32>,
    /// Cells along each side of a pixel, at least 2.
    pub factor: usize,
    /// Root mean square length of the gradient.
    slope: f32,
}

impl FineHeights {
    /// The factor that scales gradients of the fine heights to a root mean square length of
    /// `amount`, and 0 if the paper is flat.
    #[must_use]
    pub fn per_slope(&self, amount: f32) -> f32 {
        if self.slope > 0.0 { amount / self.slope } else { 0.0 }
    }
}

impl PaperTexture {
    /// The paper of `settings` over `width` x `height` px. A scan smaller than this is
    /// repeated, mirrored.
    ///
    /// # Errors
    /// [`PaperTextureError`] if the scan cannot be read or a setting is out of its range.
    pub fn new(
        width: usize,
        height: usize,
        settings: &PaperSettings,
    ) -> Result<Self, PaperTextureError> {
        let px_mm = BUMP_MM / f64::from(settings.grain_px);
        let (raw, depth) = match &settings.scan {
            Some(path) => (scanned(width, height, path, settings.scan_scale)?, 1.0),
            None => {
                let paper = Paper::of(settings.kind, settings.seed);
                let depth = paper.relief_mm / PaperFinish::ColdPressed.relief_mm();
                (paper.heights_mm(width, height, px_mm)?, depth)
            }
        };
        let (heights, per_raw) = spread(raw, SPREAD * depth);
        let unit_mm =
            if settings.scan.is_some() || per_raw == 0.0 { SCAN_MM } else { 1.0 / per_raw };
        let slope = slope(&heights);
        let quantiles = Quantiles::of(&heights);
        Ok(Self { heights, px_mm, unit_mm, depth: depth as f32, slope, quantiles, fine: None })
    }

    /// Adds heights on a grid `factor` times as fine, by which we displace outlines
    /// ([`super::super::wobble`]). A factor of 1 adds none. `settings` belong to this paper.
    ///
    /// # Errors
    /// [`PaperTextureError`] if the scan cannot be read or a setting is out of its range.
    pub fn with_fine_heights(
        self,
        factor: usize,
        settings: &PaperSettings,
    ) -> Result<Self, PaperTextureError> {
        if factor < 2 {
            return Ok(Self { fine: None, ..self });
        }
        let mut settings = settings.clone();
        settings.grain_px *= factor as f32;
        settings.scan_scale *= factor as f32;
        let width = self.heights.width();
        let height = self.heights.height();
        let Self { heights, slope, .. } = Self::new(width * factor, height * factor, &settings)?;
        Ok(Self { fine: Some(FineHeights { heights, factor, slope }), ..self })
    }

    /// Heights on a finer grid, if the paper has them.
    #[must_use]
    pub fn fine(&self) -> Option<&FineHeights> {
        self.fine.as_ref()
    }

    /// The height below which this `share` (0..1) of the paper lies, accurate to about 0.001 of
    /// the paper.
    #[must_use]
    pub fn height_above(&self, share: f32) -> f32 {
        self.quantiles.at(share)
    }

    /// The factor that scales gradients of the paper to a root mean square length of `amount`,
    /// and 0 if the paper is flat.
    #[must_use]
    pub fn per_slope(&self, amount: f32) -> f32 {
        if self.slope > 0.0 { amount / self.slope } else { 0.0 }
    }

    /// [`Self::per_slope`] times the relief of the paper relative to cold-pressed paper. You reach
    /// `amount` on cold-pressed paper.
    #[must_use]
    pub fn relief_per_slope(&self, amount: f32) -> f32 {
        self.per_slope(amount * self.depth)
    }

    /// The factor on the heights in mm at which Lambert's law shades this paper, in encoded
    /// values, as much as the setting `relief` does, 0 to 10. It is 0 if the paper is flat. The light
    /// stands `elevation_deg` above the paper and is diffuse to the share `ambient`, 0 to 1.
    #[must_use]
    pub fn lit_relief(&self, relief: f32, elevation_deg: f64, ambient: f64) -> f64 {
        let slant = elevation_deg.to_radians().tan();
        // We take a slope over two pixels, in both directions at an angle of 45 degrees to the
        // light. Encoded values change by 1/2.2 of linear ones.
        let per_slope = 2.2 * 2.0 * std::f64::consts::SQRT_2 * slant;
        let shaded = f64::from(self.relief_per_slope(relief));
        let direct = (1.0 - ambient).max(0.05);
        (per_slope * shaded * self.px_mm / self.unit_mm / direct).clamp(0.0, 10.0)
    }

    /// The heights in the integer quanta of a painting with cells that are
    /// [`PaperTexture::px_mm`] wide.
    #[must_use]
    pub fn quanta(&self) -> Field<i32> {
        let scale = self.unit_mm / self.px_mm * f64::from(QUANTA_PER_CELL);
        let values = self
            .heights
            .values()
            .par_iter()
            .map(|&height: &f32| (f64::from(height) * scale).round() as i32)
            .collect();
        Field::from_values(self.heights.width(), self.heights.height(), values)
    }
}

/// Shifts and scales heights to a mean of 0.5 and the standard deviation `deviation`, clipped to
/// 0..1. Returns them with the scale. A flat field becomes 0.5 with a scale of 0.
fn spread(mut heights: Field<f32>, deviation: f64) -> (Field<f32>, f64) {
    let count = heights.values().len().max(1) as f64;
    let mean = heights.values().iter().map(|&v| f64::from(v)).sum::<f64>() / count;
    let squares = heights.values().iter().map(|&v| (f64::from(v) - mean).powi(2)).sum::<f64>();
    let own = (squares / count).sqrt();
    let scale = if own > 1e-9 { deviation / own } else { 0.0 };
    heights.values_mut().par_iter_mut().for_each(|value| {
        *value = (0.5 + scale * (f64::from(*value) - mean)).clamp(0.0, 1.0) as f32;
    });
    (heights, scale)
}

/// Root mean square length of the gradient (right minus left, below minus above).
fn slope(heights: &Field<f32>) -> f32 {
    let rows = (0..heights.height()).into_par_iter();
    let squares: Vec<f64> = rows.map(|y| squared_slopes(heights, y)).collect();
    let pixels = heights.values().len().max(1);
    (squares.iter().sum::<f64>() / pixels as f64).sqrt() as f32
}

/// Sum of the squared lengths of the gradient in a row.
fn squared_slopes(heights: &Field<f32>, y: usize) -> f64 {
    let width = heights.width();
    let here = heights.row(y, 0, width);
    let above = heights.row(y.saturating_sub(1), 0, width);
    let below = heights.row((y + 1).min(heights.height() - 1), 0, width);
    (0..width)
        .map(|x: usize| {
            let across = here[(x + 1).min(width - 1)] - here[x.saturating_sub(1)];
            let down = below[x] - above[x];
            f64::from(across * across + down * down)
        })
        .sum()
}

/// The heights of a scan: sRGB-encoded luminance. Its pixels become `scale` px wide. Beyond
/// its borders it is repeated, mirrored.
fn scanned(
    width: usize,
    height: usize,
    path: &str,
    scale: f32,
) -> Result<Field<f32>, PaperTextureError> {
    let photograph = Photograph::open(Path::new(path))?;
    let [columns, rows] = [photograph.size().0, photograph.size().1].map(|pixels: usize| {
        ((pixels as f64 * f64::from(scale)).round() as usize).clamp(1, LARGEST)
    });
    let weights = RgbSpace::Srgb.xyz_from_linear();
    let picture = photograph.on_canvas(columns, rows);
    let mut heights = Field::filled(width, height, 0.0);
    heights.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, out)| {
        let row = mirrored(y, rows);
        for (x, out) in out.iter_mut().enumerate() {
            let rgb = picture[(mirrored(x, columns), row)].map(f64::from);
            let luminance = weights.apply(rgb)[1] / 100.0;
            // Encoded values, since they are about proportional to the lightness seen.
            *out = Rgb([luminance.clamp(0.0, 1.0); 3]).encoded().0[0] as f32;
        }
    });
    Ok(heights)
}

/// The index in 0..count for `place` on a line repeated with mirroring.
fn mirrored(place: usize, count: usize) -> usize {
    let place = place % (2 * count);
    place.min(2 * count - 1 - place)
}

/// Why a paper cannot be made.
#[derive(Debug, thiserror::Error, Explain)]
pub enum PaperTextureError {
    /// The scan cannot be read.
    #[error("scan of paper: {0}")]
    #[hint("paper.scan names a picture ({NAMES}); without it paper.kind makes a paper")]
    Scan(#[from] PhotographError),
    /// A setting of the paper is out of its range.
    #[error(transparent)]
    Ground(#[from] GroundError),
}

/// Standard deviation of the texture, the same as for the heights of cold-pressed paper.
const BRUSH_TOUCH_SPREAD: f32 = 0.18;

/// Width of a streak relative to the grain of the paper. Chosen by eye.
const STREAK_GRAINS: f32 = 0.8;

/// Touch of a dry brush, 0 to 1: the brush leaves the paper bare where it is low.
#[derive(Debug, Clone, PartialEq)]
pub struct BrushTouch {
    /// Values of the pixels, with a mean of 0.5 and a standard deviation of about 0.18.
    pub touch: Field<f32>,
    /// Shares of the paper by their touch.
    pub quantiles: Quantiles,
}

impl BrushTouch {
    /// The touch of the strokes of `settings` on `paper`. This is `None` if the brush is not dry or
    /// has no streaks. Then the heights of the paper alone decide.
    #[must_use]
    pub fn new(
        paper: &PaperTexture,
        settings: &DryBrushSettings,
        sheet: &PaperSettings,
    ) -> Option<Self> {
        if settings.amount <= 0.0 || settings.streaks <= 0.0 {
            return None;
        }
        let mut random = random(sheet.seed, 23);
        let octaves = [Hills::new(&mut random), Hills::new(&mut random), Hills::new(&mut random)];
        let (sin, cos) = settings.direction_deg.to_radians().sin_cos();
        let per_length = 1.0 / settings.length_px.max(1.0);
        let per_width = 1.0 / (STREAK_GRAINS * sheet.grain_px.max(1.0));
        let (streaks, grain) = (settings.streaks, 1.0 - settings.streaks);
        // Both parts are independent, so their variances add.
        let scale = 1.0 / streaks.hypot(grain);
        let shares = [0.6_f32, 0.7, 0.4];
        let own = shares.iter().map(|share| share * share).sum::<f32>().sqrt();
        let unit = BRUSH_TOUCH_SPREAD / (own * (Hills::VARIANCE as f32).sqrt());
        let heights = &paper.heights;
        let width = heights.width();
        let mut touch = Field::filled(width, heights.height(), 0.0);
        touch.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
            for ((x, out), height) in row.iter_mut().enumerate().zip(heights.row(y, 0, width)) {
                // The vertical axis of the picture points downwards.
                let x = x as f32;
                let y = y as f32;
                let along = x * cos - y * sin;
                let across = x * sin + y * cos;
                let mut streak = 0.0;
                for (octave, (hills, share)) in octaves.iter().zip(shares).enumerate() {
                    let finer = [0.25_f32, 1.0, 2.0][octave];
                    let place = along * per_length * finer.sqrt();
                    streak += share * hills.at(place, across * per_width * finer);
                }
                let sum = streaks * unit * streak + grain * (height - 0.5);
                *out = (0.5 + scale * sum).clamp(0.0, 1.0);
            }
        });
        let quantiles = Quantiles::of(&touch);
        Some(Self { touch, quantiles })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirrors_run_back_and_forth() {
        let places: Vec<usize> = (0..8).map(|place| mirrored(place, 3)).collect();
        assert_eq!(places, [0, 1, 2, 2, 1, 0, 0, 1]);
        assert_eq!(mirrored(5, 1), 0);
    }
}
