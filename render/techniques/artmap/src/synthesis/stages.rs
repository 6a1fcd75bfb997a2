//! Pictures of how maps are made, step by step.

use graphics::field::Field;
use graphics::picture::Picture;
use rayon::prelude::*;
use spectra::color::Rgb;

use super::candidates::LevelMap;
use super::key_maps::{KeyMaps, level_maps};
use super::level::FEATURES;
use super::prepared::Prepared;
use super::settings::{SynthesisError, SynthesisSettings};
use crate::sample::{Sample, SampleSet};

/// Encoded grey of what has no information, and of a feature of its mean value.
const GREY: f64 = 0.5;

/// Deviations of a feature from grey to white.
const DEVIATIONS: f64 = 3.0;

/// Texels between features.
const GAP: usize = 4;

/// A picture of one step of a synthesis.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Name in letters, digits and hyphens; samples and levels count from 1, coarse to fine.
    pub name: String,
    /// Linear sRGB.
    pub picture: Picture,
}

/// Synthesises maps as [`key_maps`](super::key_maps) does, to the bit, with pictures of the steps in
/// their order:
///
/// - `sample-1` and on: the samples, dark to light;
/// - `features-1` and on: what patches are compared by (edges, lightness, a*, b*, height) as
///   greys beside each other;
/// - `links-1-level-1` and on: in the place of each patch of the first map the most similar patch
///   of the sample, before anything is made to fit its neighbours;
/// - `map-1-level-1` and on: the map of the sample at each level.
///
/// # Errors
/// Those of [`key_maps`](super::key_maps).
pub fn key_maps_with_stages(
    set: &SampleSet,
    settings: &SynthesisSettings,
) -> Result<(KeyMaps, Vec<Stage>), SynthesisError> {
    let prepared = Prepared::new(set, settings)?;
    let maps = level_maps(&prepared, settings);
    let samples = set.samples.iter().enumerate();
    let mut stages: Vec<Stage> = samples
        .map(|(at, sample)| stage(format!("sample-{}", at + 1), shrunk(sample, 0)))
        .collect();
    let count = set.samples.len();
    let features = (0..count).filter_map(|at| {
        let features = prepared.features(at)?;
        Some(stage(format!("features-{}", at + 1), beside(features, &set.samples[at].mask)))
    });
    stages.extend(features);
    let levels = prepared.grids.len();
    let all: Vec<(usize, usize)> =
        (0..count).flat_map(|at| (0..levels).map(move |level| (at, level))).collect();
    // One after the other, so that the patches of one sample are in memory at a time.
    stages.extend(all.iter().map(|&(at, level): &(usize, usize)| {
        let sources = linked(&prepared, &maps[prepared.first][level], (at, level));
        let shown = shown(&set.samples[at], levels - 1 - level, &sources);
        stage(format!("links-{}-level-{}", at + 1, level + 1), shown)
    }));
    stages.extend(
        all.par_iter()
            .map(|&(at, level): &(usize, usize)| {
                let shown = shown(&set.samples[at], levels - 1 - level, &maps[at][level].sources);
                stage(format!("map-{}-level-{}", at + 1, level + 1), shown)
            })
            .collect::<Vec<_>>(),
    );
    Ok((KeyMaps::of(&prepared, maps), stages))
}

fn stage(name: String, picture: Picture) -> Stage {
    Stage { name, picture }
}

/// A sample with its sides halved so many times; grey where it has no texel.
fn shrunk(sample: &Sample, halvings: usize) -> Picture {
    let (width, height) = sample.size();
    let side = 1 << halvings;
    let mean = |index: usize| {
        let x = index % (width >> halvings) * side;
        let y = index / (width >> halvings) * side;
        let texels = (0..side * side).map(|at| (x + at % side, y + at / side));
        let mut sum = [0.0; 3];
        let mut count = 0.0_f32;
        for at in texels.filter(|at| sample.mask[*at]) {
            (0..3).for_each(|channel| sum[channel] += sample.color[at][channel]);
            count += 1.0;
        }
        if count > 0.0 { sum.map(|sum| sum / count) } else { [grey(GREY); 3] }
    };
    let columns = width >> halvings;
    let rows = height >> halvings;
    Field::from_values(columns, rows, (0..columns * rows).map(mean).collect())
}

/// Colours of a sample at a level, at the places of `sources`.
fn shown(sample: &Sample, halvings: usize, sources: &Field<[u16; 2]>) -> Picture {
    let small = shrunk(sample, halvings);
    let last = (small.width() - 1, small.height() - 1);
    let colors = sources
        .values()
        .iter()
        .map(|&[x, y]: &[u16; 2]| small[(usize::from(x).min(last.0), usize::from(y).min(last.1))])
        .collect();
    Field::from_values(sources.width(), sources.height(), colors)
}

