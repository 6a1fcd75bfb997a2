//! Undo and redo of every kind of action restore paint, brushes and picture bit for bit. If you
//! extend a stroke in portions, any division gives the paint and the undo of the whole stroke.

use calibrate::PigmentId;
use documents::hint::Explain;
use graphics::field::Field;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::studio::{
    BLUE, PALETTE, WHITE, YELLOW, along, bare, crossing, loaded, on_both, on_cpu, open, pigment,
    pure,
};
use paint::brush::{HeadShape, HeadShape as PiecesHeadShape};
use paint::document::{Document, Lighting};
use paint::engine::{BrushId, BrushId as PiecesBrushId, PaintEngine};
use paint::history::TILE_BYTES;
use paint::layer::{Layer, Layer as PiecesLayer, LayerRef};
use paint::light::Light;
use paint::optics::Gloss;
use paint::painting::{Painting, PaintingError, UNDO_BYTES};
use paint::pose::Sample;
use paint::stroke::StrokeError;
use paint::strokes::{Action, StrokeTool};

/// A painting, the paint on each of its brushes, and its picture.
type Whole = (Document, Vec<Layer>, Field<[f32; 4]>);

fn whole(painting: &mut Painting, brushes: usize) -> Whole {
    let paint =
        (0..brushes).map(BrushId).map(|brush| painting.brush_paint(brush).unwrap()).collect();
    (painting.document().unwrap(), paint, painting.picture().unwrap())
}

/// Applies a random action. Returns whether it became a step of the history.
fn apply(painting: &mut Painting, random: &mut ChaCha8Rng) -> bool {
    let layers = painting.state().dry.len();
    match random.random_range(0..16) {
        0 => painting.dry(random.random_range(0.1..=1.0)).unwrap(),
        1 if layers > 0 => {
            let opacity = random.random_range(0.0..2.0);
            painting.set_opacity(LayerRef::Dry(random.random_range(0..layers)), opacity).unwrap();
            true
        }
        2 => {
            let layer = random.random_range(0..=layers);
            let coating = if layer == layers { LayerRef::Wet } else { LayerRef::Dry(layer) };
            let a = pigment("Vermilion");
            let b = pigment("Minium");
            painting.swap_pigment(coating, a, b).is_ok()
                || painting.swap_pigment(coating, b, a).is_ok()
        }
        3 => {
            let more = ["Ultramarine", "Cobalt Blue"][random.random_range(0..2)];
            let names = PALETTE[..5].iter().chain([&more]);
            let pigments: Vec<PigmentId> = names.map(|name| pigment(name)).collect();
            painting.set_palette(&pigments).is_ok()
        }
        4 => {
            let illuminant = ["A", "D65"][random.random_range(0..2)].to_owned();
            let azimuth_deg = random.random_range(0.0..360.0);
            painting.relight(Lighting { illuminant, azimuth_deg, ..Lighting::default() }).unwrap();
            true
        }
        10 => {
            let x_mm = random.random_range(0.0..26.0);
            let y_mm = random.random_range(0.0..20.0);
            let recipe = std::array::from_fn(|slot| if slot < 5 { 1.0 } else { 0.0 });
            painting.squeeze(&recipe, 0.1, x_mm, y_mm, random.random_range(0.1..60.0)).is_ok()
        }
        11 if random.random_range(0..2) == 0 => {
            painting.scrape().unwrap();
            true
        }
        12 => {
            let shine = Gloss { strength: random.random_range(0.0..0.5), exponent: 30.0 };
            let dry = Gloss { strength: 0.1, ..shine };
            painting.apply(&Action::Gloss { wet: shine, dry }).unwrap();
            true
        }
        5 if layers > 1 => {
            let [a, b] = [0; 2].map(|_| LayerRef::Dry(random.random_range(0..layers)));
            painting.merge(a, b).is_ok()
        }
        13 if layers > 0 => {
            let layer = painting.state().dry[random.random_range(0..layers)].id;
            let name = ["sky", "sea"][layers % 2].to_owned();
            painting.apply(&Action::Name { layer: LayerRef::Id(layer), name }).unwrap();
            true
        }
        14 if layers > 0 => {
            let layer = LayerRef::Dry(random.random_range(0..layers));
            let value = random.random_bool(0.5);
            painting.apply(&Action::Visible { layer, value }).unwrap();
            true
        }
        15 if layers > 1 => {
            let layer = random.random_range(0..layers);
            let to = random.random_range(0..layers);
            painting.apply(&Action::Order { layer: LayerRef::Dry(layer), to }).unwrap()
        }
        _ => {
            let brush = random.random_range(0..2);
            let places =
                [(); 3].map(|()| (random.random_range(0.0..26.0), random.random_range(0.0..20.0)));
            let report = painting.stroke(BrushId(brush), &along(&places, 0.6)).unwrap();
            assert!(report.undoable, "a stroke exceeds the undo memory");
            true
        }
    }
}

