//! OpenEXR files of one or several parts, and of linear light in one part.

use std::io::Cursor;

use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, Layers};
use exr::math::Vec2;
use exr::meta::attribute::{Chromaticities, IntegerBounds};
use exr::meta::header::{ImageAttributes, LayerAttributes};
use spectra::color::RgbSpace;

use super::{ExportError, check_cell, check_size};
use crate::field::Field;

/// A part of an OpenEXR file: its name, and named channels with their samples row by row.
pub type ExrPart = (String, Vec<(String, Vec<f32>)>);

/// Encodes named channels (samples row by row) with the primaries of sRGB. A pixel is `cell_mm`
/// wide.
pub fn exr_file(
    size: (usize, usize),
    cell_mm: f64,
    channels: Vec<(String, FlatSamples)>,
    attributes: LayerAttributes,
) -> Result<Vec<u8>, ExportError> {
    encoded(size, cell_mm, vec![(attributes, channels)])
}

/// Encodes parts of one size as one OpenEXR file with the primaries of sRGB. Each part has named
/// channels of 32-bit floats. A pixel is `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] for an empty picture, a pixel size out of range, and parts with the same name
/// or none.
pub fn exr_parts(
    size: (usize, usize),
    cell_mm: f64,
    parts: Vec<ExrPart>,
) -> Result<Vec<u8>, ExportError> {
    encoded(
        size,
        cell_mm,
        parts
            .into_iter()
            .map(|(name, channels): ExrPart| {
                let channels = channels.into_iter();
                let channels = channels.map(|(name, values)| (name, FlatSamples::F32(values)));
                (LayerAttributes::named(name.as_str()), channels.collect())
            })
            .collect(),
    )
}

fn encoded(
    (width, height): (usize, usize),
    cell_mm: f64,
    parts: Vec<(LayerAttributes, Vec<(String, FlatSamples)>)>,
) -> Result<Vec<u8>, ExportError> {
    check_size(width, height)?;
    check_cell(cell_mm)?;
    let layers: Layers<_> = parts
        .into_iter()
        .map(|(attributes, channels): (LayerAttributes, Vec<(String, FlatSamples)>)| {
            let channels =
                channels.into_iter().map(|(name, samples)| AnyChannel::new(name.as_str(), samples));
            let attributes =
                LayerAttributes { horizontal_density: Some((25.4 / cell_mm) as f32), ..attributes };
            let channels = AnyChannels::sort(channels.collect());
            Layer::new((width, height), attributes, Encoding::SMALL_LOSSLESS, channels)
        })
        .collect();
    let window = IntegerBounds::from_dimensions((width, height));
    let mut attributes = ImageAttributes::new(window);
    attributes.chromaticities = Some(chromaticities());
    let mut bytes = Vec::new();
    let image = Image::from_layers(attributes, layers);
    let written = image.write().to_buffered(Cursor::new(&mut bytes));
    written
        .map_err(|error| ExportError::Encoder { format: "OpenEXR", reason: error.to_string() })?;
    Ok(bytes)
}

fn chromaticities() -> Chromaticities {
    let space = RgbSpace::Srgb;
    let columns = space.xyz_from_linear().0;
    fn at([x, y, z]: [f64; 3]) -> Vec2<f32> {
        let sum = x + y + z;
        Vec2((x / sum) as f32, (y / sum) as f32)
    }
    fn column(j: usize, columns: &[[f64; 3]; 3]) -> Vec2<f32> {
        at([columns[0][j], columns[1][j], columns[2][j]])
    }
    let white = at(space.white().to_array());
    Chromaticities {
        red: column(0, &columns),
        green: column(1, &columns),
        blue: column(2, &columns),
        white,
    }
}

/// Encodes linear sRGB (white at 1) as channels R, G, B of 32-bit floats. This does not clip
/// colours. Attribute `chromaticities` has the primaries of sRGB. A pixel is `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] for an empty picture, a pixel size out of range, and colours that are not
/// finite.
pub fn linear_exr(picture: &Field<[f32; 4]>, cell_mm: f64) -> Result<Vec<u8>, ExportError> {
    let size = (picture.width(), picture.height());
    let channels = rgb_channels(picture)?;
    exr_file(size, cell_mm, channels, LayerAttributes::default())
}

/// Encodes named channels of 32-bit floats, row by row, as one OpenEXR part with the primaries of
/// sRGB. A pixel is `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] for an empty picture and a pixel size out of range.
pub fn float_exr(
    size: (usize, usize),
    cell_mm: f64,
    channels: Vec<(String, Vec<f32>)>,
) -> Result<Vec<u8>, ExportError> {
    let channels = channels.into_iter().map(|(name, values)| (name, FlatSamples::F32(values)));
    exr_file(size, cell_mm, channels.collect(), LayerAttributes::default())
}

/// The channels R, G and B of a picture as 32-bit floats. You pass them to [`exr_file`].
///
/// # Errors
/// [`ExportError::NotFinite`].
pub fn rgb_channels(picture: &Field<[f32; 4]>) -> Result<Vec<(String, FlatSamples)>, ExportError> {
    let values = picture.values();
    if let Some((index, found)) = values.iter().enumerate().find_map(|(index, rgb)| {
        Some((index, rgb[..3].iter().copied().find(|value| !value.is_finite())?))
    }) {
        let x = index % picture.width();
        let y = index / picture.width();
        return Err(ExportError::NotFinite { what: "the colour".into(), x, y, found });
    }
    Ok(["R", "G", "B"]
        .iter()
        .enumerate()
        .map(|(i, name)| {
            ((*name).to_owned(), FlatSamples::F32(values.iter().map(|rgb| rgb[i]).collect()))
        })
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{ReadChannels, ReadLayers, read};

    #[test]
    fn parts_keep_their_names_channels_and_values() {
        fn plane(value: f32) -> Vec<f32> {
            vec![value; 6]
        }
        let parts = vec![
            ("color".to_owned(), vec![("R".to_owned(), plane(0.25)), ("B".to_owned(), plane(2.0))]),
            ("count".to_owned(), vec![("sky".to_owned(), plane(300.0))]),
        ];
        let bytes = exr_parts((3, 2), 0.5, parts).unwrap();
        let image = read().no_deep_data().largest_resolution_level().all_channels().all_layers();
        let image = image.all_attributes().from_buffered(Cursor::new(bytes)).unwrap();
        let names: Vec<String> = image
            .layer_data
            .iter()
            .map(|layer| layer.attributes.layer_name.as_ref().unwrap().to_string())
            .collect();
        assert_eq!(names, ["color", "count"]);
        let channels = image.layer_data.iter().flat_map(|layer| layer.channel_data.list.iter());
        let found: Vec<(String, f32)> = channels
            .map(|channel| {
                (channel.name.to_string(), channel.sample_data.values_as_f32().next().unwrap())
            })
            .collect();
        let wanted = [("B", 2.0), ("R", 0.25), ("sky", 300.0)];
        assert_eq!(found, wanted.map(|(name, first)| (name.to_owned(), first)));
        let twice = vec![("a".to_owned(), vec![]), ("a".to_owned(), vec![])];
        assert!(exr_parts((3, 2), 0.5, twice).is_err());
    }
}
