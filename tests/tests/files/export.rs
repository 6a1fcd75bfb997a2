//! Exported pictures, read back with independent readers: pigment maps with scale, file names and
//! volumes, OpenEXR of linear RGB and of spectra, and PNG with sRGB curve, chunks of colour space
//! and size, clipping and refusals.

use std::io::Cursor;

use exr::prelude::{AttributeValue, FlatImage, FlatSamples, ReadChannels, ReadLayers, Text, Vec2};
use graphics::export::{ExportError, linear_exr, png8, png16};
use graphics::field::Field;
use paint::export::{NamedFile, PigmentMap, pigment_maps, spectral_exr};
use spectra::color::Rgb;
use suite::golden::assert_near;

fn map(name: &str, height_mm: impl Fn(usize) -> f32) -> PigmentMap {
    let values = (0..12).map(height_mm).collect();
    PigmentMap { name: name.to_owned(), height_mm: Field::from_values(4, 3, values) }
}

fn three() -> Vec<PigmentMap> {
    vec![
        map("Zinc White", |i| i as f32 * 0.01),
        map("Blue, \"dark\"", |i| if i == 11 { 0.09 } else { 0.0 }),
        map("Zinc white", |_| 0.0),
    ]
}

fn file<'a>(files: &'a [NamedFile], name: &str) -> &'a [u8] {
    let names: Vec<_> = files.iter().map(|file| &file.name).collect();
    let found = files.iter().find(|file| file.name == name);
    &found.unwrap_or_else(|| panic!("no {name} in {names:?}")).bytes
}

#[test]
fn maps_give_millimetres_back_by_their_scale() {
    let files = pigment_maps("study", &three(), 0.2).unwrap();
    let sidecar: serde_json::Value =
        serde_json::from_slice(file(&files, "study.maps.json")).unwrap();
    let scale = sidecar["mm_at_65535"].as_f64().unwrap();
    // The thickest cell gives the scale: 0.11 mm of white and 0.09 mm of blue.
    assert_near("scale", &[scale], &[0.2], 1e-7);
    assert_eq!(sidecar["width_mm"], 0.8);
    for (index, map) in three().iter().enumerate() {
        assert_eq!(sidecar["maps"][index]["pigment"], *map.name);
        let png = file(&files, sidecar["maps"][index]["file"].as_str().unwrap());
        let image = image::load_from_memory(png).unwrap();
        let grey = image.as_luma16().unwrap();
        let got: Vec<f64> = grey.iter().map(|v| f64::from(*v) * scale / 65535.0).collect();
        let wanted: Vec<f64> = map.height_mm.values().iter().map(|mm| f64::from(*mm)).collect();
        assert_near(&map.name, &got, &wanted, 0.51 * scale / 65535.0);
    }
    let total = file(&files, sidecar["thickness"]["file"].as_str().unwrap());
    let total = image::load_from_memory(total).unwrap();
    assert_eq!(total.as_luma16().unwrap().iter().max(), Some(&65535));
    let names: Vec<_> = files.iter().map(|file| file.name.as_str()).collect();
    let wanted = [
        "study.zinc-white.png",
        "study.blue---dark-.png",
        "study.zinc-white-2.png",
        "study.thickness.png",
        "study.maps.json",
        "study.recipe.csv",
    ];
    assert_eq!(names, wanted);
}

#[test]
fn the_recipe_tells_volumes_and_shares() {
    let files = pigment_maps("study", &three(), 0.2).unwrap();
    let mut table = csv::Reader::from_reader(file(&files, "study.recipe.csv"));
    let rows: Vec<_> = table.records().map(|row| row.unwrap()).collect();
    assert_eq!(rows[1][0], *"Blue, \"dark\"");
    // The heights of white sum to 0.66 mm over 12 cells of 0.04 mm2. One cell has 0.09 mm of blue.
    for (row, name, wanted, tolerance) in [
        (0_usize, "white", [0.0264, 0.88, 0.055, 0.11, 11.0 / 12.0], 1e-5),
        (1, "blue", [0.0036, 0.12, 0.0075, 0.09, 1.0 / 12.0], 1e-5),
        (2, "none", [0.0; 5], 0.0),
    ] {
        let figures: Vec<f64> =
            rows[row].iter().skip(1).map(|text| text.parse().unwrap()).collect();
        assert_near(name, &figures, &wanted, tolerance);
    }
}

#[test]
fn no_paint_makes_black_maps() {
    let files = pigment_maps("bare", &[map("Zinc White", |_| 0.0)], 0.2).unwrap();
    let image = image::load_from_memory(file(&files, "bare.zinc-white.png")).unwrap();
    assert!(image.as_luma16().unwrap().iter().all(|v| *v == 0), "black");
}

#[test]
fn maps_that_are_no_amounts_are_refused() {
    let odd = PigmentMap { name: "B".to_owned(), height_mm: Field::filled(3, 4, 0.0) };
    let cases = [
        (vec![], "found `0 x 0`"),
        (vec![map("A", |_| 0.0), odd], "`B` has another size than the picture of 4 x 3"),
        (vec![map("A", |i| if i == 6 { -0.5 } else { 0.0 })], "A at x 2, y 1 is 0 and up"),
        (vec![map("A", |i| if i == 6 { f32::NAN } else { 0.0 })], "A at x 2, y 1 is not a finite"),
    ];
    for (maps, wanted) in cases {
        let error = pigment_maps("x", &maps, 0.1).unwrap_err().to_string();
        assert!(error.contains(wanted), "{error} for {wanted}");
    }
}

const CELL_MM: f64 = 0.1;

