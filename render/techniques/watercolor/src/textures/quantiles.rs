//! Quantiles of a texture: the value below which a share of its pixels lies.

use rayon::prelude::*;

use graphics::field::Field;

/// Number of intervals of the table.
const INTERVALS: usize = 1024;

/// The values of a texture below which 0, 1/1024, 2/1024 .. 1 of its pixels lie.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantiles(Vec<f32>);

impl Quantiles {
    /// The quantiles of `texture`; those of an empty one are 0.5.
    #[must_use]
    pub fn of(texture: &Field<f32>) -> Self {
        let mut sorted = texture.values().to_vec();
        sorted.par_sort_unstable_by(f32::total_cmp);
        let at = |i: usize| sorted.get(i * sorted.len().saturating_sub(1) / INTERVALS);
        Self((0..=INTERVALS).map(|i| at(i).copied().unwrap_or(0.5)).collect())
    }

    /// The value below which this `share` (0..1) of the pixels lies, accurate to about 0.001 of
    /// them.
    #[must_use]
    pub fn at(&self, share: f32) -> f32 {
        let place = share.clamp(0.0, 1.0) * INTERVALS as f32;
        let first = (place as usize).min(INTERVALS - 1);
        let low = self.0[first];
        let high = self.0[first + 1];
        low + (high - low) * (place - first as f32)
    }
}