#[test]
fn any_sequence_of_actions_is_undone_and_redone_to_the_bit() {
    for mut painting in on_both(&bare(130, 100)) {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let _ = loaded(&mut painting, HeadShape::Flat, 5.0, WHITE, 0.6);
        let _ = loaded(&mut painting, HeadShape::Round, 3.0, BLUE, 0.6);
        let mut past = vec![whole(&mut painting, 2)];
        for round in 0..24 {
            if apply(&mut painting, &mut random) {
                past.push(whole(&mut painting, 2));
            } else {
                let same = whole(&mut painting, 2) == past[past.len() - 1];
                assert!(same, "round {round}: a refused action changed something");
            }
        }
        assert!(past.len() > 12, "only {} actions", past.len());
        let back: usize = past.len() - 1;
        for index in (0..back).rev() {
            assert!(painting.undo().unwrap(), "no undo left at {index}");
            assert!(whole(&mut painting, 2) == past[index], "state {index} after undo");
        }
        assert!(!painting.undo().unwrap(), "an undo before the first action");
        assert!(whole(&mut painting, 2) == past[0], "an undo of nothing changed something");
        for (index, then) in past.iter().enumerate().skip(1) {
            assert!(painting.redo().unwrap(), "no redo left at {index}");
            assert!(whole(&mut painting, 2) == *then, "state {index} after redo");
        }
        assert!(!painting.redo().unwrap(), "a redo after the last action");
    }
}

#[test]
fn what_passes_the_memory_limit_is_forgotten_oldest_first() {
    let document = bare(130, 100);
    let brush_bytes = {
        let mut painting = on_cpu(document.clone());
        let brush = painting.add_brush(HeadShape::Round, 2.0).unwrap();
        painting.brush_paint(brush).unwrap().vehicle.values().len() as u64 * 36
    };
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    let mut painting = open(document, engine, 3 * (TILE_BYTES + brush_bytes));
    let brush = loaded(&mut painting, HeadShape::Round, 2.0, YELLOW, 0.5);
    let mut past = Vec::new();
    // Each dab is within one tile, so three of them fit into the memory limit.
    for place in [(4.0, 4.0), (6.0, 6.0), (4.0, 8.0), (8.0, 4.0), (5.0, 5.0)] {
        past.push(painting.wet().unwrap());
        let dab = along(&[place, (place.0 + 0.5, place.1)], 0.5);
        assert!(painting.stroke(brush, &dab).unwrap().undoable, "one tile fits");
    }
    for index in [4, 3, 2] {
        assert!(painting.undo().unwrap(), "step {index} was dropped");
        assert!(painting.wet().unwrap() == past[index], "state {index} after undo");
    }
    assert!(!painting.undo().unwrap(), "older ones do not fit");
    // This goes along three edges, through more tiles than the limit holds.
    let long = along(&[(2.0, 2.0), (24.0, 2.0), (24.0, 18.0), (2.0, 18.0)], 0.5);
    assert!(!painting.stroke(brush, &long).unwrap().undoable, "a stroke beyond the memory limit");
    assert!(!painting.undo().unwrap(), "older steps are dropped too");
}

