//! One level of a sample's Gaussian pyramid with the values by which we compare patches. Also the
//! grid of patches on a map that tiles, and the settings and errors of the synthesis.
//!
//! Samples may be nested. This means that their strokes stand at the places of another sample's
//! strokes, e.g. in painted tones with the same strokes.

use documents::hint::Explain;
use graphics::blurred;
use graphics::encoding::lab_from_linear;
use graphics::field::Field;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::sample::Sample;

/// We compare patches of different samples by this many channels.
pub(crate) const FEATURES: usize = 5;
/// We compare overlaps within a sample by this many channels.
pub(crate) const LOOKS: usize = 4;
/// We blur by this deviation before we halve a level, in texels.
const BEFORE_HALVING: f64 = 0.8;
/// Weight of height beside colour when we compare overlaps.
const HEIGHT: f32 = 0.7;
/// If the deviation of a* or b* in CIELAB is below this, a sample counts as grey.
const GREY: f64 = 1.0;

/// L*, a*, b* and height in mm of a sample at one resolution.
#[derive(Debug, Clone)]
pub(crate) struct Channels {
    values: Field<[f32; LOOKS]>,
    mask: Field<bool>,
}

#[derive(Debug, Clone)]
pub(crate) struct Level {
    /// Colour and height, scaled by their deviation. Use this to compare texels of this sample.
    pub(crate) look: Field<[f32; LOOKS]>,
    /// Channels of deviation 1. Use this to compare patches of different samples.
    pub(crate) features: Field<[f32; FEATURES]>,
    /// Weight of a texel in overlaps. It is 1, and more at edges.
    pub(crate) weight: Field<f32>,
    pub(crate) mask: Field<bool>,
    pub(crate) contrast: f64,
}

impl Channels {
    pub(crate) fn of(sample: &Sample) -> Self {
        let lab = lab_from_linear(&sample.color);
        let (width, height) = sample.size();
        let values = lab
            .values()
            .iter()
            .enumerate()
            .map(|(index, &[l, a, b]): (usize, &[f32; 3])| {
                [l, a, b, sample.height_mm.as_ref().map_or(0.0, |heights| heights.values()[index])]
            })
            .collect();
        Self { values: Field::from_values(width, height, values), mask: sample.mask.clone() }
    }

    /// The next coarser level: texel `(x, y)` covers texels `2 x, 2 x + 1` and `2 y, 2 y + 1`.
    pub(crate) fn halved(&self) -> Self {
        let smooth = self.smooth(BEFORE_HALVING);
        let width = self.mask.width() / 2;
        let height = self.mask.height() / 2;
        let mut values = Vec::with_capacity(width * height);
        let mut mask = Vec::with_capacity(width * height);
        for y in 0..height {
            for x in 0..width {
                let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| (2 * x + i, 2 * y + j));
                values.push(std::array::from_fn(|channel| {
                    four.iter().map(|&at| smooth[at][channel]).sum::<f32>() / 4.0
                }));
                mask.push(four.iter().all(|&at| self.mask[at]));
            }
        }
        let values = Field::from_values(width, height, values);
        let mask = mask;
        Self { values, mask: Field::from_values(width, height, mask) }
    }

    /// Blurs the channels. This fills texels outside the mask from their neighbours.
    fn smooth(&self, sigma: f64) -> Field<[f32; LOOKS]> {
        let weighed = self
            .values
            .values()
            .iter()
            .zip(self.mask.values())
            .map(|(value, &inside): (&[f32; LOOKS], &bool)| {
                let [l, a, b, height] = if inside { *value } else { [0.0; LOOKS] };
                [l, a, b, height, f32::from(inside)]
            })
            .collect();
        let width = self.mask.width();
        let height = self.mask.height();
        let sums = blurred(&Field::from_values(width, height, weighed), sigma);
        Field::from_values(
            width,
            height,
            sums.values()
                .iter()
                .map(|&[l, a, b, height, weight]: &[f32; LOOKS + 1]| {
                    if weight > 1e-4 {
                        [l, a, b, height].map(|sum| sum / weight)
                    } else {
                        [0.0; LOOKS]
                    }
                })
                .collect(),
        )
    }

    /// Slope of a channel of `fine` over its L*, over the mask. This is 0 where L* is even.
    fn slope_over_lightness(&self, fine: &Field<[f32; LOOKS]>, channel: usize) -> f32 {
        let (mean, deviation) = self.moments(|index| fine.values()[index][0]);
        let covariance = self
            .moments(|index: usize| {
                let value = fine.values()[index];
                (value[0] - mean as f32) * value[channel]
            })
            .0;
        if deviation > 0.0 { (covariance / (deviation * deviation)) as f32 } else { 0.0 }
    }

    /// Mean and deviation of a channel over the mask. `value` gives its values.
    fn moments(&self, value: impl Fn(usize) -> f32) -> (f64, f64) {
        let inside = (0..self.mask.values().len()).filter(|&index| self.mask.values()[index]);
        let inside: Vec<f64> = inside.map(|index| f64::from(value(index))).collect();
        let count = inside.len().max(1) as f64;
        let mean = inside.iter().sum::<f64>() / count;
        let squares = inside.iter().map(|value| (value - mean).powi(2));
        (mean, (squares.sum::<f64>() / count).sqrt())
    }
}

