//! Prepares samples for synthesis: pyramids, grids of patches, and patches described by few
//! numbers. For a given patch you can find the patches most like it. This is the coherence search
//! space of Yan and others (2008, section 4.2), stored as nearest neighbours.
//!
//! We sample a patch at up to 7 x 7 places after smoothing, and project it onto the principal
//! components of the patches of all samples. To find neighbours we compare all descriptors. With
//! about 30 components, this is exact and as fast as a tree.

use graphics::blurred;
use graphics::field::Field;
use nalgebra::{DMatrix, SymmetricEigen};
use rayon::prelude::*;

use super::level::{Channels, FEATURES, Level, PatchGrid, SynthesisError, SynthesisSettings};
use crate::sample::{Sample, SampleSet};

/// We sample a patch at this many places along a side.
const SAMPLES: usize = 7;
const NUMBERS: usize = SAMPLES * SAMPLES * FEATURES;
/// The components keep this share of the variance.
const KEPT: f64 = 0.97;
/// We find the components from this many patches of each sample.
const TRAINED: usize = 600;

/// Principal components of patches of one size.
#[derive(Debug)]
pub(crate) struct PatchSpace {
    patch: usize,
    mean: Vec<f32>,
    components: Vec<f32>,
}

/// The described patches of one sample.
#[derive(Debug)]
pub(crate) struct Descriptors {
    /// First texel of each patch.
    pub(crate) places: Vec<[u16; 2]>,
    /// Index of the patch at each texel. `u32::MAX` means that there is none.
    index: Field<u32>,
    dimensions: usize,
    values: Vec<f32>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Link {
    pub(crate) place: [u16; 2],
    /// Mean squared difference of the features of both patches. Features have deviation 1.
    pub(crate) distance: f32,
}

impl PatchSpace {
    /// The space of patches of `patch` x `patch` texels of `levels`.
    pub(crate) fn of(levels: &[&Level], patch: usize) -> Self {
        let mut rows: Vec<[f32; NUMBERS]> = Vec::new();
        for level in levels {
            let smooth = smoothed(level, patch);
            let places = level.places(patch);
            let step = places.len().div_ceil(TRAINED).max(1);
            rows.extend(places.iter().step_by(step).map(|&place| sampled(&smooth, place, patch)));
        }
        let count = rows.len().max(1) as f64;
        let mean: Vec<f64> = (0..NUMBERS)
            .map(|i| rows.iter().map(|row| f64::from(row[i])).sum::<f64>() / count)
            .collect();
        // We sum in our own loops: a library's product may round differently on other machines.
        let covariance: Vec<Vec<f64>> = (0..NUMBERS)
            .into_par_iter()
            .map(|i| {
                let mut sums = vec![0.0; NUMBERS];
                for row in &rows {
                    let centred = f64::from(row[i]) - mean[i];
                    let others = row.iter().zip(&mean);
                    for (sum, (value, mean)) in sums.iter_mut().zip(others) {
                        *sum += centred * (f64::from(*value) - mean);
                    }
                }
                sums
            })
            .collect();
        let matrix = DMatrix::from_fn(NUMBERS, NUMBERS, |i, j| covariance[i][j] / count);
        let eigen = SymmetricEigen::new(matrix);
        let mut order: Vec<usize> = (0..NUMBERS).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        let total: f64 = eigen.eigenvalues.iter().map(|value| value.max(0.0)).sum();
        let mut components = Vec::new();
        let mut kept = 0.0;
        for index in order {
            if kept >= KEPT * total {
                break;
            }
            kept += eigen.eigenvalues[index].max(0.0);
            components.extend(eigen.eigenvectors.column(index).iter().map(|value| *value as f32));
        }
        Self { patch, mean: mean.iter().map(|mean| *mean as f32).collect(), components }
    }

