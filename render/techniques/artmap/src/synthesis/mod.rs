//! Textures that tile, synthesised from samples. Each texel is a place in its sample. You get maps
//! of all samples of a set, and if you like, pictures of how they are made, step by step.

mod level;
mod descriptors;
mod canvas;
mod patches;

use graphics::field::Field;
use graphics::picture::Picture;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use spectra::color::Rgb;

use crate::sample::{Sample, SampleSet};
use descriptors::Prepared;
use level::{FEATURES, is_nested};
use patches::{Following, LevelMap, first_level};

pub use level::{Features, SynthesisError, SynthesisSettings};

/// Maps that tile, one of each sample. Their strokes stand at the places of the first map's
/// strokes.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyMaps {
    /// Index of the sample that got the first map.
    pub first: usize,
    /// For every map, in the order of the samples: column and row of the texel in the sample that
    /// each texel of the map shows.
    pub sources: Vec<Field<[u16; 2]>>,
    /// Width and height of a patch at the finest level, in texels.
    pub patch: usize,
    /// Number of levels of the pyramids.
    pub levels: usize,
}

/// Synthesises a map of each sample (Yan and others 2008, section 4.3).
///
/// Nothing guides the first map. For each patch of the other maps, we take the place in their own
/// sample that is most like the first map there and fits the patches already laid. If a sample has
/// its strokes at the places of the first one, it shows the same places. You get the same maps for
/// the same input with any number of threads.
///
/// # Errors
/// [`SynthesisError`] for settings out of range, and for samples that are too small, flat, or of
/// another spacing than the first one.
pub fn key_maps(set: &SampleSet, settings: &SynthesisSettings) -> Result<KeyMaps, SynthesisError> {
    let prepared = Prepared::new(set, settings)?;
    Ok(KeyMaps::of(&prepared, level_maps(&prepared, settings)))
}

impl KeyMaps {
    pub(crate) fn of(prepared: &Prepared, maps: Vec<Vec<LevelMap>>) -> Self {
        let Prepared { first, patch, ref grids, .. } = *prepared;
        let sources = maps
            .into_iter()
            .map(|mut levels: Vec<LevelMap>| {
                levels.pop().map_or_else(|| Field::filled(0, 0, [0; 2]), |map| map.sources)
            })
            .collect();
        Self { first, sources, patch, levels: grids.len() }
    }
}

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
    (0..pyramids.len())
        .into_par_iter()
        .map(|sample: usize| {
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
        })
        .collect()
}

/// Encoded grey of texels without information. A feature of its mean value has this grey too.
const GREY: f64 = 0.5;

/// A feature goes from grey to white over this many deviations.
const DEVIATIONS: f64 = 3.0;

const GAP: usize = 4;

/// A picture of one step of a synthesis. You can use this to see why a map came out as it did.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Name in letters, digits and hyphens. Samples and levels count from 1, coarse to fine.
    pub name: String,
    /// Linear sRGB.
    pub picture: Picture,
}

/// Synthesises maps as [`key_maps`] does, to the bit. You also get pictures of the steps in their
/// order:
///
/// - `sample-1` and on: the samples, dark to light,
/// - `features-1` and on: what patches are compared by (edges, lightness, a*, b*, height) as
///   greys beside each other,
/// - `links-1-level-1` and on: in the place of each patch of the first map the most similar patch
///   of the sample, before anything is made to fit its neighbours,
/// - `map-1-level-1` and on: the map of the sample at each level.
///
/// # Errors
/// This fails like [`key_maps`].
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
    // We go one after the other, so that the patches of only one sample are in memory at a time.
    stages.extend(all.iter().map(|&(at, level): &(usize, usize)| {
        let sources = linked(&prepared, &maps[prepared.first][level], (at, level));
        let shown = picture_of_sources(&set.samples[at], levels - 1 - level, &sources);
        stage(format!("links-{}-level-{}", at + 1, level + 1), shown)
    }));
    stages.extend(
        all.par_iter()
            .map(|&(at, level): &(usize, usize)| {
                let shown = picture_of_sources(
                    &set.samples[at],
                    levels - 1 - level,
                    &maps[at][level].sources,
                );
                stage(format!("map-{}-level-{}", at + 1, level + 1), shown)
            })
            .collect::<Vec<_>>(),
    );
    Ok((KeyMaps::of(&prepared, maps), stages))
}

