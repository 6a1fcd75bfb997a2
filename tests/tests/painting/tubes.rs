//! Squeezing paint onto a surface, and scraping wet paint off.

use documents::hint::Explain;
use graphics::tile::{Rect, TileSet};
use paint::amount::{QUANTA_PER_CELL, mm_from_quanta};
use paint::brush::HeadShape;
use paint::history::TILE_BYTES;
use paint::layer::SLOTS;
use paint::painting::{Painting, PaintingError};

use super::studio::{BLUE, CELL_MM, WHITE, YELLOW, along, bare, bare_on, loaded, on_both, pure};

/// Converts a volume in mm3 to quanta.
fn quanta(volume_mm3: f64) -> f64 {
    volume_mm3 / CELL_MM.powi(3) * f64::from(QUANTA_PER_CELL)
}

#[test]
fn all_that_is_squeezed_out_lies_there_to_the_quantum() {
    for mut painting in on_both(&bare(250, 200)) {
        let mut recipe = [0.0; SLOTS];
        (recipe[WHITE], recipe[BLUE]) = (3.0, 1.0);
        let mut wanted = [0.0; SLOTS + 1];
        for (volume, x_mm) in [(0.002, 8.0), (1.0, 12.0), (120.0, 25.03)] {
            painting.squeeze(&recipe, 0.2, x_mm, 20.0, volume).unwrap();
            wanted[WHITE] += (quanta(volume) * 0.6).round();
            wanted[BLUE] += (quanta(volume) * 0.2).round();
            wanted[SLOTS] += (quanta(volume) * 0.2).round();
        }
        let totals = painting.wet().unwrap().totals().map(|total| total as f64);
        assert_eq!(totals, wanted);
    }
}

/// Height of the highest column of wet paint, in mm, and the smallest rectangle around all wet
/// cells.
fn heap(painting: &mut Painting) -> (f64, Rect) {
    let wet = painting.wet().unwrap();
    let (mut highest, mut found): (u32, Option<[usize; 4]>) = (0, None);
    for (index, y) in (0..wet.height()).flat_map(|y| (0..wet.width()).map(move |x| (x, y))) {
        let volume = wet.cell(y * wet.width() + index).volume();
        if volume > 0 {
            highest = highest.max(volume);
            let [left, top, right, bottom] = found.unwrap_or([index, y, index, y]);
            found = Some([left.min(index), top.min(y), right.max(index), bottom.max(y)]);
        }
    }
    let [x, y, right, bottom] = found.unwrap();
    let rect = Rect { x, y, width: right - x + 1, height: bottom - y + 1 };
    (mm_from_quanta(highest, CELL_MM), rect)
}

#[test]
fn a_heap_is_round_a_third_as_high_as_wide_and_brushes_take_from_it() {
    for mut painting in on_both(&bare(250, 200)) {
        painting.squeeze(&pure(YELLOW), 0.0, 25.0, 20.0, 150.0).unwrap();
        let (highest, rect) = heap(&mut painting);
        assert!(rect.width.abs_diff(rect.height) <= 1, "{rect:?}");
        let wide = rect.width as f64 * CELL_MM;
        assert!((highest * 3.0 / wide - 1.0).abs() < 0.08, "{highest} high, {wide} wide");
        assert!((8.0..12.0).contains(&wide), "{wide}");
        assert!((rect.x + rect.width / 2).abs_diff(125) <= 1, "{rect:?}");
        let wet = painting.wet().unwrap();
        let row: Vec<u32> =
            (rect.x..rect.x + rect.width).map(|x| wet.cell(100 * 250 + x).volume()).collect();
        let middle = row.len() / 2;
        assert!(row[..middle].is_sorted() && row[middle..].iter().rev().is_sorted(), "{row:?}");
        let knife = painting.add_brush(HeadShape::Flat, 5.0).unwrap();
        painting.stroke(knife, &along(&[(18.0, 20.0), (32.0, 20.0)], 0.6)).unwrap();
        assert!(painting.brush_paint(knife).unwrap().totals()[YELLOW] > 0, "it took no paint");
    }
}

#[test]
fn a_heap_at_the_edge_is_cut_there_and_touches_only_its_tiles() {
    for mut painting in on_both(&bare(250, 200)) {
        painting.refresh(false).unwrap();
        painting.squeeze(&pure(WHITE), 0.0, 25.0, 20.0, 100.0).unwrap();
        let whole = painting.wet().unwrap().totals()[WHITE];
        let (_, rect) = heap(&mut painting);
        let mut tiles = TileSet::default();
        tiles.insert(rect.grown(2, painting.bounds()));
        let told = painting.refresh(false).unwrap();
        assert!(told.iter().all(|tile| tiles.iter().any(|one| one == tile)), "{told:?}");
        let (used, _) = painting.undo_bytes();
        assert!(used <= tiles.len() as u64 * TILE_BYTES, "{used} bytes");
        assert!(painting.undo().unwrap(), "no undo");
        assert_eq!(painting.wet().unwrap().totals(), [0; SLOTS + 1]);
        painting.squeeze(&pure(WHITE), 0.0, 50.0, 20.0, 100.0).unwrap();
        let cut = painting.wet().unwrap().totals()[WHITE] as f64 / whole as f64;
        assert!((cut - 0.5).abs() < 0.01, "{cut} of a heap on the edge");
    }
}

