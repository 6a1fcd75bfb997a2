//! Segmentation and morphology (its quality compared with OpenCV's mean shift), and the abstraction
//! of photographs that uses both: regions, opacity, size, and CPU against GPU. The pictures have
//! known regions and are generated exactly as in `tests/golden/segmentation.py`.

mod segmentation;

use std::io::Cursor;

use documents::hint::Explain;
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::picture::Photograph;
use graphics::segmentation::{SegmentationSettings, segment};
use image::{ImageFormat, Rgba, RgbaImage};
use serde::Deserialize;
use suite::golden::{Golden, read};
use suite::program::device;
use watercolor::{AbstractionError, RegionSettings, abstract_photograph};

const WIDTH: usize = 160;
const HEIGHT: usize = 120;

/// A shape with a soft outline, drawn over the shapes before it. `across` and `down` are the
/// changes of colour to the right and to the bottom. `texture` is the amplitude of a diagonal wave.
#[derive(Deserialize)]
struct Shape {
    kind: String,
    numbers: Vec<f64>,
    rgb: [f64; 3],
    across: [f64; 3],
    down: [f64; 3],
    texture: f64,
    period: f64,
    soft: f64,
}

/// Number of regions found, with recall and precision of their boundaries.
#[derive(Deserialize, Debug)]
struct Found {
    regions: usize,
    recall: f64,
    precision: f64,
}

/// A picture of the golden file, with OpenCV's results by range radius.
#[derive(Deserialize)]
struct MadePicture {
    name: String,
    seed: u64,
    noise: f64,
    shapes: Vec<Shape>,
    fnv: u32,
    opencv: Vec<Found>,
}

/// Linear congruential generator of numbers in 0..1.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 32) as f64 / 4294967296.0
    }
}

impl Shape {
    /// Signed distance of a position from the outline in pixels, negative inside.
    fn distance(&self, x: f64, y: f64) -> f64 {
        let n = &self.numbers;
        match self.kind.as_str() {
            "everywhere" => -1e6,
            "disc" => ((x - n[0]) * (x - n[0]) + (y - n[1]) * (y - n[1])).sqrt() - n[2],
            "half" => n[2] - (n[0] * x + n[1] * y),
            "line" => (n[0] * x + n[1] * y - n[2]).abs() - n[3],
            other => panic!("a shape of kind `{other}`"),
        }
    }
}

impl MadePicture {
    /// The picture in encoded sRGB with coverage, and the index of the topmost shape by pixel.
    fn made(&self) -> (Field<[f32; 4]>, Field<u32>) {
        let mut random = Noise(self.seed);
        let mut truth = Field::filled(WIDTH, HEIGHT, 0);
        let mut bytes = Vec::new();
        for row in 0..HEIGHT {
            for column in 0..WIDTH {
                let x = column as f64;
                let y = row as f64;
                let mut colors = [0.0; 3];
                for (number, shape) in (0..).zip(&self.shapes) {
                    let away = shape.distance(x, y);
                    if away < 0.0 {
                        truth[(column, row)] = number;
                    }
                    let t = (0.5 - away / (2.0 * shape.soft)).clamp(0.0, 1.0);
                    let cover = t * t * (3.0 - 2.0 * t);
                    let turn = (x + 2.0 * y) / shape.period;
                    let turn = turn - turn.trunc();
                    let wave = shape.texture * (4.0 * (turn - 0.5).abs() - 1.0);
                    for (i, color) in colors.iter_mut().enumerate() {
                        let own = shape.rgb[i] + shape.across[i] * (x / WIDTH as f64);
                        let own = own + shape.down[i] * (y / HEIGHT as f64) + wave;
                        *color += cover * (own - *color);
                    }
                }
                for color in colors {
                    let draws = random.next() + random.next() + random.next() + random.next();
                    let value: f64 = color + self.noise * 1.75 * (draws - 2.0);
                    bytes.push((value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
                }
            }
        }
        let found = bytes.iter().fold(2166136261, |sum: u32, &byte: &u8| {
            (sum ^ u32::from(byte)).wrapping_mul(16777619)
        });
        assert_eq!(found, self.fnv, "{}: not the picture given to OpenCV", self.name);
        (opaque(WIDTH, HEIGHT, &bytes), truth)
    }
}

/// An opaque picture of RGB bytes.
fn opaque(width: usize, height: usize, bytes: &[u8]) -> Field<[f32; 4]> {
    Field::from_values(
        width,
        height,
        bytes
            .chunks_exact(3)
            .map(|rgb: &[u8]| [rgb[0], rgb[1], rgb[2], 255].map(|byte| f32::from(byte) / 255.0))
            .collect(),
    )
}

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
    fn near(found: [f32; 4], wanted: [u8; 4]) -> bool {
        let wanted = wanted.map(|byte| f32::from(byte) / 255.0);
        found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 2e-5)
    }
    for stage in [&found.original, &found.segmented, &found.smoothed] {
        assert!(near(stage[(5, 5)], [200, 40, 30, 255]), "{:?}", stage[(5, 5)]);
        assert!(near(stage[(45, 5)], [30, 60, 180, 128]), "{:?}", stage[(45, 5)]);
        assert_eq!(stage[(80, 5)], [1.0, 1.0, 1.0, 0.0]);
    }
    // One pixel of the red is a little lighter. Segmentation gives its region one colour.
    assert!(near(found.original[(20, 50)], [203, 40, 30, 255]), "as it was read");
    assert_eq!(found.segmented[(20, 50)], found.segmented[(5, 5)], "one region, one colour");
    assert!(near(found.segmented[(10, 30)], [90, 90, 90, 255]));
    assert!(near(found.smoothed[(10, 30)], [200, 40, 30, 255]));
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
    let refusal = |width, settings| {
        abstract_photograph(&mut Compute::cpu(), &photograph(), width, &settings).unwrap_err()
    };
    assert!(matches!(refusal(0, settings(1)), AbstractionError::NoWidth));
    let large = refusal(90, settings(500));
    assert!(matches!(large, AbstractionError::Smoothing(500)), "{large}");
    let mut flat = settings(1);
    flat.segmentation.range_radius = -1.0;
    let error = refusal(90, flat);
    assert_eq!(error.to_string(), "a range radius is a number above 0, found `-1`");
    assert!(error.hint().unwrap().to_string().contains("flatter"));
}

