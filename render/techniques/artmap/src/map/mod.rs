//! Art maps: key tiles of brushwork from dark to light, gathered from samples, and tiles between
//! two neighbouring ones.

pub mod file;
mod check;
mod sheet;

use graphics::encoding::{lab_from_linear, linear_from_lab};
use graphics::field::Field;
use graphics::picture::Picture;
use paint::layer::SLOTS;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::relief::blurred_tile;
use crate::sample::{PaintOfSamples, Sample, SampleSet, TexelPaint};
use crate::synthesis::{
    KeyMaps, Stage, SynthesisError, SynthesisSettings, key_maps, key_maps_with_stages,
};

pub use check::{BetweenFigures, KeyFigures, MapFault, MapFigures};

/// The brushwork of one sample as a tile.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyMap {
    /// Name of the sample.
    pub name: String,
    /// Colour, paint and height.
    pub tile: Tile,
    /// For each texel the column and row of the sample that it shows.
    pub sources: Field<[u16; 2]>,
    /// Mean L* of the tile.
    pub tone: f64,
}

/// A painterly art map (Yan and others 2008). Its tiles have one size and show the brushwork of a
/// painting, from dark to light, with strokes at the same places.
#[derive(Debug, Clone, PartialEq)]
pub struct ArtMap {
    /// Tiles from dark to light, at least one.
    pub keys: Vec<KeyMap>,
    /// Index of the tile that was made first. The others follow this one.
    pub first: usize,
    /// Pigments of the paint of the tiles, `None` for maps without pigments.
    pub paint: Option<PaintOfSamples>,
    /// Distance of neighbouring strokes in texels.
    pub spacing: f64,
    /// Side of a texel in mm, where it is known.
    pub mm_per_texel: Option<f64>,
    /// Whether heights are a guess from a photograph.
    pub guessed_relief: bool,
    /// Width and height of a patch of the synthesis, in texels.
    pub patch: usize,
    /// Number of levels of the synthesis.
    pub levels: usize,
    /// Settings of the synthesis.
    pub settings: SynthesisSettings,
    /// Where the samples come from, in words.
    pub provenance: String,
}

impl ArtMap {
    /// Synthesises a map of the samples. Tiles are in the order of their mean lightness. If tiles
    /// are equally light, they keep the order of the samples.
    ///
    /// # Errors
    /// [`SynthesisError`], as of [`key_maps`].
    pub fn of(set: &SampleSet, settings: &SynthesisSettings) -> Result<Self, SynthesisError> {
        Ok(Self::gathered(set, settings, key_maps(set, settings)?))
    }

    /// Synthesises a map as [`Self::of`] does. You also get pictures of the steps
    /// ([`key_maps_with_stages`]).
    ///
    /// # Errors
    /// This fails like [`Self::of`].
    pub fn with_stages(
        set: &SampleSet,
        settings: &SynthesisSettings,
    ) -> Result<(Self, Vec<Stage>), SynthesisError> {
        let (maps, stages) = key_maps_with_stages(set, settings)?;
        Ok((Self::gathered(set, settings, maps), stages))
    }

    fn gathered(set: &SampleSet, settings: &SynthesisSettings, maps: KeyMaps) -> Self {
        fn key((sample, sources): (&Sample, Field<[u16; 2]>)) -> KeyMap {
            let tile = tile_of(sample, &sources);
            KeyMap { name: sample.name.clone(), tone: tile.tone(), tile, sources }
        }
        let pairs: Vec<_> = set.samples.iter().zip(maps.sources).collect();
        let keys: Vec<KeyMap> = pairs.into_par_iter().map(key).collect();
        let mut order: Vec<usize> = (0..keys.len()).collect();
        order.sort_by(|a, b| keys[*a].tone.total_cmp(&keys[*b].tone).then(a.cmp(b)));
        let first = order.iter().position(|index| *index == maps.first).unwrap_or(0);
        let mut keys: Vec<(usize, KeyMap)> = keys.into_iter().enumerate().collect();
        keys.sort_by_key(|(index, _)| order.iter().position(|at| at == index));
        let sample = &set.samples[maps.first];
        Self {
            keys: keys.into_iter().map(|(_, key)| key).collect(),
            first,
            paint: set.paint.clone(),
            spacing: sample.spacing,
            mm_per_texel: sample.mm_per_texel,
            guessed_relief: set.samples.iter().any(|sample| sample.guessed_relief),
            patch: maps.patch,
            levels: maps.levels,
            settings: settings.clone(),
            provenance: set.provenance.clone(),
        }
    }

