//! Measures how well a map has the brushwork of its sample. You can compare its contrast and
//! strokes with the sample, see how maps agree with each other and with themselves across their
//! borders, and how often they repeat a place of their sample.

use graphics::blurred;
use graphics::encoding::lab_from_linear;
use graphics::field::Field;
use graphics::picture::Picture;

use crate::relief::blurred_tile;

/// L* of a texture that tiles, or of a sample with a mask.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    lightness: Field<f32>,
    /// Texels that belong to it. `None` if the texture tiles and all do.
    mask: Option<Field<bool>>,
}

impl Texture {
    /// A texture of linear sRGB that tiles.
    #[must_use]
    pub fn tiled(color: &Picture) -> Self {
        Self { lightness: lightness(color), mask: None }
    }

    /// Takes the texels of a sample, in linear sRGB, that are true in the mask.
    ///
    /// # Panics
    /// If the sizes differ.
    #[must_use]
    pub fn masked(color: &Picture, mask: &Field<bool>) -> Self {
        let size = (color.width(), color.height());
        let covered = (mask.width(), mask.height());
        assert_eq!(size, covered, "a mask must cover its sample");
        Self { lightness: lightness(color), mask: Some(mask.clone()) }
    }

    /// The texture without its variation over distances much longer than `sigma` texels. This
    /// subtracts from L* its mean around each texel, weighted by a Gaussian of this deviation.
    #[must_use]
    pub fn levelled(&self, sigma: f64) -> Self {
        let means = match &self.mask {
            None => blurred_tile(&self.lightness, sigma),
            Some(mask) => masked_blur(&self.lightness, mask, sigma),
        };
        let mut lightness = self.lightness.clone();
        let pairs = lightness.values_mut().iter_mut().zip(means.values());
        pairs.for_each(|(value, mean)| *value -= mean);
        Self { lightness, mask: self.mask.clone() }
    }

    /// Width and height in texels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.lightness.width(), self.lightness.height())
    }

    /// Mean L* of the texels that belong to it.
    #[must_use]
    pub fn tone(&self) -> f64 {
        let count = self.inside().count().max(1) as f64;
        self.inside().map(f64::from).sum::<f64>() / count
    }

    /// L* of every texel, also outside the mask.
    #[must_use]
    pub fn lightness(&self) -> &Field<f32> {
        &self.lightness
    }

    fn inside(&self) -> impl Iterator<Item = f32> + '_ {
        let values = self.lightness.values().iter().enumerate();
        values
            .filter(move |(index, _)| self.mask.as_ref().is_none_or(|mask| mask.values()[*index]))
            .map(|(_, value)| *value)
    }

    /// Calls `with` with L* of every texel and of the texel `step` away, if both belong to the
    /// texture.
    fn pairs(&self, step: [isize; 2], mut with: impl FnMut(f32, f32)) {
        let (width, height) = self.size();
        for y in 0..height {
            for x in 0..width {
                let u = x as isize + step[0];
                let v = y as isize + step[1];
                let other = if self.mask.is_none() {
                    (u.rem_euclid(width as isize) as usize, v.rem_euclid(height as isize) as usize)
                } else if u < 0 || v < 0 || u >= width as isize || v >= height as isize {
                    continue;
                } else {
                    (u as usize, v as usize)
                };
                if self.mask.as_ref().is_none_or(|mask| mask[(x, y)] && mask[other]) {
                    with(self.lightness[(x, y)], self.lightness[other]);
                }
            }
        }
    }
}

/// Blurs the values inside a mask. Values outside count for nothing.
fn masked_blur(values: &Field<f32>, mask: &Field<bool>, sigma: f64) -> Field<f32> {
    let weighed = values
        .values()
        .iter()
        .zip(mask.values())
        .map(|(value, &inside): (&f32, &bool)| {
            let weight = f32::from(inside);
            [weight * value, weight]
        })
        .collect();
    let width = values.width();
    let height = values.height();
    let sums = blurred(&Field::from_values(width, height, weighed), sigma);
    Field::from_values(
        width,
        height,
        sums.values()
            .iter()
            .map(|&[sum, weight]: &[f32; 2]| if weight > 1e-4 { sum / weight } else { 0.0 })
            .collect(),
    )
}

fn lightness(color: &Picture) -> Field<f32> {
    let lab = lab_from_linear(color);
    let values = lab.values().iter().map(|lab| lab[0]).collect();
    Field::from_values(lab.width(), lab.height(), values)
}

