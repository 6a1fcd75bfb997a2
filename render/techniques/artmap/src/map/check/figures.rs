//! Figures of a map.

use std::cmp::Ordering;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::map::art_map::ArtMap;
use crate::map::between::Between;
use crate::measures::{Texture, coherence, contrast, stroke_length, usual_wrap_ratio, wrap_ratio};

/// Shares of the way to the lighter tile at which in-betweens are measured.
const SHARES: [f32; 3] = [0.25, 0.5, 0.75];

/// Distance in spacings above which unevenness is no stroke.
const LEVELLED: f64 = 4.0;

/// Figures of a map, as `ArtMap::figures` measures them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MapFigures {
    /// Index of the tile that the others follow.
    pub first: usize,
    /// Figures of the key tiles, in their order.
    pub keys: Vec<KeyFigures>,
    /// Figures of the tiles at 25, 50 and 75 % between each two neighbours, made by dissolving.
    pub betweens: Vec<BetweenFigures>,
}

/// Figures of a key tile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KeyFigures {
    /// Name of the sample.
    pub name: String,
    /// Mean L*, as the map has it.
    pub tone: f64,
    /// Standard deviation of L*.
    pub contrast: f64,
    /// Length of the strokes along y in texels, of the tile levelled over four spacings.
    pub stroke_length: f64,
    /// Correlation of its detail with that of the first tile, -1 to 1; 1 for the first tile.
    pub coherence: f64,
    /// Correlation of its detail with that of the neighbouring tile on the side of the first one,
    /// -1 to 1. In line art strokes are added from tone to tone, so that only neighbours agree.
    pub neighbour_coherence: f64,
    /// Steps of L* across the borders over those within the tile; 1 where no seam shows.
    pub wrap_ratio: f64,
    /// The ratio that 95 of 100 places within the tile stay below.
    pub usual_wrap_ratio: f64,
}

/// Figures of a tile between two key tiles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BetweenFigures {
    /// Index of the darker key tile.
    pub lower: usize,
    /// Share of the way to the lighter one, 0 to 1.
    pub share: f64,
    /// Contrast over that of the key tiles, weighted by the share. None where those have none.
    pub contrast: Option<f64>,
    /// Mean L*.
    pub tone: f64,
    /// Mean L* of the key tiles, weighted by the share.
    pub wanted_tone: f64,
}

impl ArtMap {
    /// Measures the map.
    ///
    /// # Panics
    /// If the tiles differ in size, or `first` is no tile.
    #[must_use]
    pub fn figures(&self) -> MapFigures {
        let textures: Vec<Texture> =
            self.keys.par_iter().map(|key| Texture::tiled(&key.tile.color)).collect();
        let agreement = |index: usize, other: usize| {
            if index == other {
                return 1.0;
            }
            coherence(&textures[other], &textures[index], self.spacing)
        };
        let key = |index: usize| KeyFigures {
            name: self.keys[index].name.clone(),
            tone: self.keys[index].tone,
            contrast: contrast(&textures[index]),
            stroke_length: stroke_length(&textures[index].levelled(LEVELLED * self.spacing)),
            coherence: agreement(index, self.first),
            neighbour_coherence: match index.cmp(&self.first) {
                Ordering::Less => agreement(index, index + 1),
                Ordering::Equal => 1.0,
                Ordering::Greater => agreement(index, index - 1),
            },
            wrap_ratio: wrap_ratio(&textures[index]),
            usual_wrap_ratio: usual_wrap_ratio(&textures[index]),
        };
        let keys: Vec<KeyFigures> = (0..self.keys.len()).into_par_iter().map(key).collect();
        let lower = 0..self.keys.len().saturating_sub(1);
        let betweens: Vec<Vec<BetweenFigures>> =
            lower.into_par_iter().map(|lower| self.between_figures(lower, &keys)).collect();
        MapFigures { first: self.first, keys, betweens: betweens.concat() }
    }

    /// Figures of the tiles above the key tile `lower`.
    fn between_figures(&self, lower: usize, keys: &[KeyFigures]) -> Vec<BetweenFigures> {
        let Some(transition) = self.transition(lower, Between::Dissolve) else {
            return Vec::new();
        };
        let darker = &keys[lower];
        let lighter = &keys[lower + 1];
        let figures = |at: f32| {
            let tile = transition.at(at);
            let share = f64::from(at);
            let mean = |dark: f64, light: f64| dark + share * (light - dark);
            let of_keys = mean(darker.contrast, lighter.contrast);
            let found = contrast(&Texture::tiled(&tile.color));
            BetweenFigures {
                lower,
                share,
                contrast: (of_keys > 0.0).then(|| found / of_keys),
                tone: tile.tone(),
                wanted_tone: mean(darker.tone, lighter.tone),
            }
        };
        SHARES.map(figures).to_vec()
    }
}
