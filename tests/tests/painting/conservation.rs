//! Strokes, drying, undo and redo neither create nor lose a quantum of any pigment or of vehicle.
//! CPU and GPU hold equal paint and show it alike, and pictures from eight wavelengths match the
//! full spectrum. If you relight, swap a pigment or change an opacity, you get the painting that
//! these settings would have made from the start.

use calibrate::PigmentId;
use calibrate::evaluate::Viewing;
use paint::amount::{MAX_COLUMN, mm_from_quanta};
use paint::brush::HeadShape;
use paint::document::{Document, Lighting, Slots};
use paint::engine::BrushId;
use paint::layer::{Layer, LayerRef, SLOTS};
use paint::painting::{Painting, PaintingError, UNDO_BYTES};
use paint::scene::SpectralDocument;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::{Lab, RgbSpace, delta_e_ciede2000};

use super::studio::{
    BLUE, CELL_MM, RED, WHITE, YELLOW, along, bare, crossing, differences, lab, loaded, mean,
    on_both, on_cpu, on_gpu, pigment, pure, sorted, tell,
};

/// Paint in dry layers, in the wet layer and on `brushes`, in quanta by slot and then vehicle.
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
            // Parts of the strokes are outside the canvas.
            let places = [(); 8]
                .map(|()| (random.random_range(-3.0..39.0), random.random_range(-3.0..27.0)));
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
        let total: f64 = painting.wet_totals_mm().unwrap().iter().sum();
        let left = left as f64 * mm_from_quanta(1, CELL_MM);
        assert!((total - left).abs() < 1e-6, "{total} mm wet, {left} on the brushes");
        assert!(wet.iter().sum::<f64>() > total, "drying did not reduce wet paint");
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
        // Without a limit on columns, 60 such strokes piled up paint as high as 1057 cell widths.
        for _ in 0..100 {
            painting.wash(brush).unwrap();
            painting.load(brush, &recipe, 0.0, 0.8).unwrap();
            painting.stroke(brush, &along(&[(2.0, 4.0), (9.0, 4.0)], 1.0)).unwrap();
        }
        let wet = painting.wet().unwrap();
        let highest = (0..1600).map(|index| wet.cell(index).volume()).max().unwrap();
        tell(&format!("{}: {} cell widths at most", painting.backend(), highest >> 21));
        assert!(highest < MAX_COLUMN / 2, "{highest} quanta on {}", painting.backend());
        // You can still dry and save columns of this height.
        painting.dry(1.0).unwrap();
        assert!(paint::file::write(&painting.document().unwrap()).is_ok(), "not saved");
    }
}

/// Paints dried impasto, a thin glaze of 90 % vehicle over it, half dried, and wet strokes. Also
/// sets an opacity, swaps a pigment, undoes and redoes.
fn finished(painting: &mut Painting) {
    crossing(painting);
    painting.dry(1.0).unwrap();
    let glaze = painting.add_brush(HeadShape::Mop, 8.0).unwrap();
    let mut recipe = [0.0; 8];
    (recipe[BLUE], recipe[RED]) = (1.0, 2.0);
    painting.load(glaze, &recipe, 0.9, 0.05).unwrap();
    painting.stroke(glaze, &along(&[(2.0, 7.0), (22.0, 7.0), (22.0, 12.0)], 0.5)).unwrap();
    painting.dry(0.5).unwrap();
    painting.set_opacity(LayerRef::Dry(1), 1.5).unwrap();
    painting.swap_pigment(LayerRef::Dry(0), pigment("Chrome Yellow"), pigment("Minium")).unwrap();
    let red = loaded(painting, HeadShape::Bright, 4.0, RED, 0.4);
    painting.stroke(red, &along(&[(2.0, 14.0), (14.0, 13.0), (22.0, 3.0)], 0.7)).unwrap();
    painting.undo().unwrap();
    painting.redo().unwrap();
    let white = loaded(painting, HeadShape::Knife, 5.0, WHITE, 0.5);
    painting.stroke(white, &along(&[(18.0, 16.0), (6.0, 10.0)], 0.4)).unwrap();
    let _ = loaded(painting, HeadShape::Round, 2.0, YELLOW, 0.2);
}

fn same_paint(a: &Document, b: &Document) {
    assert_eq!(a.dry.len(), b.dry.len(), "dry layers");
    for (index, (a, b)) in a.dry.iter().zip(&b.dry).enumerate() {
        assert!(a == b, "dry layer {index}");
    }
    assert!(a.wet == b.wet, "the wet layer");
}

