//! Samples made ready for synthesis: pyramids, grids of patches, descriptors.

use graphics::field::Field;
use rayon::prelude::*;

use super::descriptors::{Descriptors, PatchSpace};
use super::grid::PatchGrid;
use super::level::{Channels, FEATURES, Level};
use super::settings::{SynthesisError, SynthesisSettings};
use crate::sample::{Sample, SampleSet};

/// Texels of a patch at the finest level.
const PATCHES: std::ops::RangeInclusive<usize> = 16..=64;
/// Least side of a patch at a coarser level.
const LEAST_PATCH: usize = 8;
/// Least size of the coarsest map.
const LEAST_SIZE: usize = 32;
/// Least number of places for patches in a sample at a level but the finest.
const LEAST_PLACES: usize = 64;
/// Least number of strokes beside each other on a map.
const LEAST_STROKES: f64 = 4.0;
/// Largest ratio of the spacings of two samples.
const UNLIKE: f64 = 1.1;

/// Samples ready for synthesis. Levels are in order from the coarsest to the finest.
#[derive(Debug)]
pub(crate) struct Prepared {
    /// Patches of the maps, by level.
    pub(crate) grids: Vec<PatchGrid>,
    /// Levels of each sample.
    pub(crate) pyramids: Vec<Vec<Level>>,
    /// Index of the sample whose map is made first.
    pub(crate) first: usize,
    /// Its described patches, by level. Those of the others are described as they are needed: they
    /// take the most memory.
    pub(crate) of_first: Vec<Descriptors>,
    /// Channels that describe patches, for each level.
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
        let space = |index: usize| {
            let levels: Vec<&Level> = pyramids.iter().map(|pyramid| &pyramid[index]).collect();
            PatchSpace::of(&levels, grids[index].patch)
        };
        let spaces: Vec<PatchSpace> = (0..grids.len()).map(space).collect();
        let of_first =
            spaces.iter().zip(&pyramids[first]).map(|(space, level)| space.describe(level));
        let of_first = of_first.collect();
        Ok(Self { grids, pyramids, first, of_first, spaces, patch })
    }

    /// Describes the patches of a sample at a level.
    pub(crate) fn described(&self, sample: usize, level: usize) -> Descriptors {
        self.spaces[level].describe(&self.pyramids[sample][level])
    }

    /// Channels by which patches of a sample are compared, at the finest level.
    pub(crate) fn features(&self, sample: usize) -> Option<&Field<[f32; FEATURES]>> {
        self.pyramids[sample].last().map(|level| &level.features)
    }
}

fn check_settings(settings: &SynthesisSettings) -> Result<(), SynthesisError> {
    let check = |name: &'static str, found: f64, from: f64, to: f64| {
        if (from..=to).contains(&found) {
            return Ok(());
        }
        let found = format!("{found}");
        let range = format!("{from} to {to}");
        Err(SynthesisError::Setting { name, found, range })
    };
    let sizes = SynthesisSettings::SIZES;
    check("size", settings.size as f64, *sizes.start() as f64, *sizes.end() as f64)?;
    check("links", settings.links as f64, 1.0, 512.0)?;
    check("follow", f64::from(settings.follow), 0.0, 16.0)?;
    check("uniformity", f64::from(settings.uniformity), 0.0, 16.0)
}

/// The spacing of all samples, which may differ a little.
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

/// Grids of the levels, coarsest first: as many as map and samples have room for.
fn grids(size: usize, patch: usize, samples: &[Sample]) -> Vec<PatchGrid> {
    let sides = samples.iter().map(|sample| sample.size().0.min(sample.size().1));
    let least_side = sides.min().unwrap_or(0);
    let mut grids = vec![PatchGrid::new(size, patch)];
    loop {
        let halvings = grids.len();
        let size = size >> halvings;
        let patch = (patch >> halvings).max(LEAST_PATCH);
        // A coarse level with few places to choose from would repeat them.
        if size < LEAST_SIZE || least_side >> halvings < 2 * patch {
            break;
        }
        grids.push(PatchGrid::new(size, patch));
    }
    grids.reverse();
    grids
}

/// Leaves out coarse levels at which some sample has too few places for patches, as a passage of
/// irregular outline may have. The finest level stays.
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

/// Levels of a sample, coarsest first.
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
        return Err(SynthesisError::Flat { name });
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

/// Index of the sample with the strongest contrast of lightness. Of equal ones the first.
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
