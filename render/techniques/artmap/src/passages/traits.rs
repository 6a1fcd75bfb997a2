//! Traits of regions by which they are joined: tone, contrast, and direction of strokes.
//!
//! Yan, Chi, Lee and Lin (2008, section 4.1) average the directions of the strongest fifth of the
//! gradients. Angles jump from 180 to 0 degrees, so the structure tensor is averaged instead.

use std::f64::consts::PI;

use graphics::field::Field;
use rayon::prelude::*;

use super::regions::Regions;

/// Share of the strongest gradients that tell the direction.
const STRONGEST: f64 = 0.2;

/// Depth from which gradients do not feel the neighbouring region.
const INSIDE: u32 = 4;

/// Differences that cost 1: of the mean intensity and its deviation (0..1), and of the direction.
const MEAN_STEP: f64 = 0.08;
const DEVIATION_STEP: f64 = 0.05;
const ANGLE_STEP: f64 = 25.0 * PI / 180.0;

/// Sums over a region, from which its traits follow. Sums of joined regions are added.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct RegionTraits {
    /// Number of pixels.
    pub(super) pixels: f64,
    /// Sum of the intensity.
    sum: f64,
    /// Sum of its square.
    squares: f64,
    /// Sum of the strongest gradients with their angles doubled: along x and y.
    doubled: [f64; 2],
    /// Sum of the squared lengths of these gradients.
    strength: f64,
}

impl RegionTraits {
    /// Traits of the given pixels. `depth` is the distance of each pixel from the region's border.
    pub(super) fn of(
        pixels: &[u32],
        depth: &Field<u32>,
        intensity: &Field<f32>,
        gradient: &Field<[f32; 2]>,
    ) -> Self {
        let mut traits = Self { pixels: pixels.len() as f64, ..Self::default() };
        for &pixel in pixels {
            let value = f64::from(intensity.values()[pixel as usize]);
            traits.sum += value;
            traits.squares += value * value;
        }
        for pixel in strongest(&inner(pixels, depth), gradient) {
            let [x, y] = gradient.values()[pixel as usize].map(f64::from);
            traits.doubled[0] += x * x - y * y;
            traits.doubled[1] += 2.0 * x * y;
            traits.strength += x * x + y * y;
        }
        traits
    }

    /// Adds the sums of another region.
    pub(super) fn add(&mut self, other: &Self) {
        self.pixels += other.pixels;
        self.sum += other.sum;
        self.squares += other.squares;
        self.doubled[0] += other.doubled[0];
        self.doubled[1] += other.doubled[1];
        self.strength += other.strength;
    }

    /// Mean intensity, 0 to 1.
    pub(super) fn mean(&self) -> f64 {
        self.sum / self.pixels.max(1.0)
    }

    /// Standard deviation of the intensity.
    pub(super) fn deviation(&self) -> f64 {
        (self.squares / self.pixels.max(1.0) - self.mean().powi(2)).max(0.0).sqrt()
    }

    /// Share of the gradients that agree in direction: 1 if all do, 0 without any direction.
    pub(super) fn coherence(&self) -> f64 {
        let [x, y] = self.doubled;
        if self.strength > 0.0 { (x.hypot(y) / self.strength).min(1.0) } else { 0.0 }
    }

    /// Angle of the strokes, which run across the gradient, in radians from 0 to pi: 0 along x,
    /// growing from x (right) to y (down).
    pub(super) fn angle(&self) -> f64 {
        let [x, y] = self.doubled;
        let angle = (0.5 * y.atan2(x) + 0.5 * PI).rem_euclid(PI);
        // Rounding may reach pi itself.
        if angle < PI { angle } else { 0.0 }
    }

    /// Unlikeness of two regions; those below 1 are joined.
    pub(super) fn apart(&self, other: &Self) -> f64 {
        let mean = (self.mean() - other.mean()) / MEAN_STEP;
        let deviation = (self.deviation() - other.deviation()) / DEVIATION_STEP;
        let turn = (self.angle() - other.angle()).abs();
        let turn = turn.min(PI - turn) / ANGLE_STEP;
        let coherence = self.coherence().min(other.coherence());
        (mean * mean + deviation * deviation + coherence * turn * turn).sqrt()
    }
}

/// Traits of all regions.
pub(super) fn traits_of(
    regions: &Regions,
    intensity: &Field<f32>,
    gradient: &Field<[f32; 2]>,
) -> Vec<RegionTraits> {
    let depth = regions.depths();
    let pixels = regions.pixels();
    pixels
        .par_iter()
        .map(|pixels: &Vec<u32>| RegionTraits::of(pixels, &depth, intensity, gradient))
        .collect()
}

