//! Truth of rows: shares of the paint that is seen, blurred as the camera blurs light.

use std::ops::Range;

use rayon::prelude::*;

use super::paint_class::PaintClass;
use crate::camera::Camera;

/// Numbers of parts of which the truth of a pixel consists: those of pigments, then of layers, then that of the
/// ground. Those of the pigments sum to 1 with that of the ground, and so do those of the layers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TruthParts {
    /// Number of pigments.
    pub pigments: usize,
    /// Number of layers.
    pub layers: usize,
}

impl TruthParts {
    /// Numbers of a pixel.
    #[must_use]
    pub fn count(&self) -> usize {
        self.pigments + self.layers + 1
    }
}

/// Truth of the pixels of some rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TruthRows {
    /// Number of pigments.
    pub pigments: usize,
    /// Share of each pigment in the paint that is seen, sum 1; all 0 where no paint is.
    pub share: Vec<f32>,
    /// Part of the ground in what is seen, 0 to 1.
    pub ground: Vec<f32>,
    /// Mean reflectance over the bands, before drift and noise.
    pub mean_reflectance: Vec<f32>,
    /// Kind of each pixel.
    pub class: Vec<PaintClass>,
}

/// Truth of `rows`, of which the camera told `mean_reflectance`. `of(line)` gives the parts of a row, those of one
/// pixel after another in the order of [`TruthParts`].
#[must_use]
pub fn truth_rows(
    camera: &Camera,
    parts: TruthParts,
    rows: Range<usize>,
    mean_reflectance: Vec<f32>,
    of: &(dyn Fn(usize) -> Vec<f64> + Sync),
) -> TruthRows {
    let count = parts.count();
    let blurred = camera.blurred(rows.clone(), of);
    let each: Vec<TruthRows> = (blurred.par_iter().zip(rows))
        .map(|(blurred, line)| {
            let mut truth = TruthRows::default();
            let own = of(line);
            for (seen, own) in blurred.chunks_exact(count).zip(own.chunks_exact(count)) {
                let shares = shares(seen, parts);
                let apart = shares.iter().zip(self::shares(own, parts));
                let apart: f64 = apart.map(|(a, b)| 0.5 * (a - b).abs()).sum();
                let ground = seen[count - 1];
                let layers = &seen[parts.pigments..count - 1];
                let paint: f64 = layers.iter().sum();
                let greatest = layers.iter().copied().fold(0.0, f64::max) / paint.max(1e-12);
                truth.class.push(PaintClass::of(ground, greatest, apart));
                truth.ground.push(ground as f32);
                truth.share.extend(shares.iter().map(|share| *share as f32));
            }
            truth
        })
        .collect();
    let mut all = TruthRows { pigments: parts.pigments, mean_reflectance, ..TruthRows::default() };
    for line in each {
        all.share.extend(line.share);
        all.ground.extend(line.ground);
        all.class.extend(line.class);
    }
    all
}

/// Shares of the pigments in the paint alone.
fn shares(parts: &[f64], TruthParts { pigments, .. }: TruthParts) -> Vec<f64> {
    let sum: f64 = parts[..pigments].iter().sum();
    let factor = if sum > 1e-9 { 1.0 / sum } else { 0.0 };
    parts[..pigments].iter().map(|part| part * factor).collect()
}