#[test]
fn both_backends_hold_the_same_paint_and_show_it_alike() {
    let mut document = bare(130, 100);
    document.ground.gloss.strength = 0.2;
    let Some(mut gpu) = on_gpu(document.clone()) else { return };
    let mut cpu = on_cpu(document);
    finished(&mut cpu);
    finished(&mut gpu);
    fn check(cpu: &mut Painting, gpu: &mut Painting, what: &str) {
        let shown = differences(&cpu.picture().unwrap(), &gpu.picture().unwrap());
        let mean = mean(&shown);
        let high = shown[shown.len() * 999 / 1000];
        let largest = shown[shown.len() - 1];
        tell(&format!(
            "CPU against GPU, {what}: mean {mean:.2e}, 99.9th percentile {high:.2e}, largest {largest:.2e} CIEDE2000"
        ));
        assert!(mean < 0.1 && high < 1.0, "{what}: mean {mean}, 99.9 % below {high}");
    }
    check(&mut cpu, &mut gpu, "daylight");
    same_paint(&cpu.document().unwrap(), &gpu.document().unwrap());
    let low = Lighting {
        illuminant: "A".into(),
        azimuth_deg: 80.0,
        elevation_deg: 20.0,
        relief: 2.0,
        ambient: 0.2,
        ..Lighting::default()
    };
    cpu.relight(low.clone()).unwrap();
    gpu.relight(low).unwrap();
    check(&mut cpu, &mut gpu, "a low lamp");
    cpu.dry(0.8).unwrap();
    gpu.dry(0.8).unwrap();
    check(&mut cpu, &mut gpu, "dried");
    same_paint(&cpu.document().unwrap(), &gpu.document().unwrap());
}

#[test]
fn eight_wavelengths_show_a_finished_painting_as_the_full_spectrum_does() {
    let mut painting = on_cpu(bare(130, 100));
    finished(&mut painting);
    let flat = painting.flat_picture().unwrap();
    let document = painting.document().unwrap();
    let spectral = SpectralDocument::full(&document);
    let weights = Viewing::default().weights(document.library.grid).unwrap();
    let cells = (0..130 * 100).map(|i| (i % 130, i / 130));
    let light = painting.light();
    let white = light.quadrature.rule.white;
    let exact = cells.map(|(x, y)| {
        let xyz = weights.xyz(&spectral.measured_reflectance(x, y));
        let linear =
            RgbSpace::Srgb.linear_from_xyz(xyz, white, spectra::color::Adaptation::Bradford);
        let adapted = RgbSpace::Srgb.xyz_from_linear().apply(linear.0);
        Lab::from_xyz(adapted.into(), RgbSpace::Srgb.white())
    });
    let pairs = exact.zip(flat.values());
    let found = sorted(pairs.map(|(exact, rgb)| delta_e_ciede2000(exact, lab(rgb))).collect());
    let mean = mean(&found);
    let largest = found[found.len() - 1];
    tell(&format!("8 wavelengths against 31: mean {mean:.3}, largest {largest:.3} CIEDE2000"));
    assert!(mean < 0.3, "mean {mean}");
    assert!(mean > 0.0, "the full spectrum was compared with itself");
}

/// Paints two dry layers. 30 % of the paint of the last stroke stays wet.
fn layered(mut painting: Painting) -> Painting {
    crossing(&mut painting);
    painting.dry(1.0).unwrap();
    let brush = loaded(&mut painting, HeadShape::Flat, 6.0, RED, 0.3);
    painting.stroke(brush, &along(&[(3.0, 9.0), (21.0, 9.0)], 0.5)).unwrap();
    painting.dry(0.7).unwrap();
    painting
}

#[test]
fn relighting_gives_what_a_painting_opened_under_that_light_shows() {
    let lamp = Lighting {
        illuminant: "A".into(),
        azimuth_deg: 45.0,
        elevation_deg: 30.0,
        ..Lighting::default()
    };
    for painting in on_both(&bare(130, 100)) {
        let mut painting = layered(painting);
        let daylight = painting.picture().unwrap();
        painting.relight(lamp.clone()).unwrap();
        let relit = painting.picture().unwrap();
        let document = painting.document().unwrap();
        let engine = paint::engine::PaintEngine::on_cpu(document.ground.height.clone());
        let mut opened = Painting::open(document, engine, UNDO_BYTES).unwrap();
        let off = differences(&relit, &opened.picture().unwrap());
        assert!(off[off.len() - 1] < 0.01, "{:?} off", off.last());
        let moved = differences(&daylight, &relit);
        assert!(moved[moved.len() - 1] > 1.0, "the lamp changed nothing");
        // Only the direction of the light changes, so the reflectance of dry layers is not
        // recomputed.
        painting.relight(Lighting { azimuth_deg: 200.0, ..lamp.clone() }).unwrap();
        let moved = painting.picture().unwrap();
        assert!(moved != relit, "the azimuth changed nothing");
        painting.relight(lamp.clone()).unwrap();
        assert!(painting.picture().unwrap() == relit, "picture at the first azimuth");
        assert!(painting.undo().unwrap() && painting.picture().unwrap() == moved, "after undo");
    }
}

