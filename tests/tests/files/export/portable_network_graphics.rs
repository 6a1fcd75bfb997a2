//! PNG export: sRGB curve, chunks of colour space and size, clipping, refused pictures.

use graphics::export::{ExportError, png8, png16};
use graphics::field::Field;
use spectra::color::Rgb;
use suite::near::assert_near;

fn ramp() -> Field<[f32; 4]> {
    Field::from_values(
        32,
        8,
        (0..256)
            .map(|i: usize| {
                let v = i as f32 / 255.0;
                [v, v * v, 1.0 - v, 1.0]
            })
            .collect(),
    )
}

/// The sRGB transfer curve with the constants printed in IEC 61966-2-1.
fn curve(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

fn chunk<'a>(bytes: &'a [u8], name: &[u8; 4]) -> Option<&'a [u8]> {
    let at = bytes.windows(4).position(|window| window == name)?;
    let length = u32::from_be_bytes(bytes[at - 4..at].try_into().unwrap()) as usize;
    Some(&bytes[at + 4..][..length])
}

#[test]
fn pictures_follow_the_curve_of_srgb_in_both_depths() {
    let picture = ramp();
    for (png, highest, tolerance) in [
        (png8(&picture, 0.1).unwrap(), 255.0, 0.5 / 255.0),
        (png16(&picture, 0.1).unwrap(), 65535.0, 0.5 / 65535.0),
    ] {
        assert_eq!(png.outside, 0);
        let image = image::load_from_memory(&png.bytes).unwrap();
        let got: Vec<f64> = match image {
            image::DynamicImage::ImageRgb8(image) => image.iter().map(|v| f64::from(*v)).collect(),
            image::DynamicImage::ImageRgb16(image) => image.iter().map(|v| f64::from(*v)).collect(),
            other => panic!("{:?}", other.color()),
        };
        let got: Vec<f64> = got.iter().map(|v| v / highest).collect();
        let wanted: Vec<f64> = picture
            .values()
            .iter()
            .flat_map(|c| [c[0], c[1], c[2]])
            .map(|v| curve(f64::from(v)))
            .collect();
        // The curve with printed constants and the exact curve differ by about 1e-7.
        assert_near("sRGB", &got, &wanted, tolerance + 1e-6);
    }
}

#[test]
fn pictures_say_what_they_are_and_how_large() {
    for png in [png8(&ramp(), 0.1).unwrap(), png16(&ramp(), 0.1).unwrap()] {
        assert_eq!(chunk(&png.bytes, b"sRGB"), Some(&[1][..]));
        assert_eq!(chunk(&png.bytes, b"cICP"), Some(&[1, 13, 0, 1][..]));
        let [x, y] = [10_000_u32; 2].map(u32::to_be_bytes);
        assert_eq!(chunk(&png.bytes, b"pHYs"), Some(&[&x[..], &y[..], &[1]].concat()[..]));
        let at = |name: &[u8]| png.bytes.windows(4).position(|window| window == name).unwrap();
        assert!(at(b"cICP") < at(b"IDAT"), "the colour space must precede the pixels");
    }
}

#[test]
fn colors_out_of_gamut_keep_hue_and_lightness_and_are_counted() {
    let mut picture = ramp();
    picture[(3, 0)] = [1.5, -0.25, 0.5, 1.0];
    picture[(4, 0)] = [0.0, 0.0, -0.1, 1.0];
    // An excess of the size of a rounding error is not counted.
    picture[(5, 0)] = [1.000_000_1, 0.0, 0.0, 1.0];
    let png = png8(&picture, 0.1).unwrap();
    assert_eq!(png.outside, 2);
    let image = image::load_from_memory(&png.bytes).unwrap().into_rgb8();
    let shown = Rgb([1.5, -0.25, 0.5]).mapped_into_gamut().encoded().to_bytes();
    assert_eq!(image.get_pixel(3, 0).0, shown);
    assert_ne!(shown, [255, 0, 188], "channels are not cut off one by one");
}

#[test]
fn the_same_picture_gives_the_same_bytes() {
    assert_eq!(png8(&ramp(), 0.1).unwrap(), png8(&ramp(), 0.1).unwrap());
    assert_eq!(png16(&ramp(), 0.1).unwrap(), png16(&ramp(), 0.1).unwrap());
}

#[test]
fn pictures_without_colors_or_cells_are_refused() {
    let mut picture = ramp();
    picture[(7, 3)][1] = f32::NAN;
    let error = png8(&picture, 0.1).unwrap_err();
    assert_eq!(error.to_string(), "the colour at x 7, y 3 is no finite number, found `NaN`");
    let nothing = Field::filled(0, 3, [0.0; 4]);
    assert_eq!(png16(&nothing, 0.1).unwrap_err(), ExportError::Size { width: 0, height: 3 });
    for cell_mm in [0.0, -1.0, f64::NAN, 1e9] {
        assert!(png8(&ramp(), cell_mm).is_err(), "{cell_mm}");
    }
}
