//! Photographs converted from the ICC profile that is embedded in them to sRGB.

use image::{ColorType, DynamicImage, ImageBuffer, Rgba};
use moxcms::{ColorProfile, DataColorSpace, Layout, RenderingIntent, TransformOptions};
use rayon::prelude::*;

/// Why a picture cannot be converted.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ProfileError {
    /// The file holds inks, whose colours depend on a press.
    #[error("its colours are inks ({0})")]
    Inks(String),
    /// The profile cannot be read, or does not suit the picture.
    #[error("its colour profile cannot be used: {0}")]
    Unusable(String),
}

/// Converts a picture of encoded samples from `profile` (the content of an ICC file) to encoded sRGB
/// with 16 bits per channel: relative to white, colours outside sRGB clipped channel by channel.
/// Opacity stays.
///
/// # Errors
/// [`ProfileError`] for a damaged profile, one of inks, and one for another number of channels.
pub fn to_srgb(image: DynamicImage, profile: &[u8]) -> Result<DynamicImage, ProfileError> {
    let unusable = |error: moxcms::CmsError| ProfileError::Unusable(error.to_string());
    let source = ColorProfile::new_from_slice(profile).map_err(unusable)?;
    let grey =
        matches!(image.color(), ColorType::L8 | ColorType::La8 | ColorType::L16 | ColorType::La16);
    match (source.color_space, grey) {
        (DataColorSpace::Rgb, _) | (DataColorSpace::Gray, true) => {}
        (DataColorSpace::Cmyk | DataColorSpace::Cmy, _) => {
            return Err(ProfileError::Inks("CMYK".to_owned()));
        }
        (space, _) => {
            let channels = if grey { "grey" } else { "RGB" };
            let reason = format!("it is for {space:?}, the picture is {channels}");
            return Err(ProfileError::Unusable(reason));
        }
    }
    let options = TransformOptions {
        rendering_intent: RenderingIntent::RelativeColorimetric,
        prefer_fixed_point: false,
        ..TransformOptions::default()
    };
    let srgb = ColorProfile::new_srgb();
    let wide = image.into_rgba16();
    let (width, height) = wide.dimensions();
    let mut from = wide.into_raw();
    let mut to = vec![0_u16; from.len()];
    let layout = if source.color_space == DataColorSpace::Gray {
        from = from.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[3]]).collect();
        Layout::GrayAlpha
    } else {
        Layout::Rgba
    };
    let transform =
        source.create_transform_16bit(layout, &srgb, Layout::Rgba, options).map_err(unusable)?;
    let channels = if layout == Layout::Rgba { 4 } else { 2 };
    let row = width.max(1) as usize;
    let rows = from.par_chunks(channels * row).zip(to.par_chunks_mut(4 * row));
    rows.try_for_each(|(from, to)| transform.transform(from, to)).map_err(unusable)?;
    let converted = ImageBuffer::<Rgba<u16>, _>::from_raw(width, height, to);
    converted
        .map(DynamicImage::ImageRgba16)
        .ok_or_else(|| ProfileError::Unusable("the picture has another size".to_owned()))
}