#[test]
fn a_drying_keeps_only_the_tiles_that_were_wet() {
    let document = bare(400, 400);
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    let mut painting = open(document, engine, 4 * TILE_BYTES);
    let brush = loaded(&mut painting, HeadShape::Round, 1.0, YELLOW, 0.5);
    painting.stroke(brush, &along(&[(4.0, 4.0), (5.0, 4.0)], 0.5)).unwrap();
    let before = painting.wet().unwrap();
    assert!(painting.dry(1.0).unwrap(), "there was paint");
    assert!(painting.undo().unwrap(), "49 tiles do not fit, one does");
    assert!(painting.wet().unwrap() == before, "paint after undo");
    assert!(painting.dry(1.0).unwrap() && !painting.dry(1.0).unwrap(), "nothing stays wet");
}

#[test]
fn a_brush_never_changes_its_pigment_by_an_undo() {
    for mut painting in on_both(&bare(60, 60)) {
        let mut all: Vec<PigmentId> = PALETTE.iter().map(|name| pigment(name)).collect();
        all[0] = pigment("Ultramarine");
        let brush = painting.add_brush(HeadShape::Round, 2.0).unwrap();
        painting.set_palette(&all).unwrap();
        assert_eq!(painting.slot_of(pigment("Ultramarine")).unwrap(), WHITE);
        painting.load(brush, &pure(WHITE), 0.0, 0.2).unwrap();
        let late = painting.add_brush(HeadShape::Round, 2.0).unwrap();
        painting.load(late, &pure(WHITE), 0.0, 0.2).unwrap();
        assert!(painting.undo().unwrap(), "no undo of the palette");
        let clean = [0; 9];
        for brush in [brush, late] {
            let paint = painting.brush_paint(brush).unwrap().totals();
            assert_eq!(paint, clean, "ultramarine became lead white on {brush:?}");
        }
        assert!(painting.redo().unwrap(), "no redo of the palette");
        assert!(painting.brush_paint(brush).unwrap().totals()[WHITE] > 0, "paint after redo");
    }
}

#[test]
fn a_measured_light_comes_back_with_an_undo() {
    let lamp: Vec<String> = (380..=780).step_by(10).map(|nm| format!("{nm},{nm}")).collect();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("lamp.csv");
    std::fs::write(&file, lamp.join("\n")).unwrap();
    let viewing = calibrate::evaluate::Viewing {
        illuminant: spectra::light_from_text(file.to_str().unwrap()).unwrap(),
        ..calibrate::evaluate::Viewing::default()
    };
    let mut document = bare(60, 60);
    document.lighting.illuminant = "my lamp".to_owned();
    let light = Light::new(&document.library, &viewing).unwrap();
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    let mut painting = Painting::open_under(document, light, engine, UNDO_BYTES).unwrap();
    crossing(&mut painting);
    let seen = painting.picture().unwrap();
    painting.relight(Lighting::default()).unwrap();
    assert!(painting.picture().unwrap() != seen, "the light changed");
    assert!(painting.undo().unwrap(), "no undo to a light without a known name");
    assert!(painting.picture().unwrap() == seen, "picture after undo");
}

/// The wet layer, and the paint on each of the first `brushes` brushes.
fn paint(painting: &mut Painting, brushes: usize) -> Vec<PiecesLayer> {
    let mut layers = vec![painting.wet().unwrap()];
    layers
        .extend((0..brushes).map(PiecesBrushId).map(|brush| painting.brush_paint(brush).unwrap()));
    layers
}

/// Random samples, some outside the canvas. One position occurs twice, like a pen at rest.
fn wandering(random: &mut ChaCha8Rng) -> Vec<Sample> {
    let count = random.random_range(1..9);
    let mut places: Vec<_> = (0..count)
        .map(|_| (random.random_range(-6.0..32.0), random.random_range(-6.0..26.0)))
        .collect();
    places.insert(count / 2, places[count / 2]);
    along(&places, 0.6)
}

