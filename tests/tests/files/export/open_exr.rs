//! OpenEXR export of linear RGB and of spectra.

use std::io::Cursor;

use exr::prelude::{AttributeValue, FlatImage, FlatSamples, ReadChannels, ReadLayers, Text, Vec2};
use graphics::export::linear_exr;
use graphics::field::Field;
use paint::export::spectral_exr;
use suite::near::assert_near;

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
    let plane = |value: f32| Field::filled(5, 3, value);
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
