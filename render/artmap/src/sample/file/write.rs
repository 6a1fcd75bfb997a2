//! Encoding of a file of samples.

use std::io::Cursor;

use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::{AttributeValue, Compression, IntegerBounds, LineOrder, Text};
use exr::meta::header::{ImageAttributes, LayerAttributes};

use super::error::SampleFileError;
use super::header::{ATTRIBUTE, FileHeader, sizes_agree};
use super::planes::{plane, sample};
use crate::sample::passage::SampleSet;

/// PIZ is lossless.
const ENCODING: Encoding = Encoding {
    compression: Compression::PIZ,
    blocks: Blocks::ScanLines,
    line_order: LineOrder::Increasing,
};

/// Encodes samples as a file. The same samples always give the same bytes.
///
/// # Errors
/// [`SampleFileError::Unwritable`] for a set without samples or with fields of different sizes,
/// samples with paint in a set without pigments or the other way round, paint in slots without
/// pigment, and numbers that are not finite.
pub fn write(set: &SampleSet) -> Result<Vec<u8>, SampleFileError> {
    let unwritable = |reason: String| SampleFileError::Unwritable { reason };
    check(set).map_err(unwritable)?;
    let header = FileHeader::of(set)?;
    let pigments = header.pigments.as_deref();
    let json = header.to_json()?;
    let mut layers = Vec::with_capacity(set.samples.len());
    for (of, description) in set.samples.iter().zip(&header.samples) {
        let names = description.channels(pigments);
        let planes: Vec<Vec<f32>> =
            names.iter().map(|name| plane(of, name, pigments.unwrap_or_default())).collect();
        sample(description, pigments, &names, &planes).map_err(|(channel, reason)| {
            unwritable(format!("sample `{}`, channel `{channel}` {reason}", of.name))
        })?;
        let mut own = LayerAttributes::named(description.part.as_str());
        if layers.is_empty() {
            // The encoder does not keep the order of several custom attributes.
            let text = AttributeValue::Text(json.as_str().into());
            own.other.extend([(Text::from(ATTRIBUTE), text)]);
        }
        let channels = names
            .iter()
            .zip(planes)
            .map(|(name, plane)| AnyChannel::new(name.as_str(), FlatSamples::F32(plane)));
        let channels = AnyChannels::sort(channels.collect());
        layers.push(Layer::new(of.size(), own, ENCODING, channels));
    }
    let widest = set.samples.iter().map(|sample| sample.size().0).max().unwrap_or(1);
    let highest = set.samples.iter().map(|sample| sample.size().1).max().unwrap_or(1);
    let display = ImageAttributes::new(IntegerBounds::new((0, 0), (widest, highest)));
    let image = Image::from_layers(display, layers);
    let mut bytes = Vec::new();
    let written = image.write().to_buffered(Cursor::new(&mut bytes));
    written.map_err(|error| unwritable(error.to_string()))?;
    Ok(bytes)
}

fn check(set: &SampleSet) -> Result<(), String> {
    if set.samples.is_empty() {
        return Err("there are none".to_owned());
    }
    for sample in &set.samples {
        let name = &sample.name;
        if !sizes_agree(sample) {
            return Err(format!("fields of sample `{name}` differ in size"));
        }
        match (&sample.paint, &set.paint) {
            (None, None) => {}
            (Some(paint), Some(of)) => {
                let stray = |slot: &usize| {
                    let amounts = paint.values().iter().map(|texel| texel.pigments_mm[*slot]);
                    of.slots[*slot].is_none() && amounts.into_iter().any(|amount| amount != 0.0)
                };
                if let Some(slot) = (0..of.slots.len()).find(stray) {
                    return Err(format!("sample `{name}` has paint of no pigment in slot {slot}"));
                }
            }
            (Some(_), None) => return Err(format!("sample `{name}` has paint of no library")),
            (None, Some(_)) => return Err(format!("sample `{name}` has no paint")),
        }
    }
    Ok(())
}
