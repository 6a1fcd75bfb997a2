use graphics::field::Field;
use graphics::picture::Picture;
use rayon::ThreadPoolBuilder;

use super::descriptors::PatchSpace;
use super::level::{Channels, FEATURES, Level};
use super::*;
use crate::measures::{
    Texture, co_occurrence_error, coherence, contrast, most_used, stroke_length, wrap_ratio,
};
use crate::painted::{PaintedSettings, Style, painted_samples};
use crate::sample::{Sample, SampleSet, strokes};

const SPACING: usize = 8;

fn set(samples: Vec<Sample>) -> SampleSet {
    SampleSet { samples, paint: None, provenance: "made up".to_owned() }
}

fn small() -> SynthesisSettings {
    SynthesisSettings { size: 128, ..SynthesisSettings::default() }
}

/// Colour of a map.
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
        .map(|(seed, tone): (u64, f32)| strokes(&format!("tone {tone}"), 240, SPACING, tone, seed))
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
            let half = |from: usize| {
                let mask = (0..240 * 240).map(|index| index % 240 / 120 == from).collect();
                Texture::masked(&sample.color, &Field::from_values(240, 240, mask))
            };
            let whole = Texture::masked(&sample.color, &sample.mask);
            let floor = co_occurrence_error(&half(0), &half(1));
            let error = co_occurrence_error(&whole, &map);
            assert!(error <= floor + 0.1, "{error} of {floor}");
            let ratio = contrast(&map) / contrast(&whole);
            assert!((0.9..=1.1).contains(&ratio), "contrast {ratio}");
            let most = most_used(sources, &sample.mask, 16);
            assert!(most <= 4.0, "use {most}");
            let length = |texture: &Texture| stroke_length(&texture.levelled(4.0 * SPACING as f64));
            lengths.push(length(&map) / length(&whole));
            seams.push(wrap_ratio(&map));
        }
    }
    // Both figures scatter by 0.15 even over crops of one sample of this size, so their means are
    // held to the bounds.
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    assert!((0.8..=1.25).contains(&mean(&lengths)), "stroke lengths {lengths:?}");
    assert!(lengths.iter().all(|length| (0.65..=1.4).contains(length)), "{lengths:?}");
    assert!(mean(&seams) <= 1.05, "seams {seams:?}");
}

#[test]
fn links_are_the_nearest_of_all_patches() {
    const PATCH: usize = 10;
    let level =
        |sample: &Sample| Level::new(&Channels::of(sample), SPACING as f64, Features::default());
    let first = level(&strokes("a", 64, SPACING, 0.1, 1));
    let second = level(&strokes("b", 64, SPACING, 0.3, 2));
    let space = PatchSpace::of(&[&first, &second], PATCH);
    let from = space.describe(&first);
    let to = space.describe(&second);
    let exact = |a: [u16; 2], b: [u16; 2]| {
        let mut sum = 0.0;
        for index in 0..PATCH * PATCH {
            let at =
                |[x, y]: [u16; 2]| (usize::from(x) + index % PATCH, usize::from(y) + index / PATCH);
            let a = first.features[at(a)];
            let b = second.features[at(b)];
            sum += (0..FEATURES).map(|i| (a[i] - b[i]).powi(2)).sum::<f32>();
        }
        sum
    };
    let mut found = 0;
    let mut wanted = 0;
    for &place in from.places.iter().step_by(97) {
        let links = to.nearest(from.at(place).unwrap(), 32);
        let mut all: Vec<_> = to.places.iter().map(|&other| (exact(place, other), other)).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        wanted += 8;
        found +=
            all[..8].iter().filter(|(_, other)| links.iter().any(|l| l.place == *other)).count();
        assert!(links.windows(2).all(|pair| pair[0].distance <= pair[1].distance));
    }
    assert!(found * 100 >= wanted * 95, "{found} of {wanted}");
}

#[test]
fn threads_and_reruns_change_nothing_and_seeds_do() {
    let samples = tones([1, 2, 3]);
    let settings = SynthesisSettings { size: 64, ..small() };
    let with = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| key_maps(&samples, &settings).unwrap())
    };
    let once = with(1);
    assert_eq!(once, with(2));
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
        // Bars 26 texels wide.
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
    let refused = |samples: Vec<Sample>, settings: &SynthesisSettings| {
        key_maps(&set(samples), settings).unwrap_err().to_string()
    };
    let good = || strokes("good", 96, SPACING, 0.2, 1);
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