fn stage(name: String, picture: Picture) -> Stage {
    Stage { name, picture }
}

/// A sample with its sides halved this many times. It is grey where it has no texel.
fn shrunk(sample: &Sample, halvings: usize) -> Picture {
    let (width, height) = sample.size();
    let side = 1 << halvings;
    let columns = width >> halvings;
    let rows = height >> halvings;
    Field::from_values(
        columns,
        rows,
        (0..columns * rows)
            .map(|index: usize| {
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
            })
            .collect(),
    )
}

fn picture_of_sources(sample: &Sample, halvings: usize, sources: &Field<[u16; 2]>) -> Picture {
    let small = shrunk(sample, halvings);
    let last = (small.width() - 1, small.height() - 1);
    let colors = sources
        .values()
        .iter()
        .map(|&[x, y]: &[u16; 2]| small[(usize::from(x).min(last.0), usize::from(y).min(last.1))])
        .collect();
    Field::from_values(sources.width(), sources.height(), colors)
}

/// Places of the patches of a sample that are most like the patches of the first map. This lays
/// them without cutting seams.
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

/// The channels of features as greys beside each other. The mean is grey, lower is darker.
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

fn grey(encoded: f64) -> f32 {
    Rgb([encoded.clamp(0.0, 1.0); 3]).linear().0[0] as f32
}

#[cfg(test)]
mod stages_tests {
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

#[cfg(test)]
mod tests {
    use super::descriptors::PatchSpace;
    use super::level::{Channels, FEATURES, Level};
    use super::*;
    use crate::measures::{
        Texture, co_occurrence_error, coherence, contrast, most_used, stroke_length, wrap_ratio,
    };
    use crate::painted::{PaintedSettings, Style, painted_samples};
    use crate::sample::{Sample, SampleSet, strokes};
    use graphics::field::Field;
    use graphics::picture::Picture;
    use rayon::ThreadPoolBuilder;

    const SPACING: usize = 8;

    fn set(samples: Vec<Sample>) -> SampleSet {
        SampleSet { samples, paint: None, provenance: "made up".to_owned() }
    }

    fn small() -> SynthesisSettings {
        SynthesisSettings { size: 128, ..SynthesisSettings::default() }
    }

    fn color(sample: &Sample, sources: &Field<[u16; 2]>) -> Picture {
        Field::from_values(
            sources.width(),
            sources.height(),
            sources
                .values()
                .iter()
                .map(|&[x, y]: &[u16; 2]| sample.color[(usize::from(x), usize::from(y))])
                .collect(),
        )
    }

    fn textures(set: &SampleSet, maps: &KeyMaps) -> Vec<Texture> {
        let maps = set.samples.iter().zip(&maps.sources);
        maps.map(|(sample, sources)| Texture::tiled(&color(sample, sources))).collect()
    }

    fn tones(seeds: [u64; 3]) -> SampleSet {
        set(seeds
            .into_iter()
            .zip([0.08, 0.2, 0.45])
            .map(|(seed, tone): (u64, f32)| {
                strokes(&format!("tone {tone}"), 240, SPACING, tone, seed)
            })
            .collect())
    }

    #[test]
    fn maps_of_unlike_samples_have_their_strokes_at_the_same_places() {
        let samples = tones([1, 2, 3]);
        let maps = key_maps(&samples, &small()).unwrap();
        let shown = textures(&samples, &maps);
        let alone = SynthesisSettings { seed: 7, ..small() };
        for (index, texture) in shown.iter().enumerate() {
            let found = coherence(&shown[maps.first], texture, SPACING as f64);
            assert!(found >= 0.6, "map {index} to {}: {found}", maps.first);
            if index != maps.first {
                let only = set(vec![samples.samples[index].clone()]);
                let free = &textures(&only, &key_maps(&only, &alone).unwrap())[0];
                let independent = coherence(&shown[maps.first], free, SPACING as f64);
                assert!(independent <= 0.15, "independent map {index}: {independent}");
            }
        }
    }

    #[test]
    fn maps_of_nested_samples_agree_almost_everywhere() {
        let samples = tones([4, 4, 4]);
        let maps = key_maps(&samples, &small()).unwrap();
        let shown = textures(&samples, &maps);
        for texture in &shown {
            let found = coherence(&shown[maps.first], texture, SPACING as f64);
            assert!(found >= 0.9, "{found}");
        }
    }

