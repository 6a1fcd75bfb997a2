//! Noise of pigment: clouds carried by the water of a wet wash, and grains that gather in flocks of
//! several sizes. You also find the quantiles of such a texture here.

use graphics::field::Field;
use graphics::noise::{Hills, random};
use rand::RngExt;
use rayon::prelude::*;

use crate::settings::{DispersionSettings, FlowSettings};

/// Standard deviation of the texture before clipping to 0..1. Chosen by eye.
const SPREAD: f64 = 0.2;

/// A sum of octaves of gradient noise (Perlin 2002), each with half the wavelength and half
/// the amplitude of the previous one (Bousseau et al. 2006, section 3.2).
///
/// The mean is 0.5, the standard deviation 0.2. Values outside 0..1 (about 1 %) are clipped.
/// Nearly all power lies between half a wave per widest cloud and two waves per narrowest
/// one. The value of a pixel does not depend on the size of the field.
#[must_use]
pub fn turbulent_flow(width: usize, height: usize, settings: &FlowSettings) -> Field<f32> {
    let mut random = random(settings.seed, 11);
    let mut variance = 0.0;
    let octaves: Vec<(Hills, f32, f32)> = (0..settings.octaves as i32)
        .map(|octave| {
            let share = 0.5_f64.powi(octave);
            variance += Hills::VARIANCE * share * share;
            let step = 2.0_f64.powi(octave) / f64::from(settings.size_px.max(1.0));
            (Hills::new(&mut random), share as f32, step as f32)
        })
        .collect();
    let scale = (SPREAD / variance.sqrt()) as f32;
    let mut flow = Field::filled(width, height, 0.0);
    flow.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        for (x, out) in row.iter_mut().enumerate() {
            let sum: f32 = octaves
                .iter()
                .map(|(hills, share, step)| share * hills.at(x as f32 * step, y as f32 * step))
                .sum();
            *out = (0.5 + scale * sum).clamp(0.0, 1.0);
        }
    });
    flow
}

/// Standard deviation of the texture before clipping to 0..1. Chosen by eye.
const DISPERSION_SPREAD: f64 = 0.2;

/// A sum of white Gaussian noises, each blurred by a Gaussian twice as wide as the one
/// before and scaled to the same standard deviation (Bousseau et al. 2006, section 3.2).
///
/// The mean is 0.5, the standard deviation 0.2. Values outside 0..1 (about 1 %) are clipped.
/// Blur kernels end at three standard deviations. The finest blur keeps the share
/// `exp(-2 (pi finest / n)^2)` of the amplitude of a wave of `n` px.
#[must_use]
pub fn dispersion(width: usize, height: usize, settings: &DispersionSettings) -> Field<f32> {
    let mut sum = Field::filled(width, height, 0.0_f32);
    let scale = DISPERSION_SPREAD / f64::from(settings.scales.max(1)).sqrt();
    for octave in 0..settings.scales {
        let sigma = f64::from(settings.finest_px) * 2.0_f64.powi(octave as i32);
        let half = half_gaussian(sigma);
        // Sum of squares of the kernel in one direction. Its square is the sum of the 2D kernel.
        let kept = half[0] * half[0] + 2.0 * half[1..].iter().map(|w| w * w).sum::<f64>();
        let weights: Vec<f32> = half.iter().map(|weight| (weight / kept.sqrt()) as f32).collect();
        let seed = settings.seed.wrapping_mul(64).wrapping_add(u64::from(octave));
        add_grains(&mut sum, &weights, seed, scale as f32);
    }
    sum.values_mut().par_iter_mut().for_each(|value| *value = (0.5 + *value).clamp(0.0, 1.0));
    sum
}

/// Right half of a Gaussian kernel, centre first, not normalised. `sigma` is in px.
fn half_gaussian(sigma: f64) -> Vec<f64> {
    let radius = (3.0 * sigma).ceil() as usize;
    (0..=radius).map(|i| (-0.5 * (i as f64 / sigma).powi(2)).exp()).collect()
}

/// Adds blurred white noise of unit variance times `scale`. The noise extends beyond the
/// borders, so that the texture has the same statistics there.
fn add_grains(sum: &mut Field<f32>, half: &[f32], seed: u64, scale: f32) {
    let radius = half.len() - 1;
    let width = sum.width();
    let height = sum.height();
    let wide = width + 2 * radius;
    let mut sideways = vec![0.0_f32; width * (height + 2 * radius)];
    sideways.par_chunks_mut(width.max(1)).enumerate().for_each_init(
        || vec![0.0; wide],
        |noise, (y, out)| {
            // Each row has its own random stream, so that rows can be computed in any order.
            gaussian(noise, seed, y as u64);
            for (x, out) in out.iter_mut().enumerate() {
                *out = mean(half, |tap| noise[(x + radius).wrapping_add_signed(tap)]);
            }
        },
    );
    sum.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, out)| {
        for (x, out) in out.iter_mut().enumerate() {
            *out += scale
                * mean(half, |tap| sideways[(y + radius).wrapping_add_signed(tap) * width + x]);
        }
    });
}

fn mean(half: &[f32], at: impl Fn(isize) -> f32) -> f32 {
    let pairs = half.iter().zip(0..).skip(1);
    half[0] * at(0) + pairs.map(|(weight, i)| weight * (at(-i) + at(i))).sum::<f32>()
}

/// Fills `row` with normally distributed numbers, two at a time (Box and Muller 1958).
fn gaussian(row: &mut [f32], seed: u64, stream: u64) {
    let mut random = random(seed, stream);
    for pair in row.chunks_mut(2) {
        let radius = (-2.0 * (1.0 - random.random::<f32>()).ln()).sqrt();
        let (sin, cos) = (std::f32::consts::TAU * random.random::<f32>()).sin_cos();
        for (out, part) in pair.iter_mut().zip([cos, sin]) {
            *out = radius * part;
        }
    }
}

/// Number of intervals of the table.
const INTERVALS: usize = 1024;

/// The values of a texture below which 0, 1/1024, 2/1024 .. 1 of its pixels lie.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantiles(Vec<f32>);

impl Quantiles {
    /// The quantiles of `texture`. For an empty one they are 0.5.
    #[must_use]
    pub fn of(texture: &Field<f32>) -> Self {
        let mut sorted = texture.values().to_vec();
        sorted.par_sort_unstable_by(f32::total_cmp);
        let last = sorted.len().saturating_sub(1);
        let places = (0..=INTERVALS).map(|i| i * last / INTERVALS);
        Self(places.map(|place| sorted.get(place).copied().unwrap_or(0.5)).collect())
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
