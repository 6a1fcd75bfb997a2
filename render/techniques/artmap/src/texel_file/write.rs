//! Encoding of a file of texels.

use std::io::Cursor;

use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::{AttributeValue, Compression, IntegerBounds, LineOrder, Text};
use exr::meta::header::{ImageAttributes, LayerAttributes};
use paint::file::ATTRIBUTE;

use super::error::TexelFileError;
use super::kind::TexelFileKind;
use super::part::PartPlanes;

/// PIZ is lossless.
const ENCODING: Encoding = Encoding {
    compression: Compression::PIZ,
    blocks: Blocks::ScanLines,
    line_order: LineOrder::Increasing,
};

/// Encodes parts as a file with their description. Equal parts always give equal bytes.
///
/// # Errors
/// [`TexelFileError::Unwritable`] if the encoder refuses the parts.
pub(crate) fn write(
    kind: &TexelFileKind,
    description: &str,
    parts: Vec<PartPlanes>,
) -> Result<Vec<u8>, TexelFileError> {
    let widest = parts.iter().map(|part| part.plan.width).max().unwrap_or(1);
    let highest = parts.iter().map(|part| part.plan.height).max().unwrap_or(1);
    let mut layers = Vec::with_capacity(parts.len());
    for PartPlanes { plan, planes } in parts {
        let mut own = LayerAttributes::named(plan.name.as_str());
        if layers.is_empty() {
            // The encoder does not keep the order of several custom attributes.
            let text = AttributeValue::Text(description.into());
            own.other.extend([(Text::from(ATTRIBUTE), text)]);
        }
        let channels = plan.channels.iter().zip(planes);
        let channels = channels
            .map(|(name, plane)| AnyChannel::new(name.as_str(), FlatSamples::F32(plane)))
            .collect();
        let size = (plan.width, plan.height);
        layers.push(Layer::new(size, own, ENCODING, AnyChannels::sort(channels)));
    }
    let display = ImageAttributes::new(IntegerBounds::new((0, 0), (widest, highest)));
    let image = Image::from_layers(display, layers);
    let mut bytes = Vec::new();
    let written = image.write().to_buffered(Cursor::new(&mut bytes));
    written.map_err(|error| kind.unwritable(error.to_string()))?;
    Ok(bytes)
}
