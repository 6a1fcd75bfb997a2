//! Reads photographs: bit depth, transparency, resampling, EXIF orientation, broken files, TIFF and
//! WebP, and ICC profiles of wide gamut.

use std::io::Cursor;

use documents::hint::{Explain, Fault};
use graphics::picture_formats::MOST_SIDE;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::codecs::webp::WebPEncoder;
use image::{
    DynamicImage, ExtendedColorType, GrayAlphaImage, GrayImage, ImageEncoder, ImageFormat,
    RgbImage, RgbaImage,
};
use moxcms::ColorProfile;
use spectra::color::Rgb;
use strokes::{MOST_PIXELS, Photograph, PhotographError};

fn png(image: impl Into<DynamicImage>) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.into().write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

fn read(bytes: &[u8]) -> Photograph {
    Photograph::from_bytes("made.png", bytes).unwrap()
}

fn one(bytes: &[u8]) -> [f32; 3] {
    read(bytes).on_canvas(1, 1)[(0, 0)]
}

fn near(found: [f32; 3], wanted: [f64; 3]) {
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((f64::from(*found) - wanted).abs() < 1e-6, "{found} for {wanted}");
    }
}

#[test]
fn every_depth_becomes_linear_light() {
    fn decoded(value: f64) -> f64 {
        Rgb([value; 3]).linear().0[0]
    }
    near(one(&png(GrayImage::from_pixel(1, 1, [100].into()))), [decoded(100.0 / 255.0); 3]);
    let color = [10.0, 128.0, 250.0].map(|value| decoded(value / 255.0));
    near(one(&png(RgbImage::from_pixel(1, 1, [10, 128, 250].into()))), color);
    let deep =
        image::ImageBuffer::<image::Rgb<u16>, _>::from_pixel(1, 1, [9, 40_000, 65_535].into());
    near(one(&png(deep)), [9.0, 40_000.0, 65_535.0].map(|value| decoded(value / 65_535.0)));
    let grey = image::ImageBuffer::<image::Luma<u16>, _>::from_pixel(1, 1, [30_000].into());
    near(one(&png(grey)), [decoded(30_000.0 / 65_535.0); 3]);
}

#[test]
fn transparent_parts_are_white() {
    near(one(&png(RgbaImage::from_pixel(1, 1, [255, 0, 0, 0].into()))), [1.0; 3]);
    let half = one(&png(RgbaImage::from_pixel(1, 1, [255, 0, 0, 51].into())));
    near(half, [1.0, 0.8, 0.8]);
    near(one(&png(GrayAlphaImage::from_pixel(1, 1, [0, 51].into()))), [0.8; 3]);
}

#[test]
fn cells_are_means_of_linear_light() {
    let checks =
        RgbImage::from_fn(64, 64, |x, y| [if (x + y) % 2 == 0 { 255 } else { 0 }; 3].into());
    let canvas = read(&png(checks)).on_canvas(10, 10);
    for value in canvas.values() {
        assert!((value[0] - 0.5).abs() < 0.02, "{value:?}");
    }
    let mean: f32 = canvas.values().iter().map(|value| value[0]).sum::<f32>() / 100.0;
    assert!((mean - 0.5).abs() < 1e-5, "{mean}");
}

