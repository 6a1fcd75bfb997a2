//! The description of a set in its file: JSON in attribute `impasto`.

use std::sync::Arc;

use paint::layer::Slots;
use pigment::{PigmentId, PigmentLibrary};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::error::SampleFileError;
use crate::sample::passage::{PaintOfSamples, Sample, SampleSet};

/// Name of the attribute.
pub(super) const ATTRIBUTE: &str = "impasto";

const FORMAT: &str = "impasto-samples";
const VERSION: u64 = 1;

/// Channels that pigments cannot be called.
pub(super) const COLOR: [&str; 3] = ["R", "G", "B"];
pub(super) const MASK: &str = "mask";
pub(super) const HEIGHT: &str = "height";
pub(super) const VEHICLE: &str = "vehicle";

/// Longest name of a pigment's channel in bytes; OpenEXR allows 255.
const LONGEST: usize = 200;

/// Content of the attribute.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileHeader {
    format: String,
    version: u64,
    pub(super) provenance: String,
    pub(super) samples: Vec<SampleHeader>,
    /// Pigments in use, with their channels; `None` for samples without paint.
    pub(super) pigments: Option<Vec<PigmentHeader>>,
    library: Option<Value>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SampleHeader {
    pub(super) part: String,
    pub(super) name: String,
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) spacing: f64,
    pub(super) mm_per_texel: Option<f64>,
    /// Whether the part has a channel of heights.
    pub(super) relief: bool,
    pub(super) guessed_relief: bool,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PigmentHeader {
    pub(super) slot: usize,
    pub(super) name: String,
    pub(super) channel: String,
}

/// Name of the part of the sample number `index`.
fn part(index: usize) -> String {
    format!("sample.{index:03}")
}

impl FileHeader {
    /// Description of `set`.
    pub(super) fn of(set: &SampleSet) -> Result<Self, SampleFileError> {
        let unwritable = |reason: String| SampleFileError::Unwritable { reason };
        let samples = set.samples.iter().enumerate().map(|(index, sample)| SampleHeader {
            part: part(index),
            name: sample.name.clone(),
            width: sample.size().0,
            height: sample.size().1,
            spacing: sample.spacing,
            mm_per_texel: sample.mm_per_texel,
            relief: sample.height_mm.is_some(),
            guessed_relief: sample.guessed_relief,
        });
        let (mut pigments, mut library) = (None, None);
        if let Some(paint) = &set.paint {
            let used = channels(paint)
                .ok_or_else(|| unwritable("a pigment lies beyond the library".to_owned()))?;
            pigments = Some(used);
            let json = serde_json::from_str(&paint.library.to_json());
            library = Some(json.map_err(|error| unwritable(error.to_string()))?);
        }
        let header = Self {
            format: FORMAT.to_owned(),
            version: VERSION,
            provenance: set.provenance.clone(),
            samples: samples.collect(),
            pigments,
            library,
        };
        // JSON has no notation for NaN and infinity, and libraries are written in six digits.
        match Self::from_json("", &header.to_json()?) {
            Ok((back, paint)) if back == header && paint == set.paint => Ok(header),
            Ok(_) => Err(unwritable("their header does not come back as it was".to_owned())),
            Err(SampleFileError::Header { reason, .. }) => Err(unwritable(reason)),
            Err(error) => Err(unwritable(error.to_string())),
        }
    }

    /// Encodes the description as JSON in ASCII.
    pub(super) fn to_json(&self) -> Result<String, SampleFileError> {
        let text = serde_json::to_string(self)
            .map_err(|error| SampleFileError::Unwritable { reason: error.to_string() })?;
        let mut ascii = String::with_capacity(text.len());
        for letter in text.chars() {
            if letter.is_ascii() {
                ascii.push(letter);
            } else {
                for unit in letter.encode_utf16(&mut [0; 2]) {
                    ascii.push_str(&format!("\\u{unit:04x}"));
                }
            }
        }
        Ok(ascii)
    }

    /// Parses and checks a description; returns it with the library and slots that it holds.
    pub(super) fn from_json(
        file: &str,
        json: &str,
    ) -> Result<(Self, Option<PaintOfSamples>), SampleFileError> {
        let fault = |reason: String| SampleFileError::Header { file: file.to_owned(), reason };
        let value: Value = serde_json::from_str(json).map_err(|error| fault(error.to_string()))?;
        if value["format"] != FORMAT {
            let reason = format!("`format` must be \"{FORMAT}\", found `{}`", value["format"]);
            return Err(SampleFileError::Format { file: file.to_owned(), reason });
        }
        if value["version"] != VERSION {
            let (file, found) = (file.to_owned(), value["version"].to_string());
            return Err(SampleFileError::Version { file, found, newest: VERSION });
        }
        let header: Self =
            serde_json::from_value(value).map_err(|error| fault(error.to_string()))?;
        for (index, sample) in header.samples.iter().enumerate() {
            sample.check(index).map_err(fault)?;
        }
        let paint = match (&header.pigments, &header.library) {
            (None, None) => None,
            (Some(pigments), Some(library)) => {
                let name = format!("{file}: library");
                let library = PigmentLibrary::from_json(&name, &library.to_string())?;
                let slots = slots(pigments, &library).map_err(fault)?;
                Some(PaintOfSamples { library: Arc::new(library), slots })
            }
            _ => return Err(fault("`pigments` and `library` go together".to_owned())),
        };
        Ok((header, paint))
    }
}

