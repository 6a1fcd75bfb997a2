//! Masks: no paint gets on or off covered cells.

use super::bench::{CELL_MM, along, film, loaded, on_cpu, on_gpu};
use crate::brush::{HeadShape, StrokeTool};
use crate::layer::Layer;
use crate::painting::{LayerRef, MaskChange, Painting, PaintingError};

const LINEN: &str = r#"{"kind": "linen"}"#;

/// A triangle over the middle of the canvas.
fn triangle() -> MaskChange {
    MaskChange::PolygonMm(vec![[8.0, 1.0], [33.0, 7.0], [14.0, 15.0]])
}

/// Paints, blends and scrapes over the border of the mask.
fn work(painting: &mut Painting) {
    let brush = loaded(painting, HeadShape::Flat, 5.0);
    painting.stroke(brush, &along(6.0, (3.0, 37.0), 0.7)).unwrap();
    for (tool, y_mm) in [
        (StrokeTool::Blend { strength: 1.0 }, 8.0),
        (StrokeTool::Scrape { height_mm: 0.05 }, 10.0),
        (StrokeTool::Erase { strength: 0.7 }, 11.0),
    ] {
        painting.stroke_as(tool, brush, &along(y_mm, (37.0, 3.0), 0.7)).unwrap();
    }
}

/// Number of covered and of open cells whose paint differs.
fn changed(painting: &Painting, before: &Layer, after: &Layer) -> (usize, usize) {
    let mask = painting.mask().expect("a mask is set");
    let cells = 0..before.vehicle.values().len();
    let (covered, open): (Vec<usize>, Vec<usize>) = cells
        .filter(|&cell| before.cell(cell) != after.cell(cell))
        .partition(|&cell| mask.covers(cell));
    (covered.len(), open.len())
}

#[test]
fn strokes_change_no_covered_cell_and_undo_and_redo_move_the_mask_too() {
    let mut painting = on_cpu(LINEN, 0.3);
    let before = painting.wet().unwrap();
    assert!(painting.change_mask(&triangle()).unwrap());
    work(&mut painting);
    let after = painting.wet().unwrap();
    let (covered, open) = changed(&painting, &before, &after);
    assert!(covered == 0 && open > 1000, "{covered} covered and {open} open cells changed");
    assert!(painting.change_mask(&MaskChange::Inverse(true)).unwrap());
    work(&mut painting);
    let both = painting.wet().unwrap();
    let (covered, open) = changed(&painting, &after, &both);
    assert!(covered == 0 && open > 1000, "{covered} covered and {open} open cells changed");
    for _ in 0..9 {
        painting.undo().unwrap();
    }
    let triangular = painting.mask().expect("the first mask is set").clone();
    assert!(painting.wet().unwrap() == before, "all strokes are undone");
    painting.undo().unwrap();
    assert!(painting.mask().is_none(), "the mask is undone");
    while painting.redo().unwrap() {}
    assert!(painting.wet().unwrap() == both, "all is done again");
    assert_eq!(**painting.mask().unwrap(), triangular.inverse());
}

#[test]
fn both_backends_keep_off_the_mask_to_the_same_bits() {
    let Some(mut device) = on_gpu(LINEN, 0.3) else { return };
    let mut processor = on_cpu(LINEN, 0.3);
    for painting in [&mut device, &mut processor] {
        // Fluid paint levels after a stroke, also beside the head.
        painting.set_stiffness(0.3).unwrap();
        painting.change_mask(&triangle()).unwrap();
        let brush = loaded(painting, HeadShape::Flat, 4.0);
        painting.stroke(brush, &along(6.0, (5.0, 15.0), 0.7)).unwrap();
        let erase = StrokeTool::Erase { strength: 0.7 };
        painting.stroke_as(erase, brush, &along(8.0, (12.0, 6.0), 0.7)).unwrap();
        painting.change_mask(&MaskChange::Clear {}).unwrap();
        painting.stroke(brush, &along(5.0, (5.0, 12.0), 0.5)).unwrap();
    }
    assert!(device.wet().unwrap() == processor.wet().unwrap(), "the backends differ");
}

#[test]
fn paint_that_levels_stays_on_its_side_of_the_border() {
    let mut painting = on_cpu(LINEN, 0.3);
    painting.set_stiffness(0.0).unwrap();
    painting.change_mask(&triangle()).unwrap();
    let before = painting.wet().unwrap();
    let brush = loaded(&mut painting, HeadShape::Flat, 5.0);
    painting.stroke(brush, &along(6.0, (3.0, 37.0), 0.7)).unwrap();
    let after = painting.wet().unwrap();
    assert_eq!(changed(&painting, &before, &after).0, 0, "covered cells changed");
}

#[test]
fn a_mask_by_paint_locks_the_bare_canvas() {
    let mut painting = on_cpu(LINEN, 0.0);
    let brush = loaded(&mut painting, HeadShape::Flat, 4.0);
    painting.stroke(brush, &along(5.0, (4.0, 20.0), 0.6)).unwrap();
    painting.dry(1.0).unwrap();
    painting.stroke(brush, &along(11.0, (4.0, 20.0), 0.6)).unwrap();
    let dry = painting.dry_in(0, painting.bounds()).unwrap();
    let wet = painting.wet().unwrap();
    let painted = |layer: &Layer, cell: usize| layer.cell(cell).volume() > 0;
    for (change, open) in [
        (MaskChange::Layer(LayerRef::Dry(0)), (true, false)),
        (MaskChange::Layer(LayerRef::Wet), (false, true)),
        (MaskChange::Painted {}, (true, true)),
    ] {
        painting.change_mask(&change).unwrap();
        let mask = painting.mask().unwrap();
        for cell in 0..wet.vehicle.values().len() {
            let wanted = open.0 && painted(&dry, cell) || open.1 && painted(&wet, cell);
            assert_eq!(mask.covers(cell), !wanted, "{change:?}, cell {cell}");
        }
    }
    let error = painting.change_mask(&MaskChange::Layer(LayerRef::Dry(1))).unwrap_err();
    assert!(matches!(error, PaintingError::NoLayer { index: 1, count: 1 }), "{error}");
}

#[test]
fn heaps_and_scraping_spare_covered_cells() {
    let mut painting = on_cpu(LINEN, 0.1);
    painting.change_mask(&triangle()).unwrap();
    let before = film(&painting, 0.1);
    let mut recipe = [0.0; crate::layer::SLOTS];
    recipe[0] = 1.0;
    painting.squeeze(&recipe, 0.0, 9.0, 4.0, 30.0).unwrap();
    let heap = painting.wet().unwrap();
    let (covered, open) = changed(&painting, &before, &heap);
    assert!(covered == 0 && open > 20, "{covered} and {open}");
    assert!(painting.scrape().unwrap());
    let scraped = painting.wet().unwrap();
    assert_eq!(changed(&painting, &heap, &scraped).0, 0);
    let mask = painting.mask().unwrap();
    let left = |cell: usize| scraped.cell(cell).volume() > 0;
    let cells = scraped.vehicle.values().len();
    assert!((0..cells).all(|cell| left(cell) == mask.covers(cell)), "{CELL_MM} mm cells");
}

#[test]
fn without_a_mask_there_is_none_to_invert_or_take_off() {
    let mut painting = on_cpu(LINEN, 0.1);
    assert!(!painting.change_mask(&MaskChange::Inverse(true)).unwrap());
    assert!(!painting.change_mask(&MaskChange::Clear {}).unwrap());
    assert_eq!(painting.undo_count(), 0);
}