/// Extends a stroke by `samples` in random portions, and paints a random number of sub-steps after
/// each. Returns the sub-steps, the cells, and whether you can undo the stroke.
fn in_pieces(
    painting: &mut Painting,
    brush: PiecesBrushId,
    samples: &[Sample],
    random: &mut ChaCha8Rng,
) -> (u64, u64, bool) {
    let mut stroke = painting.begin_stroke(StrokeTool::Paint, brush).unwrap();
    let mut rest = samples;
    while !rest.is_empty() {
        let (now, later) = rest.split_at(random.random_range(0..=rest.len()));
        stroke.extend(now).unwrap();
        rest = later;
        for _ in 0..random.random_range(0..6) {
            stroke.advance(painting, random.random_range(0..70)).unwrap();
        }
    }
    if random.random_range(0..2) == 0 {
        stroke.lift();
        while stroke.advance(painting, 50).unwrap() > 0 {
            let reached = stroke.reached();
            assert!(reached <= samples.len(), "{reached} of {}", samples.len());
        }
        assert_eq!(stroke.reached(), samples.len(), "not all were reached");
    }
    assert!(painting.stroke_open(), "closed too early");
    let report = stroke.finish(painting).unwrap();
    assert!(!painting.stroke_open(), "still open");
    (report.substeps, report.cells, report.undoable)
}

#[test]
fn however_a_stroke_is_cut_its_paint_brush_and_undo_are_those_of_the_whole() {
    let wholes = on_both(&bare(130, 100));
    for (mut whole, mut cut) in wholes.into_iter().zip(on_both(&bare(130, 100))) {
        for painting in [&mut whole, &mut cut] {
            crossing(painting);
            let _ = loaded(painting, PiecesHeadShape::Flat, 5.0, WHITE, 0.6);
        }
        let before = paint(&mut whole, 4);
        let mut painted = 0;
        for seed in 0..16 {
            let random = &mut ChaCha8Rng::seed_from_u64(seed);
            let samples = wandering(random);
            let brush = PiecesBrushId(random.random_range(2..4));
            let report = whole.stroke(brush, &samples).unwrap();
            let found = in_pieces(&mut cut, brush, &samples, random);
            assert_eq!(found, (report.substeps, report.cells, report.undoable), "seed {seed}");
            painted += report.substeps;
            assert!(paint(&mut cut, 4) == paint(&mut whole, 4), "seed {seed}");
        }
        assert!(painted > 500, "{painted} sub-steps");
        assert!(cut.picture().unwrap() == whole.picture().unwrap(), "pictures differ");
        let after = paint(&mut cut, 4);
        (0..16).for_each(|_| assert!(cut.undo().unwrap(), "one undo a stroke"));
        assert!(paint(&mut cut, 4) == before, "paint after undo");
        (0..16).for_each(|_| assert!(cut.redo().unwrap(), "one redo a stroke"));
        assert!(paint(&mut cut, 4) == after, "paint after redo");
    }
}

#[test]
fn a_refused_sample_leaves_the_stroke_as_far_as_it_was() {
    let samples = along(&[(3.0, 4.0), (9.0, 5.0), (15.0, 9.0), (20.0, 14.0)], 0.6);
    let bad = [
        Sample { pressure: 1.5, ..samples[3] },
        Sample { x_mm: f64::NAN, ..samples[3] },
        Sample { seconds: 0.15, ..samples[3] },
    ];
    for bad in bad {
        let wholes = on_both(&bare(130, 100));
        for (mut whole, mut cut) in wholes.into_iter().zip(on_both(&bare(130, 100))) {
            let brush = loaded(&mut whole, PiecesHeadShape::Round, 4.0, BLUE, 0.4);
            assert_eq!(loaded(&mut cut, PiecesHeadShape::Round, 4.0, BLUE, 0.4), brush);
            let clean = paint(&mut cut, 1);
            whole.stroke(brush, &samples[..3]).unwrap();
            let mut stroke = cut.begin_stroke(StrokeTool::Paint, brush).unwrap();
            stroke.extend(&samples[..2]).unwrap();
            stroke.advance(&mut cut, 20).unwrap();
            // The sample before the refused one is accepted, but not the one after it.
            let error = stroke.extend(&[samples[2], bad, samples[3]]).unwrap_err();
            let error = PaintingError::from(error);
            assert!(matches!(error, PaintingError::Stroke(_)), "{error}");
            assert!(error.to_string().starts_with("sample 3: "), "{error}");
            assert!(error.hint().is_some(), "{error}");
            stroke.advance(&mut cut, 20).unwrap();
            stroke.finish(&mut cut).unwrap();
            assert!(paint(&mut cut, 1) == paint(&mut whole, 1), "{bad:?}");
            assert!(cut.undo().unwrap(), "no undo");
            assert!(paint(&mut cut, 1) == clean, "paint after undo");
        }
    }
}

