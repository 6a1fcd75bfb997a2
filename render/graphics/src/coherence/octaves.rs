//! The octaves of feature noise: which octave a feature belongs to, and how strong it is.
//!
//! Octave o has features of radius r / 2^o. A feature's rank is its priority converted to
//! features per pixel, at the scale at which it is seen; ranks grow as the model moves
//! away. Octave 0 takes features up to some rank, each further octave those up to four
//! times the rank of the one before. So about the same number of features overlap in every
//! octave. As the model moves away, features fade one after the other from each octave to
//! the next.

/// Width of the range of ranks, in octaves, over which a feature fades to the next octave.
/// Wide fades pop less; narrow ones mix fewer sizes of features. Chosen by eye.
const FADE: f32 = 1.0;

/// Standard deviation of both kinds of noise about their mean of 0.5. Values beyond 0 and
/// 1, which are 2.5 standard deviations away, are cut off.
pub const SPREAD: f32 = 0.2;

/// Feature noise of several octaves, each of half the size of the one before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeatureNoise {
    /// Radius of the largest features in pixels, above 0.
    pub largest_px: f32,
    /// Number of octaves, 1 to 8.
    pub octaves: usize,
    /// Strength of an octave relative to the one before, above 0: 1/2 gives the turbulence
    /// of Perlin 1985, 1 gives all octaves the same strength.
    pub persistence: f32,
    /// Mean number of features of each octave that overlap at a point, above 0. More make
    /// the noise more even and slower to draw.
    pub coverage: f32,
}

impl FeatureNoise {
    /// Slow changes, like pigment carried by water.
    pub const FLOW: Self = Self { largest_px: 40.0, octaves: 4, persistence: 0.5, coverage: 4.0 };
    /// Fine grain, like pigment that settles.
    pub const DISPERSION: Self =
        Self { largest_px: 6.0, octaves: 2, persistence: 0.8, coverage: 4.0 };
}

/// The radius and amplitude of features in each octave.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Octaves {
    /// For each octave the radius in pixels and the amplitude of its features.
    each: Vec<[f32; 2]>,
    /// The rank at which octave 0 ends, in features per pixel.
    first: f32,
}

/// Rises from 0 at t = 0 to 1 at t = 1 with slope 0 at both ends (Perlin 2002).
fn profile(t: f32) -> f32 {
    let t = t.clamp(0.0, 1.0);
    t * t * t * (t * (6.0 * t - 15.0) + 10.0)
}

impl Octaves {
    pub(super) fn new(noise: FeatureNoise) -> Self {
        let FeatureNoise { largest_px, octaves, persistence, coverage } = noise;
        let count = octaves.clamp(1, 8);
        // All coarser octaves together have a third of the features of an octave.
        let first = 4.0 / 3.0 * coverage / std::f32::consts::PI / (largest_px * largest_px);
        let radii = (0..count).map(|octave| largest_px / (1u32 << octave) as f32);
        let mut octaves = Self { each: radii.map(|radius| [radius, 1.0]).collect(), first };
        let strength = |octave: usize| persistence.powi(octave as i32);
        let all = (0..count).map(|octave| strength(octave).powi(2)).sum::<f32>().sqrt();
        for octave in 0..count {
            let radius = octaves.each[octave][0];
            // Features are placed at random, so their squares add (Campbell 1909).
            let variance = octaves.features(octave) * squared_profile_integral() * radius * radius;
            octaves.each[octave][1] = SPREAD * strength(octave) / all / variance.sqrt();
        }
        octaves
    }

    /// Features of an octave per pixel, each weighted by the square of its share.
    fn features(&self, octave: usize) -> f32 {
        const STEPS: usize = 400;
        let share = |level: f32| self.share(octave, level).powi(2);
        let low = -6.0;
        let high = self.each.len() as f32 + 1.0;
        let step = (high - low) / STEPS as f32;
        let levels = (0..STEPS).map(|i| low + (i as f32 + 0.5) * step);
        let above: f32 = levels.map(|level| share(level) * 4.0f32.powf(level)).sum();
        let tail = share(low) * 4.0f32.powf(low);
        self.first * (above * step * 4.0f32.ln() + tail)
    }

