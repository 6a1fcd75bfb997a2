//! Paint and reflectance read from a rectangle of a painting.

use graphics::tile::Rect;
use paint::painting::{LayerRef, PaintingError};
use paint::scene::SpectralDocument;

use super::studio::{bare, crossing, on_both};

const RECTS: [Rect; 4] = [
    Rect { x: 0, y: 0, width: 130, height: 100 },
    Rect { x: 61, y: 13, width: 9, height: 58 },
    Rect { x: 40, y: 40, width: 1, height: 1 },
    Rect { x: 100, y: 70, width: 30, height: 30 },
];

#[test]
fn a_part_of_wet_and_dry_paint_is_that_of_the_whole() {
    for mut painting in on_both(&bare(130, 100)) {
        crossing(&mut painting);
        painting.dry(0.6).unwrap();
        crossing(&mut painting);
        painting.dry(0.3).unwrap();
        let document = painting.document().unwrap();
        for rect in RECTS {
            assert!(painting.wet_in(rect).unwrap() == document.wet.part(rect), "{rect:?}");
            for (index, layer) in document.dry.iter().enumerate() {
                let found = painting.dry_in(index, rect).unwrap();
                assert!(found == layer.paint.part(rect), "layer {index}, {rect:?}");
            }
        }
        let error = painting.dry_in(2, RECTS[1]).unwrap_err();
        assert!(matches!(error, PaintingError::NoLayer { index: 2, count: 2 }), "{error}");
    }
}

#[test]
fn the_reflectance_of_a_place_is_the_mean_of_its_cells() {
    for mut painting in on_both(&bare(130, 100)) {
        crossing(&mut painting);
        painting.dry(0.6).unwrap();
        painting.set_opacity(LayerRef::Dry(0), 1.7).unwrap();
        crossing(&mut painting);
        let document = painting.document().unwrap();
        let spectral = SpectralDocument::full(&document);
        for rect in &RECTS[1..] {
            let found = painting.reflectance_in(*rect).unwrap();
            let mut wanted = vec![0.0; spectral.count()];
            for y in rect.y..rect.y + rect.height {
                for x in rect.x..rect.x + rect.width {
                    for (sum, one) in wanted.iter_mut().zip(spectral.measured_reflectance(x, y)) {
                        *sum += one;
                    }
                }
            }
            let cells = (rect.width * rect.height) as f64;
            assert_eq!(found.len(), wanted.len());
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found - wanted / cells).abs() < 1e-12, "{found} of {rect:?}");
            }
            let unlike = found.iter().any(|value| (value - found[0]).abs() > 0.01);
            assert!(unlike, "a flat spectrum, {found:?}, at {rect:?}");
        }
    }
}
