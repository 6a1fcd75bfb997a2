//! Reading photographs: bit depth, transparency, resampling, EXIF orientation, broken files.

use std::io::Cursor;

use documents::hint::{Explain, Fault};
use image::{
    DynamicImage, ExtendedColorType, GrayAlphaImage, GrayImage, ImageEncoder, ImageFormat,
    RgbImage, RgbaImage,
};
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

/// Linear sRGB of a picture of one pixel.
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
    let decoded = |value: f64| Rgb([value; 3]).linear().0[0];
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
    // Cells smaller than pixels: interpolation makes no cell darker or brighter.
    let fine = photograph.on_canvas(90, 30);
    for value in fine.values() {
        assert!((value.iter().sum::<f32>() - 1.0).abs() < 1e-5, "{value:?}");
    }
}

/// A JPEG of two halves, white left, black right, with an EXIF orientation.
fn turned(orientation: u8) -> Vec<u8> {
    let halves = GrayImage::from_fn(32, 16, |x, _| [if x < 16 { 255 } else { 0 }].into());
    let mut plain = Vec::new();
    image::codecs::jpeg::JpegEncoder::new(&mut plain)
        .write_image(halves.as_raw(), 32, 16, ExtendedColorType::L8)
        .unwrap();
    // APP1: TIFF header, one entry (0x0112, SHORT, 1), no further directory.
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
    let corners = |orientation| {
        let photograph = Photograph::from_bytes("made.jpg", &turned(orientation)).unwrap();
        let (width, height) = photograph.size();
        let canvas = photograph.on_canvas(width, height);
        let light = |x, y| canvas[(x, y)][0] > 0.5;
        ((width, height), light(1, 1), light(width - 2, 1), light(1, height - 2))
    };
    assert_eq!(corners(1), ((32, 16), true, false, true));
    assert_eq!(corners(3), ((32, 16), false, true, false));
    assert_eq!(corners(6), ((16, 32), true, true, false));
    assert_eq!(corners(8), ((16, 32), false, false, true));
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
    // A PNG whose header claims 20000 x 20000 pixels, with the data of one.
    let whole = png(GrayImage::from_pixel(1, 1, [0].into()));
    let mut head = whole[..29].to_vec();
    head[16..20].copy_from_slice(&20_000_u32.to_be_bytes());
    head[20..24].copy_from_slice(&20_000_u32.to_be_bytes());
    head.extend(crc(&head[12..29]).to_be_bytes());
    head.extend(&whole[33..]);
    let error = Photograph::from_bytes("wall.png", &head).unwrap_err();
    assert!(matches!(error, PhotographError::TooLarge { .. }), "{error}");
    let told =
        format!("wall.png: a photograph has {MOST_PIXELS} pixels at most, found `20000 x 20000`");
    assert_eq!(error.to_string(), told);
}

/// CRC-32 of a PNG chunk (ISO 3309).
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 }
        })
    })
}
