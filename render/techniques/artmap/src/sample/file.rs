//! Files of samples: OpenEXR, format `impasto-samples`, version 1.
//!
//! One file has a part per sample: `sample.000`, `sample.001` .. in the order of the set. It has
//! scan lines of 32-bit float channels, so you can look at it with any program that reads OpenEXR.
//!
//! | channels | content |
//! | --- | --- |
//! | `R`, `G`, `B` | colour of a level surface, linear sRGB |
//! | `mask` | 1 where a texel belongs to the sample, else 0 |
//! | `height` | height over the ground in mm, left out without relief |
//! | one per pigment, `vehicle` | paint in mm, left out without pigments |
//!
//! Attribute `impasto` of the first part is JSON in ASCII. It holds format and version,
//! provenance, names, sizes and spacing of the samples, the channel of each pigment, and the
//! pigment library. You get everything back bit for bit.

use std::path::Path;

use paint::file::{PigmentChannel, channels_of_slots};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::SampleSet;
use crate::sample::Sample;
use crate::texel_file::PaintOfSamples;
use crate::texel_file::{
    COLOR, HEIGHT, Opened, Origin, PartPlan, PartPlanes, TexelFileError, TexelFileKind, Texels,
    VEHICLE, decoded, encoded, encoded_library, paint_of, proven, write as write_parts,
};

impl SampleSet {
    /// Reads samples from their file (OpenEXR, see [`crate::sample::file`]).
    ///
    /// # Errors
    /// [`TexelFileError`] if the file cannot be read or holds no valid samples.
    pub fn open(path: &Path) -> Result<Self, TexelFileError> {
        read(&path.display().to_string(), &documents::file::read(path)?)
    }

    /// Writes samples to a file (OpenEXR, see [`crate::sample::file`]). This replaces the file as
    /// a whole or not at all.
    ///
    /// # Errors
    /// [`TexelFileError`] if the set is inconsistent or the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), TexelFileError> {
        Ok(documents::file::write_whole(path, &write(self)?)?)
    }
}

const MASK: &str = "mask";

