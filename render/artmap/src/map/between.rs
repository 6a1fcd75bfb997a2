//! Tiles between two neighbouring key tiles.

use graphics::encoding::{lab_from_linear, linear_from_lab};
use graphics::field::Field;
use paint::layer::SLOTS;
use serde::{Deserialize, Serialize};

use super::art_map::ArtMap;
use super::tile::Tile;
use crate::sample::TexelPaint;
use crate::tiling::blurred_tile;

/// Share of the strokes that dissolve at a time.
const BAND: f64 = 0.15;
/// Deviation of the smoothing of the difference of two tiles, in spacings of strokes.
const SMOOTH: f64 = 0.25;

/// How a tile between two key tiles is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Between {
    /// Strokes of the lighter tile replace those of the darker one, first where they differ most.
    /// Keeps the contrast of the strokes.
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
    /// When each texel changes, 0 first to 1 last; NaN for texels that change all the way.
    ranks: Option<Vec<f32>>,
}

impl ArtMap {
    /// The transition from key tile `lower` to the next lighter one; `None` for the last one.
    #[must_use]
    pub fn transition(&self, lower: usize, between: Between) -> Option<Transition<'_>> {
        let darker = &self.keys.get(lower)?.tile;
        let lighter = &self.keys.get(lower + 1)?.tile;
        let labs = [lab_from_linear(&darker.color), lab_from_linear(&lighter.color)];
        let ranks = match between {
            Between::Blend => None,
            Between::Dissolve => Some(ranks(&labs, SMOOTH * self.spacing)),
        };
        Some(Transition { darker, lighter, labs, ranks })
    }
}

impl Transition<'_> {
    /// The tile at `share` of the way: at 0 or less the darker, at 1 or more the lighter key tile.
    /// In between the mean L* changes in proportion. Amounts of paint and heights are means of
    /// amounts and heights with the weights of the colours.
    #[must_use]
    pub fn at(&self, share: f64) -> Tile {
        if share >= 1.0 {
            return self.lighter.clone();
        }
        if share.is_nan() || share <= 0.0 {
            return self.darker.clone();
        }
        let even = vec![share as f32; self.labs[0].values().len()];
        let weights = match &self.ranks {
            None => even,
            Some(ranks) => {
                let threshold = threshold_of(share) as f32;
                let weight = |rank: &f32| match rank {
                    rank if rank.is_nan() => share as f32,
                    rank => ((threshold - rank) / BAND as f32).clamp(0.0, 1.0),
                };
                ranks.iter().map(weight).collect()
            }
        };
        mixed(self.darker, self.lighter, &self.labs, &weights)
    }
}

/// When each texel changes to the lighter tile: texels in the order of the smoothed difference of
/// L*, largest first. The place in that order is measured in difference, not in texels, so that
/// the mean L* follows the share. Where the lighter tile is not lighter, nothing tells which
/// stroke comes first: NaN.
fn ranks([darker, lighter]: &[Field<[f32; 3]>; 2], sigma: f64) -> Vec<f32> {
    let (width, height) = (darker.width(), darker.height());
    let pairs = darker.values().iter().zip(lighter.values());
    let difference = Field::from_values(width, height, pairs.map(|(a, b)| b[0] - a[0]).collect());
    let smooth = blurred_tile(&difference, sigma);
    let mut order: Vec<usize> = (0..width * height).collect();
    order.sort_by(|&a, &b| smooth.values()[b].total_cmp(&smooth.values()[a]).then(a.cmp(&b)));
    let total: f64 = smooth.values().iter().map(|value| f64::from(value.max(0.0))).sum();
    let mut ranks = vec![f32::NAN; width * height];
    let mut before = 0.0;
    for index in order {
        let value = f64::from(smooth.values()[index]);
        if value <= 0.0 {
            break;
        }
        ranks[index] = ((before + 0.5 * value) / total) as f32;
        before += value;
    }
    ranks
}

/// The threshold at which the mean over ranks 0..1 of `clamp((threshold - rank) / BAND, 0, 1)` is
/// `share`.
fn threshold_of(share: f64) -> f64 {
    if share < 0.5 * BAND {
        (2.0 * BAND * share).sqrt()
    } else if share <= 1.0 - 0.5 * BAND {
        share + 0.5 * BAND
    } else {
        1.0 + BAND - (2.0 * BAND * (1.0 - share)).sqrt()
    }
}

/// The mean of two tiles with a weight of the lighter one for each texel.
fn mixed(darker: &Tile, lighter: &Tile, labs: &[Field<[f32; 3]>; 2], weights: &[f32]) -> Tile {
    let size = darker.size();
    let mean = |a: f32, b: f32, weight: f32| a + weight * (b - a);
    let pairs = labs[0].values().iter().zip(labs[1].values()).zip(weights);
    let lab: Vec<[f32; 3]> =
        pairs.map(|((a, b), &w)| std::array::from_fn(|i| mean(a[i], b[i], w))).collect();
    let mut color = linear_from_lab(&Field::from_values(size, size, lab));
    // A key tile's own texels keep their bits.
    for (index, weight) in weights.iter().enumerate() {
        if *weight == 0.0 {
            color.values_mut()[index] = darker.color.values()[index];
        } else if *weight == 1.0 {
            color.values_mut()[index] = lighter.color.values()[index];
        }
    }
    let paint = darker.paint.as_ref().zip(lighter.paint.as_ref()).map(|(a, b)| {
        let texel = |((a, b), &w): ((&TexelPaint, &TexelPaint), &f32)| {
            let amount = |slot: usize| mean(a.pigments_mm[slot], b.pigments_mm[slot], w);
            let pigments_mm: [f32; SLOTS] = std::array::from_fn(amount);
            TexelPaint { pigments_mm, vehicle_mm: mean(a.vehicle_mm, b.vehicle_mm, w) }
        };
        Field::from_values(
            size,
            size,
            a.values().iter().zip(b.values()).zip(weights).map(texel).collect(),
        )
    });
    let height_mm = darker.height_mm.as_ref().zip(lighter.height_mm.as_ref()).map(|(a, b)| {
        let pairs = a.values().iter().zip(b.values()).zip(weights);
        Field::from_values(size, size, pairs.map(|((a, b), &w)| mean(*a, *b, w)).collect())
    });
    Tile { color, paint, height_mm }
}