impl SampleHeader {
    fn check(&self, index: usize) -> Result<(), String> {
        let Self { part: found, name, width, height, spacing, mm_per_texel, .. } = self;
        if *found != part(index) {
            return Err(format!("sample {index} is part `{}`, found `{found}`", part(index)));
        }
        if *width == 0 || *height == 0 {
            return Err(format!("sample `{name}` has texels, found `{width} x {height}`"));
        }
        let positive = |number: f64| number.is_finite() && number > 0.0;
        if !positive(*spacing) {
            return Err(format!("spacing of sample `{name}` is above 0, found `{spacing}`"));
        }
        match mm_per_texel {
            Some(mm) if !positive(*mm) => {
                Err(format!("mm_per_texel of sample `{name}` is above 0, found `{mm}`"))
            }
            _ => Ok(()),
        }
    }

    /// Names of the channels of the part, sorted as OpenEXR requires.
    pub(super) fn channels(&self, pigments: Option<&[PigmentHeader]>) -> Vec<String> {
        let mut names: Vec<&str> = COLOR.into_iter().chain([MASK]).collect();
        names.extend(self.relief.then_some(HEIGHT));
        if let Some(pigments) = pigments {
            names.push(VEHICLE);
            names.extend(pigments.iter().map(|pigment| pigment.channel.as_str()));
        }
        names.sort_unstable();
        names.into_iter().map(str::to_owned).collect()
    }
}

/// Slots in use with a channel for each; `None` if the library lacks a pigment.
fn channels(paint: &PaintOfSamples) -> Option<Vec<PigmentHeader>> {
    let mut taken: Vec<String> = COLOR.map(str::to_owned).to_vec();
    taken.extend([MASK, HEIGHT, VEHICLE].map(str::to_owned));
    let used = paint.slots.iter().enumerate().filter_map(|(slot, id)| Some((slot, (*id)?)));
    used.map(|(slot, id)| {
        let name = &paint.library.pigments.get(id.index())?.name;
        let channel = channel(name, &taken);
        taken.push(channel.clone());
        Some(PigmentHeader { slot, name: name.clone(), channel })
    })
    .collect()
}

/// Name for the channel of a pigment: characters that OpenEXR does not allow are replaced, and a
/// name that is taken gets a number.
fn channel(pigment: &str, taken: &[String]) -> String {
    let legal = |letter: char| letter == ' ' || (letter.is_ascii_graphic() && letter != '.');
    let plain: String =
        pigment.chars().map(|l| if legal(l) { l } else { '_' }).take(LONGEST).collect();
    let plain = if plain.trim().is_empty() { "pigment".to_owned() } else { plain };
    let numbered = (2..=taken.len() + 2).map(|number| format!("{plain} {number}"));
    let mut names = std::iter::once(plain.clone()).chain(numbered);
    names.find(|name| !taken.contains(name)).unwrap_or(plain)
}

/// Pigments of a header by slot.
fn slots(pigments: &[PigmentHeader], library: &PigmentLibrary) -> Result<Slots, String> {
    let mut slots = Slots::default();
    for (at, PigmentHeader { slot, name, channel }) in pigments.iter().enumerate() {
        let index = library.pigments.iter().position(|pigment| pigment.name == *name);
        let index = index.ok_or_else(|| {
            format!("channel `{channel}` names no pigment of the library: `{name}`")
        })?;
        match slots.get_mut(*slot) {
            Some(place @ None) => *place = Some(PigmentId(index)),
            Some(_) => return Err(format!("slot named twice: `{slot}`")),
            None => return Err(format!("slots are 0 to 7, found `{slot}`")),
        }
        let reserved = COLOR.contains(&channel.as_str())
            || [MASK, HEIGHT, VEHICLE].contains(&channel.as_str());
        if reserved || pigments[..at].iter().any(|other| other.channel == *channel) {
            return Err(format!("channel named twice: `{channel}`"));
        }
    }
    Ok(slots)
}

/// Whether all fields of a sample have its size.
pub(super) fn sizes_agree(sample: &Sample) -> bool {
    let bounds = sample.color.bounds();
    let paint = sample.paint.as_ref().is_none_or(|paint| paint.bounds() == bounds);
    let height = sample.height_mm.as_ref().is_none_or(|height| height.bounds() == bounds);
    sample.mask.bounds() == bounds && paint && height
}