    /// Width and height of the tiles in texels.
    #[must_use]
    pub fn size(&self) -> usize {
        self.keys.first().map_or(0, |key| key.tile.size())
    }

    /// Number of tiles between the tones `lower` and `upper` that make steps of at most `step` of
    /// 255 levels of intensity (equation 7 of Yan and others 2008). We take L* as intensity.
    #[must_use]
    pub fn steps(lower: f64, upper: f64, step: f64) -> usize {
        ((upper - lower).abs() * 2.55 / step).floor() as usize
    }
}

/// In a dissolve, the texels within this share of the order of change are partly changed.
const BAND: f32 = 0.15;
/// Deviation of the Gaussian that smooths two tiles, in spacings of strokes.
const SMOOTH: f64 = 0.25;

/// We divide the deviation of the difference in L* of two tiles by its mean. If the ratio is below
/// the first value, the tone changes evenly. If it is above the second, strokes alone change it,
/// for example where lines are added to lines.
const IN_STROKES: [f32; 2] = [1.0, 2.0];

/// How to make a tile between two key tiles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Between {
    /// Each place shows the strokes of either tile and changes once, light strokes first. This
    /// keeps the contrast of the strokes. Where both tiles differ by much the same everywhere, the
    /// tone also changes evenly.
    #[default]
    Dissolve,
    /// The weighted mean of both tiles in CIELAB (equation 8 of Yan and others 2008).
    Blend,
}

/// The way from a key tile to the next lighter one.
#[derive(Debug, Clone)]
pub struct Transition<'a> {
    darker: &'a Tile,
    lighter: &'a Tile,
    labs: [Field<[f32; 3]>; 2],
    /// When each texel changes, from 0 (first) to 1 (last). `None` if all texels change together.
    ranks: Option<Vec<f32>>,
    /// Share of the difference of tone that changes with the strokes. The rest changes evenly.
    in_strokes: f32,
}

impl ArtMap {
    /// The transition from key tile `lower` to the next lighter one. `None` for the last one.
    #[must_use]
    pub fn transition(&self, lower: usize, between: Between) -> Option<Transition<'_>> {
        let darker = &self.keys.get(lower)?.tile;
        let lighter = &self.keys.get(lower + 1)?.tile;
        let labs = [lab_from_linear(&darker.color), lab_from_linear(&lighter.color)];
        let in_strokes = in_strokes(&labs);
        let ranks = match between {
            Between::Blend => None,
            Between::Dissolve => Some(ranks(&labs, in_strokes, SMOOTH * self.spacing)),
        };
        Some(Transition { darker, lighter, labs, ranks, in_strokes })
    }
}