const LEVELS: usize = 16;
/// We ignore this share of the texels below the darkest and above the lightest level.
const TAILS: f64 = 0.005;
/// We compare texels at these distances: along both axes and both diagonals.
const STEPS: [[isize; 2]; 14] = [
    [1, 0],
    [2, 0],
    [4, 0],
    [8, 0],
    [0, 1],
    [0, 2],
    [0, 4],
    [0, 8],
    [1, 1],
    [3, 3],
    [6, 6],
    [1, -1],
    [3, -3],
    [6, -6],
];
/// A stroke ends at this correlation.
const END: f64 = 0.05;

/// Average co-occurrence error between two textures, from 0 (alike) to 2. It measures how often
/// grey levels stand at given distances from each other. This predicts how people rank textures
/// (Benard, Thollot and Sillion 2009). We divide L* into 16 levels between the 0.5 and 99.5
/// percentiles of `reference`.
#[must_use]
pub fn co_occurrence_error(reference: &Texture, other: &Texture) -> f64 {
    let mut sorted: Vec<f32> = reference.inside().collect();
    if sorted.is_empty() {
        return 2.0;
    }
    sorted.sort_by(f32::total_cmp);
    let tail = (TAILS * sorted.len() as f64) as usize;
    let least = sorted[tail];
    let most = sorted[sorted.len() - 1 - tail];
    let per_level = LEVELS as f32 / (most - least).max(1e-6);
    fn level(value: f32, least: f32, per_level: f32) -> usize {
        (((value - least) * per_level).max(0.0) as usize).min(LEVELS - 1)
    }
    STEPS
        .iter()
        .map(|&step: &[isize; 2]| {
            let [first, second] = [reference, other].map(|texture| {
                let mut counts = [0_u64; LEVELS * LEVELS];
                texture.pairs(step, |a, b| {
                    counts[level(a, least, per_level) * LEVELS + level(b, least, per_level)] += 1;
                });
                let total = counts.iter().sum::<u64>().max(1) as f64;
                counts.map(|count| count as f64 / total)
            });
            first.iter().zip(second).map(|(a, b)| (a - b).abs()).sum::<f64>()
        })
        .sum::<f64>()
        / STEPS.len() as f64
}

/// Standard deviation of L*.
#[must_use]
pub fn contrast(texture: &Texture) -> f64 {
    moments(texture).1.sqrt()
}

/// Length of strokes in texels along y: the integral of the autocorrelation of L* until it falls
/// below 0.05. Unevenness over long distances counts as well. If you compare textures of different
/// size, use [`Texture::levelled`] first.
#[must_use]
pub fn stroke_length(texture: &Texture) -> f64 {
    let (mean, variance) = moments(texture);
    if variance <= 0.0 {
        return 0.0;
    }
    let mut length = 0.5;
    for step in 1..texture.size().1 / 2 {
        let mut sum = 0.0;
        let mut count = 0_u64;
        texture.pairs([0, step as isize], |a, b| {
            sum += (f64::from(a) - mean) * (f64::from(b) - mean);
            count += 1;
        });
        let correlation = sum / count.max(1) as f64 / variance;
        if correlation < END {
            break;
        }
        length += correlation;
    }
    length
}

fn moments(texture: &Texture) -> (f64, f64) {
    let count = texture.inside().count().max(1) as f64;
    let mean = texture.inside().map(f64::from).sum::<f64>() / count;
    let squares = texture.inside().map(|value| (f64::from(value) - mean).powi(2));
    (mean, squares.sum::<f64>() / count)
}

/// Deviation, in texels, of the blur before we compare lightness.
const DETAIL: f64 = 2.0;

/// Correlation of the detail of L* of two maps that tile, -1 to 1. Use this to see whether their
/// strokes stand at the same places. Detail is L* blurred by 2 texels, less L* blurred by
/// `spacing`, the distance between strokes.
///
/// # Panics
/// If the maps differ in size.
#[must_use]
pub fn coherence(first: &Texture, second: &Texture, spacing: f64) -> f64 {
    assert_eq!(first.size(), second.size(), "maps must be of one size");
    let first = detail(first.lightness(), spacing);
    let second = detail(second.lightness(), spacing);
    fn sum(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>()
    }
    let squares = sum(&first, &first) * sum(&second, &second);
    if squares > 0.0 { sum(&first, &second) / squares.sqrt() } else { 0.0 }
}