    /// The share of a feature, 0 to 1, that belongs to `octave`. `level` is the logarithm of
    /// the rank: 0 where octave 0 ends, 1 where octave 1 ends.
    fn share(&self, octave: usize, level: f32) -> f32 {
        let passed = |end: f32| profile((level - end) / FADE + 0.5);
        let entered = if octave == 0 { 1.0 } else { passed(octave as f32 - 1.0) };
        entered * (1.0 - passed(octave as f32))
    }

    /// Features of this rank and above belong to no octave.
    pub(super) fn end(&self) -> f32 {
        self.first * 4.0f32.powf(self.each.len() as f32 - 1.0 + FADE / 2.0)
    }

    /// Radius of the largest features, in pixels.
    pub(super) fn largest_px(&self) -> f32 {
        self.each[0][0]
    }

    /// Radius of the largest features of this rank and above, in pixels.
    pub(super) fn largest_from(&self, rank: f32) -> f32 {
        self.each[self.first_of(rank).1.min(self.each.len() - 1)][0]
    }

    /// The logarithm of a rank, and the first octave that its features may belong to.
    fn first_of(&self, rank: f32) -> (f32, usize) {
        let level = (rank / self.first).log2() / 2.0;
        (level, (level + 0.5) as usize)
    }

    /// Radius in pixels and amplitude with which a feature of this rank is drawn: once, or
    /// twice while it fades from one octave to the next.
    pub(super) fn parts(&self, rank: f32) -> impl Iterator<Item = [f32; 2]> {
        // A feature belongs to two octaves at most.
        let (level, nearest) = self.first_of(rank);
        let near = nearest.min(self.each.len())..(nearest + 2).min(self.each.len());
        near.filter_map(move |octave| {
            let [radius, amplitude] = self.each[octave];
            let share = self.share(octave, level);
            (share > 0.0).then_some([radius, amplitude * share])
        })
    }
}

/// The integral of the squared profile over a disc of radius 1.
fn squared_profile_integral() -> f32 {
    const STEPS: usize = 400;
    let rings = (0..STEPS).map(|i| (i as f32 + 0.5) / STEPS as f32);
    let sum: f32 = rings.map(|radius| profile(1.0 - radius).powi(2) * radius).sum();
    std::f32::consts::TAU * sum / STEPS as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_feature_passes_from_octave_to_octave_without_a_step() {
        let octaves = Octaves::new(FeatureNoise {
            largest_px: 32.0,
            octaves: 3,
            persistence: 0.5,
            coverage: 4.0,
        });
        let drawn = |rank: f32| -> Vec<f32> {
            let mut amplitudes = vec![0.0; 3];
            for [radius, amplitude] in octaves.parts(rank) {
                amplitudes[(32.0 / radius).log2().round() as usize] += amplitude;
            }
            amplitudes
        };
        let ranks = (0..3000).map(|i| octaves.first * 2.0f32.powf(i as f32 / 300.0 - 3.0));
        let all: Vec<Vec<f32>> = ranks.map(drawn).collect();
        for octave in 0..3 {
            let most = all.iter().map(|drawn| drawn[octave]).fold(0.0, f32::max);
            assert!((most / octaves.each[octave][1] - 1.0).abs() < 1e-3, "{octave}: {most}");
            for pair in all.windows(2) {
                let step = (pair[0][octave] - pair[1][octave]).abs();
                assert!(step < 0.01 * most, "{octave}: {pair:?}");
            }
        }
        assert_eq!(octaves.parts(octaves.end() * 1.001).count(), 0);
        assert_eq!(octaves.parts(0.0).count(), 1);
    }

    #[test]
    fn the_spread_is_that_of_features_strewn_at_random() {
        let octaves = Octaves::new(FeatureNoise {
            largest_px: 20.0,
            octaves: 3,
            persistence: 0.7,
            coverage: 2.0,
        });
        // Campbell's sum computed another way: in small steps of the rank.
        let steps = 200_000;
        let variance: f64 = (0..steps)
            .map(|i| {
                let rank = octaves.end() * (i as f32 + 0.5) / steps as f32;
                let parts = octaves.parts(rank);
                let squares = parts.map(|[radius, a]| f64::from(radius * a).powi(2));
                squares.sum::<f64>() * f64::from(octaves.end() * squared_profile_integral())
                    / f64::from(steps)
            })
            .sum();
        assert!((variance.sqrt() / f64::from(SPREAD) - 1.0).abs() < 0.01, "{}", variance.sqrt());
    }
}
