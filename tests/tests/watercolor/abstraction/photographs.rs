//! Abstraction of photographs: regions, opacity, size, and CPU against GPU.

use std::io::Cursor;

use documents::hint::Explain;
use graphics::compute::Compute;
use graphics::picture::Photograph;
use graphics::segmentation::SegmentationSettings;
use image::{ImageFormat, Rgba, RgbaImage};
use suite::adapter::device;
use watercolor::{AbstractionError, RegionSettings, abstract_photograph};

/// Three bands: opaque red with a grey speck and one lighter pixel, half transparent blue, and
/// full transparency.
fn photograph() -> Photograph {
    let picture = RgbaImage::from_fn(90, 60, |x, y| match x {
        10..=11 if (30..32).contains(&y) => Rgba([90, 90, 90, 255]),
        20 if y == 50 => Rgba([203, 40, 30, 255]),
        0..30 => Rgba([200, 40, 30, 255]),
        30..60 => Rgba([30, 60, 180, 128]),
        _ => Rgba([0, 0, 0, 0]),
    });
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).expect("memory takes it");
    Photograph::from_bytes("made.png", bytes.get_ref()).expect("it was just written")
}

fn settings(smoothing_radius_px: u32) -> RegionSettings {
    let segmentation = SegmentationSettings {
        spatial_radius_px: 4.0,
        range_radius: 8.0,
        least_region_px: 2,
        tone_step: 0.0,
    };
    RegionSettings { segmentation, smoothing_radius_px }
}

#[test]
fn photographs_become_flat_with_their_opacity() {
    let found = abstract_photograph(&mut Compute::cpu(), &photograph(), 90, &settings(3)).unwrap();
    assert_eq!((found.original.width(), found.original.height()), (90, 60));
    assert_eq!(found.regions, 4);
    let near = |found: [f32; 4], wanted: [f32; 4]| {
        found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 2e-5)
    };
    let bytes = |rgba: [u8; 4]| rgba.map(|byte| f32::from(byte) / 255.0);
    for stage in [&found.original, &found.segmented, &found.smoothed] {
        assert!(near(stage[(5, 5)], bytes([200, 40, 30, 255])), "{:?}", stage[(5, 5)]);
        assert!(near(stage[(45, 5)], bytes([30, 60, 180, 128])), "{:?}", stage[(45, 5)]);
        assert_eq!(stage[(80, 5)], [1.0, 1.0, 1.0, 0.0]);
    }
    // One pixel of the red is a little lighter; segmentation gives its region one colour.
    assert!(near(found.original[(20, 50)], bytes([203, 40, 30, 255])), "as it was read");
    assert_eq!(found.segmented[(20, 50)], found.segmented[(5, 5)], "one region, one colour");
    assert!(near(found.segmented[(10, 30)], bytes([90, 90, 90, 255])));
    assert!(near(found.smoothed[(10, 30)], bytes([200, 40, 30, 255])));
}

#[test]
fn the_width_is_as_asked_and_the_shape_kept() {
    let found = abstract_photograph(&mut Compute::cpu(), &photograph(), 33, &settings(0)).unwrap();
    assert_eq!((found.smoothed.width(), found.smoothed.height()), (33, 22));
    assert_eq!(found.smoothed, found.segmented);
}

#[test]
fn processor_and_device_abstract_the_same() {
    let Some(mut gpu) = device().map(Compute::gpu) else { return };
    let here = abstract_photograph(&mut Compute::cpu(), &photograph(), 60, &settings(2)).unwrap();
    assert!(abstract_photograph(&mut gpu, &photograph(), 60, &settings(2)).unwrap() == here);
}

#[test]
fn what_cannot_be_is_told() {
    let told = |width, settings| {
        abstract_photograph(&mut Compute::cpu(), &photograph(), width, &settings).unwrap_err()
    };
    assert!(matches!(told(0, settings(1)), AbstractionError::NoWidth));
    let large = told(90, settings(500));
    assert!(matches!(large, AbstractionError::Smoothing { found: 500 }), "{large}");
    let mut flat = settings(1);
    flat.segmentation.range_radius = -1.0;
    let error = told(90, flat);
    assert_eq!(error.to_string(), "a range radius is a number above 0, found `-1`");
    assert!(error.hint().unwrap().to_string().contains("flatter"));
}