    #[test]
    fn maps_of_tones_painted_with_the_same_strokes_agree() {
        let mut style = Style::named("oil-flat").unwrap();
        style.canvas.cell_mm = 0.5;
        style.canvas.side_cells = 128;
        let settings = PaintedSettings { tones: 3, ..PaintedSettings::default() };
        let samples = painted_samples(&style, &settings).unwrap();
        let maps = key_maps(&samples, &SynthesisSettings { size: 96, ..small() }).unwrap();
        let shown = textures(&samples, &maps);
        for (index, texture) in shown.iter().enumerate() {
            let found = coherence(&shown[maps.first], texture, samples.samples[0].spacing);
            assert!(found >= 0.9, "map {index} to {}: {found}", maps.first);
        }
    }

    #[test]
    fn maps_have_the_brushwork_of_their_samples_and_no_seams() {
        let samples = tones([1, 2, 3]);
        let mut lengths = Vec::new();
        let mut seams = Vec::new();
        for seed in [1, 2] {
            let maps = key_maps(&samples, &SynthesisSettings { seed, ..small() }).unwrap();
            for ((sample, map), sources) in
                samples.samples.iter().zip(textures(&samples, &maps)).zip(&maps.sources)
            {
                fn half(from: usize, sample: &Sample) -> Texture {
                    let mask = (0..240 * 240).map(|index| index % 240 / 120 == from).collect();
                    Texture::masked(&sample.color, &Field::from_values(240, 240, mask))
                }
                let whole = Texture::masked(&sample.color, &sample.mask);
                let floor = co_occurrence_error(&half(0, sample), &half(1, sample));
                let error = co_occurrence_error(&whole, &map);
                assert!(error <= floor + 0.1, "{error} of {floor}");
                let ratio = contrast(&map) / contrast(&whole);
                assert!((0.9..=1.1).contains(&ratio), "contrast {ratio}");
                let most = most_used(sources, &sample.mask, 16);
                assert!(most <= 4.0, "use {most}");
                fn length(texture: &Texture) -> f64 {
                    stroke_length(&texture.levelled(4.0 * SPACING as f64))
                }
                lengths.push(length(&map) / length(&whole));
                seams.push(wrap_ratio(&map));
            }
        }
        // Both figures scatter by 0.15 even over crops of one sample of this size, so we bound
        // their means.
        fn mean(values: &[f64]) -> f64 {
            values.iter().sum::<f64>() / values.len() as f64
        }
        assert!((0.8..=1.25).contains(&mean(&lengths)), "stroke lengths {lengths:?}");
        assert!(lengths.iter().all(|length| (0.65..=1.4).contains(length)), "{lengths:?}");
        assert!(mean(&seams) <= 1.05, "seams {seams:?}");
    }