impl Level {
    /// Builds a level from `channels`, with strokes `spacing` texels apart.
    pub(crate) fn new(channels: &Channels, spacing: f64, features: Features) -> Self {
        let values = &channels.values;
        let width = values.width();
        let height = values.height();
        let fine = channels.smooth((spacing / 8.0).clamp(0.5, 1.0));
        let edges = edge_strength(&fine);
        // Across the tones of one paint, a* and b* may rise or fall with L*. We leave to L* what
        // follows from L*.
        let slopes = [1, 2].map(|channel| channels.slope_over_lightness(&fine, channel));
        let raw = |index: usize| {
            let [l, a, b, height] = fine.values()[index];
            [edges[index], l, a - slopes[0] * l, b - slopes[1] * l, height]
        };
        let scales: [(f32, f32); FEATURES] = std::array::from_fn(|feature| {
            let (mean, deviation) = channels.moments(|index| raw(index)[feature]);
            let used = match feature {
                0 => deviation > 0.0,
                2 | 3 => deviation >= GREY,
                _ => deviation > 0.0 && features == Features::Tone,
            };
            (mean as f32, if used { (1.0 / deviation) as f32 } else { 0.0 })
        });
        let [l, a, b, height_deviation] =
            [0, 1, 2, 3].map(|channel: usize| channels.moments(|i| values.values()[i][channel]).1);
        let color = (l.powi(2) + a.powi(2) + b.powi(2)).sqrt();
        fn per(deviation: f64) -> f32 {
            if deviation > 0.0 { (1.0 / deviation) as f32 } else { 0.0 }
        }
        let per_color = per(color);
        let per_height = HEIGHT * per(height_deviation);
        let mean_edge = channels.moments(|index| edges[index]).0 as f32;
        let looks = values
            .values()
            .iter()
            .map(|&[l, a, b, height]: &[f32; LOOKS]| {
                [l * per_color, a * per_color, b * per_color, height * per_height]
            })
            .collect();
        let scaled = (0..width * height)
            .map(|index: usize| {
                let raw = raw(index);
                std::array::from_fn(|feature| {
                    (raw[feature] - scales[feature].0) * scales[feature].1
                })
            })
            .collect();
        Self {
            look: Field::from_values(width, height, looks),
            features: Field::from_values(width, height, scaled),
            weight: Field::from_values(
                width,
                height,
                edges
                    .iter()
                    .map(
                        |edge: &f32| {
                            if mean_edge > 0.0 { 1.0 + 2.0 * edge / mean_edge } else { 1.0 }
                        },
                    )
                    .collect(),
            ),
            mask: channels.mask.clone(),
            contrast: channels.moments(|index| fine.values()[index][0]).1,
        }
    }

    /// Whether the sample shows nothing to compare patches by.
    pub(crate) fn is_flat(&self) -> bool {
        self.features.values().iter().all(|features| features.iter().all(|value| *value == 0.0))
    }

    /// Places at which you can put a patch of `patch` x `patch` texels. It goes from there to the
    /// right and down, and must lie in the mask. The places come row by row.
    pub(crate) fn places(&self, patch: usize) -> Vec<[u16; 2]> {
        let width = self.mask.width();
        let height = self.mask.height();
        // Number of texels to the left of and above each corner that lie outside the mask.
        let mut outside = vec![0_u32; (width + 1) * (height + 1)];
        for y in 0..height {
            let mut row = 0;
            for x in 0..width {
                row += u32::from(!self.mask[(x, y)]);
                outside[(y + 1) * (width + 1) + x + 1] = outside[y * (width + 1) + x + 1] + row;
            }
        }
        fn corner(x: usize, y: usize, outside: &[u32], width: usize) -> u32 {
            outside[y * (width + 1) + x]
        }
        let mut places = Vec::new();
        for y in 0..(height + 1).saturating_sub(patch) {
            for x in 0..(width + 1).saturating_sub(patch) {
                let right = x + patch;
                let below = y + patch;
                if corner(right, below, &outside, width) + corner(x, y, &outside, width)
                    == corner(right, y, &outside, width) + corner(x, below, &outside, width)
                {
                    places.push([x as u16, y as u16]);
                }
            }
        }
        places
    }
}

