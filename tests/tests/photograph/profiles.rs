//! Photographs as TIFF and WebP, and with ICC profiles of wide gamut.

use std::io::Cursor;

use documents::hint::{Explain, Fault};
use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::codecs::webp::WebPEncoder;
use image::{DynamicImage, ExtendedColorType, ImageEncoder, ImageFormat, RgbImage};
use moxcms::ColorProfile;
use spectra::color::Rgb;
use strokes::{Photograph, PhotographError};

type Deep = image::ImageBuffer<image::Rgb<u16>, Vec<u16>>;

fn linear(bytes: &[u8]) -> [f32; 3] {
    Photograph::from_bytes("made", bytes).unwrap().on_canvas(1, 1)[(0, 0)]
}

fn near(found: [f32; 3], wanted: [f64; 3], tolerance: f64) {
    let far = found.iter().zip(wanted).map(|(f, w)| (f64::from(*f) - w).abs());
    assert!(far.fold(0.0, f64::max) < tolerance, "{found:?} for {wanted:?}");
}

fn written(image: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.into().write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

#[test]
fn tiff_of_16_bits_and_webp_are_read() {
    let values = [9, 40_000, 65_535];
    let deep = Deep::from_pixel(8, 8, values.into());
    let wanted = values.map(|v| Rgb([f64::from(v) / 65_535.0; 3]).linear().0[0]);
    near(linear(&written(deep, ImageFormat::Tiff)), wanted, 1e-6);
    let flat = RgbImage::from_pixel(8, 8, [10, 128, 250].into());
    let wanted = [10.0, 128.0, 250.0].map(|v| Rgb([v / 255.0; 3]).linear().0[0]);
    near(linear(&written(flat, ImageFormat::WebP)), wanted, 1e-6);
}

#[test]
fn a_cut_file_is_refused_wherever_it_ends() {
    let noise =
        RgbImage::from_fn(40, 30, |x, y| [(x * 37) as u8, (y * 91) as u8, (x * y) as u8].into());
    for format in [ImageFormat::Tiff, ImageFormat::WebP] {
        let whole = written(noise.clone(), format);
        for part in 1..10 {
            let cut = &whole[..whole.len() * part / 10];
            let error = Photograph::from_bytes("cut", cut).unwrap_err();
            assert!(matches!(error, PhotographError::NoPicture { .. }), "{format:?}: {error}");
            assert_eq!(error.fault(), Fault::Input, "{error}");
        }
    }
}

/// A picture of 8 x 8 pixels of one colour, with a profile, in each format that holds one.
fn with_profile(values: [u8; 3], profile: &ColorProfile) -> [Vec<u8>; 3] {
    let profile = profile.encode().unwrap();
    let picture = RgbImage::from_pixel(8, 8, values.into());
    let mut files = [Vec::new(), Vec::new(), Vec::new()];
    let [png, jpeg, webp] = &mut files;
    let mut encoder = PngEncoder::new(png);
    encoder.set_icc_profile(profile.clone()).unwrap();
    encoder.write_image(&picture, 8, 8, ExtendedColorType::Rgb8).unwrap();
    let mut encoder = JpegEncoder::new_with_quality(jpeg, 100);
    encoder.set_icc_profile(profile.clone()).unwrap();
    encoder.write_image(&picture, 8, 8, ExtendedColorType::Rgb8).unwrap();
    let mut encoder = WebPEncoder::new_lossless(webp);
    encoder.set_icc_profile(profile).unwrap();
    encoder.write_image(&picture, 8, 8, ExtendedColorType::Rgb8).unwrap();
    files
}

#[test]
fn wide_gamut_is_converted_by_its_primaries() {
    // Linear light of Display P3 (sRGB curve, SMPTE EG 432-1 primaries) and of Adobe RGB (1998)
    // (gamma 563/256), by the published matrices to linear sRGB.
    let p3 = [
        [1.224_940, -0.224_940, 0.0],
        [-0.042_057, 1.042_057, 0.0],
        [-0.019_638, -0.078_636, 1.098_274],
    ];
    let adobe = [[1.398_284, -0.398_284, 0.0], [0.0, 1.0, 0.0], [0.0, -0.042_942, 1.042_942]];
    let values = [150_u8, 120, 100];
    let srgb_curve = |v: f64| Rgb([v; 3]).linear().0[0];
    let gamma = |v: f64| v.powf(563.0 / 256.0);
    let curves: [&dyn Fn(f64) -> f64; 2] = [&srgb_curve, &gamma];
    let profiles = [ColorProfile::new_display_p3(), ColorProfile::new_adobe_rgb()];
    let cases = profiles.into_iter().zip([p3, adobe]).zip(curves);
    // Bytes as the file has them: a JPEG rounds colours before it stores them.
    let stored = |file: &[u8]| {
        let bytes = image::load_from_memory(file).unwrap().to_rgb8()[(4, 4)].0;
        bytes.map(|byte| f64::from(byte) / 255.0)
    };
    for ((profile, matrix), curve) in cases {
        for file in with_profile(values, &profile) {
            let light = stored(&file).map(curve);
            let wanted = matrix.map(|row| row.iter().zip(light).map(|(m, l)| m * l).sum::<f64>());
            near(linear(&file), wanted, 5e-4);
            let moved = f64::from(linear(&file)[0]) - srgb_curve(stored(&file)[0]);
            assert!(moved.abs() > 0.01, "the profile was used: {moved}");
        }
    }
    for file in with_profile(values, &ColorProfile::new_srgb()) {
        near(linear(&file), stored(&file).map(srgb_curve), 5e-4);
    }
}

#[test]
fn inks_and_damaged_profiles_are_refused_with_a_way_out() {
    let inks = vec![90_u8; 4 * 64];
    let mut tiff = Cursor::new(Vec::new());
    tiff::encoder::TiffEncoder::new(&mut tiff)
        .unwrap()
        .write_image::<tiff::encoder::colortype::CMYK8>(8, 8, &inks)
        .unwrap();
    let mut png = Vec::new();
    let mut encoder = PngEncoder::new(&mut png);
    encoder.set_icc_profile(b"no profile".to_vec()).unwrap();
    encoder.write_image(&[1, 2, 3], 1, 1, ExtendedColorType::Rgb8).unwrap();
    for (bytes, said) in [(tiff.into_inner(), "inks (CMYK)"), (png, "colour profile")] {
        let error = Photograph::from_bytes("press.tif", &bytes).unwrap_err();
        assert!(matches!(error, PhotographError::Profile { .. }), "{error}");
        let text = error.to_string();
        assert!(text.starts_with("press.tif: ") && text.contains(said), "{text}");
        assert!(error.hint().unwrap().to_string().contains("sRGB"), "a way out");
    }
}
