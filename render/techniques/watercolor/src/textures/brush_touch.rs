//! Where a dry brush touches the paper: its heights, and streaks along the strokes.

use rayon::prelude::*;

use super::paper::PaperTexture;
use super::quantiles::Quantiles;
use crate::settings::{DryBrushSettings, PaperSettings};
use graphics::field::Field;
use graphics::noise::{Hills, random};

/// Standard deviation of the texture, that of the heights of cold-pressed paper.
const SPREAD: f32 = 0.18;

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
    /// The touch of the strokes of `settings` on `paper`. `None` if the brush is not dry or
    /// has no streaks, so that the heights of the paper alone decide.
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
        let unit = SPREAD / (own * (Hills::VARIANCE as f32).sqrt());
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