const KIND: TexelFileKind = TexelFileKind {
    format: "impasto-samples",
    version: 1,
    content: "samples",
    reserved: &[COLOR[0], COLOR[1], COLOR[2], MASK, HEIGHT, VEHICLE],
};

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct FileHeader {
    format: String,
    version: u64,
    provenance: String,
    samples: Vec<SampleHeader>,
    pigments: Option<Vec<PigmentChannel>>,
    library: Option<Value>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SampleHeader {
    part: String,
    name: String,
    width: usize,
    height: usize,
    spacing: f64,
    mm_per_texel: Option<f64>,
    relief: bool,
    guessed_relief: bool,
}

fn header_part(index: usize) -> String {
    format!("sample.{index:03}")
}

impl FileHeader {
    fn of(set: &SampleSet) -> Result<Self, TexelFileError> {
        let samples = set.samples.iter().enumerate().map(|(index, sample)| SampleHeader {
            part: header_part(index),
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

    fn to_json(&self) -> Result<String, TexelFileError> {
        encoded(&KIND, self)
    }

    /// Parses and checks a description. Returns it with the library and slots in it.
    fn from_json(
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

    fn plans(&self) -> Vec<PartPlan> {
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
        if *found != header_part(index) {
            return Err(format!(
                "sample {index} is part `{}`, found `{found}`",
                header_part(index)
            ));
        }
        if let Some(wanted) = documents::name_violation(name) {
            return Err(format!(
                "sample {index} has {wanted}, found `{}`",
                documents::excerpt(name)
            ));
        }
        if *width == 0 || *height == 0 {
            return Err(format!("sample `{name}` has texels, found `{width} x {height}`"));
        }
        fn positive(number: f64) -> bool {
            number.is_finite() && number > 0.0
        }
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

fn texels(sample: &Sample) -> Texels<'_> {
    Texels {
        color: &sample.color,
        paint: sample.paint.as_ref(),
        height_mm: sample.height_mm.as_ref(),
    }
}

fn part(sample: &Sample, plan: PartPlan, pigments: Option<&[PigmentChannel]>) -> PartPlanes {
    plan.with(|channel| match channel {
        MASK => sample.mask.values().iter().map(|inside| f32::from(u8::from(*inside))).collect(),
        _ => texels(sample).plane(channel, pigments),
    })
}

/// Checks the numbers of a part. Texels outside the mask may hold anything.
///
/// # Errors
/// The channel with impossible numbers, and the reason.
fn check(part: &PartPlanes, pigments: Option<&[PigmentChannel]>) -> Result<(), (String, String)> {
    part.check(MASK, "is 0 or 1, found another number", |_, number| [0.0, 1.0].contains(&number))?;
    let mask = part.of(MASK);
    part.check_texels(pigments, |index| mask[index] == 1.0)
}

fn sample(header: &SampleHeader, part: &PartPlanes, pigments: Option<&[PigmentChannel]>) -> Sample {
    Sample {
        name: header.name.clone(),
        color: part.color(),
        paint: pigments.map(|pigments| part.paint(pigments)),
        height_mm: part.height_mm(),
        mask: part.field(part.of(MASK).iter().map(|value| *value == 1.0).collect()),
        spacing: header.spacing,
        mm_per_texel: header.mm_per_texel,
        guessed_relief: header.guessed_relief,
    }
}

/// Decodes samples from `bytes`, the content of `file`. Only errors use this name.
///
/// # Errors
/// [`TexelFileError`] if the content is not OpenEXR, holds no samples, is of a newer version,
/// truncated or inconsistent.
pub fn read(file: &str, bytes: &[u8]) -> Result<SampleSet, TexelFileError> {
    let origin = Origin { kind: &KIND, file };
    let opened = Opened::new(origin, bytes)?;
    let (header, paint) = FileHeader::from_json(origin, &opened.description()?)?;
    let pigments = header.pigments.as_deref();
    let parts = opened.planes(header.plans())?.into_par_iter().zip(&header.samples);
    let samples: Vec<_> = parts
        .map(|(part, header)| {
            check(&part, pigments).map_err(|fault| origin.channel(&header.part, fault))?;
            Ok(sample(header, &part, pigments))
        })
        .collect();
    let samples = samples.into_iter().collect::<Result<_, TexelFileError>>()?;
    Ok(SampleSet { samples, paint, provenance: header.provenance })
}

/// Encodes samples as a file. If you pass equal samples, you get equal bytes.
///
/// # Errors
/// [`TexelFileError::Unwritable`] for a set without samples or with fields of different sizes,
/// samples with paint in a set without pigments or the other way round, paint in slots without
/// pigment, and numbers that are not finite.
pub fn write(set: &SampleSet) -> Result<Vec<u8>, TexelFileError> {
    if set.samples.is_empty() {
        return Err(KIND.unwritable("there are none"));
    }
    for sample in &set.samples {
        let whose = format!("sample `{}`", sample.name);
        if sample.mask.bounds() != sample.color.bounds() {
            return Err(KIND.unwritable(format!("fields of {whose} differ in size")));
        }
        texels(sample)
            .check(&whose, set.paint.as_ref())
            .map_err(|reason| KIND.unwritable(reason))?;
    }
    let header = FileHeader::of(set)?;
    let pigments = header.pigments.as_deref();
    let mut parts = Vec::with_capacity(set.samples.len());
    for (sample, plan) in set.samples.iter().zip(header.plans()) {
        let part = part(sample, plan, pigments);
        check(&part, pigments).map_err(|(channel, reason)| {
            KIND.unwritable(format!("sample `{}`, channel `{channel}` {reason}", sample.name))
        })?;
        parts.push(part);
    }
    write_parts(&KIND, &header.to_json()?, parts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::Sample;
    use crate::texel_file::{PaintOfSamples, TexelPaint};
    use documents::hint::Explain;
    use graphics::field::Field;
    use paint::layer::Slots;
    use pigment::{PigmentId, PigmentLibrary};
    use std::sync::Arc;

    /// A number that loses bits in anything but lossless storage.
    fn number(index: usize) -> f32 {
        0.001 + (index as f32 * 0.618_034).fract() / 3.0
    }

    fn sample(name: &str, width: usize, height: usize) -> Sample {
        let color =
            (0..width * height).map(|i| [number(i), -number(i + 7), number(i + 9)]).collect();
        let paint = (0..width * height).map(|i| TexelPaint {
            pigments_mm: [number(i), 0.0, number(i + 3), 0.0, 0.0, 0.0, 0.0, number(i + 5)],
            vehicle_mm: number(i + 1),
        });
        Sample {
            name: name.to_owned(),
            color: Field::from_values(width, height, color),
            paint: Some(Field::from_values(width, height, paint.collect())),
            height_mm: Some({
                Field::from_values(
                    width,
                    height,
                    (0..width * height).map(|i| number(2 * i)).collect(),
                )
            }),
            mask: Field::from_values(
                width,
                height,
                (0..width * height).map(|i| i % 5 > 0).collect(),
            ),
            spacing: 7.25,
            mm_per_texel: Some(0.15),
            guessed_relief: false,
        }
    }

    fn set() -> SampleSet {
        let mut library = PigmentLibrary::van_gogh_oils();
        library.pigments[2].name = "R".to_owned();
        let mut slots = Slots::default();
        (slots[0], slots[2], slots[7]) =
            (Some(PigmentId(1)), Some(PigmentId(2)), Some(PigmentId(4)));
        let mut bare = sample("l\u{f6}ss", 9, 40);
        (bare.height_mm, bare.mm_per_texel, bare.guessed_relief) = (None, None, true);
        SampleSet {
            samples: vec![sample("tone 1", 33, 21), bare],
            paint: Some(PaintOfSamples { library: Arc::new(library), slots }),
            provenance: "a test".to_owned(),
        }
    }

    #[test]
    fn samples_come_back_bit_for_bit_and_files_are_the_same_bytes() {
        let mut plain = set();
        plain.paint = None;
        plain.samples.iter_mut().for_each(|sample| sample.paint = None);
        // Texels that are masked out may hold anything.
        plain.samples[0].color[(0, 0)] = [f32::INFINITY, -1e30, 0.0];
        for set in [set(), plain] {
            let bytes = write(&set).unwrap();
            assert!(read("a.exr", &bytes).unwrap() == set);
            assert_eq!(write(&set).unwrap(), bytes);
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("samples.exr");
        set().save(&path).unwrap();
        assert!(SampleSet::open(&path).unwrap() == set());
    }

    /// Replaces `from` in the bytes by `to` of the same length.
    fn replaced(bytes: &[u8], from: &str, to: &str) -> Vec<u8> {
        assert_eq!(from.len(), to.len(), "same length");
        let at = bytes.windows(from.len()).position(|window| window == from.as_bytes()).unwrap();
        let mut bytes = bytes.to_vec();
        bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
        bytes
    }

    #[test]
    fn bad_files_are_refused_with_their_place_and_a_way_out() {
        let bytes = write(&set()).unwrap();
        fn refused(bytes: &[u8]) -> TexelFileError {
            let error = read("a.exr", bytes).unwrap_err();
            assert!(error.to_string().starts_with("a.exr: "), "{error}");
            assert!(error.hint().is_some(), "{error}");
            error
        }
        let error = refused(&replaced(&bytes, "\"version\":1", "\"version\":9"));
        assert!(
            matches!(error, TexelFileError::Version { ref found, newest: 1, .. } if found == "9")
        );
        let error = refused(&replaced(&bytes, "impasto-samples", "impasto-simples"));
        assert!(matches!(error, TexelFileError::Format { .. }), "{error}");
        let error = refused(&replaced(&bytes, "\"width\":33", "\"width\":32"));
        assert!(error.to_string().contains("part `sample.000` has `33 x 21` texels"), "{error}");
        let error = refused(&replaced(&bytes, "\"height\":40", "\"height\":99"));
        assert!(error.to_string().contains("part `sample.001`"), "{error}");
        let error = refused(&replaced(&bytes, "\"spacing\":7.25", "\"spacing\":-7.2"));
        assert!(error.to_string().contains("spacing of sample `tone 1`"), "{error}");
        let error = refused(&replaced(&bytes, "mask\0", "masc\0"));
        assert!(matches!(error, TexelFileError::Channel { .. }), "{error}");
        let error = refused(&replaced(&bytes, "\"relief\":true,", "\"relief\":null,"));
        assert!(matches!(error, TexelFileError::Header { .. }), "{error}");
    }

    #[test]
    fn a_missing_channel_is_named() {
        let bytes = write(&set()).unwrap();
        let json = replaced(&bytes, "\"relief\":false", "\"relief\":true ");
        let error = read("a.exr", &json).unwrap_err();
        let TexelFileError::Channel { part, channel, reason, .. } = &error else {
            panic!("{error}")
        };
        assert_eq!((&**part, &**channel, &**reason), ("sample.001", "height", "is missing"));
    }

    #[test]
    fn truncated_and_damaged_files_are_errors_and_never_panics() {
        let bytes = write(&set()).unwrap();
        for cut in (0..bytes.len()).step_by(97).chain([bytes.len() - 1]) {
            assert!(read("a.exr", &bytes[..cut]).is_err(), "{cut} of {}", bytes.len());
        }
        for at in (0..bytes.len()).step_by(61) {
            let mut bytes = bytes.clone();
            bytes[at] ^= 0x55;
            // The flipped number may be a valid one. This must only not panic.
            let _ = read("a.exr", &bytes);
        }
    }

    #[test]
    fn inconsistent_sets_are_not_written() {
        fn refused(change: &dyn Fn(&mut SampleSet)) -> String {
            let mut set = set();
            change(&mut set);
            write(&set).unwrap_err().to_string()
        }
        assert!(refused(&|set| set.samples.clear()).contains("there are none"));
        let sizes = refused(&|set| set.samples[0].mask = Field::filled(3, 3, true));
        assert!(sizes.contains("fields of sample `tone 1` differ in size"), "{sizes}");
        assert!(refused(&|set| set.samples[1].paint = None).contains("has no paint"));
        assert!(refused(&|set| set.paint = None).contains("paint of no library"));
        assert!(refused(&|set| set.samples[0].spacing = f64::NAN).contains("cannot be saved"));
        let color = refused(&|set| set.samples[0].color[(1, 0)] = [f32::NAN; 3]);
        assert!(
            color.contains("sample `tone 1`, channel `B` is impossible at x 1, y 0"),
            "{color}"
        );
        let stray = refused(&|set| {
            if let Some(paint) = &mut set.samples[0].paint {
                paint[(2, 2)].pigments_mm[1] = 0.1;
            }
        });
        assert!(stray.contains("paint of no pigment in slot 1"), "{stray}");
    }
}
