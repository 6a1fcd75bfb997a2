//! How paint should behave: wet mixing, contact with the weave, pick-up by a clean brush, and
//! limits of brushes and columns. Fluid paint levels after a stroke, while stiff paint keeps its
//! furrows. Also squeezing and scraping paint, continuous adjustments, gloss, the memory limit of
//! undo, and setting the paint on a brush.

use documents::hint::Explain;
use graphics::tile::{Rect, TileSet};
use paint::amount::{MAX_COLUMN, QUANTA_PER_CELL, mm_from_quanta};
use paint::brush::HeadShape;
use paint::document::Lighting;
use paint::engine::BrushId;
use paint::history::TILE_BYTES;
use paint::layer::{Layer, LayerRef, SLOTS};
use paint::optics::Gloss;
use paint::painting::{Painting, PaintingError};
use paint::pose::Sample;
use paint::strokes::Action;
use spectra::color::Lab;

use super::studio::{
    BLUE, CELL_MM, WHITE, YELLOW, along, bare, bare_on, crossing, lab, loaded, on_both, on_cpu,
    pure,
};

fn bare_cells(wet: &Layer) -> usize {
    (0..wet.vehicle.values().len()).filter(|&cell| wet.cell(cell).volume() == 0).count()
}

/// Colour and blue share of yellow plus blue, in every cell with more of these two than a tenth of
/// the cell width.
fn mixed(strokes: impl Fn(&mut Painting)) -> Vec<(Lab, f64)> {
    let mut painting = on_cpu(bare_on(r#"{"kind": "panel", "seed": 1}"#, 160, 60));
    strokes(&mut painting);
    let picture = painting.flat_picture().unwrap();
    let wet = painting.wet().unwrap();
    let cells = (0..160 * 60).filter_map(|index| {
        let [_, yellow, blue, ..] = wet.cell(index).pigments;
        let share = f64::from(blue) / f64::from(yellow + blue);
        (yellow + blue > QUANTA_PER_CELL / 10).then(|| (lab(&picture.values()[index]), share))
    });
    cells.collect()
}

#[test]
fn yellow_and_blue_mixed_wet_on_the_canvas_go_through_green() {
    fn lay(painting: &mut Painting, slot: usize, amount_mm: f64) {
        let brush = loaded(painting, HeadShape::Flat, 6.0, slot, amount_mm);
        painting.stroke(brush, &along(&[(3.0, 6.0), (29.0, 6.0)], 0.8)).unwrap();
    }
    let [yellow, blue] = [YELLOW, BLUE].map(|slot| mixed(|painting| lay(painting, slot, 0.6)));
    assert!(yellow.len() > 500 && blue.len() > 500, "{} {}", yellow.len(), blue.len());
    let ends = [&yellow, &blue].map(|cells| {
        let mut a: Vec<f64> = cells.iter().map(|(lab, _)| lab.a).collect();
        a.sort_by(f64::total_cmp);
        a[a.len() / 2]
    });
    let ends = ends[0].min(ends[1]);
    let both = mixed(|painting| {
        lay(painting, YELLOW, 0.6);
        lay(painting, BLUE, 0.03);
    });
    // Additive mixing would give an a* between the two pigments, but never below both.
    let green = both
        .iter()
        .filter(|(lab, share)| (0.005..0.5).contains(share) && lab.a < ends - 10.0 && lab.b > 0.0);
    let green = green.count();
    assert!(green > 50, "{green} of {} cells are green; a* of the ends {ends}", both.len());
}

#[test]
fn a_stroke_beside_the_canvas_only_evens_out_the_hair() {
    for mut painting in on_both(&bare(80, 80)) {
        let brush = loaded(&mut painting, HeadShape::Flat, 4.0, YELLOW, 0.4);
        painting.stroke(brush, &along(&[(3.0, 8.0), (12.0, 8.0)], 0.5)).unwrap();
        let before = whole(&mut painting, brush);
        for places in [[(-40.0, 5.0), (-20.0, 9.0)], [(5.0, 60.0), (9.0, 1e3)]] {
            let report = painting.stroke(brush, &along(&places, 0.8)).unwrap();
            assert_eq!((report.substeps, report.cells), (0, 0));
            let (wet, head) = whole(&mut painting, brush);
            assert!(wet == before.0, "{places:?}");
            assert_eq!(head.totals(), before.1.totals(), "{places:?}");
            painting.undo().unwrap();
            assert!(whole(&mut painting, brush) == before, "{places:?}");
        }
    }
}

#[test]
fn a_brush_that_does_not_move_takes_no_substeps_after_its_dab() {
    let mut painting = on_cpu(bare(80, 80));
    let brush = loaded(&mut painting, HeadShape::Flat, 4.0, YELLOW, 0.4);
    let still = Sample { twist_deg: 0.0, ..along(&[(8.0, 8.0)], 0.5)[0] };
    let mut other = on_cpu(bare(80, 80));
    let same = loaded(&mut other, HeadShape::Flat, 4.0, YELLOW, 0.4);
    let dab = painting.stroke(brush, &[still]).unwrap();
    let long: Vec<Sample> = (0..100).map(|i| Sample { seconds: f64::from(i), ..still }).collect();
    assert_eq!(other.stroke(same, &long).unwrap(), dab);
    assert!(painting.document().unwrap() == other.document().unwrap(), "a longer rest differs");
    assert!(dab.substeps > 0 && bare_cells(&painting.wet().unwrap()) < 6400, "no paint");
}

fn whole(painting: &mut Painting, brush: BrushId) -> (Layer, Layer) {
    (painting.wet().unwrap(), painting.brush_paint(brush).unwrap())
}

#[test]
fn a_light_touch_leaves_more_of_the_weave_bare_than_a_heavy_one() {
    let ground = r#"{"kind": "linen", "seed": 3}"#;
    let shares = [0.02, 0.2, 0.8].map(|pressure| {
        let mut painting = on_cpu(bare_on(ground, 120, 60));
        let brush = loaded(&mut painting, HeadShape::Flat, 6.0, YELLOW, 0.3);
        painting.stroke(brush, &along(&[(4.0, 6.0), (20.0, 6.0)], pressure)).unwrap();
        // Cells along the path of the middle of the head.
        let wet = painting.wet().unwrap();
        let cells = (20..40).flat_map(|y| (30..90).map(move |x| y * 120 + x));
        let painted = cells.filter(|&cell| wet.cell(cell).volume() > 0).count();
        painted as f64 / 1200.0
    });
    assert!(shares[0] < 0.99, "nothing stays bare under a light touch: {shares:?}");
    assert!(shares[2] > shares[0], "{shares:?}");
}

#[test]
fn a_clean_brush_takes_up_wet_paint_and_no_dry() {
    for mut painting in on_both(&bare(120, 60)) {
        let brush = loaded(&mut painting, HeadShape::Flat, 5.0, YELLOW, 0.6);
        painting.stroke(brush, &along(&[(3.0, 6.0), (20.0, 6.0)], 0.6)).unwrap();
        let clean = painting.add_brush(HeadShape::Flat, 5.0).unwrap();
        let before = painting.wet().unwrap().totals()[YELLOW];
        painting.stroke(clean, &along(&[(3.0, 6.0), (20.0, 6.0)], 0.6)).unwrap();
        let taken = painting.brush_paint(clean).unwrap().totals()[YELLOW];
        assert!(taken > 0, "the brush took no wet paint");
        assert_eq!(painting.wet().unwrap().totals()[YELLOW], before - taken);
        painting.dry(1.0).unwrap();
        painting.wash(clean).unwrap();
        painting.stroke(clean, &along(&[(3.0, 6.0), (20.0, 6.0)], 0.6)).unwrap();
        assert_eq!(painting.brush_paint(clean).unwrap().totals(), [0; 9]);
    }
}

fn most_load_mm(painting: &mut Painting, brush: BrushId) -> f64 {
    let paint = painting.brush_paint(brush).unwrap();
    painting.most_load_mm(brush, &paint)
}

#[test]
fn a_brush_takes_what_it_can_hold_and_refuses_more() {
    let mut painting = on_cpu(bare(60, 60));
    let brush = painting.add_brush(HeadShape::Round, 2.0).unwrap();
    painting.load(brush, &[0.0; 8], 1.0, 0.2).unwrap();
    let clear = painting.brush_paint(brush).unwrap().totals();
    assert!(clear[8] > 0 && clear[..8].iter().all(|&pigment| pigment == 0), "{clear:?}");
    let two = std::array::from_fn(|slot| if slot < 2 { 1.0 } else { 0.0 });
    for amount_mm in [65.0 * CELL_MM, 1e9, 1e300] {
        let error = painting.load(brush, &two, 0.0, amount_mm).unwrap_err();
        assert!(matches!(error, PaintingError::Overloaded { .. }), "{error}");
    }
    for (recipe, vehicle, amount_mm) in [
        ([0.0; 8], 0.5, 0.1),
        ([f64::NAN; 8], 0.0, 0.1),
        ([f64::INFINITY; 8], 0.0, 0.1),
        (pure(0).map(|part| -part), 0.0, 0.1),
        (pure(0), 1.1, 0.1),
        (pure(0), f64::NAN, 0.1),
        (pure(0), 0.0, -0.1),
        (pure(0), 0.0, f64::NAN),
        (pure(7), 0.0, 0.1),
    ] {
        assert!(painting.load(brush, &recipe, vehicle, amount_mm).is_err(), "{recipe:?}");
    }
    assert_eq!(painting.brush_paint(brush).unwrap().totals(), clear, "a refused load changed it");
    let most_mm = most_load_mm(&mut painting, brush);
    painting.load(brush, &two, 0.0, most_mm * 0.999).unwrap();
    let left_mm = most_load_mm(&mut painting, brush);
    assert!(left_mm < 0.002 * most_mm, "{left_mm} of {most_mm} mm");
    // A load that a clean brush could hold fills it.
    let before = painting.brush_paint(brush).unwrap().totals();
    painting.load(brush, &two, 0.0, 0.5 * most_mm).unwrap();
    let full = painting.brush_paint(brush).unwrap().totals();
    assert!(full[0] > before[0] && full[1] > before[1], "{before:?} to {full:?}");
    assert!(most_load_mm(&mut painting, brush) < 1e-6 * most_mm, "full");
    painting.load(brush, &two, 0.0, 0.5 * most_mm).unwrap();
    assert_eq!(painting.brush_paint(brush).unwrap().totals(), full, "no room is left");
}

#[test]
fn paint_too_high_for_whole_numbers_is_refused_when_opened() {
    let mut document = bare(60, 60);
    let mut layer = Layer::empty(60, 60);
    let mut cell = layer.cell(77);
    cell.vehicle = MAX_COLUMN;
    layer.set_cell(77, cell);
    let slots = document.slots;
    for _ in 0..2 {
        document.push_dry(slots, layer.clone());
    }
    let engine = paint::engine::PaintEngine::on_cpu(document.ground.height.clone());
    let error = Painting::open(document, engine, 0).unwrap_err();
    assert!(matches!(error, PaintingError::TooHigh { x: 17, y: 1 }), "{error}");
}

const COLUMNS: usize = 200;

/// Mean difference in height of neighbouring cells across the middle of a stroke along x, relative
/// to the mean height there.
fn furrows(wet: &Layer) -> f64 {
    let middle = (80..120).flat_map(|x| (23..37).map(move |y| (x, y)));
    let [mut steps, mut sum] = [0.0; 2];
    for (x, y) in middle {
        let [here, below] = [y, y + 1].map(|y| f64::from(wet.cell(y * COLUMNS + x).volume()));
        steps += (below - here).abs();
        sum += here;
    }
    steps / sum
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

/// Height of the highest column of wet paint in mm, and the smallest rectangle around all wet
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
        let refreshed = painting.refresh(false).unwrap();
        assert!(refreshed.iter().all(|tile| tiles.iter().any(|one| one == tile)), "{refreshed:?}");
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
        // Without the limit on its height, the heap would be 85 cells high.
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
        let white = pure(WHITE);
        for (recipe, vehicle, x_mm, y_mm, volume, words) in [
            (white, 0.0, 3.0, 3.0, -1.0, "found `-1`"),
            (white, 0.0, 3.0, 3.0, f64::NAN, "`NaN`"),
            (white, 0.0, 3.0, 3.0, 2e6, "a litre"),
            (white, 0.0, -0.1, 3.0, 1.0, "-0.1 mm from its left"),
            (white, 0.0, 3.0, f64::NAN, 1.0, "`NaN` mm from its upper"),
            (white, 1.5, 3.0, 3.0, 1.0, "vehicle"),
            (pure(7), 0.0, 3.0, 3.0, 1.0, "slot 7"),
            ([0.0; SLOTS], 0.0, 3.0, 3.0, 1.0, "parts"),
        ] {
            let error = painting.squeeze(&recipe, vehicle, x_mm, y_mm, volume).unwrap_err();
            assert_eq!(painting.undo_count(), 0, "{error}");
            assert!(error.to_string().contains(words), "{error}");
        }
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
        // If you scrape a surface without wet paint, the history gets no step.
        let actions = painting.undo_count();
        assert!(!painting.scrape().unwrap(), "a clean canvas");
        assert_eq!(painting.undo_count(), actions);
    }
}

#[test]
fn a_slider_that_is_dragged_is_one_action_and_shows_every_state() {
    for mut painting in on_both(&bare(130, 100)) {
        crossing(&mut painting);
        painting.dry(1.0).unwrap();
        let before = (painting.document().unwrap(), painting.picture().unwrap());
        let actions = painting.undo_count();
        painting.begin_adjusting();
        let mut seen = vec![before.1.clone()];
        for share in 1..4 {
            painting.set_opacity(LayerRef::Dry(0), 1.0 + f64::from(share)).unwrap();
            seen.push(painting.picture().unwrap());
            let azimuth_deg = 30.0 * f64::from(share);
            painting.relight(Lighting { azimuth_deg, ..Lighting::default() }).unwrap();
            seen.push(painting.picture().unwrap());
            let shine = Gloss { strength: 0.3 * share as f32, exponent: 30.0 };
            painting.apply(&Action::Gloss { wet: shine, dry: shine }).unwrap();
            seen.push(painting.picture().unwrap());
        }
        assert!(painting.set_opacity(LayerRef::Dry(0), -1.0).is_err(), "an opacity below 0");
        painting.end_adjusting();
        assert!(seen.windows(2).all(|pair| pair[0] != pair[1]), "a state was not shown");
        assert_eq!(painting.undo_count(), actions + 1);
        let after = (painting.document().unwrap(), painting.picture().unwrap());
        assert!(painting.undo().unwrap(), "no undo");
        assert!((painting.document().unwrap(), painting.picture().unwrap()) == before, "undo");
        assert!(painting.redo().unwrap(), "no redo");
        assert!((painting.document().unwrap(), painting.picture().unwrap()) == after, "redo");
    }
}

#[test]
fn a_slider_that_is_only_touched_is_no_action() {
    for mut painting in on_both(&bare(130, 100)) {
        painting.squeeze(&pure(WHITE), 0.0, 9.0, 9.0, 5.0).unwrap();
        painting.undo().unwrap();
        painting.begin_adjusting();
        painting.end_adjusting();
        assert_eq!((painting.undo_count(), painting.redo_count()), (0, 1));
    }
}

#[test]
#[should_panic(expected = "an adjustment is open")]
fn no_undo_while_a_slider_is_dragged() {
    let mut painting = on_both(&bare(40, 40)).remove(0);
    painting.begin_adjusting();
    let _ = painting.undo();
}

#[test]
fn gloss_changes_what_shines_is_kept_by_the_file_and_undone() {
    for mut painting in on_both(&bare(130, 100)) {
        crossing(&mut painting);
        let before = painting.picture().unwrap();
        let medium = painting.medium().clone();
        let wet = Gloss { strength: 0.9, exponent: 90.0 };
        let dry = medium.dry;
        painting.apply(&Action::Gloss { wet, dry }).unwrap();
        assert!(painting.picture().unwrap() != before, "the gloss changed nothing");
        let found = painting.document().unwrap().medium;
        assert_eq!((found.wet, found.dry), (wet, dry));
        assert!(found.scattering_per_mm == medium.scattering_per_mm, "the scattering changed");
        painting.undo().unwrap();
        assert!(painting.picture().unwrap() == before, "undo");
        assert_eq!(painting.medium(), &medium);
        for strength in [-0.1, f32::NAN, 1e3] {
            let dry = Gloss { strength, ..dry };
            let error = painting.apply(&Action::Gloss { wet, dry }).unwrap_err();
            assert!(matches!(error, PaintingError::Invalid(_)), "{error}");
        }
        assert_eq!(painting.medium(), &medium);
    }
}

#[test]
fn what_undo_may_keep_is_told_and_can_be_less() {
    for mut painting in on_both(&bare(300, 200)) {
        let brush = loaded(&mut painting, HeadShape::Flat, 4.0, WHITE, 0.5);
        for y_mm in [5.0, 15.0, 25.0, 35.0] {
            painting.stroke(brush, &along(&[(5.0, y_mm), (50.0, y_mm)], 0.5)).unwrap();
        }
        let (used, limit) = painting.undo_bytes();
        assert!(used > 0 && used <= limit, "{used} of {limit}");
        painting.undo().unwrap();
        assert_eq!((painting.undo_count(), painting.redo_count()), (3, 1));
        let wet = painting.wet().unwrap();
        painting.set_undo_bytes(used / 2);
        let (kept, limit) = painting.undo_bytes();
        assert!(kept <= limit && limit == used / 2, "{kept} of {limit}");
        let actions = painting.undo_count() + painting.redo_count();
        assert!((1..4).contains(&actions), "{actions} actions");
        assert!(painting.wet().unwrap() == wet, "the limit changed the paint");
        while painting.undo().unwrap() {}
        painting.set_undo_bytes(0);
        assert_eq!((painting.undo_bytes(), painting.undo_count()), ((0, 0), 0));
    }
}

#[test]
fn paint_put_on_a_brush_from_elsewhere_is_what_it_holds() {
    for mut painting in on_both(&bare(130, 100)) {
        let brush = loaded(&mut painting, HeadShape::Flat, 4.0, WHITE, 0.5);
        let paint = painting.brush_paint(brush).unwrap();
        painting.wash(brush).unwrap();
        painting.set_brush_paint(brush, &paint).unwrap();
        assert!(painting.brush_paint(brush).unwrap() == paint, "the brush holds other paint");
        assert_eq!(painting.undo_count(), 0);
        assert_eq!(painting.head(brush).shape(), HeadShape::Flat);
    }
}
