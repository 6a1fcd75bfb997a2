//! Pictures with several pixels a cell.

use graphics::field::Field;
use paint::document::{Document, Lighting};
use paint::scene::{PixelsPerCell, fine_picture, picture, scene};

use crate::made_up::{document, glazes_over_mixtures, lay, light};

fn pixels(count: u8) -> PixelsPerCell {
    PixelsPerCell::new(count).unwrap()
}

fn both(document: &Document, count: u8) -> [Field<[f32; 4]>; 2] {
    let scene = scene(document, &light(&document.library, "D65"));
    [picture(document, &scene), fine_picture(document, &scene, pixels(count))]
}

#[test]
fn even_paint_keeps_its_bits() {
    let mut even = document(9, 7, &["Vermilion", "Lead White"]);
    for cell in (0..7).flat_map(|y| (0..9).map(move |x| (x, y))) {
        lay(&mut even.wet, cell, &[0.013, 0.02]);
    }
    even.lighting = Lighting { relief: 3.0, elevation_deg: 20.0, ..Lighting::default() };
    for count in 1..=4 {
        let [coarse, fine] = both(&even, count);
        assert_eq!((fine.width(), fine.height()), (9 * usize::from(count), 7 * usize::from(count)));
        assert!(fine.values().iter().all(|rgb| *rgb == coarse.values()[0]), "{count}");
    }
}

#[test]
fn a_picture_keeps_its_mean() {
    let glazes = glazes_over_mixtures();
    let mean = |picture: &Field<[f32; 4]>| -> f64 {
        let sum: f64 = picture.values().iter().map(|rgb| f64::from(rgb[1])).sum();
        sum / picture.values().len() as f64
    };
    for count in 1..=4 {
        let [coarse, fine] = both(&glazes, count);
        let coarse = mean(&coarse);
        let fine = mean(&fine);
        assert!((coarse - fine).abs() < 0.01 * coarse, "{count}: {coarse} {fine}");
    }
}

#[test]
fn the_edge_of_a_slanting_stroke_has_no_stairs() {
    // Paint to the left of a line that moves a cell to the right with each row.
    let edge = |y: f64| y - 0.5;
    let mut slanting = document(40, 40, &["Bone Black"]);
    for cell in (0..40).flat_map(|y| (0..40).map(move |x| (x, y))) {
        let covered = (cell.0 as f64) + 0.5 <= edge(cell.1 as f64 + 0.5) + 0.25;
        lay(&mut slanting.wet, cell, &[if covered { 0.2 } else { 0.0 }]);
    }
    let [coarse, fine] = both(&slanting, 4);
    let middle = 0.5 * (coarse[(0, 39)][1] + coarse[(39, 0)][1]);
    // Span of the distances between the line and the edge of the paint over quarters of a row.
    let stairs = |lighter: &dyn Fn(usize, usize) -> bool| {
        let ends = (32..128).map(|y| {
            let x = (0..160).position(|x| lighter(x, y)).unwrap();
            x as f64 / 4.0 - edge((y as f64 + 0.5) / 4.0)
        });
        let (least, most) = ends.fold((f64::MAX, f64::MIN), |(a, b), d| (a.min(d), b.max(d)));
        most - least
    };
    let cells = stairs(&|x, y| coarse[(x / 4, y / 4)][1] > middle);
    let pixels = stairs(&|x, y| fine[(x, y)][1] > middle);
    assert!(cells > 0.7 && pixels < 0.3, "{cells} {pixels}");
}