/// Mean step of L* across the borders of a map that tiles, over the mean step within it. If this
/// is 1, no seam shows.
#[must_use]
pub fn wrap_ratio(map: &Texture) -> f64 {
    let (width, height) = map.size();
    let lightness = map.lightness();
    let mut across = (0.0, 0_u64);
    let mut inside = (0.0, 0_u64);
    for y in 0..height {
        for x in 0..width {
            let right = (x + 1) % width;
            let below = (y + 1) % height;
            for (wraps, beside) in [(right == 0, (right, y)), (below == 0, (x, below))] {
                let (sum, count) = if wraps { &mut across } else { &mut inside };
                *sum += f64::from((lightness[(x, y)] - lightness[beside]).abs());
                *count += 1;
            }
        }
    }
    fn mean((sum, count): (f64, u64)) -> f64 {
        sum / count.max(1) as f64
    }
    if mean(inside) > 0.0 { mean(across) / mean(inside) } else { 1.0 }
}

/// The ratio of [`wrap_ratio`] that 95 of 100 places inside the map stay below, where each inner
/// column and row counts as if it were the border. If the border is above this value, it stands
/// out. Strokes that happen to end at one place raise both.
#[must_use]
pub fn usual_wrap_ratio(map: &Texture) -> f64 {
    let (width, height) = map.size();
    let lightness = map.lightness();
    fn step(a: (usize, usize), b: (usize, usize), lightness: &Field<f32>) -> f64 {
        f64::from((lightness[a] - lightness[b]).abs())
    }
    let columns: Vec<f64> = (0..width.saturating_sub(1))
        .map(|x: usize| (0..height).map(|y| step((x, y), (x + 1, y), lightness)).sum::<f64>())
        .collect();
    let rows: Vec<f64> = (0..height.saturating_sub(1))
        .map(|y: usize| (0..width).map(|x| step((x, y), (x, y + 1), lightness)).sum::<f64>())
        .collect();
    let inside: f64 = columns.iter().chain(&rows).sum();
    if inside <= 0.0 {
        return 1.0;
    }
    let mean = inside / (columns.len() * height + rows.len() * width) as f64;
    let pairs = columns.iter().zip(&rows);
    let mut ratios: Vec<f64> =
        pairs.map(|(x, y)| (x + y) / (width + height) as f64 / mean).collect();
    ratios.sort_by(f64::total_cmp);
    ratios.get(ratios.len() * 95 / 100).copied().unwrap_or(1.0)
}

/// How often a map uses the most used part of its sample, relative to the mean use of all parts. It
/// is 1 if all parts are used equally. If the map is too small to show every part once, this is
/// relative to a single use instead. Parts are squares of `block` texels that lie in the mask.
#[must_use]
pub fn most_used(sources: &Field<[u16; 2]>, mask: &Field<bool>, block: usize) -> f64 {
    let width = mask.width().div_ceil(block);
    let height = mask.height().div_ceil(block);
    let mut used = vec![0_u64; width * height];
    let mut inside = vec![0_u64; width * height];
    fn part(x: usize, y: usize, block: usize, width: usize) -> usize {
        y / block * width + x / block
    }
    for &[x, y] in sources.values() {
        used[part(usize::from(x), usize::from(y), block, width)] += 1;
    }
    for (index, &is_inside) in mask.values().iter().enumerate() {
        inside[part(index % mask.width(), index / mask.width(), block, width)] +=
            u64::from(is_inside);
    }
    let all = inside.iter().sum::<u64>().max(1) as f64;
    let mean = (sources.values().len() as f64 / all).max(1.0);
    let uses = used
        .iter()
        .zip(&inside)
        .filter(|(_, inside): &(&u64, &u64)| **inside == (block * block) as u64);
    uses.map(|(&used, &inside)| used as f64 / inside as f64 / mean).fold(0.0, f64::max)
}