#[test]
fn a_photograph_is_stretched_to_another_shape() {
    // Red, green and blue thirds.
    let thirds = RgbImage::from_fn(30, 10, |x, _| {
        let mut color = [0; 3];
        color[x as usize / 10] = 255;
        color.into()
    });
    let photograph = read(&png(thirds));
    assert_eq!(photograph.size(), (30, 10));
    let stretched = photograph.on_canvas(3, 3);
    assert_eq!(stretched.row(1, 0, 3), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    // The cells are smaller than pixels: interpolation makes no cell darker or brighter.
    let fine = photograph.on_canvas(90, 30);
    for value in fine.values() {
        assert!((value.iter().sum::<f32>() - 1.0).abs() < 1e-5, "{value:?}");
    }
}

/// A JPEG of two halves, white on the left and black on the right, with an EXIF orientation.
fn turned(orientation: u8) -> Vec<u8> {
    let halves = GrayImage::from_fn(32, 16, |x, _| [if x < 16 { 255 } else { 0 }].into());
    let mut plain = Vec::new();
    JpegEncoder::new(&mut plain)
        .write_image(halves.as_raw(), 32, 16, ExtendedColorType::L8)
        .unwrap();
    // APP1 holds a TIFF header, one entry (0x0112, SHORT, 1), and no further directory.
    let mut exif = b"Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0".to_vec();
    exif.extend([orientation, 0, 0, 0, 0, 0, 0]);
    let mut bytes = plain[..2].to_vec();
    bytes.extend([0xff, 0xe1]);
    bytes.extend((exif.len() as u16 + 2).to_be_bytes());
    bytes.extend(exif);
    bytes.extend(&plain[2..]);
    bytes
}

#[test]
fn photographs_are_turned_as_their_exif_says() {
    for (orientation, wanted) in [
        (1, ((32, 16), [true, false, true])),
        (3, ((32, 16), [false, true, false])),
        (6, ((16, 32), [true, true, false])),
        (8, ((16, 32), [false, false, true])),
    ] {
        let photograph = Photograph::from_bytes("made.jpg", &turned(orientation)).unwrap();
        let (width, height) = photograph.size();
        let canvas = photograph.on_canvas(width, height);
        let corners = [(1, 1), (width - 2, 1), (1, height - 2)].map(|at| canvas[at][0] > 0.5);
        assert_eq!(((width, height), corners), wanted);
    }
}

#[test]
fn a_broken_file_is_refused_by_its_name() {
    let whole = png(RgbImage::from_pixel(40, 40, [1, 2, 3].into()));
    for bytes in [&whole[..0], &whole[..20], &whole[..whole.len() / 2], b"no picture at all"] {
        let error = Photograph::from_bytes("sky.png", bytes).unwrap_err();
        assert!(matches!(error, PhotographError::NoPicture { .. }), "{error}");
        assert!(error.to_string().starts_with("sky.png: "), "{error}");
        assert_eq!(error.fault(), Fault::Input, "{error}");
    }
    let error = Photograph::open(std::path::Path::new("no/such/sky.png")).unwrap_err();
    assert!(error.to_string().starts_with("no/such/sky.png: "), "{error}");
    assert_eq!(error.fault(), Fault::Environment, "{error}");
}

#[test]
fn too_many_pixels_are_refused_before_they_are_read() {
    // The headers of these PNG files claim many pixels, but there is data for one.
    fn claiming(width: u32, height: u32) -> Vec<u8> {
        let whole = png(GrayImage::from_pixel(1, 1, [0].into()));
        let mut head = whole[..29].to_vec();
        head[16..20].copy_from_slice(&width.to_be_bytes());
        head[20..24].copy_from_slice(&height.to_be_bytes());
        head.extend(crc(&head[12..29]).to_be_bytes());
        head.extend(&whole[33..]);
        head
    }
    for (width, height) in [(134_000_000, 1), (1, MOST_SIDE + 1)] {
        let error = Photograph::from_bytes("wall.png", &claiming(width, height)).unwrap_err();
        assert_eq!(
            error.to_string(),
            format!(
                "wall.png: a photograph has {MOST_SIDE} pixels a side at most, found `{width} x {height}`"
            )
        );
    }
    let error = Photograph::from_bytes("wall.png", &claiming(20_000, 20_000)).unwrap_err();
    assert!(matches!(error, PhotographError::TooLarge { .. }), "{error}");
    let message =
        format!("wall.png: a photograph has {MOST_PIXELS} pixels at most, found `20000 x 20000`");
    assert_eq!(error.to_string(), message);
}

fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 }
        })
    })
}

type Deep = image::ImageBuffer<image::Rgb<u16>, Vec<u16>>;

fn linear(bytes: &[u8]) -> [f32; 3] {
    Photograph::from_bytes("made", bytes).unwrap().on_canvas(1, 1)[(0, 0)]
}

fn near_in_profile(found: [f32; 3], wanted: [f64; 3], tolerance: f64) {
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
    near_in_profile(linear(&written(deep, ImageFormat::Tiff)), wanted, 1e-6);
    let flat = RgbImage::from_pixel(8, 8, [10, 128, 250].into());
    let wanted = [10.0, 128.0, 250.0].map(|v| Rgb([v / 255.0; 3]).linear().0[0]);
    near_in_profile(linear(&written(flat, ImageFormat::WebP)), wanted, 1e-6);
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

/// A picture of 8 x 8 pixels of one colour with a profile, in each format that can have one.
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
    fn srgb_curve(v: f64) -> f64 {
        Rgb([v; 3]).linear().0[0]
    }
    fn gamma(v: f64) -> f64 {
        v.powf(563.0 / 256.0)
    }
    let curves: [fn(f64) -> f64; 2] = [srgb_curve, gamma];
    let profiles = [ColorProfile::new_display_p3(), ColorProfile::new_adobe_rgb()];
    let cases = profiles.into_iter().zip([p3, adobe]).zip(curves);
    // A JPEG rounds colours before it stores them, so we take the bytes of the file.
    fn stored(file: &[u8]) -> [f64; 3] {
        let bytes = image::load_from_memory(file).unwrap().to_rgb8()[(4, 4)].0;
        bytes.map(|byte| f64::from(byte) / 255.0)
    }
    for ((profile, matrix), curve) in cases {
        for file in with_profile(values, &profile) {
            let light = stored(&file).map(curve);
            let wanted = matrix.map(|row| row.iter().zip(light).map(|(m, l)| m * l).sum::<f64>());
            near_in_profile(linear(&file), wanted, 5e-4);
            let moved = f64::from(linear(&file)[0]) - srgb_curve(stored(&file)[0]);
            assert!(moved.abs() > 0.01, "the profile was used: {moved}");
        }
    }
    for file in with_profile(values, &ColorProfile::new_srgb()) {
        near_in_profile(linear(&file), stored(&file).map(srgb_curve), 5e-4);
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
