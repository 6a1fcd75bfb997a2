//! The description of a set in its file.

use paint::file::{PigmentChannel, channels_of_slots};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::sample::passage::SampleSet;
use crate::texel::PaintOfSamples;
use crate::texel_file::{
    COLOR, HEIGHT, Origin, PartPlan, TexelFileError, TexelFileKind, Texels, VEHICLE, decoded,
    encoded, encoded_library, paint_of, proven,
};

/// Channel that tells which texels belong to the sample.
pub(super) const MASK: &str = "mask";

/// Files of samples.
pub(super) const KIND: TexelFileKind = TexelFileKind {
    format: "impasto-samples",
    version: 1,
    content: "samples",
    reserved: &[COLOR[0], COLOR[1], COLOR[2], MASK, HEIGHT, VEHICLE],
};

/// Content of the attribute.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileHeader {
    format: String,
    version: u64,
    pub(super) provenance: String,
    pub(super) samples: Vec<SampleHeader>,
    /// Pigments in use, with their channels; `None` for samples without paint.
    pub(super) pigments: Option<Vec<PigmentChannel>>,
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

/// Name of the part of the sample number `index`.
fn part(index: usize) -> String {
    format!("sample.{index:03}")
}

impl FileHeader {
    /// Description of `set`.
    pub(super) fn of(set: &SampleSet) -> Result<Self, TexelFileError> {
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
        let mut pigments = None;
        let mut library = None;
        if let Some(paint) = &set.paint {
            let used = channels_of_slots(&paint.library, &paint.slots, KIND.reserved);
            pigments =
                Some(used.ok_or_else(|| KIND.unwritable("a pigment lies beyond the library"))?);
            library = Some(encoded_library(&KIND, paint)?);
        }
        let header = Self {
            format: KIND.format.to_owned(),
            version: KIND.version,
            provenance: set.provenance.clone(),
            samples: samples.collect(),
            pigments,
            library,
        };
        let back = Self::from_json(Origin { kind: &KIND, file: "" }, &header.to_json()?);
        proven(&KIND, header, set.paint.as_ref(), back)
    }

    /// Encodes the description as JSON in ASCII.
    pub(super) fn to_json(&self) -> Result<String, TexelFileError> {
        encoded(&KIND, self)
    }

    /// Parses and checks a description; returns it with the library and slots that it holds.
    pub(super) fn from_json(
        origin: Origin<'_>,
        json: &str,
    ) -> Result<(Self, Option<PaintOfSamples>), TexelFileError> {
        let header: Self = decoded(origin, json)?;
        for (index, sample) in header.samples.iter().enumerate() {
            sample.check(index).map_err(|reason| origin.header(reason))?;
        }
        let paint = paint_of(origin, header.pigments.as_deref(), header.library.as_ref())?;
        Ok((header, paint))
    }

    /// The parts of the samples.
    pub(super) fn plans(&self) -> Vec<PartPlan> {
        self.samples
            .iter()
            .map(|sample: &SampleHeader| {
                let mut channels = Texels::channels(sample.relief, self.pigments.as_deref());
                channels.push(MASK);
                PartPlan::new(&sample.part, (sample.width, sample.height), &channels)
            })
            .collect()
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
}