#[derive(Deserialize)]
struct Settings {
    spatial_radius_px: f32,
    range_radius: f32,
    least_region_px: u32,
}

#[derive(Deserialize)]
struct Shared {
    settings: Settings,
}

#[derive(Deserialize)]
struct Cases {
    pictures: Vec<MadePicture>,
}

/// Pixels with another label than the pixel to the right or below.
fn edges(labels: &Field<u32>) -> Vec<(i32, i32)> {
    let width = labels.width();
    let height = labels.height();
    let mut found = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let own = labels[(x, y)];
            let right = x + 1 < width && labels[(x + 1, y)] != own;
            if right || (y + 1 < height && labels[(x, y + 1)] != own) {
                found.push((x as i32, y as i32));
            }
        }
    }
    found
}

/// Share of the pixels `found` that have one of `wanted` within 2 px.
fn near(found: &[(i32, i32)], wanted: &[(i32, i32)]) -> f64 {
    let close = found
        .iter()
        .filter(|a| wanted.iter().any(|b| (a.0 - b.0).pow(2) + (a.1 - b.1).pow(2) <= 4));
    let count = close.count();
    if found.is_empty() { 0.0 } else { count as f64 / found.len() as f64 }
}

fn whole<'a>(found: impl Iterator<Item = &'a Found>) -> Found {
    let none = Found { regions: 0, recall: 0.0, precision: 0.0 };
    found.fold(none, |sum, found| Found {
        regions: sum.regions + found.regions,
        recall: sum.recall + found.recall,
        precision: sum.precision + found.precision,
    })
}

/// Compares with OpenCV's mean shift filter. The same rules divide its output into regions. On each
/// picture the recall is at most 0.005 below OpenCV with any range radius. Over all pictures,
/// compared with the range radius of the highest recall, there is no lower recall, there are no
/// more regions, and the mean precision is at most 0.05 lower.
#[test]
fn boundaries_are_found_no_worse_than_by_opencv() {
    let golden: Golden<Cases, Shared> = read("segmentation");
    let Settings { spatial_radius_px, range_radius, least_region_px } = golden.shared.settings;
    let settings =
        SegmentationSettings { spatial_radius_px, range_radius, least_region_px, tone_step: 0.0 };
    let mut own = Vec::new();
    for case in &golden.cases.pictures {
        let (picture, truth) = case.made();
        let segmentation = segment(&picture, &settings).unwrap();
        let edge = edges(&segmentation.labels);
        let wanted = edges(&truth);
        let found = Found {
            regions: segmentation.colors.len(),
            recall: near(&wanted, &edge),
            precision: near(&edge, &wanted),
        };
        for other in &case.opencv {
            assert!(found.recall >= other.recall - 0.005, "{}: {found:?} {other:?}", case.name);
        }
        own.push(found);
    }
    let pictures = &golden.cases.pictures;
    let others = (0..pictures[0].opencv.len())
        .map(|range| whole(pictures.iter().map(|case| &case.opencv[range])));
    let other = others.max_by(|a, b| a.recall.total_cmp(&b.recall)).unwrap();
    let own = whole(own.iter());
    assert!(own.recall >= other.recall, "{own:?}, OpenCV {other:?}");
    assert!(own.regions <= other.regions, "{own:?}, OpenCV {other:?}");
    let lacking = (other.precision - own.precision) / pictures.len() as f64;
    assert!(lacking <= 0.05, "{own:?}, OpenCV {other:?}");
}