impl Transition<'_> {
    /// The tile at `share` of the way. At 0 or less you get the darker key tile, at 1 or more the
    /// lighter. In between, the means of L*, a*, b*, of each pigment and of the height change in
    /// proportion.
    #[must_use]
    pub fn at(&self, share: f32) -> Tile {
        if share >= 1.0 {
            return self.lighter.clone();
        }
        if share.is_nan() || share <= 0.0 {
            return self.darker.clone();
        }
        let weights: Vec<f32> = match &self.ranks {
            None => vec![share; self.labs[0].values().len()],
            Some(ranks) => {
                let threshold = share * (1.0 + BAND);
                ranks.iter().map(|rank| ((threshold - rank) / BAND).clamp(0.0, 1.0)).collect()
            }
        };
        self.mixed(&Mixing { share, weights, in_strokes: self.in_strokes })
    }

    fn mixed(&self, mixing: &Mixing) -> Tile {
        let (darker, lighter, size) = (self.darker, self.lighter, self.darker.size());
        let [dark, light] = self.labs.each_ref().map(Field::values);
        let [l, a, b] = [0, 1, 2].map(|i| mixing.level(dark, light, |lab| lab[i]));
        let lab = l.into_iter().zip(a).zip(b).map(|((l, a), b)| [l, a, b]).collect();
        let paint = darker.paint.as_ref().zip(lighter.paint.as_ref()).map(|(dark, light)| {
            let dark = dark.values();
            let light = light.values();
            let vehicle = mixing.amount(dark, light, |texel| texel.vehicle_mm);
            let mut texels: Vec<TexelPaint> = vehicle
                .into_iter()
                .map(|vehicle_mm| TexelPaint { vehicle_mm, ..TexelPaint::default() })
                .collect();
            for slot in 0..SLOTS {
                let amounts = mixing.amount(dark, light, |texel| texel.pigments_mm[slot]);
                texels.iter_mut().zip(amounts).for_each(|(texel, mm)| texel.pigments_mm[slot] = mm);
            }
            Field::from_values(size, size, texels)
        });
        let height_mm = darker.height_mm.as_ref().zip(lighter.height_mm.as_ref());
        let height_mm = height_mm.map(|(dark, light)| {
            Field::from_values(size, size, mixing.amount(dark.values(), light.values(), |mm| *mm))
        });
        Tile { color: linear_from_lab(&Field::from_values(size, size, lab)), paint, height_mm }
    }
}

struct Mixing {
    share: f32,
    weights: Vec<f32>,
    /// Share of the difference of the means that changes with `weights`. The rest changes evenly.
    in_strokes: f32,
}

impl Mixing {
    /// Mixes a channel of any sign. The mean of the result is the mean of both tiles, mixed by
    /// `share`.
    fn level<T>(&self, dark: &[T], light: &[T], of: impl Fn(&T) -> f32) -> Vec<f32> {
        let means = [dark, light].map(|texels| mean(texels.iter().map(&of)));
        let step = means[1] - means[0];
        let wanted = means[0] + self.share * step;
        let evenly = (1.0 - self.in_strokes) * step;
        let mut mixed: Vec<f32> = dark
            .iter()
            .zip(light)
            .zip(&self.weights)
            .map(|((dark, light), weight): ((&T, &T), &f32)| {
                let dark = of(dark);
                let light = of(light);
                dark + self.share * evenly + weight * (light - dark - evenly)
            })
            .collect();
        let shift = wanted - mean(mixed.iter().copied());
        mixed.iter_mut().for_each(|value| *value += shift);
        mixed
    }

    /// Mixes a channel of amounts, which are not negative. The mean of the result is the mean of
    /// both tiles, mixed by `share`.
    fn amount<T>(&self, dark: &[T], light: &[T], of: impl Fn(&T) -> f32) -> Vec<f32> {
        let mut mixed = self.level(dark, light, of);
        let wanted = mean(mixed.iter().copied());
        mixed.iter_mut().for_each(|amount| *amount = amount.max(0.0));
        let found = mean(mixed.iter().copied());
        if found > 0.0 {
            mixed.iter_mut().for_each(|amount| *amount *= wanted / found);
        }
        mixed
    }
}

fn mean(values: impl ExactSizeIterator<Item = f32>) -> f32 {
    let count = values.len().max(1) as f64;
    (values.map(f64::from).sum::<f64>() / count) as f32
}

fn in_strokes([darker, lighter]: &[Field<[f32; 3]>; 2]) -> f32 {
    let differences = darker.values().iter().zip(lighter.values()).map(|(a, b)| b[0] - a[0]);
    let step = mean(differences.clone());
    let deviation = mean(differences.map(|difference| (difference - step).powi(2))).sqrt();
    let [evenly, all] = IN_STROKES;
    let ratio = deviation / step.abs().max(f32::MIN_POSITIVE);
    ((ratio - evenly) / (all - evenly)).clamp(0.0, 1.0)
}

