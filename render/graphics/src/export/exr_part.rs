//! OpenEXR files of a single part, made from planes of values.

use std::io::Cursor;

use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
use exr::math::Vec2;
use exr::meta::attribute::Chromaticities;
use exr::meta::header::LayerAttributes;
use spectra::color::RgbSpace;

use super::error::{ExportError, check_cell, check_size};

/// Encodes named channels (samples row by row) with the primaries of sRGB; a pixel is
/// `cell_mm` wide.
pub fn exr_file(
    (width, height): (usize, usize),
    cell_mm: f64,
    channels: Vec<(String, FlatSamples)>,
    attributes: LayerAttributes,
) -> Result<Vec<u8>, ExportError> {
    check_size(width, height)?;
    check_cell(cell_mm)?;
    let channels =
        channels.into_iter().map(|(name, samples)| AnyChannel::new(name.as_str(), samples));
    let attributes =
        LayerAttributes { horizontal_density: Some((25.4 / cell_mm) as f32), ..attributes };
    let channels = AnyChannels::sort(channels.collect());
    let layer = Layer::new((width, height), attributes, Encoding::SMALL_LOSSLESS, channels);
    let mut image = Image::from_layer(layer);
    image.attributes.chromaticities = Some(chromaticities());
    let mut bytes = Vec::new();
    let written = image.write().to_buffered(Cursor::new(&mut bytes));
    written
        .map_err(|error| ExportError::Encoder { format: "OpenEXR", reason: error.to_string() })?;
    Ok(bytes)
}

/// Chromaticities of sRGB's primaries and white.
fn chromaticities() -> Chromaticities {
    let space = RgbSpace::Srgb;
    let columns = space.xyz_from_linear().0;
    let at = |[x, y, z]: [f64; 3]| {
        let sum = x + y + z;
        Vec2((x / sum) as f32, (y / sum) as f32)
    };
    let column = |j: usize| at([columns[0][j], columns[1][j], columns[2][j]]);
    let white = at(space.white().to_array());
    Chromaticities { red: column(0), green: column(1), blue: column(2), white }
}