fn edge_strength(fine: &Field<[f32; LOOKS]>) -> Vec<f32> {
    let width = fine.width();
    let height = fine.height();
    let mut edges = Vec::with_capacity(width * height);
    for y in 0..height {
        let above = y.saturating_sub(1);
        let below = (y + 1).min(height - 1);
        for x in 0..width {
            let left = x.saturating_sub(1);
            let right = (x + 1).min(width - 1);
            let over_x = fine[(right, y)][0] - fine[(left, y)][0];
            let over_y = fine[(x, below)][0] - fine[(x, above)][0];
            edges.push((over_x * over_x + over_y * over_y).sqrt() / 2.0);
        }
    }
    edges
}

/// Squared distance of two texels of a sample.
#[inline]
pub(crate) fn difference(a: &[f32; LOOKS], b: &[f32; LOOKS]) -> f32 {
    let mut sum = 0.0;
    for channel in 0..LOOKS {
        sum += (a[channel] - b[channel]) * (a[channel] - b[channel]);
    }
    sum
}

/// Properties by which patches of two samples are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Features {
    /// Strength of edges, lightness, height, a* and b*.
    #[default]
    Tone,
    /// Strength of edges, a* and b*: equations 1 and 2 of Yan and others (2008), with a* and b*
    /// instead of the angle of hue, which means nothing in greys.
    Paper,
}

/// Settings of [`key_maps`](super::key_maps).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct SynthesisSettings {
    /// Width and height of the maps in texels, [`SynthesisSettings::SIZES`].
    pub size: usize,
    /// Name of the sample with the first map, which the other maps follow. `None` takes the sample
    /// with the strongest contrast of lightness.
    pub first: Option<String>,
    /// Properties by which patches are compared.
    pub features: Features,
    /// Number of similar patches in each other sample that we try for a patch of the first map,
    /// 1..=512.
    pub links: usize,
    /// Weight of the likeness of linked patches relative to the likeness of overlaps, 0..=16:
    /// higher keeps maps closer to the first one, lower makes better seams.
    pub follow: f32,
    /// Penalty on places that were used before, 0..=16.
    pub uniformity: f32,
    /// Seed of the choices of the first map.
    pub seed: u64,
}

impl SynthesisSettings {
    /// Range of [`SynthesisSettings::size`].
    pub const SIZES: std::ops::RangeInclusive<usize> = 64..=1024;

    /// Least distance of neighbouring strokes in texels.
    pub const LEAST_SPACING: f64 = 6.0;
}

impl Default for SynthesisSettings {
    fn default() -> Self {
        Self {
            size: 256,
            first: None,
            features: Features::default(),
            links: 32,
            follow: 8.0,
            uniformity: 1.0,
            seed: 1,
        }
    }
}

/// Why maps could not be synthesised.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum SynthesisError {
    /// There are no samples.
    #[error("there is no sample to synthesise from")]
    #[hint("mark at least one passage of the painting")]
    NoSample,
    /// A setting is out of its range.
    #[error("`{name}` is {found}, it must lie within {range}")]
    #[hint("change [{name}]")]
    #[fault(Setting)]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Its value.
        found: String,
        /// The range.
        range: String,
    },
    /// No sample has the name of the first map.
    #[error("no sample is called `{name}`; there are {}", .known.join(", "))]
    #[hint("name one of the samples as [first]")]
    #[fault(Setting)]
    UnknownFirst {
        /// The name that was asked for.
        name: String,
        /// Names of all samples.
        known: Vec<String>,
    },
    /// Strokes stand too close, or too far apart for the size of the maps.
    #[error(
        "strokes of sample `{name}` are {spacing:.1} texels apart; maps of {size} texels take \
         {least} to {most:.0}"
    )]
    #[hint("scale the picture, or make maps of another [size]")]
    Spacing {
        /// Name of the sample.
        name: String,
        /// Its spacing in texels.
        spacing: f64,
        /// Size of the maps in texels.
        size: usize,
        /// Least spacing.
        least: f64,
        /// Most spacing.
        most: f64,
    },
    /// The samples have different spacings.
    #[error(
        "strokes of sample `{name}` are {spacing:.1} texels apart, those of `{first}` {wanted:.1}"
    )]
    #[hint("scale the samples to one spacing")]
    UnlikeSpacings {
        /// Name of the sample.
        name: String,
        /// Its spacing in texels.
        spacing: f64,
        /// Name of the first sample.
        first: String,
        /// Its spacing in texels.
        wanted: f64,
    },
    /// No patch lies wholly in the sample.
    #[error(
        "sample `{name}` of {width} x {height} texels has no room for a patch of {patch} x {patch}"
    )]
    #[hint("mark a passage at least four times as wide and high as its strokes are apart")]
    TooSmall {
        /// Name of the sample.
        name: String,
        /// Its width in texels.
        width: usize,
        /// Its height in texels.
        height: usize,
        /// Side of a patch in texels.
        patch: usize,
    },
    /// A sample is of one colour, without any relief.
    #[error("sample `{0}` is of one colour: it has no strokes")]
    #[hint("mark a passage whose strokes show")]
    Flat(String),
}