/// When each texel changes. We order texels by the smoothed mean of both tiles, lightest first,
/// and measure the place in this order in the difference that changes with the strokes. So the
/// tile changes evenly. An order by the difference itself would leave the strongest strokes of one
/// tile to the end, and lose contrast.
fn ranks([darker, lighter]: &[Field<[f32; 3]>; 2], in_strokes: f32, sigma: f64) -> Vec<f32> {
    let width = darker.width();
    let height = darker.height();
    let means = [darker, lighter].map(|lab| mean(lab.values().iter().map(|lab| lab[0])));
    let evenly = (1.0 - in_strokes) * (means[1] - means[0]);
    let smoothed = |of: &dyn Fn(f32, f32) -> f32| {
        let pairs = darker.values().iter().zip(lighter.values());
        let values = pairs.map(|(dark, light)| of(dark[0], light[0])).collect();
        blurred_tile(&Field::from_values(width, height, values), sigma)
    };
    let light = smoothed(&|a, b| a + b);
    let change = smoothed(&|a, b| b - a - evenly);
    let mut order: Vec<usize> = (0..width * height).collect();
    order.sort_by(|&a, &b| light.values()[b].total_cmp(&light.values()[a]).then(a.cmp(&b)));
    fn size(index: usize, change: &Field<f32>) -> f64 {
        f64::from(change.values()[index].abs())
    }
    let total: f64 = order.iter().map(|&index| size(index, &change)).sum();
    let mut ranks = vec![0.5; width * height];
    let mut before = 0.0;
    for index in order {
        if total > 0.0 {
            ranks[index] = ((before + 0.5 * size(index, &change)) / total) as f32;
        }
        before += size(index, &change);
    }
    ranks
}

/// Brushwork of one tone on a square that tiles in both directions. Strokes run along y.
#[derive(Debug, Clone, PartialEq)]
pub struct Tile {
    /// Colour under a level surface, in linear sRGB with white at 1.
    pub color: Picture,
    /// Paint of each texel. `None` for maps without pigments.
    pub paint: Option<Field<TexelPaint>>,
    /// Height of the surface above the ground in mm. `None` without relief.
    pub height_mm: Option<Field<f32>>,
}

impl Tile {
    /// Width and height in texels.
    #[must_use]
    pub fn size(&self) -> usize {
        self.color.width()
    }

    /// Mean L*, the tone of the tile.
    #[must_use]
    pub fn tone(&self) -> f64 {
        let lab = lab_from_linear(&self.color);
        let sum: f64 = lab.values().iter().map(|lab| f64::from(lab[0])).sum();
        sum / lab.values().len().max(1) as f64
    }
}

/// We blend channels over this many texels on either side of a seam.
const BLEND: isize = 1;

/// Builds the tile that shows, at every texel, the texel of `sample` in `sources`. At a seam,
/// neighbouring texels show places that are not neighbours in the sample. There we also continue
/// the source of each texel around to this one, and take the means of colour, paint and height.
/// Elsewhere you see the source alone.
fn tile_of(sample: &Sample, sources: &Field<[u16; 2]>) -> Tile {
    let size = sources.width();
    let shown: Vec<Vec<(usize, usize)>> = (0..size * size)
        .map(|index| continued(sample, sources, (index % size, index / size)))
        .collect();
    let field = |of: &dyn Fn((usize, usize)) -> f32| {
        shown
            .iter()
            .map(|places: &Vec<(usize, usize)>| {
                places.iter().map(|&place| of(place)).sum::<f32>() / places.len() as f32
            })
            .collect::<Vec<f32>>()
    };
    let [red, green, blue] = [0, 1, 2].map(|index| field(&|place| sample.color[place][index]));
    let color = (0..size * size).map(|at| [red[at], green[at], blue[at]]).collect();
    let paint = sample.paint.as_ref().map(|paint| {
        let mut gathered = vec![TexelPaint::default(); size * size];
        for slot in 0..SLOTS {
            let amounts = field(&|place| paint[place].pigments_mm[slot]);
            gathered.iter_mut().zip(amounts).for_each(|(texel, mm)| texel.pigments_mm[slot] = mm);
        }
        let vehicle = field(&|place| paint[place].vehicle_mm);
        gathered.iter_mut().zip(vehicle).for_each(|(texel, mm)| texel.vehicle_mm = mm);
        Field::from_values(size, size, gathered)
    });
    let height = sample.height_mm.as_ref();
    let height_mm =
        height.map(|height| Field::from_values(size, size, field(&|place| height[place])));
    Tile { color: Field::from_values(size, size, color), paint, height_mm }
}

