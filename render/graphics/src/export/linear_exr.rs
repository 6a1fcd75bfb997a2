//! OpenEXR files of linear light.

use exr::image::FlatSamples;
use exr::meta::header::LayerAttributes;

use super::error::ExportError;
use super::exr_part::exr_file;
use crate::field::Field;

/// Encodes linear sRGB (white at 1) as channels R, G, B of 32-bit floats, unclipped, with
/// the primaries of sRGB in attribute `chromaticities`; a pixel is `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] for an empty picture, a pixel size out of range, and colours that are
/// not finite.
pub fn linear_exr(picture: &Field<[f32; 4]>, cell_mm: f64) -> Result<Vec<u8>, ExportError> {
    let size = (picture.width(), picture.height());
    let channels = rgb_channels(picture)?;
    exr_file(size, cell_mm, channels, LayerAttributes::default())
}

/// Encodes named channels of 32-bit floats, row by row, as one OpenEXR part with the primaries of
/// sRGB; a pixel is `cell_mm` wide.
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

/// The channels R, G and B of a picture as 32-bit floats, for [`exr_file`].
///
/// # Errors
/// [`ExportError::NotFinite`].
pub fn rgb_channels(picture: &Field<[f32; 4]>) -> Result<Vec<(String, FlatSamples)>, ExportError> {
    let not_finite = |rgb: &[f32; 4]| rgb[..3].iter().copied().find(|value| !value.is_finite());
    let values = picture.values();
    if let Some((index, found)) =
        values.iter().enumerate().find_map(|(index, rgb)| Some((index, not_finite(rgb)?)))
    {
        let x = index % picture.width();
        let y = index / picture.width();
        return Err(ExportError::NotFinite { what: "the colour".into(), x, y, found });
    }
    let channel =
        |index: usize| FlatSamples::F32(values.iter().map(move |rgb| rgb[index]).collect());
    Ok(["R", "G", "B"]
        .iter()
        .enumerate()
        .map(|(i, name)| ((*name).to_owned(), channel(i)))
        .collect())
}