    pub(crate) fn describe(&self, level: &Level) -> Descriptors {
        let smooth = smoothed(level, self.patch);
        let places = level.places(self.patch);
        let mut index = Field::filled(level.mask.width(), level.mask.height(), u32::MAX);
        for (number, &[x, y]) in places.iter().enumerate() {
            index[(usize::from(x), usize::from(y))] = number as u32;
        }
        let dimensions = self.components.len() / NUMBERS;
        let mut values = vec![0.0; dimensions * places.len()];
        if dimensions > 0 {
            values.par_chunks_exact_mut(dimensions).zip(&places).for_each(
                |(values, &place): (&mut [f32], &[u16; 2])| {
                    let mut numbers = sampled(&smooth, place, self.patch);
                    numbers.iter_mut().zip(&self.mean).for_each(|(number, mean)| *number -= mean);
                    for (value, component) in
                        values.iter_mut().zip(self.components.chunks_exact(NUMBERS))
                    {
                        *value = product(&numbers, component);
                    }
                },
            );
        }
        Descriptors { places, index, dimensions, values }
    }
}

impl Descriptors {
    /// Descriptor of the patch that starts at a texel, if there is one.
    pub(crate) fn at(&self, [x, y]: [u16; 2]) -> Option<&[f32]> {
        let x = usize::from(x);
        let y = usize::from(y);
        if x >= self.index.width() || y >= self.index.height() {
            return None;
        }
        let index = self.index[(x, y)];
        (index != u32::MAX).then(|| self.of(index as usize))
    }

    /// The `count` patches most like the one described by `wanted`, nearest first. Among equal
    /// ones, the first in the sample comes first.
    pub(crate) fn nearest(&self, wanted: &[f32], count: usize) -> Vec<Link> {
        let mut all: Vec<(f32, u32)> = (0..self.places.len())
            .map(|index| (distance(wanted, self.of(index)), index as u32))
            .collect();
        fn order(a: &(f32, u32), b: &(f32, u32)) -> std::cmp::Ordering {
            a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
        }
        if count < all.len() {
            all.select_nth_unstable_by(count, order);
            all.truncate(count);
        }
        all.sort_unstable_by(order);
        // We go by reference. Links collected from the list itself would keep the memory of all
        // patches.
        all.iter()
            .map(|&(distance, index): &(f32, u32)| Link {
                place: self.places[index as usize],
                distance,
            })
            .collect()
    }

