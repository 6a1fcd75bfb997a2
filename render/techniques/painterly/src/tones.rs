//! We lay the maps out for painting as a packed slice for each tone, at several sizes. The memory
//! of a graphics device can hold them too.

use std::ops::Range;

use artmap::map::{ArtMap, Between, Tile};
use glam::Vec3;
use graphics::compute::{Compute, GpuCompute, Plane};
use graphics::field::Field;
use graphics::gpu::{Buffer, DeviceError};
use graphics::picture::Picture;
use rayon::prelude::*;

use super::coloring::Coloring;

/// Change of intensity between slices, in levels of 255 (k of Yan and others 2008, equation 7).
const STEP: f64 = 5.0;

/// We halve sizes down to this width in texels.
pub(super) const LEAST_SIZE: usize = 16;

/// Heights further than this many standard deviations from the mean are cut.
const DEVIATIONS: f64 = 2.0;

/// Coordinates of colour, and height.
const CHANNELS: usize = 4;

/// All tones of some maps.
#[derive(Debug, Clone)]
pub(super) struct Tones {
    /// Map by map, from dark to light.
    slices: Vec<Slice>,
    maps: Vec<LaidMap>,
    /// Value of a byte of 0, by channel.
    pub(super) low: [f32; CHANNELS],
    /// Change of value from byte to byte, by channel.
    pub(super) step: [f32; CHANNELS],
}

/// One map among the tones.
#[derive(Debug, Clone)]
pub(super) struct LaidMap {
    /// Its slices.
    slices: Range<usize>,
    /// Width and height of the largest size in texels.
    pub(super) size: usize,
    /// Distance of neighbouring strokes in texels of the largest size.
    pub(super) spacing: f32,
}

/// One tone.
#[derive(Debug, Clone)]
struct Slice {
    /// Mean L*.
    tone: f32,
    /// Each of half the size of the one before.
    sizes: Vec<Texels>,
}

/// A tile of one tone at one size. It has a byte for each channel, which takes a fourth of the
/// memory of f32.
#[derive(Debug, Clone)]
pub(super) struct Texels {
    pub(super) size: usize,
    /// Texels with a column and a row more, which repeat the first: a byte for each channel, in the
    /// order 0, 2, 1, 3.
    packed: Vec<u32>,
}

/// One size of one tone before it is packed.
type Values = Vec<[f32; CHANNELS]>;

impl Tones {
    /// Lays out the tones of maps of at least one tile each.
    pub(super) fn new(maps: &[&ArtMap], between: Between, coloring: &Coloring) -> Self {
        let mut laid: Vec<(f32, Vec<(usize, Values)>)> = Vec::new();
        let maps = maps
            .iter()
            .enumerate()
            .map(|(number, map): (usize, &&ArtMap)| {
                let tiles = tone_tiles(map, between);
                let first = laid.len();
                laid.par_extend(
                    tiles
                        .par_iter()
                        .map(|tile: &Tile| (tile.tone() as f32, sizes(tile, coloring, number))),
                );
                LaidMap { slices: first..laid.len(), size: map.size(), spacing: map.spacing as f32 }
            })
            .collect();
        let whole = laid.iter().flat_map(|(_, sizes)| &sizes[0].1);
        let (mut low, mut step) = range(whole.clone());
        (low[3], step[3]) = usual_heights(whole.map(|value| value[3]), [low[3], step[3]]);
        let slices = laid
            .into_par_iter()
            .map(|(tone, sizes): (f32, Vec<(usize, Values)>)| Slice {
                tone,
                sizes: sizes
                    .iter()
                    .map(|(size, values)| packed(*size, values, low, step))
                    .collect(),
            })
            .collect();
        Self { slices, maps, low, step }
    }

    /// The map with this number, in the order in which you gave them.
    #[inline(always)]
    pub(super) fn map(&self, map: usize) -> &LaidMap {
        &self.maps[map]
    }

