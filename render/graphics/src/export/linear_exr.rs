//! OpenEXR of linear light.

use exr::image::FlatSamples;
use exr::meta::header::LayerAttributes;
use exr::prelude::f16;

use super::error::ExportError;
use super::exr_part::exr_file;
use crate::field::Field;

/// Bits of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum FloatBits {
    /// 16: three digits, half the size; values beyond 65504 do not fit.
    #[default]
    Half,
    /// 32: as computed.
    Single,
}

/// Channels R, G, B of linear sRGB, white at 1, with the primaries of sRGB in
/// the attribute `chromaticities` and nothing clipped; cells of `cell_mm`.
///
/// # Errors
/// [`ExportError`] for a picture without cells, cells without a size, and
/// colours that are not finite or beyond what the bits hold.
pub fn linear_exr(
    picture: &Field<[f32; 4]>,
    cell_mm: f64,
    bits: FloatBits,
) -> Result<Vec<u8>, ExportError> {
    let size = (picture.width(), picture.height());
    let channels = rgb_channels(picture, bits)?;
    exr_file(size, cell_mm, channels, LayerAttributes::default())
}

/// The three channels of a picture.
pub fn rgb_channels(
    picture: &Field<[f32; 4]>,
    bits: FloatBits,
) -> Result<Vec<(String, FlatSamples)>, ExportError> {
    let largest = match bits {
        FloatBits::Half => f16::MAX.to_f32(),
        FloatBits::Single => f32::MAX,
    };
    let strange =
        |rgb: &[f32; 4]| rgb[..3].iter().copied().find(|v| v.is_nan() || v.abs() > largest);
    let values = picture.values();
    if let Some((index, found)) =
        values.iter().enumerate().find_map(|(index, rgb)| Some((index, strange(rgb)?)))
    {
        let (x, y) = (index % picture.width(), index / picture.width());
        return Err(ExportError::NotFinite { what: "the colour".into(), x, y, found });
    }
    let channel = |index: usize| {
        let values = values.iter().map(move |rgb| rgb[index]);
        match bits {
            FloatBits::Half => FlatSamples::F16(values.map(f16::from_f32).collect()),
            FloatBits::Single => FlatSamples::F32(values.collect()),
        }
    };
    Ok(["R", "G", "B"]
        .iter()
        .enumerate()
        .map(|(i, name)| ((*name).to_owned(), channel(i)))
        .collect())
}
