//! Maps of all samples of a set.

use graphics::field::Field;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::candidates::LevelMap;
use super::first::first_level;
use super::following::Following;
use super::nested::is_nested;
use super::prepared::Prepared;
use super::settings::{SynthesisError, SynthesisSettings};
use crate::sample::SampleSet;

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
    let prepared = Prepared::new(set, settings)?;
    Ok(KeyMaps::of(&prepared, level_maps(&prepared, settings)))
}

impl KeyMaps {
    /// The finest of the levels of all maps.
    pub(crate) fn of(prepared: &Prepared, maps: Vec<Vec<LevelMap>>) -> Self {
        let finest = |mut levels: Vec<LevelMap>| {
            levels.pop().map_or_else(|| Field::filled(0, 0, [0; 2]), |map| map.sources)
        };
        let Prepared { first, patch, ref grids, .. } = *prepared;
        let sources = maps.into_iter().map(finest).collect();
        Self { first, sources, patch, levels: grids.len() }
    }
}

/// All levels of the map of each sample, coarsest first.
pub(crate) fn level_maps(prepared: &Prepared, settings: &SynthesisSettings) -> Vec<Vec<LevelMap>> {
    let Prepared { grids, pyramids, first, of_first, .. } = prepared;
    let first = *first;
    let mut random = ChaCha8Rng::seed_from_u64(settings.seed);
    let mut first_maps: Vec<LevelMap> = Vec::with_capacity(grids.len());
    for (index, &grid) in grids.iter().enumerate() {
        let here = (&pyramids[first][index], &of_first[index]);
        let coarser = first_maps.last().map(|map| (&pyramids[first][index - 1], map));
        first_maps.push(first_level(here, grid, coarser, settings.uniformity, &mut random));
    }
    let SynthesisSettings { links, follow, uniformity, .. } = *settings;
    let following = Following { links, follow, uniformity };
    let levels_of = |sample: usize| {
        let finest = grids.len() - 1;
        if sample == first || is_nested(&pyramids[first][finest], &pyramids[sample][finest]) {
            return first_maps.clone();
        }
        let mut maps: Vec<LevelMap> = Vec::with_capacity(grids.len());
        for (index, &grid) in grids.iter().enumerate() {
            let described = prepared.described(sample, index);
            let here = (&pyramids[sample][index], &described);
            let there = (&first_maps[index], &of_first[index]);
            maps.push(following.level(index + 1, here, there, grid, maps.last()));
        }
        maps
    };
    (0..pyramids.len()).into_par_iter().map(levels_of).collect()
}