    /// Index of the slice of a tone: 0 the darkest to 1 the lightest tile of a map, evenly in L*.
    pub(super) fn slice(&self, map: usize, tone: f32) -> usize {
        let slices = &self.slices[self.maps[map].slices.clone()];
        let [first, last] = [slices.first(), slices.last()];
        let [darkest, lightest] = [first, last].map(|slice| slice.map_or(0.0, |slice| slice.tone));
        self.nearest(map, darkest + tone.clamp(0.0, 1.0) * (lightest - darkest))
    }

    /// Index of the slice of a map with the nearest mean L*.
    pub(super) fn nearest(&self, map: usize, wanted: f32) -> usize {
        let first = self.maps[map].slices.start;
        let slices = &self.slices[self.maps[map].slices.clone()];
        let above = slices.partition_point(|slice| slice.tone < wanted);
        let below = above.saturating_sub(1);
        let above = above.min(slices.len() - 1);
        fn off(at: usize, slices: &[Slice], wanted: f32) -> f32 {
            (slices[at].tone - wanted).abs()
        }
        first + if off(below, slices, wanted) <= off(above, slices, wanted) { below } else { above }
    }

    pub(super) fn tone(&self, slice: usize) -> f32 {
        self.slices[slice].tone
    }

    /// How many times to halve the largest size of a map, so that a pixel sees about one texel. At
    /// the largest size it sees `texels_per_px`.
    pub(super) fn halvings(&self, map: usize, texels_per_px: f32) -> usize {
        let sizes = self.slices[self.maps[map].slices.start].sizes.len();
        let mut halvings = 0;
        let mut left = texels_per_px;
        while halvings + 1 < sizes && left > std::f32::consts::SQRT_2 {
            left /= 2.0;
            halvings += 1;
        }
        halvings
    }

    /// The sizes of each slice.
    pub(super) fn sizes(&self) -> impl Iterator<Item = &[Texels]> {
        self.slices.iter().map(|slice| slice.sizes.as_slice())
    }

    /// A tone at a size.
    #[inline(always)]
    pub(super) fn texels(&self, slice: usize, halvings: usize) -> &Texels {
        &self.slices[slice].sizes[halvings]
    }

    #[inline(always)]
    pub(super) fn values(&self, bytes: [f32; CHANNELS]) -> [f32; CHANNELS] {
        std::array::from_fn(|i| self.low[i] + self.step[i] * bytes[i])
    }
}

/// The tiles of all tones from dark to light, of a map of at least one tile. Neighbours differ by at
/// most 5 of 255 levels of intensity.
pub(super) fn tone_tiles(map: &ArtMap, between: Between) -> Vec<Tile> {
    let shares: Vec<(usize, f64)> = (0..map.keys.len())
        .flat_map(|lower| {
            fn tone(at: usize, map: &ArtMap) -> Option<f64> {
                map.keys.get(at).map(|key| key.tone)
            }
            let steps = match (tone(lower, map), tone(lower + 1, map)) {
                (Some(own), Some(next)) => ArtMap::steps(own, next, STEP),
                _ => 0,
            };
            (0..=steps).map(move |step| (lower, step as f64 / (steps + 1) as f64))
        })
        .collect();
    let transitions: Vec<_> =
        (0..map.keys.len()).into_par_iter().map(|lower| map.transition(lower, between)).collect();
    shares
        .into_par_iter()
        .map(|(lower, share): (usize, f64)| match &transitions[lower] {
            Some(transition) if share > 0.0 => transition.at(share as f32),
            _ => map.keys[lower].tile.clone(),
        })
        .collect()
}

impl Texels {
    /// Texels row by row, a column and a row more than the size: a byte for each channel, in the
    /// order 0, 2, 1, 3.
    pub(super) fn packed(&self) -> &[u32] {
        &self.packed
    }