    #[test]
    fn links_are_the_nearest_of_all_patches() {
        const PATCH: usize = 10;
        fn level(sample: &Sample) -> Level {
            Level::new(&Channels::of(sample), SPACING as f64, Features::default())
        }
        let first = level(&strokes("a", 64, SPACING, 0.1, 1));
        let second = level(&strokes("b", 64, SPACING, 0.3, 2));
        let space = PatchSpace::of(&[&first, &second], PATCH);
        let from = space.describe(&first);
        let to = space.describe(&second);
        let exact = |a: [u16; 2], b: [u16; 2]| {
            let mut sum = 0.0;
            for index in 0..PATCH * PATCH {
                fn at([x, y]: [u16; 2], index: usize) -> (usize, usize) {
                    (usize::from(x) + index % PATCH, usize::from(y) + index / PATCH)
                }
                let a = first.features[at(a, index)];
                let b = second.features[at(b, index)];
                sum += (0..FEATURES).map(|i| (a[i] - b[i]).powi(2)).sum::<f32>();
            }
            sum
        };
        let mut found = 0;
        let mut wanted = 0;
        for &place in from.places.iter().step_by(97) {
            let links = to.nearest(from.at(place).unwrap(), 32);
            let mut all: Vec<_> =
                to.places.iter().map(|&other| (exact(place, other), other)).collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0));
            wanted += 8;
            found += all[..8]
                .iter()
                .filter(|(_, other)| links.iter().any(|l| l.place == *other))
                .count();
            assert!(links.windows(2).all(|pair| pair[0].distance <= pair[1].distance));
        }
        assert!(found * 100 >= wanted * 95, "{found} of {wanted}");
    }

    #[test]
    fn threads_and_reruns_change_nothing_and_seeds_do() {
        let samples = tones([1, 2, 3]);
        let settings = SynthesisSettings { size: 64, ..small() };
        fn with(threads: usize, samples: &SampleSet, settings: &SynthesisSettings) -> KeyMaps {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| key_maps(samples, settings).unwrap())
        }
        let once = with(1, &samples, &settings);
        assert_eq!(once, with(2, &samples, &settings));
        let other = SynthesisSettings { seed: 2, ..settings };
        assert_ne!(once, key_maps(&samples, &other).unwrap());
    }

    #[test]
    fn masked_texels_are_never_shown() {
        let mut samples = tones([1, 2, 3]);
        for sample in &mut samples.samples {
            for y in 0..240_usize {
                for x in 0..240_usize {
                    let inside = x.abs_diff(120).pow(2) + y.abs_diff(120).pow(2) < 110 * 110;
                    sample.mask[(x, y)] = inside;
                    if !inside {
                        sample.color[(x, y)] = [5.0, 0.0, 0.0];
                    }
                }
            }
        }
        let maps = key_maps(&samples, &SynthesisSettings { size: 64, ..small() }).unwrap();
        for (sample, sources) in samples.samples.iter().zip(&maps.sources) {
            assert!(
                sources
                    .values()
                    .iter()
                    .all(|&[x, y]: &[u16; 2]| sample.mask[(usize::from(x), usize::from(y))]),
                "{}",
                sample.name
            );
        }
    }

    #[test]
    fn samples_of_narrow_outline_are_made_with_fewer_levels() {
        let whole = key_maps(&tones([1, 2, 3]), &small()).unwrap();
        let mut samples = tones([1, 2, 3]);
        let mask = &mut samples.samples[1].mask;
        for index in 0..240 * 240 {
            let x = index % 240;
            let y = index / 240;
            mask[(x, y)] = (x + y / 3) % 60 < 26;
        }
        let maps = key_maps(&samples, &small()).unwrap();
        assert!(maps.levels < whole.levels, "{} of {}", maps.levels, whole.levels);
        let mask = &samples.samples[1].mask;
        assert!(
            maps.sources[1]
                .values()
                .iter()
                .all(|&[x, y]: &[u16; 2]| mask[(usize::from(x), usize::from(y))])
        );
    }

    #[test]
    fn samples_that_cannot_be_used_are_refused_by_name() {
        fn refused(samples: Vec<Sample>, settings: &SynthesisSettings) -> String {
            key_maps(&set(samples), settings).unwrap_err().to_string()
        }
        fn good() -> Sample {
            strokes("good", 96, SPACING, 0.2, 1)
        }
        assert!(refused(vec![], &small()).contains("no sample"));
        let tiny = strokes("tiny", 12, SPACING, 0.2, 1);
        assert!(refused(vec![good(), tiny], &small()).contains("`tiny` of 12 x 12"));
        let mut flat = good();
        flat.color = Field::filled(96, 96, [0.2; 3]);
        flat.height_mm = None;
        assert!(refused(vec![flat], &small()).contains("of one colour"));
        let close = Sample { spacing: 3.0, ..good() };
        assert!(refused(vec![close], &small()).contains("3.0 texels apart"));
        let wide = strokes("wide", 96, 2 * SPACING, 0.2, 1);
        assert!(refused(vec![good(), wide], &small()).contains("`wide` are 16.0"));
        let first = SynthesisSettings { first: Some("none".to_owned()), ..small() };
        assert!(refused(vec![good()], &first).contains("there are good"));
        let size = SynthesisSettings { size: 2000, ..small() };
        assert!(refused(vec![good()], &size).contains("64 to 1024"));
    }

    #[test]
    fn one_sample_alone_gives_one_map() {
        let maps = key_maps(&set(vec![strokes("one", 96, SPACING, 0.2, 1)]), &small()).unwrap();
        assert_eq!((maps.first, maps.sources.len(), maps.sources[0].width()), (0, 1, 128));
    }
}
