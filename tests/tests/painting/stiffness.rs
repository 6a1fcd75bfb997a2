//! Stiffness of the medium: fluid paint levels after a stroke, stiff paint keeps its furrows.

use paint::brush::HeadShape;
use paint::layer::Layer;

use super::studio::{BLUE, along, bare_on, loaded, on_both};

const COLUMNS: usize = 200;

/// Mean difference in height of neighbouring cells across the middle of a stroke along x, over the
/// mean height there.
fn furrows(wet: &Layer) -> f64 {
    let height = |x: usize, y: usize| f64::from(wet.cell(y * COLUMNS + x).volume());
    let middle = || (80..120).flat_map(|x| (23..37).map(move |y| (x, y)));
    let steps: f64 = middle().map(|(x, y)| (height(x, y + 1) - height(x, y)).abs()).sum();
    steps / middle().map(|(x, y)| height(x, y)).sum::<f64>()
}

#[test]
fn fluid_paint_levels_after_a_stroke_and_stiff_paint_keeps_its_furrows() {
    let mut left = Vec::new();
    for stiffness in [0.0, 0.7, 1.0] {
        let mut document = bare_on(r#"{"kind": "panel", "seed": 1}"#, COLUMNS, 60);
        document.medium.stiffness = stiffness;
        let mut wets = Vec::new();
        for mut painting in on_both(&document) {
            let brush = loaded(&mut painting, HeadShape::Flat, 6.0, BLUE, 1.0);
            let bare = painting.wet().unwrap();
            let before = painting.wet_totals_mm().unwrap();
            painting.stroke(brush, &along(&[(4.0, 6.0), (36.0, 6.0)], 0.5)).unwrap();
            assert_eq!(painting.wet_totals_mm().unwrap(), before, "paint was lost or made");
            wets.push(painting.wet().unwrap());
            painting.undo().unwrap();
            assert!(painting.wet().unwrap() == bare, "an undo leaves levelled paint");
        }
        assert!(wets.windows(2).all(|pair| pair[0] == pair[1]), "backends differ at {stiffness}");
        left.push(furrows(&wets[0]));
    }
    assert!(left[0] < 0.3 * left[1], "{left:?}");
    assert!((left[2] / left[1] - 1.0).abs() < 0.2, "{left:?}");
}
