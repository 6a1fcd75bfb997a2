//! Photographs converted from the ICC profile that is embedded in them to sRGB.

use std::io::Cursor;

use image::{ColorType, DynamicImage, ImageBuffer, Rgba};
use moxcms::{ColorProfile, DataColorSpace, Layout, RenderingIntent, TransformOptions};
use rayon::prelude::*;
use tiff::TiffResult;
use tiff::decoder::{Decoder, Limits, ifd};
use tiff::tags::Tag;

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

/// The ICC profile in a TIFF file. Read here, because the decoder of pictures leaves out a profile that is
/// large beside its picture, without a word. It takes memory in proportion to the file at most.
pub(crate) fn tiff_profile(file: &[u8]) -> TiffResult<Option<Vec<u8>>> {
    let mut limits = Limits::default();
    limits.decoding_buffer_size = file.len().saturating_mul(size_of::<ifd::Value>());
    let mut decoder = Decoder::new(Cursor::new(file))?.with_limits(limits);
    decoder.find_tag(Tag::IccProfile)?.map(ifd::Value::into_u8_vec).transpose()
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

#[cfg(test)]
mod tests {
    use documents::hint::{Explain, Fault};
    use image::codecs::png::PngEncoder;
    use image::codecs::tiff::TiffEncoder;
    use image::{ExtendedColorType, ImageEncoder};
    use spectra::color::Rgb;

    use super::*;
    use crate::picture::Photograph;

    fn linear(bytes: &[u8]) -> [f32; 3] {
        Photograph::from_bytes("made", bytes).unwrap().on_canvas(1, 1)[(0, 0)]
    }

    fn near(found: [f32; 3], wanted: [f64; 3], tolerance: f64) {
        let far = found.iter().zip(wanted).map(|(f, w)| (f64::from(*f) - w).abs());
        assert!(far.fold(0.0, f64::max) < tolerance, "{found:?} for {wanted:?}");
    }

    /// A TIFF of one colour with 16 bits, and a profile.
    fn deep_tiff(values: [u16; 3], profile: &ColorProfile) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        let mut encoder = TiffEncoder::new(&mut bytes);
        encoder.set_icc_profile(profile.encode().unwrap()).unwrap();
        let samples = values.map(u16::to_ne_bytes).concat().repeat(64);
        encoder.write_image(&samples, 8, 8, ExtendedColorType::Rgb16).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn sixteen_bits_of_a_tiff_survive_its_profile() {
        let p3 = [
            [1.224_940, -0.224_940, 0.0],
            [-0.042_057, 1.042_057, 0.0],
            [-0.019_638, -0.078_636, 1.098_274],
        ];
        // Steps below the 257 of a picture with 8 bits.
        for step in 0..8 {
            let values = [30_000 + 31 * step, 27_000 - 17 * step, 25_000 + 5 * step];
            let light = values.map(|v| Rgb([f64::from(v) / 65_535.0; 3]).linear().0[0]);
            let wanted = p3.map(|row| row.iter().zip(light).map(|(m, l)| m * l).sum::<f64>());
            near(linear(&deep_tiff(values, &ColorProfile::new_display_p3())), wanted, 2e-4);
            near(linear(&deep_tiff(values, &ColorProfile::new_srgb())), light, 2e-4);
        }
    }

    #[test]
    fn the_curve_of_a_grey_profile_is_that_of_the_picture() {
        let profile = ColorProfile::new_gray_with_gamma(1.8).encode().unwrap();
        let light = |file: &[u8]| {
            let [r, g, b] = linear(file);
            assert!(r == g && g == b, "grey stays grey: {r} {g} {b}");
            f64::from(r)
        };
        for value in [40_u8, 128, 220] {
            let wanted = (f64::from(value) / 255.0).powf(1.8);
            let mut png = Vec::new();
            let mut encoder = PngEncoder::new(&mut png);
            encoder.set_icc_profile(profile.clone()).unwrap();
            encoder.write_image(&[value; 64], 8, 8, ExtendedColorType::L8).unwrap();
            let found = light(&png);
            assert!((found - wanted).abs() < 5e-4, "{found} for {wanted}");
            let mut clear = Vec::new();
            let mut encoder = PngEncoder::new(&mut clear);
            encoder.set_icc_profile(profile.clone()).unwrap();
            encoder.write_image(&[value, 51].repeat(64), 8, 8, ExtendedColorType::La8).unwrap();
            let found = light(&clear);
            let wanted = 0.2 * wanted + 0.8;
            assert!((found - wanted).abs() < 5e-4, "over white: {found} for {wanted}");
        }
        let mut colored = Vec::new();
        let mut encoder = PngEncoder::new(&mut colored);
        encoder.set_icc_profile(profile).unwrap();
        encoder.write_image(&[1, 2, 3], 1, 1, ExtendedColorType::Rgb8).unwrap();
        let error = Photograph::from_bytes("grey.png", &colored).unwrap_err().to_string();
        assert!(error.contains("Gray") && error.contains("the picture is RGB"), "{error}");
    }

    /// A JPEG of 8 x 8 pixels of middle grey with this number of components: its tables hold one code
    /// each, so that the coded data are zeros.
    fn small_jpeg(components: u8) -> Vec<u8> {
        let mut file = vec![0xff, 0xd8, 0xff, 0xdb, 0, 67, 0];
        file.extend([1; 64]);
        file.extend([0xff, 0xc0, 0, 8 + 3 * components, 8, 0, 8, 0, 8, components]);
        file.extend((1..=components).flat_map(|id| [id, 0x11, 0]));
        for class in [0x00, 0x10] {
            file.extend([0xff, 0xc4, 0, 20, class, 1]);
            file.extend([0; 16]);
        }
        file.extend([0xff, 0xda, 0, 6 + 2 * components, components]);
        file.extend((1..=components).flat_map(|id| [id, 0]));
        file.extend([0, 63, 0]);
        // One bit for the mean and one for the end of each block, then ones up to a whole byte.
        file.extend([if components == 4 { 0 } else { 0xff >> (2 * components) }, 0xff, 0xd9]);
        file
    }

    #[test]
    fn a_jpeg_of_inks_is_refused_and_one_of_light_is_read() {
        for components in [1, 3] {
            let grey = linear(&small_jpeg(components));
            near(grey, [Rgb([128.0 / 255.0; 3]).linear().0[0]; 3], 1e-3);
        }
        let inks = small_jpeg(4);
        assert!(image::load_from_memory(&inks).is_ok(), "a decoder makes some colour of it");
        let error = Photograph::from_bytes("press.jpg", &inks).unwrap_err();
        assert_eq!(error.to_string(), "press.jpg: its colours are inks (CMYK)");
        assert_eq!(error.fault(), Fault::Input);
    }
}
