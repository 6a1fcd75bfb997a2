//! The octaves of feature noise, and a texture of smooth noise that repeats without a seam.
//!
//! Octave o has features of radius r / 2^o. A feature has a priority. Its rank is this priority
//! converted to features per pixel, at the scale at which you see it. Ranks grow as the model
//! moves away. Octave 0 takes features up to some rank, each further octave those up to four times
//! the rank of the one before. So about the same number of features overlap in every octave. As
//! the model moves away, features fade one after the other from each octave to the next.
//!
//! The repeating texture interpolates independent lattice values with cubic B-splines. It is
//! smooth, has about one wavelength and repeats with the lattice. Interpolation lowers the spread
//! between the nodes, so we scale the texture to a standard deviation of [`SPREAD`].

use rayon::prelude::*;

use super::hierarchy::Seed;
use crate::field::Field;

/// Width of the range of ranks, in octaves, over which a feature fades to the next octave. Wide
/// fades pop less. Narrow ones mix fewer sizes of features. We chose it by eye.
const FADE: f32 = 1.0;

/// Standard deviation of both kinds of noise about their mean of 0.5. We clip values to 0..1,
/// which is 2.5 standard deviations to each side.
pub const SPREAD: f32 = 0.2;

/// Feature noise of several octaves, each of half the size of the one before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeatureNoise {
    /// Radius of the largest features in pixels, above 0.
    pub largest_px: f32,
    /// Number of octaves, 1 to 8.
    pub octaves: usize,
    /// Strength of an octave relative to the one before, above 0. For example, 1/2 gives the
    /// turbulence of Perlin 1985, and 1 gives all octaves the same strength.
    pub persistence: f32,
    /// Mean number of features of each octave that overlap at a point, above 0. If you ask for
    /// more, the noise becomes more even and slower to draw.
    pub coverage: f32,
}

impl FeatureNoise {
    /// Slow changes, e.g. pigment carried by water.
    pub const FLOW: Self = Self { largest_px: 40.0, octaves: 4, persistence: 0.5, coverage: 4.0 };
    /// Fine grain, e.g. pigment that settles.
    pub const DISPERSION: Self =
        Self { largest_px: 6.0, octaves: 2, persistence: 0.8, coverage: 4.0 };
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Octaves {
    /// Radius in pixels and amplitude of the features in each octave.
    each: Vec<[f32; 2]>,
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
        fn strength(octave: usize, persistence: f32) -> f32 {
            persistence.powi(octave as i32)
        }
        let all =
            (0..count).map(|octave| strength(octave, persistence).powi(2)).sum::<f32>().sqrt();
        for octave in 0..count {
            let radius = octaves.each[octave][0];
            // Features are placed at random, so their squares add (Campbell 1909).
            let variance = octaves.features(octave) * squared_profile_integral() * radius * radius;
            octaves.each[octave][1] =
                SPREAD * strength(octave, persistence) / all / variance.sqrt();
        }
        octaves
    }

    /// Features of an octave per pixel, each weighted by its squared share.
    fn features(&self, octave: usize) -> f32 {
        const STEPS: usize = 400;
        let low = -6.0;
        let high = self.each.len() as f32 + 1.0;
        let step = (high - low) / STEPS as f32;
        let levels = (0..STEPS).map(|i| low + (i as f32 + 0.5) * step);
        let above: f32 =
            levels.map(|level| self.share(octave, level).powi(2) * 4.0f32.powf(level)).sum();
        let tail = self.share(octave, low).powi(2) * 4.0f32.powf(low);
        self.first * (above * step * 4.0f32.ln() + tail)
    }

    /// The share of a feature, 0 to 1, that belongs to `octave`. `level` is the logarithm of
    /// the rank: 0 where octave 0 ends, 1 where octave 1 ends.
    fn share(&self, octave: usize, level: f32) -> f32 {
        fn passed(end: f32, level: f32) -> f32 {
            profile((level - end) / FADE + 0.5)
        }
        let entered = if octave == 0 { 1.0 } else { passed(octave as f32 - 1.0, level) };
        entered * (1.0 - passed(octave as f32, level))
    }

    pub(super) fn end(&self) -> f32 {
        self.first * 4.0f32.powf(self.each.len() as f32 - 1.0 + FADE / 2.0)
    }

    pub(super) fn largest_px(&self) -> f32 {
        self.each[0][0]
    }

    pub(super) fn largest_from(&self, rank: f32) -> f32 {
        self.each[self.first_of(rank).1.min(self.each.len() - 1)][0]
    }

    /// The logarithm of a rank, and the first octave that its features may belong to.
    fn first_of(&self, rank: f32) -> (f32, usize) {
        let level = (rank / self.first).log2() / 2.0;
        (level, (level + 0.5) as usize)
    }

