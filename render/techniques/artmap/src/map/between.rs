//! Tiles between two neighbouring key tiles.

use graphics::encoding::{lab_from_linear, linear_from_lab};
use graphics::field::Field;
use paint::layer::SLOTS;
use serde::{Deserialize, Serialize};

use super::art_map::ArtMap;
use super::tile::Tile;
use crate::sample::TexelPaint;
use crate::tiling::blurred_tile;

/// Share of the change that goes on at a time where strokes dissolve.
const BAND: f32 = 0.15;
/// Deviation of the smoothing of two tiles, in spacings of strokes.
const SMOOTH: f64 = 0.25;

/// Deviation over mean of the difference of L* of two tiles up to which the tone changes evenly,
/// and from which on strokes alone change it, as where lines are added to lines.
const IN_STROKES: [f32; 2] = [1.0, 2.0];

/// How a tile between two key tiles is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Between {
    /// Each place shows the strokes of either tile and changes once, light strokes first. Keeps
    /// the contrast of the strokes. Where both tiles differ by much the same everywhere, the tone
    /// changes evenly besides.
    #[default]
    Dissolve,
    /// The weighted mean of both tiles (equation 8 of Yan and others 2008), in CIELAB.
    Blend,
}

/// The way from a key tile to the next lighter one.
#[derive(Debug, Clone)]
pub struct Transition<'a> {
    darker: &'a Tile,
    lighter: &'a Tile,
    labs: [Field<[f32; 3]>; 2],
    /// When each texel changes, 0 first to 1 last; `None` where all change all the way.
    ranks: Option<Vec<f32>>,
    /// Share of the difference of tone that changes with the strokes; the rest changes evenly.
    in_strokes: f32,
}

impl ArtMap {
    /// The transition from key tile `lower` to the next lighter one; `None` for the last one.
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
    /// The tile at `share` of the way: at 0 or less the darker, at 1 or more the lighter key tile.
    /// In between the means of L*, a*, b*, of each pigment and of the height change in proportion.
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

/// How the channels of two tiles are mixed.
struct Mixing {
    /// Share of the lighter tile in the mean.
    share: f32,
    /// Weight of the lighter tile at each texel.
    weights: Vec<f32>,
    /// Share of the difference of the means that changes with the weights.
    in_strokes: f32,
}

impl Mixing {
    /// Mixes a channel of any sign. The mean is that of both tiles by share.
    fn level<T>(&self, dark: &[T], light: &[T], of: impl Fn(&T) -> f32) -> Vec<f32> {
        let means = [dark, light].map(|texels| mean(texels.iter().map(&of)));
        let step = means[1] - means[0];
        let wanted = means[0] + self.share * step;
        let evenly = (1.0 - self.in_strokes) * step;
        let texel = |((dark, light), weight): ((&T, &T), &f32)| {
            let dark = of(dark);
            let light = of(light);
            dark + self.share * evenly + weight * (light - dark - evenly)
        };
        let mut mixed: Vec<f32> = dark.iter().zip(light).zip(&self.weights).map(texel).collect();
        let shift = wanted - mean(mixed.iter().copied());
        mixed.iter_mut().for_each(|value| *value += shift);
        mixed
    }

    /// Mixes a channel of amounts, which are not negative. The mean is that of both tiles by share.
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

/// Share of the difference of tone that changes with the strokes.
fn in_strokes([darker, lighter]: &[Field<[f32; 3]>; 2]) -> f32 {
    let pairs = || darker.values().iter().zip(lighter.values()).map(|(a, b)| b[0] - a[0]);
    let step = mean(pairs());
    let deviation = mean(pairs().map(|difference| (difference - step).powi(2))).sqrt();
    let [evenly, all] = IN_STROKES;
    let ratio = deviation / step.abs().max(f32::MIN_POSITIVE);
    ((ratio - evenly) / (all - evenly)).clamp(0.0, 1.0)
}

/// When each texel changes: texels in the order of the smoothed mean of both tiles, lightest first.
/// The place in that order is measured in the difference that changes with the strokes, so that the
/// tile changes evenly. An order by the difference itself would keep the strongest strokes of one
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
    let size = |index: usize| f64::from(change.values()[index].abs());
    let total: f64 = order.iter().map(|&index| size(index)).sum();
    let mut ranks = vec![0.5; width * height];
    let mut before = 0.0;
    for index in order {
        if total > 0.0 {
            ranks[index] = ((before + 0.5 * size(index)) / total) as f32;
        }
        before += size(index);
    }
    ranks
}
