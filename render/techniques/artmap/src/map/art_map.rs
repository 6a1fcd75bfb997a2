//! A map with its key tiles, from dark to light.

use rayon::prelude::*;

use super::gathered;
use super::tile::Tile;
use crate::sample::{PaintOfSamples, SampleSet};
use crate::synthesis::{
    KeyMaps, Stage, SynthesisError, SynthesisSettings, key_maps, key_maps_with_stages,
};
use graphics::field::Field;

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

/// A painterly art map (Yan and others 2008): tiles of one size with the brushwork of a painting,
/// from dark to light, whose strokes stand at the same places.
#[derive(Debug, Clone, PartialEq)]
pub struct ArtMap {
    /// Tiles from dark to light, at least one.
    pub keys: Vec<KeyMap>,
    /// Index of the tile that was made first and that the others follow.
    pub first: usize,
    /// Pigments of the paint of the tiles; `None` for maps without pigments.
    pub paint: Option<PaintOfSamples>,
    /// Distance of neighbouring strokes in texels.
    pub spacing: f64,
    /// Side of a texel in mm, where it is known.
    pub mm_per_texel: Option<f64>,
    /// Whether heights were guessed from a photograph.
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
    /// Synthesises a map of the samples. Tiles are in the order of their mean lightness; tiles of
    /// equal lightness keep the order of the samples.
    ///
    /// # Errors
    /// [`SynthesisError`], as of [`key_maps`].
    pub fn of(set: &SampleSet, settings: &SynthesisSettings) -> Result<Self, SynthesisError> {
        Ok(Self::gathered(set, settings, key_maps(set, settings)?))
    }

    /// Synthesises a map as [`Self::of`] does, with pictures of the steps
    /// ([`key_maps_with_stages`]).
    ///
    /// # Errors
    /// Those of [`Self::of`].
    pub fn with_stages(
        set: &SampleSet,
        settings: &SynthesisSettings,
    ) -> Result<(Self, Vec<Stage>), SynthesisError> {
        let (maps, stages) = key_maps_with_stages(set, settings)?;
        Ok((Self::gathered(set, settings, maps), stages))
    }

    /// The map of synthesised places.
    fn gathered(set: &SampleSet, settings: &SynthesisSettings, maps: KeyMaps) -> Self {
        let key = |(sample, sources): (&crate::sample::Sample, Field<[u16; 2]>)| {
            let tile = gathered::tile(sample, &sources);
            KeyMap { name: sample.name.clone(), tone: tile.tone(), tile, sources }
        };
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

    /// Number of tiles between those of tones `lower` and `upper` that make steps of at most `step`
    /// of 255 levels of intensity (equation 7 of Yan and others 2008, with L* as intensity).
    #[must_use]
    pub fn steps(lower: f64, upper: f64, step: f64) -> usize {
        ((upper - lower).abs() * 2.55 / step).floor() as usize
    }
}