    /// The bytes of the four texels around a place, their weights in 256ths across and down.
    /// Returns 256 times the interpolated bytes.
    #[inline(always)]
    pub(super) fn interpolated(
        &self,
        column: usize,
        row: usize,
        across: u32,
        down: u32,
    ) -> [f32; 4] {
        // Nothing here wraps. We say this with `wrapping_*`, so that tests are as fast as programs.
        let stride = self.size.wrapping_add(1);
        let at = row.wrapping_mul(stride).wrapping_add(column);
        let above = pair(&self.packed, at);
        let below = pair(&self.packed, at.wrapping_add(stride));
        let right = u64::from(across);
        let lower = u64::from(down);
        let left = 256_u64.wrapping_sub(right);
        let upper = 256_u64.wrapping_sub(lower);
        // Two mixes of whole numbers in lanes of 16 bits. The first is rounded to 8 bits again.
        fn mix(a: u64, b: u64, low: u64, high: u64) -> u64 {
            a.wrapping_mul(low).wrapping_add(b.wrapping_mul(high))
        }
        const LANES: u64 = 0x00ff_00ff_00ff_00ff;
        const HALF: u64 = 0x0080_0080_0080_0080;
        let [above, below] = [above, below]
            .map(|[a, b]| (mix(spread(a), spread(b), left, right).wrapping_add(HALF) >> 8) & LANES);
        let mixed = mix(above, below, upper, lower);
        [mixed, mixed >> 16, mixed >> 32, mixed >> 48].map(|lane| f32::from(lane as u16))
    }
}

/// Two neighbouring texels.
#[inline(always)]
fn pair(texels: &[u32], at: usize) -> [u32; 2] {
    let pair = &texels[at..][..2];
    [pair[0], pair[1]]
}

/// The four bytes of a texel in lanes of 16 bits, in the order 0, 2, 1, 3 of the channels.
#[inline(always)]
fn spread(texel: u32) -> u64 {
    const EVEN: u64 = 0x00ff_00ff;
    let texel = u64::from(texel);
    (texel & EVEN) | ((texel >> 8) & EVEN) << 32
}

/// The sizes of a tile: colours are averaged as light, heights as heights.
fn sizes(tile: &Tile, coloring: &Coloring, map: usize) -> Vec<(usize, Values)> {
    let heights = tile
        .height_mm
        .as_ref()
        .map_or_else(|| vec![0.0; tile.size() * tile.size()], |height| height.values().to_vec());
    let mut laid = Vec::new();
    let mean = coloring.mean(map, &tile.color);
    let mut color = tile.color.clone();
    let mut heights = heights;
    loop {
        let size = color.width();
        let details = coloring.details(map, mean, &color).into_iter().zip(&heights);
        laid.push((size, details.map(|(detail, &height)| detail.extend(height).into()).collect()));
        if !size.is_multiple_of(2) || size < 2 * LEAST_SIZE {
            return laid;
        }
        (color, heights) = halved(&color, &heights);
    }
}

fn halved(color: &Picture, heights: &[f32]) -> (Picture, Vec<f32>) {
    let size = color.width();
    let half = color.width() / 2;
    fn corners(index: usize, half: usize) -> [(usize, usize); 4] {
        let x = 2 * (index % half);
        let y = 2 * (index / half);
        [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)]
    }
    let colors = (0..half * half)
        .map(|index| {
            let sum: Vec3 = corners(index, half).map(|at| Vec3::from(color[at])).iter().sum();
            (sum / 4.0).to_array()
        })
        .collect();
    (
        Field::from_values(half, half, colors),
        (0..half * half)
            .map(|index| {
                corners(index, half).map(|(x, y)| heights[y * size + x]).iter().sum::<f32>() / 4.0
            })
            .collect(),
    )
}

/// Value of a byte of 0 and change from byte to byte, by channel.
fn range<'a>(
    values: impl Iterator<Item = &'a [f32; CHANNELS]>,
) -> ([f32; CHANNELS], [f32; CHANNELS]) {
    let start = ([f32::INFINITY; CHANNELS], [f32::NEG_INFINITY; CHANNELS]);
    let (low, high) = values.fold(start, |(low, high), value| {
        let low = std::array::from_fn(|i| low[i].min(value[i]));
        (low, std::array::from_fn(|i| high[i].max(value[i])))
    });
    (low, std::array::from_fn(|i| (high[i] - low[i]).max(0.0) / 255.0))
}