    /// Radius in pixels and amplitude for drawing a feature of this rank. You get one pair, or two
    /// while the feature fades from one octave to the next.
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

fn squared_profile_integral() -> f32 {
    const STEPS: usize = 400;
    let rings = (0..STEPS).map(|i| (i as f32 + 0.5) / STEPS as f32);
    let sum: f32 = rings.map(|radius| profile(1.0 - radius).powi(2) * radius).sum();
    std::f32::consts::TAU * sum / STEPS as f32
}

const SIDE: usize = 512;

/// Noise of 512 x 512 texels that repeats, with mean 0.5 and standard deviation [`SPREAD`]. Its
/// waves are about `wave_texels` long. You can ask for a power of two from 8 to 128.
///
/// # Panics
/// If `wave_texels` is not such a number.
#[must_use]
pub fn repeating_noise(wave_texels: usize, seed: u64) -> Field<f32> {
    let fits = wave_texels.is_power_of_two() && (8..=128).contains(&wave_texels);
    assert!(fits, "waves of 8 to 128 texels, a power of two, found {wave_texels}");
    // The shortest waves are two lattice steps long, the mean wave four.
    let step = wave_texels / 4;
    let nodes = SIDE / step;
    let splines: Vec<[f32; 4]> = (0..step).map(|i| spline(i as f32 / step as f32)).collect();
    let rows = (0..SIDE).into_par_iter().flat_map_iter(|y| {
        let j = y / step;
        let down = &splines[y % step];
        let columns: Vec<f32> = (0..nodes + 3)
            .map(|i: usize| -> f32 {
                let values = (j..j + 4).map(|j: usize| {
                    let number = ((j % nodes) * nodes + i % nodes) as u64;
                    Seed(seed).child(number).unit(0) - 0.5
                });
                down.iter().zip(values).map(|(share, value): (&f32, f32)| share * value).sum()
            })
            .collect();
        let splines = &splines;
        (0..SIDE).map(move |x| {
            let i = x / step;
            let right = &splines[x % step];
            (0..4).map(|k| right[k] * columns[i + k]).sum::<f32>()
        })
    });
    let mut texture = Field::from_values(SIDE, SIDE, rows.collect());
    let count = (SIDE * SIDE) as f64;
    let mean = texture.values().iter().map(|&value| f64::from(value)).sum::<f64>() / count;
    let spread = (texture
        .values()
        .iter()
        .map(|&value: &f32| (f64::from(value) - mean).powi(2))
        .sum::<f64>()
        / count)
        .sqrt();
    let gain = f64::from(SPREAD) / spread;
    for value in texture.values_mut() {
        *value = (0.5 + (f64::from(*value) - mean) * gain) as f32;
    }
    texture
}

/// The weights of the four cubic B-splines at `t` (0..1) between two nodes.
fn spline(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    fn inner(t: f32) -> f32 {
        (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0
    }
    [s * s * s / 6.0, inner(t), inner(s), t * t * t / 6.0]
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
        let ranks = (0..3000).map(|i| octaves.first * 2.0f32.powf(i as f32 / 300.0 - 3.0));
        let all: Vec<Vec<f32>> = ranks
            .map(|rank: f32| -> Vec<f32> {
                let mut amplitudes = vec![0.0; 3];
                for [radius, amplitude] in octaves.parts(rank) {
                    amplitudes[(32.0 / radius).log2().round() as usize] += amplitude;
                }
                amplitudes
            })
            .collect();
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
        // This computes Campbell's sum another way, in small steps of the rank.
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

    #[test]
    fn the_texture_repeats_without_a_seam() {
        let texture = repeating_noise(32, 5);
        fn most(texture: &Field<f32>, is_down: bool, at: usize) -> f32 {
            let steps = (0..SIDE).map(|i: usize| {
                let [from, to] =
                    [at, (at + 1) % SIDE].map(|at| if is_down { (i, at) } else { (at, i) });
                (texture[from] - texture[to]).abs()
            });
            steps.fold(0.0, f32::max)
        }
        for is_down in [false, true] {
            let usual = (0..SIDE - 1).map(|at| most(&texture, is_down, at)).fold(0.0, f32::max);
            let seam = most(&texture, is_down, SIDE - 1);
            assert!(seam <= usual, "{seam} {usual}");
        }
        let mean = texture.values().iter().sum::<f32>() / (SIDE * SIDE) as f32;
        assert!((mean - 0.5).abs() < 1e-4, "{mean}");
        assert_ne!(texture, repeating_noise(32, 6));
    }
}