    fn of(&self, index: usize) -> &[f32] {
        &self.values[index * self.dimensions..][..self.dimensions]
    }
}

/// Mean squared difference of the features of two described patches.
pub(crate) fn distance(a: &[f32], b: &[f32]) -> f32 {
    let mut lanes = [0.0_f32; 8];
    let first = a.chunks_exact(8);
    let second = b.chunks_exact(8);
    let rest = first.remainder().iter().zip(second.remainder());
    let rest: f32 = rest.map(|(a, b)| (a - b) * (a - b)).sum();
    for (a, b) in first.zip(second) {
        for lane in 0..8 {
            lanes[lane] += (a[lane] - b[lane]) * (a[lane] - b[lane]);
        }
    }
    (lanes.iter().sum::<f32>() + rest) / NUMBERS as f32
}

fn product(a: &[f32; NUMBERS], b: &[f32]) -> f32 {
    let mut lanes = [0.0_f32; 4];
    for (a, b) in a.chunks_exact(4).zip(b.chunks_exact(4)) {
        for lane in 0..4 {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    lanes.iter().sum()
}

fn stride(patch: usize) -> f64 {
    patch as f64 / SAMPLES.min(patch) as f64
}

fn smoothed(level: &Level, patch: usize) -> Field<[f32; FEATURES]> {
    blurred(&level.features, 0.5 * (stride(patch) - 1.0))
}

fn sampled(smooth: &Field<[f32; FEATURES]>, [x, y]: [u16; 2], patch: usize) -> [f32; NUMBERS] {
    fn at(index: usize, patch: usize) -> usize {
        ((index as f64 + 0.5) * patch as f64 / SAMPLES as f64) as usize
    }
    let mut numbers = [0.0; NUMBERS];
    for (index, values) in numbers.chunks_exact_mut(FEATURES).enumerate() {
        let i = at(index % SAMPLES, patch);
        let j = at(index / SAMPLES, patch);
        values.copy_from_slice(&smooth[(usize::from(x) + i, usize::from(y) + j)]);
    }
    numbers
}

/// A patch may have this many texels at the finest level.
const PATCHES: std::ops::RangeInclusive<usize> = 16..=64;
const LEAST_PATCH: usize = 8;
const LEAST_SIZE: usize = 32;
/// A sample needs this many places for patches at each level but the finest.
const LEAST_PLACES: usize = 64;
/// A map must have this many strokes beside each other.
const LEAST_STROKES: f64 = 4.0;
/// Spacings of two samples may differ by at most this factor.
const UNLIKE: f64 = 1.1;

/// Samples ready for synthesis. Levels go from the coarsest to the finest.
#[derive(Debug)]
pub(crate) struct Prepared {
    pub(crate) grids: Vec<PatchGrid>,
    pub(crate) pyramids: Vec<Vec<Level>>,
    /// Index of the sample that gets the first map.
    pub(crate) first: usize,
    /// The described patches of the first sample, by level. We describe the patches of the others
    /// when we need them, because they take the most memory.
    pub(crate) of_first: Vec<Descriptors>,
    /// Channels that describe patches at each level.
    spaces: Vec<PatchSpace>,
    /// Width and height of a patch at the finest level, in texels.
    pub(crate) patch: usize,
}

impl Prepared {
    /// Checks settings and samples, and describes their patches.
    pub(crate) fn new(
        set: &SampleSet,
        settings: &SynthesisSettings,
    ) -> Result<Self, SynthesisError> {
        check_settings(settings)?;
        let samples = &set.samples;
        let spacing = common_spacing(samples, settings.size)?;
        let patch = ((1.25 * spacing).round() as usize).clamp(*PATCHES.start(), *PATCHES.end());
        let mut grids = grids(settings.size, patch, samples);
        let mut pyramids: Vec<Vec<Level>> = samples
            .par_iter()
            .map(|sample| pyramid(sample, spacing, grids.len(), settings))
            .collect();
        leave_out_crowded(&mut grids, &mut pyramids);
        for (sample, pyramid) in samples.iter().zip(&pyramids) {
            check_sample(sample, pyramid, &grids)?;
        }
        let first = match &settings.first {
            Some(name) => named(samples, name)?,
            None => strongest(&pyramids),
        };
        let spaces: Vec<PatchSpace> = (0..grids.len())
            .map(|index: usize| {
                let levels: Vec<&Level> = pyramids.iter().map(|pyramid| &pyramid[index]).collect();
                PatchSpace::of(&levels, grids[index].patch)
            })
            .collect();
        let of_first =
            spaces.iter().zip(&pyramids[first]).map(|(space, level)| space.describe(level));
        let of_first = of_first.collect();
        Ok(Self { grids, pyramids, first, of_first, spaces, patch })
    }

    pub(crate) fn described(&self, sample: usize, level: usize) -> Descriptors {
        self.spaces[level].describe(&self.pyramids[sample][level])
    }

    /// Channels by which you compare patches of a sample, at the finest level.
    pub(crate) fn features(&self, sample: usize) -> Option<&Field<[f32; FEATURES]>> {
        self.pyramids[sample].last().map(|level| &level.features)
    }
}

fn check_settings(settings: &SynthesisSettings) -> Result<(), SynthesisError> {
    fn check(name: &'static str, found: f64, from: f64, to: f64) -> Result<(), SynthesisError> {
        if (from..=to).contains(&found) {
            return Ok(());
        }
        let found = format!("{found}");
        let range = format!("{from} to {to}");
        Err(SynthesisError::Setting { name, found, range })
    }
    let sizes = SynthesisSettings::SIZES;
    check("size", settings.size as f64, *sizes.start() as f64, *sizes.end() as f64)?;
    check("links", settings.links as f64, 1.0, 512.0)?;
    check("follow", f64::from(settings.follow), 0.0, 16.0)?;
    check("uniformity", f64::from(settings.uniformity), 0.0, 16.0)
}

/// The common spacing of all samples. Spacings may differ a little.
fn common_spacing(samples: &[Sample], size: usize) -> Result<f64, SynthesisError> {
    let first = samples.first().ok_or(SynthesisError::NoSample)?;
    let most = size as f64 / LEAST_STROKES;
    for sample in samples {
        let spacing = sample.spacing;
        let least = SynthesisSettings::LEAST_SPACING;
        if !(least..=most).contains(&spacing) {
            let name = sample.name.clone();
            return Err(SynthesisError::Spacing { name, spacing, size, least, most });
        }
        if spacing.max(first.spacing) > UNLIKE * spacing.min(first.spacing) {
            return Err(SynthesisError::UnlikeSpacings {
                name: sample.name.clone(),
                spacing,
                first: first.name.clone(),
                wanted: first.spacing,
            });
        }
    }
    Ok(first.spacing)
}

/// Grids of the levels, coarsest first. There are as many as map and samples have room for.
fn grids(size: usize, patch: usize, samples: &[Sample]) -> Vec<PatchGrid> {
    let sides = samples.iter().map(|sample| sample.size().0.min(sample.size().1));
    let least_side = sides.min().unwrap_or(0);
    let mut grids = vec![PatchGrid::new(size, patch)];
    loop {
        let halvings = grids.len();
        let size = size >> halvings;
        let patch = (patch >> halvings).max(LEAST_PATCH);
        // A coarse level with few places to choose from would repeat these.
        if size < LEAST_SIZE || least_side >> halvings < 2 * patch {
            break;
        }
        grids.push(PatchGrid::new(size, patch));
    }
    grids.reverse();
    grids
}

/// Leaves out coarse levels at which some sample has too few places for patches. For example, a
/// passage of irregular outline may have too few. This keeps the finest level.
fn leave_out_crowded(grids: &mut Vec<PatchGrid>, pyramids: &mut [Vec<Level>]) {
    let first = (0..grids.len() - 1)
        .find(|index: &usize| {
            let patch = grids[*index].patch;
            pyramids.iter().all(|pyramid| pyramid[*index].places(patch).len() >= LEAST_PLACES)
        })
        .unwrap_or(grids.len() - 1);
    grids.drain(..first);
    pyramids.iter_mut().for_each(|pyramid| drop(pyramid.drain(..first)));
}

fn pyramid(
    sample: &Sample,
    spacing: f64,
    levels: usize,
    settings: &SynthesisSettings,
) -> Vec<Level> {
    let mut channels = Channels::of(sample);
    let mut found = Vec::with_capacity(levels);
    for index in 0..levels {
        if index > 0 {
            channels = channels.halved();
        }
        let spacing = spacing / f64::from(1_u32 << index);
        found.push(Level::new(&channels, spacing, settings.features));
    }
    found.reverse();
    found
}

fn check_sample(
    sample: &Sample,
    pyramid: &[Level],
    grids: &[PatchGrid],
) -> Result<(), SynthesisError> {
    let name = sample.name.clone();
    if pyramid.last().is_none_or(Level::is_flat) {
        return Err(SynthesisError::Flat(name));
    }
    let (width, height) = sample.size();
    for (index, (level, grid)) in pyramid.iter().zip(grids).enumerate() {
        if level.places(grid.patch).is_empty() {
            let patch = grid.patch << (grids.len() - 1 - index);
            return Err(SynthesisError::TooSmall { name, width, height, patch });
        }
    }
    Ok(())
}

fn named(samples: &[Sample], name: &str) -> Result<usize, SynthesisError> {
    samples.iter().position(|sample| sample.name == name).ok_or_else(|| {
        let known = samples.iter().map(|sample| sample.name.clone()).collect();
        SynthesisError::UnknownFirst { name: name.to_owned(), known }
    })
}

/// Index of the sample with the strongest contrast of lightness. If several are equal, this is the
/// first.
fn strongest(pyramids: &[Vec<Level>]) -> usize {
    let mut best = (0, f64::NEG_INFINITY);
    for (index, pyramid) in pyramids.iter().enumerate() {
        let contrast = pyramid.last().map_or(0.0, |level| level.contrast);
        if contrast > best.1 {
            best = (index, contrast);
        }
    }
    best.0
}