/// Value of a byte of 0 and change from byte to byte for heights: a few lumps and pits are cut, so
/// that bytes resolve the ridges of strokes.
fn usual_heights(heights: impl Iterator<Item = f32>, [low, step]: [f32; 2]) -> (f32, f32) {
    let (count, sum, square) = heights.fold((0.0_f64, 0.0, 0.0), |(count, sum, square), height| {
        let height = f64::from(height);
        (count + 1.0, sum + height, square + height * height)
    });
    let mean = sum / count.max(1.0);
    let deviation = (square / count.max(1.0) - mean * mean).max(0.0).sqrt();
    let least = low.max((mean - DEVIATIONS * deviation) as f32);
    let most = (low + 255.0 * step).min((mean + DEVIATIONS * deviation) as f32);
    (least, (most - least).max(0.0) / 255.0)
}

fn packed(size: usize, values: &Values, low: [f32; CHANNELS], step: [f32; CHANNELS]) -> Texels {
    Texels {
        size,
        packed: (0..(size + 1) * (size + 1))
            .map(|index: usize| {
                let x = index % (size + 1) % size;
                let y = index / (size + 1) % size;
                let value = values[y * size + x];
                u32::from_le_bytes([0, 2, 1, 3].map(|channel| match step[channel] {
                    0.0 => 0,
                    step => {
                        ((value[channel] - low[channel]) / step).round().clamp(0.0, 255.0) as u8
                    }
                }))
            })
            .collect(),
    }
}

/// Tones in the memory of the device that computes. The processor needs no copy, since it reads
/// [`Tones`] themselves.
#[derive(Debug, Clone)]
pub(super) enum ToneMemory {
    /// The processor's memory.
    Host,
    /// The memory of a graphics device.
    Device(DeviceTones),
}

/// Texels of all tones and the table of encoded light, copied once.
#[derive(Debug, Clone)]
pub(super) struct DeviceTones {
    texels: Plane<u32>,
    encoded: Plane<f32>,
    /// First texel of each size of each slice, and its width.
    tiles: Vec<Vec<[u32; 2]>>,
}

impl ToneMemory {
    /// Copies the tones to where `compute` reads them.
    ///
    /// # Errors
    /// [`DeviceError::TooLarge`] for tones beyond the device's buffer limit, and other errors of a
    /// device, never on the processor.
    pub(super) fn new(
        compute: &mut Compute,
        tones: &Tones,
        coloring: &Coloring,
    ) -> Result<Self, DeviceError> {
        match compute {
            Compute::Cpu => Ok(Self::Host),
            Compute::Gpu(gpu) => DeviceTones::new(gpu, tones, coloring).map(Self::Device),
        }
    }

    /// The tones on a device. Call this only if you put them there.
    ///
    /// # Panics
    /// If they are in the processor's memory.
    pub(super) fn device(&self) -> &DeviceTones {
        match self {
            Self::Device(tones) => tones,
            Self::Host => panic!("a graphics device was handed tones in the processor's memory"),
        }
    }
}

impl DeviceTones {
    fn new(gpu: &mut GpuCompute, tones: &Tones, coloring: &Coloring) -> Result<Self, DeviceError> {
        let count: usize = tones.sizes().flatten().map(|texels| texels.packed().len()).sum();
        gpu.device().check_size("the art map", (count * size_of::<u32>()) as u64)?;
        let mut packed = Vec::with_capacity(count);
        let mut tiles = Vec::new();
        for sizes in tones.sizes() {
            let mut of_tone = Vec::with_capacity(sizes.len());
            for texels in sizes {
                of_tone.push([packed.len() as u32, texels.size as u32]);
                packed.extend_from_slice(texels.packed());
            }
            tiles.push(of_tone);
        }
        let texels = gpu.plane(packed.len(), 1)?;
        gpu.write(&texels, &packed)?;
        let encoded = gpu.plane(coloring.encoded.len(), 1)?;
        gpu.write(&encoded, &coloring.encoded)?;
        Ok(Self { texels, encoded, tiles })
    }

    /// First texel of a tone at a size, and the width of its tile.
    pub(super) fn tile(&self, slice: usize, halvings: usize) -> [u32; 2] {
        self.tiles[slice][halvings]
    }