#[test]
fn heaps_on_small_cells_are_flatter_and_no_pile_is_without_end() {
    let mut document = bare_on(r#"{"kind": "panel"}"#, 400, 400);
    document.cell_mm = 0.02;
    for mut painting in on_both(&document) {
        // Without the limit on the height of a heap it would be 85 cells high.
        painting.squeeze(&pure(WHITE), 0.0, 4.0, 4.0, 20.0).unwrap();
        let wet = painting.wet().unwrap();
        let highest = (0..400 * 400).map(|index| wet.cell(index).volume()).max().unwrap();
        assert!((20..=27).contains(&(highest / QUANTA_PER_CELL)), "{highest}");
        let mut heaps = 0;
        let error = loop {
            match painting.squeeze(&pure(WHITE), 0.0, 4.0, 4.0, 4.0) {
                Ok(()) => heaps += 1,
                Err(error) => break error,
            }
            assert!(heaps < 5000, "no limit on the pile");
        };
        assert!(matches!(error, PaintingError::NoRoom { .. }), "{error}");
        assert!(error.hint().is_some(), "{error}");
        let brush = loaded(&mut painting, HeadShape::Round, 2.0, BLUE, 0.05);
        painting.stroke(brush, &along(&[(1.0, 4.0), (7.0, 4.0)], 0.6)).unwrap();
    }
}

#[test]
fn what_no_tube_gives_is_refused_and_changes_nothing() {
    for mut painting in on_both(&bare(60, 60)) {
        let mut refused = |recipe: &[f64; SLOTS], vehicle, x_mm, y_mm, volume| {
            let error = painting.squeeze(recipe, vehicle, x_mm, y_mm, volume).unwrap_err();
            assert_eq!(painting.undo_count(), 0, "{error}");
            error.to_string()
        };
        let white = pure(WHITE);
        assert!(refused(&white, 0.0, 3.0, 3.0, -1.0).contains("found `-1`"));
        assert!(refused(&white, 0.0, 3.0, 3.0, f64::NAN).contains("`NaN`"));
        assert!(refused(&white, 0.0, 3.0, 3.0, 2e6).contains("a litre"));
        assert!(refused(&white, 0.0, -0.1, 3.0, 1.0).contains("-0.1 mm from its left"));
        assert!(refused(&white, 0.0, 3.0, f64::NAN, 1.0).contains("`NaN` mm from its upper"));
        assert!(refused(&white, 1.5, 3.0, 3.0, 1.0).contains("vehicle"));
        assert!(refused(&pure(7), 0.0, 3.0, 3.0, 1.0).contains("slot 7"));
        assert!(refused(&[0.0; SLOTS], 0.0, 3.0, 3.0, 1.0).contains("parts"));
        painting.squeeze(&[0.0; SLOTS], 1.0, 3.0, 3.0, 1.0).unwrap();
    }
}

#[test]
fn scraping_takes_all_wet_paint_and_no_dry() {
    for mut painting in on_both(&bare(250, 200)) {
        painting.squeeze(&pure(YELLOW), 0.0, 10.0, 10.0, 20.0).unwrap();
        painting.dry(1.0).unwrap();
        painting.squeeze(&pure(BLUE), 0.0, 40.0, 30.0, 20.0).unwrap();
        painting.squeeze(&pure(WHITE), 0.0, 12.0, 10.0, 20.0).unwrap();
        let before = painting.document().unwrap();
        painting.refresh(false).unwrap();
        assert!(painting.scrape().unwrap(), "there is wet paint");
        let after = painting.document().unwrap();
        assert_eq!(after.wet.totals(), [0; SLOTS + 1]);
        assert!(after.dry == before.dry, "the dry layer");
        assert!(!painting.refresh(false).unwrap().is_empty(), "no tile changed");
        assert!(painting.undo().unwrap(), "no undo");
        assert!(painting.document().unwrap() == before, "undo");
        painting.redo().unwrap();
        assert!(painting.document().unwrap() == after, "redo");
        // Scraping a surface without wet paint adds no step to the history.
        let actions = painting.undo_count();
        assert!(!painting.scrape().unwrap(), "a clean canvas");
        assert_eq!(painting.undo_count(), actions);
    }
}