fn picture() -> Field<[f32; 4]> {
    Field::from_values(
        5,
        3,
        (0..15).map(|i: usize| [i as f32 / 7.0, -0.125, 2.5 * i as f32, 1.0]).collect(),
    )
}

fn opened(bytes: &[u8]) -> FlatImage {
    exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .unwrap()
}

fn samples(image: &FlatImage, name: &str) -> Vec<f64> {
    let list = &image.layer_data[0].channel_data.list;
    let channel = list.iter().find(|channel| channel.name.eq(name));
    let channel = channel.unwrap_or_else(|| panic!("no `{name}`"));
    channel.sample_data.values_as_f32().map(f64::from).collect()
}

#[test]
fn linear_light_comes_back_unclipped_with_its_primaries() {
    let picture = picture();
    let image = opened(&linear_exr(&picture, CELL_MM).unwrap());
    for (index, name) in ["R", "G", "B"].iter().enumerate() {
        let wanted: Vec<f64> = picture.values().iter().map(|rgb| f64::from(rgb[index])).collect();
        assert_near(name, &samples(&image, name), &wanted, 0.0);
    }
    let channel = &image.layer_data[0].channel_data.list[0];
    assert!(matches!(channel.sample_data, FlatSamples::F32(_)));
    let found = image.attributes.chromaticities.unwrap();
    // Primaries and white of sRGB, IEC 61966-2-1.
    let wanted = [(0.64, 0.33), (0.30, 0.60), (0.15, 0.06), (0.3127, 0.3290)];
    for (Vec2(x, y), (wanted_x, wanted_y)) in
        [found.red, found.green, found.blue, found.white].into_iter().zip(wanted)
    {
        let got = [f64::from(x), f64::from(y)];
        assert_near("chromaticities", &got, &[wanted_x, wanted_y], 1e-6);
    }
    assert_eq!(image.layer_data[0].attributes.horizontal_density, Some(254.0));
}

#[test]
fn spectra_stand_in_the_published_channels() {
    let nm = [400.0, 457.123_456_7, 700.0];
    let planes: Vec<_> = (0..3).map(|i| Field::filled(5, 3, 0.25 * i as f32)).collect();
    let bytes = spectral_exr(&picture(), &nm, &planes, CELL_MM).unwrap();
    assert_eq!(bytes, spectral_exr(&picture(), &nm, &planes, CELL_MM).unwrap());
    let image = opened(&bytes);
    let list = &image.layer_data[0].channel_data.list;
    let names: Vec<String> = list.iter().map(|channel| channel.name.to_string()).collect();
    let wanted = ["B", "G", "R", "T.400,000000nm", "T.457,123457nm", "T.700,000000nm"];
    assert_eq!(names, wanted);
    assert_near("700 nm", &samples(&image, "T.700,000000nm"), &[0.5; 15], 0.0);
    let version = image.layer_data[0].attributes.other.get(&Text::from("spectralLayoutVersion"));
    assert_eq!(version, Some(&AttributeValue::Text("1.0".into())));
}

#[test]
fn spectra_that_do_not_fit_are_refused() {
    fn plane(value: f32) -> Field<f32> {
        Field::filled(5, 3, value)
    }
    let small = Field::filled(4, 3, 0.5);
    let cases = [
        (vec![400.0], vec![plane(0.1), plane(0.2)], "found `1 wavelengths` for plane 2"),
        (vec![500.0, 400.0], vec![plane(0.1), plane(0.2)], "found `400` for plane 1"),
        (vec![f64::NAN], vec![plane(0.1)], "found `NaN` for plane 0"),
        (vec![400.0], vec![small], "`T.400,000000nm` has another size than the picture of 5 x 3"),
        (vec![400.0], vec![plane(f32::NAN)], "the reflectance at 400 nm at x 0, y 0"),
    ];
    for (nm, planes, wanted) in cases {
        let error = spectral_exr(&picture(), &nm, &planes, CELL_MM).unwrap_err().to_string();
        assert!(error.contains(wanted), "{error} for {wanted}");
    }
}

#[test]
fn infinite_light_is_refused_and_very_bright_light_is_not() {
    let mut picture = picture();
    picture[(1, 2)][2] = 1e6;
    assert!(linear_exr(&picture, CELL_MM).is_ok(), "32-bit floats hold the value");
    picture[(1, 2)][2] = f32::INFINITY;
    let error = linear_exr(&picture, CELL_MM).unwrap_err().to_string();
    assert!(error.contains("the colour at x 1, y 2"), "{error}");
}

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
        let [profile, pixels] = [b"cICP", b"IDAT"]
            .map(|name| png.bytes.windows(4).position(|window| window == name).unwrap());
        assert!(profile < pixels, "the colour space must precede the pixels");
    }
}

#[test]
fn colors_out_of_gamut_keep_hue_and_lightness_and_are_counted() {
    let mut picture = ramp();
    picture[(3, 0)] = [1.5, -0.25, 0.5, 1.0];
    picture[(4, 0)] = [0.0, 0.0, -0.1, 1.0];
    // An excess of the size of a rounding error does not count.
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
    assert_eq!(error.to_string(), "the colour at x 7, y 3 is not a finite number, found `NaN`");
    let nothing = Field::filled(0, 3, [0.0; 4]);
    assert_eq!(png16(&nothing, 0.1).unwrap_err(), ExportError::Size { width: 0, height: 3 });
    for cell_mm in [0.0, -1.0, f64::NAN, 1e9] {
        assert!(png8(&ramp(), cell_mm).is_err(), "{cell_mm}");
    }
}
