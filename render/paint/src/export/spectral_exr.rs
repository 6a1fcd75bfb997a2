//! Spectral OpenEXR files.
//!
//! Layout by A. Fichet, R. Pacanowski and A. Wilkie, "An OpenEXR Layout for Spectral
//! Images" (Journal of Computer Graphics Techniques 10(3), 2021): a channel
//! `T.550,000000nm` per wavelength of a reflective image (with a decimal comma, since a
//! dot separates layers), R, G and B for programs that know no spectra, and attribute
//! `spectralLayoutVersion` "1.0". Reflectance has no unit, so no other attribute is
//! needed.

use exr::image::FlatSamples;
use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::LayerAttributes;

use graphics::export::{ExportError, exr_file, rgb_channels};
use graphics::field::Field;

/// Encodes `planes` of reflectance (0..1) at `wavelengths_nm` with 32 bits each, and
/// `picture` (linear sRGB) as R, G and B; a cell is `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] unless wavelengths rise, there is one per plane, all planes have the
/// picture's size, and every value is finite.
pub fn spectral_exr(
    picture: &Field<[f32; 4]>,
    wavelengths_nm: &[f64],
    planes: &[Field<f32>],
    cell_mm: f64,
) -> Result<Vec<u8>, ExportError> {
    let width = picture.width();
    let height = picture.height();
    if wavelengths_nm.len() != planes.len() {
        let found = format!("{} wavelengths", wavelengths_nm.len());
        return Err(ExportError::Wavelength { plane: planes.len(), found });
    }
    let mut channels = rgb_channels(picture)?;
    let mut before = 0.0;
    for (index, (&nm, plane)) in wavelengths_nm.iter().zip(planes).enumerate() {
        let name = channel_name(nm);
        if !(nm.is_finite() && nm > before) || channels.iter().any(|(other, _)| *other == name) {
            return Err(ExportError::Wavelength { plane: index, found: nm.to_string() });
        }
        before = nm;
        if plane.bounds() != picture.bounds() {
            return Err(ExportError::Differs { plane: name, width, height });
        }
        if let Some(at) = plane.values().iter().position(|value| !value.is_finite()) {
            let x = at % width;
            let y = at / width;
            let found = plane.values()[at];
            let what = format!("the reflectance at {nm} nm");
            return Err(ExportError::NotFinite { what, x, y, found });
        }
        channels.push((name, FlatSamples::F32(plane.values().to_vec())));
    }
    let mut attributes = LayerAttributes::default();
    // Add at most one custom attribute: the encoder does not keep the order of several, so
    // the bytes of the file would vary.
    let version = AttributeValue::Text("1.0".into());
    attributes.other.insert(Text::from("spectralLayoutVersion"), version);
    exr_file((width, height), cell_mm, channels, attributes)
}

/// Channel name for a wavelength of a reflective image.
fn channel_name(nm: f64) -> String {
    format!("T.{}nm", format!("{nm:.6}").replace('.', ","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_named_as_published() {
        assert_eq!(channel_name(550.0), "T.550,000000nm");
        assert_eq!(channel_name(412.345_678_9), "T.412,345679nm");
    }
}
