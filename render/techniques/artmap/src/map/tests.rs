use graphics::field::Field;
use paint::layer::SLOTS;

use super::*;
use crate::measures::{Texture, contrast};
use crate::sample::{Sample, SampleSet, TexelPaint, strokes};
use crate::synthesis::SynthesisSettings;

const SPACING: usize = 8;

fn set(tones: [f32; 3]) -> SampleSet {
    let samples = tones.into_iter().zip(1..).map(|(tone, seed)| {
        let mut sample = strokes(&format!("tone {tone}"), 240, SPACING, tone, seed);
        let amounts = sample
            .color
            .values()
            .iter()
            .map(|color: &[f32; 3]| {
                let mut pigments_mm = [0.0; SLOTS];
                pigments_mm[2] = color[0];
                TexelPaint { pigments_mm, vehicle_mm: 2.0 * color[0] }
            })
            .collect();
        sample.paint = Some(Field::from_values(240, 240, amounts));
        sample
    });
    SampleSet { samples: samples.collect(), paint: None, provenance: "made up".to_owned() }
}

fn map() -> (SampleSet, ArtMap) {
    let samples = set([0.45, 0.08, 0.2]);
    let settings = SynthesisSettings { size: 128, ..SynthesisSettings::default() };
    let map = ArtMap::of(&samples, &settings).unwrap();
    (samples, map)
}

fn sample<'a>(set: &'a SampleSet, key: &KeyMap) -> &'a Sample {
    set.samples.iter().find(|sample| sample.name == key.name).unwrap()
}

#[test]
fn tiles_go_from_dark_to_light_and_show_their_sources_to_the_bit() {
    let (samples, map) = map();
    let names: Vec<&str> = map.keys.iter().map(|key| key.name.as_str()).collect();
    assert_eq!(names, ["tone 0.08", "tone 0.2", "tone 0.45"]);
    let size = map.size();
    let mut exact = 0;
    for key in &map.keys {
        let from = sample(&samples, key);
        for index in 0..size * size {
            let x = index % size;
            let y = index / size;
            let [u, v] = key.sources[(x, y)];
            let continues = |i: isize, j: isize| {
                let wrap = |at: usize, by: isize| (at as isize + by).rem_euclid(size as isize);
                let near = key.sources[(wrap(x, i) as usize, wrap(y, j) as usize)];
                near == [u as isize + i, v as isize + j].map(|at| at as u16)
            };
            if (-1..=1).all(|j| (-1..=1).all(|i| continues(i, j))) {
                let place = (usize::from(u), usize::from(v));
                assert_eq!(key.tile.color[(x, y)], from.color[place]);
                assert_eq!(
                    key.tile.height_mm.as_ref().unwrap()[(x, y)],
                    from.height_mm.as_ref().unwrap()[place]
                );
                assert_eq!(
                    key.tile.paint.as_ref().unwrap()[(x, y)],
                    from.paint.as_ref().unwrap()[place]
                );
                exact += 1;
            }
        }
    }
    assert!(exact > 3 * size * size / 2, "{exact}");
}

#[test]
fn seams_have_means_of_colour_and_paint_alike() {
    let (_, map) = map();
    for key in &map.keys {
        let paint = key.tile.paint.as_ref().unwrap();
        for (color, texel) in key.tile.color.values().iter().zip(paint.values()) {
            assert!((color[0] - texel.pigments_mm[2]).abs() < 1e-6);
            assert!((2.0 * color[0] - texel.vehicle_mm).abs() < 1e-6);
        }
    }
}

#[test]
fn tones_between_follow_the_share_and_keep_their_strokes() {
    let (_, map) = map();
    for (between, least) in [(Between::Dissolve, 0.93), (Between::Blend, 0.85)] {
        for lower in 0..2 {
            let transition = map.transition(lower, between).unwrap();
            let tones = [map.keys[lower].tone, map.keys[lower + 1].tone];
            let contrasts =
                [lower, lower + 1].map(|at| contrast(&Texture::tiled(&map.keys[at].tile.color)));
            let mut last = tones[0];
            for share in [0.05, 0.25, 0.5, 0.75, 0.95] {
                let tile = transition.at(share);
                let wanted = tones[0] + f64::from(share) * (tones[1] - tones[0]);
                assert!((tile.tone() - wanted).abs() <= 0.5, "{between:?} {share} {}", tile.tone());
                assert!(tile.tone() > last);
                last = tile.tone();
                let of_keys = contrasts[0] + f64::from(share) * (contrasts[1] - contrasts[0]);
                let found = contrast(&Texture::tiled(&tile.color)) / of_keys;
                assert!((least..=1.1).contains(&found), "{between:?} {lower} {share}: {found}");
            }
            assert_eq!(transition.at(0.0), map.keys[lower].tile);
            assert_eq!(transition.at(1.0), map.keys[lower + 1].tile);
        }
    }
    assert!(map.transition(2, Between::Blend).is_none());
}

#[test]
fn paint_and_height_between_two_tones_have_the_means_of_both() {
    let (_, map) = map();
    let means = |tile: &Tile| {
        let texels = tile.paint.as_ref().unwrap().values();
        let heights = tile.height_mm.as_ref().unwrap().values();
        assert!(texels.iter().all(|texel| texel.pigments_mm[2] >= 0.0 && texel.vehicle_mm >= 0.0));
        [
            texels.iter().map(|texel: &TexelPaint| f64::from(texel.pigments_mm[2])).sum::<f64>(),
            texels.iter().map(|texel| f64::from(texel.vehicle_mm)).sum(),
            heights.iter().map(|mm| f64::from(*mm)).sum(),
        ]
    };
    let keys = [0, 1].map(|at| means(&map.keys[at].tile));
    for between in [Between::Dissolve, Between::Blend] {
        let found = means(&map.transition(0, between).unwrap().at(0.25));
        for (index, found) in found.into_iter().enumerate() {
            let wanted = 0.75 * keys[0][index] + 0.25 * keys[1][index];
            assert!((found - wanted).abs() < 1e-4 * wanted, "{between:?} {found} {wanted}");
        }
    }
}

#[test]
fn steps_between_tones_are_those_of_the_paper() {
    // 20 L* are 51 levels of 255: ten steps of at most 5.1.
    assert_eq!(ArtMap::steps(30.0, 50.0, 5.0), 10);
    assert_eq!(ArtMap::steps(30.0, 31.0, 5.0), 0);
}