fn detail(lightness: &Field<f32>, spacing: f64) -> Vec<f64> {
    let fine = blurred_tile(lightness, DETAIL);
    let coarse = blurred_tile(lightness, spacing.max(2.0 * DETAIL));
    let pairs = fine.values().iter().zip(coarse.values());
    pairs.map(|(fine, coarse)| f64::from(fine - coarse)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use graphics::field::Field;

    fn dashes(size: usize, length: usize, spacing: usize, dark: f32) -> Texture {
        let values = (0..size * size)
            .map(|index: usize| {
                let x = index % size;
                let y = index / size;
                let column = x / spacing;
                let even = ((y + 7 * column * column) / length).is_multiple_of(2);
                let on = even && x % spacing < spacing / 2;
                [if on { dark } else { 0.8 }; 3]
            })
            .collect();
        Texture::tiled(&Field::from_values(size, size, values))
    }

    #[test]
    fn a_texture_has_no_error_to_itself_and_much_to_another() {
        let short = dashes(96, 8, 8, 0.1);
        assert_eq!(co_occurrence_error(&short, &short), 0.0);
        let moved = dashes(96, 8, 8, 0.1);
        assert!(co_occurrence_error(&short, &moved) < 0.05);
        let other = dashes(96, 24, 16, 0.4);
        assert!(co_occurrence_error(&short, &other) > 0.8);
    }

    #[test]
    fn longer_dashes_have_longer_strokes_and_paler_ones_less_contrast() {
        let short = dashes(96, 8, 8, 0.1);
        let long = dashes(96, 24, 8, 0.1);
        let ratio = stroke_length(&long) / stroke_length(&short);
        assert!((2.0..4.0).contains(&ratio), "{ratio}");
        assert!(contrast(&dashes(96, 8, 8, 0.4)) < 0.6 * contrast(&short));
    }

    #[test]
    fn a_gradient_does_not_lengthen_the_strokes_of_a_levelled_texture() {
        let short = dashes(96, 8, 8, 0.5);
        let mask = Field::filled(96, 96, true);
        let uneven = Field::from_values(
            96,
            96,
            (0..96 * 96)
                .map(|index: usize| {
                    let on = short.lightness().values()[index] < 80.0;
                    [(if on { 0.5 } else { 0.8 }) * (0.1 + (index / 96) as f32 / 96.0); 3]
                })
                .collect(),
        );
        let uneven = Texture::masked(&uneven, &mask);
        assert!(stroke_length(&uneven) > 1.5 * stroke_length(&short));
        let ratio = stroke_length(&uneven.levelled(16.0)) / stroke_length(&short.levelled(16.0));
        assert!((0.8..1.2).contains(&ratio), "{ratio}");
    }

    #[test]
    fn a_flat_texture_has_neither_contrast_nor_strokes() {
        let flat = Texture::tiled(&Field::filled(32, 32, [0.5; 3]));
        assert_eq!((contrast(&flat) < 1e-4, stroke_length(&flat)), (true, 0.0));
    }

    fn waves(size: usize, period: f32, phase: f32, offset: f32) -> Texture {
        Texture::tiled(&Field::from_values(
            size,
            size,
            (0..size * size)
                .map(|index: usize| {
                    let angle = ((index % size) as f32 / period + phase) * std::f32::consts::TAU;
                    [offset + 0.2 * angle.sin(); 3]
                })
                .collect(),
        ))
    }

    #[test]
    fn strokes_at_the_same_places_are_coherent_whatever_their_tone() {
        let map = waves(96, 12.0, 0.0, 0.3);
        assert!(coherence(&map, &waves(96, 12.0, 0.0, 0.6), 12.0) > 0.95);
        assert!(coherence(&map, &waves(96, 12.0, 0.25, 0.3), 12.0).abs() < 0.1);
        assert!(coherence(&map, &waves(96, 12.0, 0.5, 0.3), 12.0) < -0.9);
    }

    #[test]
    fn a_border_that_does_not_fit_shows() {
        assert!(wrap_ratio(&waves(96, 12.0, 0.1, 0.3)) < 1.2);
        assert!(wrap_ratio(&waves(90, 12.0, 0.25, 0.3)) > 1.3);
    }

    #[test]
    fn places_inside_tell_what_is_usual() {
        // Waves along x: the steps down are 0. The steps across rise and fall with the waves, so
        // that the steepest columns have pi / 2 times the mean of columns.
        let map = waves(96, 12.0, 0.1, 0.3);
        let usual = usual_wrap_ratio(&map);
        assert!((usual - std::f64::consts::FRAC_PI_2).abs() < 0.1, "{usual}");
        fn noise(index: usize) -> [f32; 3] {
            [((index * 7919 % 4093) as f32 / 4093.0) * 0.5; 3]
        }
        let noise = Field::from_values(64, 64, (0..64 * 64).map(noise).collect());
        let usual = usual_wrap_ratio(&Texture::tiled(&noise));
        assert!((1.0..1.3).contains(&usual), "{usual}");
        assert_eq!(usual_wrap_ratio(&Texture::tiled(&Field::filled(8, 8, [0.2; 3]))), 1.0);
    }

    #[test]
    fn a_place_used_for_everything_is_counted() {
        let mask = Field::filled(64, 64, true);
        let evenly = Field::from_values(
            64,
            64,
            (0..64 * 64).map(|index: usize| [(index % 64) as u16, (index / 64) as u16]).collect(),
        );
        assert!((most_used(&evenly, &mask, 16) - 1.0).abs() < 1e-9);
        let once = Field::filled(64, 64, [5, 5]);
        assert!((most_used(&once, &mask, 16) - 16.0).abs() < 1e-9);
    }
}