/// Places of the sample that a texel shows: its source. At a seam, also the places that would
/// continue the sources of the texels around it.
fn continued(
    sample: &Sample,
    sources: &Field<[u16; 2]>,
    (x, y): (usize, usize),
) -> Vec<(usize, usize)> {
    let size = sources.width() as isize;
    let own = sources[(x, y)];
    let mut places = vec![(usize::from(own[0]), usize::from(own[1]))];
    for (i, j) in (-BLEND..=BLEND).flat_map(|j| (-BLEND..=BLEND).map(move |i| (i, j))) {
        let near = ((x as isize + i).rem_euclid(size), (y as isize + j).rem_euclid(size));
        let [u, v] = sources[(near.0 as usize, near.1 as usize)];
        let place = (u16::try_from(u as isize - i), u16::try_from(v as isize - j));
        let (Ok(u), Ok(v)) = place else { continue };
        let place = (usize::from(u), usize::from(v));
        let inside = place.0 < sample.mask.width() && place.1 < sample.mask.height();
        if [u, v] != own && inside && sample.mask[place] {
            places.push(place);
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measures::{Texture, contrast};
    use crate::sample::{Sample, SampleSet, TexelPaint, strokes};
    use crate::synthesis::SynthesisSettings;
    use graphics::field::Field;
    use paint::layer::SLOTS;

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
                if (-1..=1).all(|j| {
                    (-1..=1).all(|i| {
                        fn wrap(at: usize, by: isize, size: usize) -> isize {
                            (at as isize + by).rem_euclid(size as isize)
                        }
                        let near =
                            key.sources[(wrap(x, i, size) as usize, wrap(y, j, size) as usize)];
                        near == [u as isize + i, v as isize + j].map(|at| at as u16)
                    })
                }) {
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
                let contrasts = [lower, lower + 1]
                    .map(|at| contrast(&Texture::tiled(&map.keys[at].tile.color)));
                let mut last = tones[0];
                for share in [0.05, 0.25, 0.5, 0.75, 0.95] {
                    let tile = transition.at(share);
                    let wanted = tones[0] + f64::from(share) * (tones[1] - tones[0]);
                    assert!(
                        (tile.tone() - wanted).abs() <= 0.5,
                        "{between:?} {share} {}",
                        tile.tone()
                    );
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
        fn means(tile: &Tile) -> [f64; 3] {
            let texels = tile.paint.as_ref().unwrap().values();
            let heights = tile.height_mm.as_ref().unwrap().values();
            assert!(
                texels.iter().all(|texel| texel.pigments_mm[2] >= 0.0 && texel.vehicle_mm >= 0.0)
            );
            [
                texels
                    .iter()
                    .map(|texel: &TexelPaint| f64::from(texel.pigments_mm[2]))
                    .sum::<f64>(),
                texels.iter().map(|texel| f64::from(texel.vehicle_mm)).sum(),
                heights.iter().map(|mm| f64::from(*mm)).sum(),
            ]
        }
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
        assert_eq!(ArtMap::steps(30.0, 50.0, 5.0), 10);
        assert_eq!(ArtMap::steps(30.0, 31.0, 5.0), 0);
    }
}
