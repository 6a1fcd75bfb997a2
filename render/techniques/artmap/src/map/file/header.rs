//! The description of a map in its file.

use paint::file::{PigmentChannel, channels_of_slots};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::map::art_map::ArtMap;
use crate::synthesis::SynthesisSettings;
use crate::texel::PaintOfSamples;
use crate::texel_file::{
    COLOR, HEIGHT, Origin, PartPlan, TexelFileError, TexelFileKind, Texels, VEHICLE, decoded,
    encoded, encoded_library, of_text, paint_of, proven,
};

/// Channels of the column and the row of the sample that a texel shows.
pub(super) const SOURCE: [&str; 2] = ["source.x", "source.y"];

/// Files of art maps.
pub(super) const KIND: TexelFileKind = TexelFileKind {
    format: "impasto-artmap",
    version: 1,
    content: "art map",
    reserved: &[COLOR[0], COLOR[1], COLOR[2], HEIGHT, VEHICLE, SOURCE[0], SOURCE[1]],
};

/// Content of the attribute.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileHeader {
    format: String,
    version: u64,
    /// SHA-256 of the description with an empty text in this place.
    pub(super) digest: String,
    pub(super) provenance: String,
    /// Width and height of the tiles.
    pub(super) size: usize,
    pub(super) spacing: f64,
    pub(super) mm_per_texel: Option<f64>,
    pub(super) guessed_relief: bool,
    pub(super) patch: usize,
    pub(super) levels: usize,
    pub(super) first: usize,
    pub(super) settings: SynthesisSettings,
    pub(super) keys: Vec<KeyHeader>,
    /// Pigments in use, with their channels; `None` for maps without paint.
    pub(super) pigments: Option<Vec<PigmentChannel>>,
    library: Option<Value>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct KeyHeader {
    pub(super) part: String,
    pub(super) name: String,
    pub(super) tone: f64,
    /// Whether the part has a channel of heights.
    pub(super) relief: bool,
    /// SHA-256 of the numbers of the part.
    pub(super) digest: String,
}

/// Name of the part of the tile number `index`.
fn part(index: usize) -> String {
    format!("key.{index:03}")
}

impl FileHeader {
    /// Description of `map`, without digests.
    pub(super) fn of(map: &ArtMap) -> Result<Self, TexelFileError> {
        let keys = map.keys.iter().enumerate().map(|(index, key)| KeyHeader {
            part: part(index),
            name: key.name.clone(),
            tone: key.tone,
            relief: key.tile.height_mm.is_some(),
            digest: String::new(),
        });
        let mut pigments = None;
        let mut library = None;
        if let Some(paint) = &map.paint {
            let used = channels_of_slots(&paint.library, &paint.slots, KIND.reserved);
            pigments =
                Some(used.ok_or_else(|| KIND.unwritable("a pigment lies beyond the library"))?);
            library = Some(encoded_library(&KIND, paint)?);
        }
        Ok(Self {
            format: KIND.format.to_owned(),
            version: KIND.version,
            digest: String::new(),
            provenance: map.provenance.clone(),
            size: map.size(),
            spacing: map.spacing,
            mm_per_texel: map.mm_per_texel,
            guessed_relief: map.guessed_relief,
            patch: map.patch,
            levels: map.levels,
            first: map.first,
            settings: map.settings.clone(),
            keys: keys.collect(),
            pigments,
            library,
        })
    }

    /// The description with its own digest, as JSON in ASCII.
    ///
    /// # Errors
    /// [`TexelFileError::Unwritable`] if it could not be read again as it is, with `paint`.
    pub(super) fn sealed(
        mut self,
        paint: Option<&PaintOfSamples>,
    ) -> Result<String, TexelFileError> {
        self.digest = self.own_digest()?;
        let json = encoded(&KIND, &self)?;
        let back = Self::from_json(Origin { kind: &KIND, file: "" }, &json);
        proven(&KIND, self, paint, back)?;
        Ok(json)
    }

    /// Parses and checks a description; returns it with the library and slots that it holds.
    pub(super) fn from_json(
        origin: Origin<'_>,
        json: &str,
    ) -> Result<(Self, Option<PaintOfSamples>), TexelFileError> {
        let header: Self = decoded(origin, json)?;
        header.check().map_err(|reason| origin.header(reason))?;
        if header.own_digest()? != header.digest {
            return Err(origin.header("`digest` is that of another description"));
        }
        let paint = paint_of(origin, header.pigments.as_deref(), header.library.as_ref())?;
        Ok((header, paint))
    }

    /// The parts of the tiles.
    pub(super) fn plans(&self) -> Vec<PartPlan> {
        self.keys
            .iter()
            .map(|key: &KeyHeader| {
                let mut channels = Texels::channels(key.relief, self.pigments.as_deref());
                channels.extend(SOURCE);
                PartPlan::new(&key.part, (self.size, self.size), &channels)
            })
            .collect()
    }

    /// The description's own digest.
    pub(super) fn own_digest(&self) -> Result<String, TexelFileError> {
        let bare = Self { digest: String::new(), ..self.clone() };
        Ok(of_text(&encoded(&KIND, &bare)?))
    }

    fn check(&self) -> Result<(), String> {
        let Self { size, spacing, mm_per_texel, patch, levels, first, keys, .. } = self;
        if keys.is_empty() {
            return Err("there is no tile".to_owned());
        }
        for (name, found) in [("size", size), ("patch", patch), ("levels", levels)] {
            if *found == 0 {
                return Err(format!("{name} is at least 1, found `{found}`"));
            }
        }
        if *first >= keys.len() {
            return Err(format!("first is one of {} tiles, found `{first}`", keys.len()));
        }
        for (name, found) in [("spacing", Some(spacing)), ("mm_per_texel", mm_per_texel.as_ref())] {
            if let Some(found) = found.filter(|found| !(found.is_finite() && **found > 0.0)) {
                return Err(format!("{name} is above 0, found `{found}`"));
            }
        }
        for (index, key) in keys.iter().enumerate() {
            if key.part != part(index) {
                let wanted = part(index);
                let found = &key.part;
                return Err(format!("tile {index} is part `{wanted}`, found `{found}`"));
            }
        }
        for pair in keys.windows(2) {
            // Also if one of them is no number.
            if !matches!(pair[0].tone.partial_cmp(&pair[1].tone), Some(order) if order.is_le()) {
                let darker = pair[0].tone;
                let lighter = pair[1].tone;
                let name = &pair[1].name;
                return Err(format!(
                    "tiles are in order of tone, found `{lighter}` of `{name}` after `{darker}`"
                ));
            }
        }
        Ok(())
    }
}