/// Those pixels whose gradients belong to the region: the ones deep inside if they are a quarter
/// of it, else those not at its border, else all.
fn inner(pixels: &[u32], depth: &Field<u32>) -> Vec<u32> {
    let depths = [INSIDE, 2];
    let found = depths
        .into_iter()
        .map(|least: u32| -> Vec<u32> {
            pixels
                .iter()
                .copied()
                .filter(|pixel: &u32| depth.values()[*pixel as usize] >= least)
                .collect()
        })
        .find(|inner| inner.len() * 4 >= pixels.len());
    found.unwrap_or_else(|| pixels.to_vec())
}

/// The fifth of the pixels that has the largest gradients; of equal ones the first.
fn strongest(pixels: &[u32], gradient: &Field<[f32; 2]>) -> Vec<u32> {
    let mut by_strength: Vec<(u32, u32)> = pixels
        .iter()
        .map(|&pixel| {
            let [x, y] = gradient.values()[pixel as usize];
            // Bits of numbers of at least 0 are in their order; the complement turns it around.
            (!(x * x + y * y).to_bits(), pixel)
        })
        .collect();
    let count = (pixels.len() as f64 * STRONGEST).ceil() as usize;
    if count > 0 && count < by_strength.len() {
        by_strength.select_nth_unstable(count - 1);
        by_strength.truncate(count);
    }
    by_strength.sort_unstable_by_key(|&(_, pixel)| pixel);
    by_strength.into_iter().map(|(_, pixel)| pixel).collect()
}

#[cfg(test)]
mod tests {
    use super::super::perceived::gradient_of;
    use super::*;

    /// Waves whose crests run at an angle, about a mean.
    fn waves(degrees: f64, mean: f64, height: f64) -> RegionTraits {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let intensity = Field::from_values(
            60,
            60,
            (0..3600)
                .map(|i: usize| {
                    let across = (i % 60) as f64 * -sin + (i / 60) as f64 * cos;
                    (mean + height * (across * 0.8).sin()) as f32
                })
                .collect(),
        );
        let whole = Regions { labels: Field::filled(60, 60, 0), count: 1 };
        traits_of(&whole, &intensity, &gradient_of(&intensity))[0]
    }

    #[test]
    fn waves_have_their_mean_deviation_and_direction() {
        for degrees in [0.0, 30.0, 75.0, 120.0, 179.0] {
            let found = waves(degrees, 0.4, 0.1);
            assert!((found.mean() - 0.4).abs() < 0.01, "{}", found.mean());
            assert!((found.deviation() - 0.1 / 2f64.sqrt()).abs() < 0.005, "{found:?}");
            assert!(found.coherence() > 0.95, "{}", found.coherence());
            let off = (found.angle().to_degrees() - degrees).abs();
            assert!(off.min(180.0 - off) < 1.0, "{} of {degrees}", found.angle().to_degrees());
        }
    }

    #[test]
    fn unlikeness_is_that_of_its_formula() {
        let [one, other] = [waves(175.0, 0.4, 0.1), waves(5.0, 0.44, 0.1)];
        let coherence = one.coherence().min(other.coherence());
        let wanted = ((0.04f64 / 0.08).powi(2) + coherence * (10.0f64 / 25.0).powi(2)).sqrt();
        assert!((one.apart(&other) - wanted).abs() < 0.03, "{} {wanted}", one.apart(&other));
        let flat = RegionTraits { pixels: 9.0, sum: 3.6, squares: 1.44, ..one };
        let flat = RegionTraits { doubled: [0.0; 2], strength: 0.0, ..flat };
        let wanted = one.deviation() / 0.05;
        assert!((one.apart(&flat) - wanted).abs() < 0.03, "no direction, no cost of turning");
    }

    #[test]
    fn a_border_does_not_lend_its_direction() {
        // Waves along x at the left, a much lighter area at the right.
        let value = |i: usize| match i % 60 < 30 {
            true => 0.3 + 0.05 * ((i / 60) as f32 * 0.9).sin(),
            false => 0.9,
        };
        let intensity = Field::from_values(60, 60, (0..3600).map(value).collect());
        let labels = (0..3600).map(|i| u32::from(i % 60 >= 30)).collect();
        let regions = Regions { labels: Field::from_values(60, 60, labels), count: 2 };
        let found = &traits_of(&regions, &intensity, &gradient_of(&intensity))[0];
        let degrees = found.angle().to_degrees();
        assert!(!(1.0..=179.0).contains(&degrees), "{degrees}");
    }
}
