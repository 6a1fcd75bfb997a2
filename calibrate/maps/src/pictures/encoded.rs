//! Fields of values as PNG files.

use super::ramp::Ramp;

/// A field that is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The number of values is not that of the pixels, or there are none.
    #[error("{values} values for a picture of {width} x {height} pixels")]
    Size {
        /// Number of values.
        values: usize,
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
    },
    /// The encoder refuses it.
    #[error("the picture cannot be encoded")]
    Encoder(#[from] png::EncodingError),
}

impl documents::hint::Explain for PictureError {}

/// Encodes `width` x `height` values as a PNG file, with the colours of `ramp`; NaN is transparent.
///
/// # Errors
/// [`PictureError`] if the number of values is not that of the pixels.
pub fn picture_png(
    values: &[f32],
    (width, height): (usize, usize),
    ramp: &Ramp,
) -> Result<Vec<u8>, PictureError> {
    let sizes = u32::try_from(width).ok().zip(u32::try_from(height).ok());
    let fits = width.checked_mul(height) == Some(values.len()) && !values.is_empty();
    let (Some((columns, rows)), true) = (sizes, fits) else {
        return Err(PictureError::Size { values: values.len(), width, height });
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, columns, rows);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    let colors: Vec<u8> = values.iter().flat_map(|value| ramp.color(*value)).collect();
    writer.write_image_data(&colors)?;
    writer.finish()?;
    Ok(bytes)
}
