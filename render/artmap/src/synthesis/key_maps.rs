//! Maps of all samples of a set.

use graphics::field::Field;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::candidates::LevelMap;
use super::descriptors::{Descriptors, PatchSpace};
use super::first::first_level;
use super::following::Following;
use super::grid::PatchGrid;
use super::level::{Channels, Level};
use super::nested::is_nested;
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

/// Tileable maps, one of each sample, whose strokes stand where those of the first one stand.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyMaps {
    /// Index of the sample whose map was made first.
    pub first: usize,
    /// For every map, in the order of the samples: the texel (column and row) of the sample that
    /// each texel of the map shows.
    pub sources: Vec<Field<[u16; 2]>>,
    /// Width and height of a patch at the finest level, in texels.
    pub patch: usize,
    /// Number of levels of the pyramids.
    pub levels: usize,
}

/// Synthesises a map of each sample (Yan and others 2008, section 4.3).
///
/// The first map is made freely. The others take, patch by patch, what in their own sample is most
/// like the first map there and agrees with their patches already laid. A sample that has its
/// strokes at the places of the first one shows the same places. The same input gives the same maps
/// with any number of threads.
///
/// # Errors
/// [`SynthesisError`] for settings out of range, and for samples that are too small, flat, or of
/// another spacing than the first one.
pub fn key_maps(set: &SampleSet, settings: &SynthesisSettings) -> Result<KeyMaps, SynthesisError> {
    check_settings(settings)?;
    let samples = &set.samples;
    let spacing = common_spacing(samples, settings.size)?;
    let patch = ((1.25 * spacing).round() as usize).clamp(*PATCHES.start(), *PATCHES.end());
    let mut grids = grids(settings.size, patch, samples);
    let mut pyramids: Vec<Vec<Level>> =
        samples.par_iter().map(|sample| pyramid(sample, spacing, grids.len(), settings)).collect();
    leave_out_crowded(&mut grids, &mut pyramids);
    for (sample, pyramid) in samples.iter().zip(&pyramids) {
        check_sample(sample, pyramid, &grids)?;
    }
    let first = match &settings.first {
        Some(name) => named(samples, name)?,
        None => strongest(&pyramids),
    };
    let described: Vec<Vec<Descriptors>> = (0..grids.len())
        .map(|index| {
            let levels: Vec<&Level> = pyramids.iter().map(|pyramid| &pyramid[index]).collect();
            let space = PatchSpace::of(&levels, grids[index].patch);
            levels.iter().map(|level| space.describe(level)).collect()
        })
        .collect();
    let mut random = ChaCha8Rng::seed_from_u64(settings.seed);
    let mut first_maps: Vec<LevelMap> = Vec::with_capacity(grids.len());
    for (index, &grid) in grids.iter().enumerate() {
        let here = (&pyramids[first][index], &described[index][first]);
        let coarser = first_maps.last().map(|map| (&pyramids[first][index - 1], map));
        first_maps.push(first_level(here, grid, coarser, settings.uniformity, &mut random));
    }
    let SynthesisSettings { links, follow, uniformity, .. } = *settings;
    let following = Following { links, follow, uniformity };
    let map_of = |sample: usize| {
        let finest = grids.len() - 1;
        if sample == first || is_nested(&pyramids[first][finest], &pyramids[sample][finest]) {
            return first_maps[finest].sources.clone();
        }
        let mut coarser: Option<LevelMap> = None;
        for (index, &grid) in grids.iter().enumerate() {
            let here = (&pyramids[sample][index], &described[index][sample]);
            let there = (&first_maps[index], &described[index][first]);
            let map = following.level(index + 1, here, there, grid, coarser.as_ref());
            coarser = Some(map);
        }
        coarser.map_or_else(|| Field::filled(0, 0, [0; 2]), |map| map.sources)
    };
    let sources = (0..samples.len()).into_par_iter().map(map_of).collect();
    Ok(KeyMaps { first, sources, patch, levels: grids.len() })
}

fn check_settings(settings: &SynthesisSettings) -> Result<(), SynthesisError> {
    let check = |name: &'static str, found: f64, from: f64, to: f64| {
        if (from..=to).contains(&found) {
            return Ok(());
        }
        let (found, range) = (format!("{found}"), format!("{from} to {to}"));
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
        let (size, patch) = (size >> halvings, (patch >> halvings).max(LEAST_PATCH));
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
    let roomy = |index: &usize| {
        let patch = grids[*index].patch;
        pyramids.iter().all(|pyramid| pyramid[*index].places(patch).len() >= LEAST_PLACES)
    };
    let first = (0..grids.len() - 1).find(roomy).unwrap_or(grids.len() - 1);
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