/// Patches of one size at equal distances on a torus. They overlap by a third or more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PatchGrid {
    pub(crate) size: usize,
    pub(crate) patch: usize,
    /// Number of patches in a row and in a column, at least 3.
    pub(crate) count: usize,
}

impl PatchGrid {
    pub(crate) fn new(size: usize, patch: usize) -> Self {
        let step = patch - patch.div_ceil(3);
        Self { size, patch, count: size.div_ceil(step).max(3) }
    }

    pub(crate) fn origin(&self, index: usize) -> usize {
        index * self.size / self.count
    }

    /// Number of texels that a patch shares with the one before it. The last one also shares some
    /// with the first one behind the border.
    pub(crate) fn overlaps(&self, index: usize) -> [usize; 2] {
        let end = |index: usize| self.origin(index) + self.patch;
        let before = if index > 0 { end(index - 1).saturating_sub(self.origin(index)) } else { 0 };
        let last = index + 1 == self.count;
        let after = if last { end(index).saturating_sub(self.size) } else { 0 };
        [before, after]
    }

    pub(crate) fn cells(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        let count = self.count;
        (0..count * count).map(move |index| [index % count, index / count])
    }
}

/// From this correlation of lightness on, two samples count as nested. Samples of different
/// strokes have less than 0.2, painted tones of the same strokes more than 0.4.
const NESTED: f64 = 0.3;

/// Whether the strokes of `other` stand where the strokes of `first` do. Both must be of one size
/// and cover the same texels.
pub(crate) fn is_nested(first: &Level, other: &Level) -> bool {
    first.mask == other.mask && correlation(first, other) >= NESTED
}

fn correlation(first: &Level, other: &Level) -> f64 {
    let inside = first.mask.values();
    fn lightness(level: &Level, at: usize) -> f64 {
        f64::from(level.features.values()[at][1])
    }
    let mut sums = [0.0; 3];
    for at in (0..inside.len()).filter(|at| inside[*at]) {
        // Features have mean 0.
        let a = lightness(first, at);
        let b = lightness(other, at);
        sums[0] += a * a;
        sums[1] += b * b;
        sums[2] += a * b;
    }
    let squares = sums[0] * sums[1];
    if squares > 0.0 { sums[2] / squares.sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::strokes;

    #[test]
    fn patches_cover_the_map_and_overlap_on_every_side() {
        for (size, patch) in [(64, 16), (256, 20), (32, 8), (100, 33)] {
            let grid = PatchGrid::new(size, patch);
            let mut covered = vec![0; size];
            for index in 0..grid.count {
                (0..patch).for_each(|i| covered[(grid.origin(index) + i) % size] += 1);
            }
            assert!(covered.iter().all(|&count| count >= 1), "{size} {patch}: {covered:?}");
            assert!(grid.overlaps(0)[0] == 0 && grid.overlaps(grid.count - 1)[1] >= patch / 3);
            let shared = (1..grid.count).map(|index| grid.overlaps(index)[0]).min();
            assert!(shared >= Some(patch / 3), "{size} {patch}: {shared:?}");
        }
    }

    fn level(tone: f32, seed: u64) -> Level {
        Level::new(&Channels::of(&strokes("a", 160, 8, tone, seed)), 8.0, Features::default())
    }

    #[test]
    fn tones_of_the_same_strokes_are_nested_and_others_are_not() {
        let first = level(0.1, 1);
        assert!(is_nested(&first, &level(0.4, 1)));
        for seed in 2..8 {
            let found = correlation(&first, &level(0.4, seed));
            assert!(found.abs() < 0.2, "seed {seed}: {found}");
        }
    }

    #[test]
    fn samples_of_other_masks_are_not_nested() {
        let first = level(0.1, 1);
        let mut other = level(0.4, 1);
        other.mask[(3, 3)] = false;
        assert!(!is_nested(&first, &other));
    }
}
