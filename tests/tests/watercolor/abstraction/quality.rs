//! Quality of segmentation: regions and boundaries against OpenCV's mean shift.

use graphics::field::Field;
use graphics::segmentation::{SegmentationSettings, segment};
use serde::Deserialize;
use suite::golden::{Golden, read};

use super::known::{Found, Told};

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
    pictures: Vec<Told>,
}

/// Pixels whose label differs from that of the pixel to the right or below.
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

/// Share of the pixels `found` with one of `wanted` within 2 px.
fn near(found: &[(i32, i32)], wanted: &[(i32, i32)]) -> f64 {
    let close = |a: &(i32, i32), b: &(i32, i32)| (a.0 - b.0).pow(2) + (a.1 - b.1).pow(2) <= 4;
    let count = found.iter().filter(|a| wanted.iter().any(|b| close(a, b))).count();
    if found.is_empty() { 0.0 } else { count as f64 / found.len() as f64 }
}

/// Sum of the results of all pictures.
fn whole<'a>(found: impl Iterator<Item = &'a Found>) -> Found {
    let none = Found { regions: 0, recall: 0.0, precision: 0.0 };
    found.fold(none, |sum, found| Found {
        regions: sum.regions + found.regions,
        recall: sum.recall + found.recall,
        precision: sum.precision + found.precision,
    })
}

/// Compares with OpenCV's mean shift filter, whose output is divided into regions by the same
/// rules. On each picture the recall is at most 0.005 below that of any range radius of OpenCV.
/// Over all pictures, against the range radius with the highest recall: no lower recall, no more
/// regions, and a mean precision at most 0.05 lower.
#[test]
fn boundaries_are_found_no_worse_than_by_opencv() {
    let golden: Golden<Cases, Shared> = read("segmentation");
    let Settings { spatial_radius_px, range_radius, least_region_px } = golden.shared.settings;
    let settings =
        SegmentationSettings { spatial_radius_px, range_radius, least_region_px, tone_step: 0.0 };
    let mut own = Vec::new();
    for told in &golden.cases.pictures {
        let (picture, truth) = told.made();
        let segmentation = segment(&picture, &settings).unwrap();
        let edge = edges(&segmentation.labels);
        let wanted = edges(&truth);
        let found = Found {
            regions: segmentation.colors.len(),
            recall: near(&wanted, &edge),
            precision: near(&edge, &wanted),
        };
        for other in &told.opencv {
            assert!(found.recall >= other.recall - 0.005, "{}: {found:?} {other:?}", told.name);
        }
        own.push(found);
    }
    let pictures = &golden.cases.pictures;
    let others = (0..pictures[0].opencv.len())
        .map(|range| whole(pictures.iter().map(|told| &told.opencv[range])));
    let other = others.max_by(|a, b| a.recall.total_cmp(&b.recall)).unwrap();
    let own = whole(own.iter());
    assert!(own.recall >= other.recall, "{own:?}, OpenCV {other:?}");
    assert!(own.regions <= other.regions, "{own:?}, OpenCV {other:?}");
    let lacking = (other.precision - own.precision) / pictures.len() as f64;
    assert!(lacking <= 0.05, "{own:?}, OpenCV {other:?}");
}