/// Places of the patches of a sample that are most like those of the first map, laid without seams
/// being cut.
fn linked(
    prepared: &Prepared,
    first: &LevelMap,
    (sample, level): (usize, usize),
) -> Field<[u16; 2]> {
    let grid = prepared.grids[level];
    let described = prepared.described(sample, level);
    let mut sources = Field::filled(grid.size, grid.size, [0; 2]);
    let links: Vec<Option<[u16; 2]>> = first
        .places
        .par_iter()
        .map(|&place| {
            let wanted = prepared.of_first[level].at(place)?;
            described.nearest(wanted, 1).first().map(|link| link.place)
        })
        .collect();
    for ([column, row], link) in grid.cells().zip(links) {
        let Some([u, v]) = link else { continue };
        let x = grid.origin(column);
        let y = grid.origin(row);
        for (j, i) in (0..grid.patch).flat_map(|j| (0..grid.patch).map(move |i| (j, i))) {
            let at = ((x + i) % grid.size, (y + j) % grid.size);
            sources[at] = [u + i as u16, v + j as u16];
        }
    }
    sources
}

/// The channels of features as greys beside each other: the mean is grey, lower is darker.
fn beside(features: &Field<[f32; FEATURES]>, mask: &Field<bool>) -> Picture {
    let width = features.width();
    let height = features.height();
    let mut picture = Field::filled(FEATURES * (width + GAP) - GAP, height, [grey(GREY); 3]);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        if mask[(x, y)] {
            for (channel, value) in features[(x, y)].iter().enumerate() {
                let value = GREY + GREY * f64::from(*value) / DEVIATIONS;
                picture[(channel * (width + GAP) + x, y)] = [grey(value); 3];
            }
        }
    }
    picture
}

/// Linear value of an encoded grey.
fn grey(encoded: f64) -> f32 {
    Rgb([encoded.clamp(0.0, 1.0); 3]).linear().0[0] as f32
}

#[cfg(test)]
mod tests {
    use super::super::key_maps::key_maps;
    use super::*;
    use crate::sample::strokes;

    fn set() -> SampleSet {
        let samples = [(0.1, 1), (0.4, 2)];
        let samples = samples.map(|(tone, seed)| strokes("a", 96, 8, tone, seed)).into();
        SampleSet { samples, paint: None, provenance: String::new() }
    }

    #[test]
    fn stages_are_named_in_order_and_the_last_ones_are_the_maps() {
        let set = set();
        let settings = SynthesisSettings { size: 64, ..Default::default() };
        let (maps, stages) = key_maps_with_stages(&set, &settings).unwrap();
        assert_eq!(maps, key_maps(&set, &settings).unwrap());
        assert_eq!(maps.levels, 2);
        let names: Vec<&str> = stages.iter().map(|stage| stage.name.as_str()).collect();
        let wanted = [
            "sample-1",
            "sample-2",
            "features-1",
            "features-2",
            "links-1-level-1",
            "links-1-level-2",
            "links-2-level-1",
            "links-2-level-2",
            "map-1-level-1",
            "map-1-level-2",
            "map-2-level-1",
            "map-2-level-2",
        ];
        assert_eq!(names, wanted);
        assert_eq!(stages[0].picture, set.samples[0].color);
        for (sample, sources) in maps.sources.iter().enumerate() {
            let map = &stages[9 + 2 * sample].picture;
            for (found, &[x, y]) in map.values().iter().zip(sources.values()) {
                let color = set.samples[sample].color[(usize::from(x), usize::from(y))];
                assert_eq!(*found, color);
            }
            assert_eq!(stages[8 + 2 * sample].picture.width(), 32);
        }
    }

    #[test]
    fn links_to_the_first_map_itself_are_its_own_patches() {
        let set = set();
        let settings = SynthesisSettings { size: 64, ..Default::default() };
        let prepared = Prepared::new(&set, &settings).unwrap();
        let maps = level_maps(&prepared, &settings);
        let first = prepared.first;
        let level = prepared.grids.len() - 1;
        let map = &maps[first][level];
        let own = linked(&prepared, map, (first, level));
        let grid = prepared.grids[level];
        for (cell, place) in grid.cells().zip(&map.places) {
            let [x, y] = cell.map(|index| grid.origin(index) + grid.patch / 2);
            let middle = own[(x % grid.size, y % grid.size)];
            let half = grid.patch as u16 / 2;
            assert_eq!(middle, place.map(|at| at + half), "cell {cell:?}");
        }
    }

    #[test]
    fn features_are_greys_about_their_mean() {
        let mut features = Field::filled(3, 2, [0.0; FEATURES]);
        features[(1, 1)] = [0.0, 3.0, 0.0, -9.0, 0.0];
        let mut mask = Field::filled(3, 2, true);
        mask[(2, 0)] = false;
        let picture = beside(&features, &mask);
        assert_eq!((picture.width(), picture.height()), (5 * 7 - 4, 2));
        assert_eq!(picture[(7 + 1, 1)], [1.0; 3]);
        assert_eq!(picture[(21 + 1, 1)], [0.0; 3]);
        assert_eq!(picture[(1, 1)], [grey(0.5); 3]);
    }
}