#[test]
fn a_swapped_pigment_looks_as_if_it_had_been_painted_with() {
    let vermilion = pigment("Vermilion");
    let minium = pigment("Minium");
    for (painting, mut other) in on_both(&bare(130, 100)).into_iter().zip({
        let mut document = bare(130, 100);
        document.slots = exchanged(document.slots, vermilion, minium);
        on_both(&document)
    }) {
        let mut painting = layered(painting);
        let before = painting.picture().unwrap();
        painting.swap_pigment(LayerRef::Dry(1), vermilion, minium).unwrap();
        painting.swap_pigment(LayerRef::Dry(0), vermilion, minium).unwrap();
        painting.swap_pigment(LayerRef::Wet, vermilion, minium).unwrap();
        assert!(painting.picture().unwrap() != before, "the swap changed nothing");
        other = layered(other);
        assert!(painting.picture().unwrap() == other.picture().unwrap(), "not the same picture");
        assert!(painting.document().unwrap() == other.document().unwrap(), "not the same painting");
        let error = painting.swap_pigment(LayerRef::Wet, vermilion, minium).unwrap_err();
        assert!(matches!(error, PaintingError::AlreadyThere(..)), "{error}");
        let error = painting.swap_pigment(LayerRef::Wet, vermilion, pigment("Eosin Lake"));
        assert!(matches!(error, Err(PaintingError::NotThere(..))), "{error:?}");
    }
}

fn exchanged(slots: Slots, from: PigmentId, to: PigmentId) -> Slots {
    slots.map(|slot| if slot == Some(from) { Some(to) } else { slot })
}

#[test]
fn a_layer_of_no_opacity_is_as_good_as_not_there() {
    for painting in on_both(&bare(130, 100)) {
        let mut painting = layered(painting);
        painting.set_opacity(LayerRef::Dry(1), 0.0).unwrap();
        let hidden = painting.flat_picture().unwrap();
        let mut document: Document = painting.document().unwrap();
        document.dry.remove(1);
        assert!(on_cpu(document).flat_picture().is_ok_and(|without| {
            let off = differences(&hidden, &without);
            off[off.len() - 1] < 0.01
        }));
        painting.set_opacity(LayerRef::Dry(1), 1.0).unwrap();
        let off = differences(&hidden, &painting.flat_picture().unwrap());
        assert!(off[off.len() - 1] > 5.0, "{:?}", off.last());
        for wrong in [f64::NAN, -0.1, 1001.0] {
            let error = painting.set_opacity(LayerRef::Dry(0), wrong).unwrap_err();
            assert!(matches!(error, PaintingError::Range { .. }), "{error}");
        }
    }
}

#[test]
fn a_palette_changes_only_where_nothing_wet_would_be_left_behind() {
    let mut painting = on_cpu(bare(60, 60));
    let brush = loaded(&mut painting, HeadShape::Round, 2.0, YELLOW, 0.2);
    let without: Vec<PigmentId> = [pigment("Lead White"), pigment("Ultramarine")].to_vec();
    let error = painting.set_palette(&without).unwrap_err();
    assert!(
        matches!(&error, PaintingError::StillWet(pigment) if pigment == "Chrome Yellow"),
        "{error}"
    );
    painting.wash(brush).unwrap();
    painting.set_palette(&without).unwrap();
    let slots = painting.slots(LayerRef::Wet).unwrap();
    assert_eq!(slots.iter().flatten().count(), 2);
    assert_eq!(slots[0], Some(pigment("Lead White")), "slot of a pigment that stays");
    let error = painting.load(brush, &pure(RED), 0.0, 0.1).unwrap_err();
    assert!(matches!(error, PaintingError::EmptySlot(RED)), "{error}");
    let nine: Vec<PigmentId> = (0..9).map(PigmentId).collect();
    let error = painting.set_palette(&nine).unwrap_err();
    assert!(matches!(error, PaintingError::TooManyPigments(9)), "{error}");
}
