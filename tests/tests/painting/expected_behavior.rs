//! Expected behaviour of paint: wet mixing, contact with the weave, pick-up by a clean brush, and
//! limits of brushes and columns.

use paint::amount::{MAX_COLUMN, QUANTA_PER_CELL};
use paint::brush::HeadShape;
use paint::engine::BrushId;
use paint::layer::Layer;
use paint::painting::{Painting, PaintingError};
use paint::pose::Sample;
use spectra::color::Lab;

use super::studio::{
    BLUE, CELL_MM, YELLOW, along, bare, bare_on, lab, loaded, on_both, on_cpu, pure,
};

fn bare_cells(wet: &Layer) -> usize {
    (0..wet.vehicle.values().len()).filter(|&cell| wet.cell(cell).volume() == 0).count()
}

/// Colour and blue share of yellow plus blue, in every cell whose paint of the two is higher than
/// a tenth of the cell width.
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
    let there = [(3.0, 6.0), (29.0, 6.0)];
    let lay = |painting: &mut Painting, slot: usize, amount_mm: f64| {
        let brush = loaded(painting, HeadShape::Flat, 6.0, slot, amount_mm);
        painting.stroke(brush, &along(&there, 0.8)).unwrap();
    };
    let yellow = mixed(|painting| lay(painting, YELLOW, 0.6));
    let blue = mixed(|painting| lay(painting, BLUE, 0.6));
    assert!(yellow.len() > 500 && blue.len() > 500, "{} {}", yellow.len(), blue.len());
    let middle = |cells: &[(Lab, f64)]| {
        let mut a: Vec<f64> = cells.iter().map(|(lab, _)| lab.a).collect();
        a.sort_by(f64::total_cmp);
        a[a.len() / 2]
    };
    let ends = middle(&yellow).min(middle(&blue));
    let both = mixed(|painting| {
        lay(painting, YELLOW, 0.6);
        lay(painting, BLUE, 0.02);
    });
    // Additive mixing would give an a* between those of the two pigments, never below both.
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
    let covered = |pressure: f64| {
        let mut painting = on_cpu(bare_on(ground, 120, 60));
        let brush = loaded(&mut painting, HeadShape::Flat, 6.0, YELLOW, 0.3);
        painting.stroke(brush, &along(&[(4.0, 6.0), (20.0, 6.0)], pressure)).unwrap();
        // Cells along the path of the middle of the head.
        let wet = painting.wet().unwrap();
        let cells = (20..40).flat_map(|y| (30..90).map(move |x| y * 120 + x));
        let painted = cells.filter(|&cell| wet.cell(cell).volume() > 0).count();
        painted as f64 / 1200.0
    };
    let shares = [0.02, 0.2, 0.8].map(covered);
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
    assert!(painting.load(brush, &two, 0.0, most_mm * 1.001).is_err(), "more than {most_mm} mm");
    painting.load(brush, &two, 0.0, most_mm * 0.999).unwrap();
    let left_mm = most_load_mm(&mut painting, brush);
    assert!(left_mm < 0.002 * most_mm, "{left_mm} of {most_mm} mm");
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