#[test]
fn a_stroke_without_samples_is_no_action() {
    for mut painting in on_both(&bare(130, 100)) {
        let brush = loaded(&mut painting, PiecesHeadShape::Round, 4.0, BLUE, 0.4);
        let error = painting.stroke(brush, &[]).unwrap_err();
        assert!(matches!(error, PaintingError::Stroke(StrokeError::Empty)), "{error}");
        let mut stroke = painting.begin_stroke(StrokeTool::Paint, brush).unwrap();
        assert_eq!(stroke.advance(&mut painting, 10).unwrap(), 0);
        assert_eq!(stroke.finish(&mut painting).unwrap().substeps, 0);
        assert!(!painting.undo().unwrap(), "something to undo");
        // A stroke of a single sample paints a dab when it ends.
        let mut stroke = painting.begin_stroke(StrokeTool::Paint, brush).unwrap();
        stroke.extend(&along(&[(9.0, 9.0)], 0.6)).unwrap();
        assert_eq!(stroke.advance(&mut painting, 10).unwrap(), 0, "no dab before the end");
        assert!(stroke.finish(&mut painting).unwrap().substeps > 3, "a dab");
        assert!(painting.undo().unwrap(), "no undo of a dab");
    }
}

#[test]
fn a_brush_hovers_between_strokes_and_bends_within_them() {
    let mut painting = on_both(&bare(130, 100)).remove(0);
    let brush = loaded(&mut painting, PiecesHeadShape::Round, 4.0, BLUE, 0.4);
    let samples = along(&[(3.0, 4.0), (15.0, 9.0)], 0.6);
    assert!(painting.head(brush).mesh().is_none(), "a mesh before the first hover");
    painting.hover(brush, &samples[0]);
    let hovering = painting.head(brush).mesh().unwrap();
    assert!(painting.wet().unwrap().totals()[BLUE] == 0, "hovering left paint");
    let mut stroke = painting.begin_stroke(StrokeTool::Paint, brush).unwrap();
    stroke.extend(&samples).unwrap();
    stroke.lift();
    stroke.advance(&mut painting, 32).unwrap();
    let bent = painting.head(brush).mesh().unwrap();
    let [bent_to, hovers_at] = [&bent, &hovering]
        .map(|mesh| mesh.vertices.iter().map(|vertex| vertex[2]).fold(f32::INFINITY, f32::min));
    assert!(bent_to < hovers_at, "the head did not bend");
    painting.hover(brush, &samples[0]);
    assert_eq!(painting.head(brush).mesh(), Some(bent), "hover moved the head");
    stroke.finish(&mut painting).unwrap();
}

#[test]
#[should_panic(expected = "a stroke is open")]
fn other_actions_wait_for_the_stroke_to_end() {
    let mut painting = on_both(&bare(40, 40)).remove(0);
    let brush = loaded(&mut painting, PiecesHeadShape::Round, 4.0, BLUE, 0.4);
    let _stroke = painting.begin_stroke(StrokeTool::Paint, brush).unwrap();
    let _ = painting.undo();
}
