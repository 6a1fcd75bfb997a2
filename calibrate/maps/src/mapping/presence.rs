//! Shares and probabilities of a pixel from all sets that were tried.

use crate::films::film::Pixel;
use crate::pixel_maps::{BlockMaps, Mask};
use crate::search::engine::Engine;
use crate::search::scores::{NEGLIGIBLE, Scores};
use crate::search::set_fit::SetFit;

/// Numbers of one pixel, by column of the map.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Told {
    pub(crate) share: Vec<f64>,
    pub(crate) share_sd: Vec<f64>,
    pub(crate) presence: Vec<f64>,
    /// Chi-square per degree of freedom.
    pub(crate) chi2: f64,
    /// Root mean square difference in reflectance.
    pub(crate) rms: f64,
    /// Columns of the best set that has others than the best of all, as bits.
    pub(crate) second: u64,
}

impl Told {
    pub(crate) fn new(columns: usize) -> Self {
        Self {
            share: vec![0.0; columns],
            share_sd: vec![0.0; columns],
            presence: vec![0.0; columns],
            chi2: 0.0,
            rms: 0.0,
            second: 0,
        }
    }

    /// Adds the numbers to `maps` as those of the next pixel.
    pub(crate) fn push_to(&self, maps: &mut BlockMaps) {
        maps.share.extend(self.share.iter().map(|value| *value as f32));
        maps.share_sd.extend(self.share_sd.iter().map(|value| *value as f32));
        maps.presence.extend(self.presence.iter().map(|value| *value as f32));
        maps.chi2.push(self.chi2 as f32);
        maps.rms.push(self.rms as f32);
        maps.second.push(self.second);
        maps.mask.push(Mask::Mapped);
    }

    /// Sums up the sets `found`, the best first. `column_of` is the column of each pigment.
    ///
    /// Sets count by [`Scores::weight`]. The shares are those of the best set; their variance is the curvature's,
    /// that of the paints' strengths, and the mean square by which other sets differ, each with its weight.
    pub(crate) fn sum(
        &mut self,
        engine: &Engine,
        pixel: &Pixel,
        found: &[SetFit],
        column_of: &[usize],
    ) {
        self.share.fill(0.0);
        self.share_sd.fill(0.0);
        self.presence.fill(0.0);
        self.second = 0;
        let Some(best) = found.first() else { return };
        let bits = |set: &SetFit| {
            set.parts().fold(0u64, |bits, (member, _)| bits | 1 << column_of[member])
        };
        for (member, share) in best.parts() {
            self.share[column_of[member]] += f64::from(share);
        }
        let best_bits = bits(best);
        let mut total = 0.0;
        let mut shares = vec![0.0; self.share.len()];
        for set in found.iter().take_while(|set| set.score < best.score + NEGLIGIBLE) {
            let weight = Scores::weight(set.score - best.score);
            total += weight;
            let columns = bits(set);
            if self.second == 0 && columns != best_bits {
                self.second = columns;
            }
            shares.fill(0.0);
            for (member, share) in set.parts() {
                shares[column_of[member]] += f64::from(share);
            }
            for (column, share) in shares.iter().enumerate() {
                self.presence[column] += weight * f64::from(u32::from(columns >> column & 1 == 1));
                self.share_sd[column] += weight * (share - self.share[column]).powi(2);
            }
        }
        let difference = best.difference(&engine.films, pixel);
        let excess = engine.scores.excess(best.chi2);
        let covariance = best.covariance(&difference);
        // A share changes with the logarithm of a paint's strength by share x (own column - column's share).
        let of_strength = |column: usize| -> f64 {
            let slopes = best.parts().map(|(member, share)| {
                let own = f64::from(u8::from(column_of[member] == column));
                f64::from(share) * (own - self.share[column])
            });
            slopes.map(|slope| (engine.strength_sd * slope).powi(2)).sum()
        };
        let mut variance: Vec<f64> = (0..self.share.len()).map(of_strength).collect();
        for (i, (a, _)) in best.parts().enumerate() {
            for (j, (b, _)) in best.parts().enumerate() {
                if column_of[a] == column_of[b] {
                    variance[column_of[a]] += covariance[i][j] * excess;
                }
            }
        }
        for ((sd, presence), variance) in
            self.share_sd.iter_mut().zip(&mut self.presence).zip(&variance)
        {
            *sd = (*sd / total + variance.max(0.0)).sqrt().min(1.0);
            *presence /= total;
        }
        let bands = engine.films.bands;
        let free = bands.saturating_sub(best.len() - 1).max(1) as f64;
        self.chi2 = f64::from(best.chi2) / free;
        self.rms = (f64::from(difference.squares) / bands as f64).sqrt();
    }
}