    /// Bytes of all texels, as [`Texels::packed`] has them.
    pub(super) fn texels(&self) -> &Buffer {
        self.texels.buffer()
    }

    /// Table from linear to encoded values.
    pub(super) fn encoded(&self) -> &Buffer {
        self.encoded.buffer()
    }
}

#[cfg(test)]
mod tests {
    use super::super::coloring::SubjectKind;
    use super::super::settings::ColorSettings;
    use super::super::test_scenes::map;
    use super::*;

    fn tones() -> (ArtMap, Tones) {
        let map = map(3);
        let coloring = Coloring::new(&[&map], &[], &ColorSettings::default(), SubjectKind::Model);
        let tones = Tones::new(&[&map], Between::Dissolve, &coloring);
        (map, tones)
    }

    #[test]
    fn slices_go_evenly_from_the_darkest_to_the_lightest() {
        let (map, tones) = tones();
        assert_eq!((tones.slice(0, 0.0), tones.slice(0, 1.0)), (0, tones.slices.len() - 1));
        let range = map.keys[2].tone - map.keys[0].tone;
        for step in 0..=100 {
            let share = step as f32 / 100.0;
            let found = f64::from(tones.slices[tones.slice(0, share)].tone) - map.keys[0].tone;
            assert!((found / range - f64::from(share)).abs() * range < 1.5, "{share}: {found}");
        }
        for pair in tones.slices.windows(2) {
            assert!(pair[1].tone > pair[0].tone && pair[1].tone - pair[0].tone < 2.5, "{pair:?}");
        }
    }

    #[test]
    fn texels_are_those_of_the_tile_and_repeat() {
        let (map, tones) = tones();
        let texels = tones.texels(0, 0);
        let size = map.size();
        let coloring = Coloring::new(&[&map], &[], &ColorSettings::default(), SubjectKind::Model);
        let details =
            coloring.details(0, coloring.mean(0, &map.keys[0].tile.color), &map.keys[0].tile.color);
        for (x, y) in [(0, 0), (5, 9), (size - 1, size - 1)] {
            let found = tones.values(texels.interpolated(x, y, 0, 0).map(|byte| byte / 256.0));
            let wanted = details[y * size + x];
            assert!((found[0] - wanted.x).abs() <= 0.51 * tones.step[0] + 1e-6);
            assert!((found[1] - wanted.y).abs() <= 0.51 * tones.step[1] + 1e-6);
            let height = map.keys[0].tile.height_mm.as_ref().unwrap()[(x, y)];
            let most = tones.low[3] + 255.0 * tones.step[3];
            let height = height.clamp(tones.low[3], most);
            assert!((found[3] - height).abs() <= 0.51 * tones.step[3] + 1e-6);
        }
        let beyond = texels.interpolated(size - 1, size - 1, 256, 256);
        assert_eq!(beyond, texels.interpolated(0, 0, 0, 0));
        let middle = texels.interpolated(3, 4, 128, 0);
        let [left, right] = [3, 4].map(|column| texels.interpolated(column, 4, 0, 0));
        for channel in 0..4 {
            let mean = (left[channel] + right[channel]) / 2.0;
            assert!((middle[channel] - mean).abs() <= 128.0, "{middle:?}");
        }
    }

    #[test]
    fn smaller_sizes_keep_the_mean_and_suit_fewer_pixels() {
        let (_, tones) = tones();
        assert_eq!(
            [0.5, 1.4, 1.5, 2.7, 2.9].map(|scale| tones.halvings(0, scale)),
            [0, 0, 1, 1, 2]
        );
        fn mean(halvings: usize, tones: &Tones) -> f32 {
            let texels = tones.texels(4, halvings);
            let size = texels.size;
            let all = (0..size * size).map(|at| texels.interpolated(at % size, at / size, 0, 0)[0]);
            all.sum::<f32>() / 256.0 / (size * size) as f32
        }
        assert!(
            (mean(0, &tones) - mean(2, &tones)).abs() < 6.0,
            "{} {}",
            mean(0, &tones),
            mean(2, &tones)
        );
    }
}
