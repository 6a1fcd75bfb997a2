//! Conservation of paint: strokes, drying, undo and redo neither create nor lose a quantum of any
//! pigment or of vehicle.

use paint::amount::{MAX_COLUMN, mm_from_quanta};
use paint::brush::HeadShape;
use paint::engine::BrushId;
use paint::layer::{Layer, SLOTS};
use paint::painting::Painting;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::studio::{CELL_MM, along, bare, on_both, tell};

/// Paint in dry layers, in the wet layer and on `brushes`, in quanta: by slot, vehicle last.
fn totals(painting: &mut Painting, brushes: &[BrushId]) -> [u64; SLOTS + 1] {
    let document = painting.document().unwrap();
    let mut layers: Vec<Layer> = document.dry.into_iter().map(|layer| layer.paint).collect();
    layers.push(document.wet);
    layers.extend(brushes.iter().map(|&brush| painting.brush_paint(brush).unwrap()));
    for layer in &layers {
        for index in 0..layer.vehicle.values().len() {
            let cell = layer.cell(index);
            let sum: u64 = cell.pigments.iter().chain([&cell.vehicle]).map(|&a| u64::from(a)).sum();
            assert!(sum < u64::from(MAX_COLUMN), "cell {index} holds {sum}: wrapped below 0");
        }
    }
    let mut sums = [0; SLOTS + 1];
    for layer in &layers {
        for (sum, more) in sums.iter_mut().zip(layer.totals()) {
            *sum += more;
        }
    }
    sums
}

#[test]
fn ten_thousand_substeps_keep_every_pigment_to_the_quantum() {
    let shapes = [HeadShape::Flat, HeadShape::Round, HeadShape::Knife, HeadShape::Fan];
    for mut painting in on_both(&bare(180, 120)) {
        let mut random = ChaCha8Rng::seed_from_u64(11);
        let brushes = shapes.map(|shape| painting.add_brush(shape, 4.0).unwrap());
        let mut wanted = [0; SLOTS + 1];
        let mut substeps = 0;
        let mut strokes = 0;
        while substeps < 10_000 {
            let brush = brushes[strokes % brushes.len()];
            if strokes % 5 < 4 {
                let before = painting.brush_paint(brush).unwrap().totals();
                let recipe = std::array::from_fn(|i| {
                    if i < 7 { f64::from(random.random_range(0..4_u8)) + 0.01 } else { 0.0 }
                });
                let amount_mm = random.random_range(0.01..0.4);
                painting.load(brush, &recipe, random.random_range(0.0..0.5), amount_mm).unwrap();
                let after = painting.brush_paint(brush).unwrap().totals();
                for ((wanted, after), before) in wanted.iter_mut().zip(after).zip(before) {
                    *wanted += after - before;
                }
            }
            // Parts of the strokes lie outside the canvas.
            let mut place = || (random.random_range(-3.0..39.0), random.random_range(-3.0..27.0));
            let places: Vec<_> = (0..8).map(|_| place()).collect();
            let pressure = random.random_range(0.1..1.0);
            substeps += painting.stroke(brush, &along(&places, pressure)).unwrap().substeps;
            strokes += 1;
            match strokes % 16 {
                6 => drop(painting.dry(0.37).unwrap()),
                13 => drop(painting.undo().unwrap() && painting.redo().unwrap()),
                _ => {}
            }
        }
        assert_eq!(totals(&mut painting, &brushes), wanted, "on {}", painting.backend());
        assert!(!painting.document().unwrap().dry.is_empty(), "nothing dried");
        let wet = painting.wet_totals_mm().unwrap();
        painting.dry(1.0).unwrap();
        assert_eq!(totals(&mut painting, &brushes), wanted, "dried on {}", painting.backend());
        let left: Vec<_> = brushes.iter().map(|&b| painting.brush_paint(b).unwrap()).collect();
        let left: u64 = left.iter().flat_map(Layer::totals).sum();
        let told: f64 = painting.wet_totals_mm().unwrap().iter().sum();
        let left = left as f64 * mm_from_quanta(1, CELL_MM);
        assert!((told - left).abs() < 1e-6, "{told} mm wet, {left} on the brushes");
        assert!(wet.iter().sum::<f64>() > told, "drying did not reduce wet paint");
        tell(&format!(
            "{}: {substeps} sub-steps, {strokes} strokes, kept {wanted:?}",
            painting.backend()
        ));
    }
}

#[test]
fn a_brush_filled_again_and_again_piles_no_cell_full() {
    for mut painting in on_both(&bare(40, 40)) {
        let brush = painting.add_brush(HeadShape::Knife, 4.0).unwrap();
        let recipe = [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0];
        // Without a limit on columns, 60 such strokes piled paint up to 1057 cell widths.
        for _ in 0..100 {
            painting.wash(brush).unwrap();
            painting.load(brush, &recipe, 0.0, 0.8).unwrap();
            painting.stroke(brush, &along(&[(2.0, 4.0), (9.0, 4.0)], 1.0)).unwrap();
        }
        let wet = painting.wet().unwrap();
        let highest = (0..1600).map(|index| wet.cell(index).volume()).max().unwrap();
        tell(&format!("{}: {} cell widths at most", painting.backend(), highest >> 21));
        assert!(highest < MAX_COLUMN / 2, "{highest} quanta on {}", painting.backend());
        // Columns this high can still be dried and saved.
        painting.dry(1.0).unwrap();
        assert!(paint::file::write(&painting.document().unwrap()).is_ok(), "not saved");
    }
}
