//! Strokes extended in portions: any division into portions gives the paint and the undo of the
//! whole stroke.

use documents::hint::Explain;
use paint::brush::{HeadMesh, HeadShape};
use paint::engine::BrushId;
use paint::layer::Layer;
use paint::painting::{Painting, PaintingError};
use paint::pose::Sample;
use paint::stroke::StrokeError;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::studio::{BLUE, WHITE, along, bare, crossing, loaded, on_both};

/// The wet layer, then the paint on each of the first `brushes` brushes.
fn paint(painting: &mut Painting, brushes: usize) -> Vec<Layer> {
    let mut layers = vec![painting.wet().unwrap()];
    layers.extend((0..brushes).map(BrushId).map(|brush| painting.brush_paint(brush).unwrap()));
    layers
}

/// Random samples, some outside the canvas; one position occurs twice (a pen at rest).
fn wandering(random: &mut ChaCha8Rng) -> Vec<Sample> {
    let count = random.random_range(1..9);
    let mut place = || (random.random_range(-6.0..32.0), random.random_range(-6.0..26.0));
    let mut places: Vec<_> = (0..count).map(|_| place()).collect();
    places.insert(count / 2, places[count / 2]);
    along(&places, 0.6)
}

/// Extends a stroke by `samples` in random portions and paints a random number of sub-steps after
/// each. Returns the sub-steps, the cells, and whether the stroke can be undone.
fn in_pieces(
    painting: &mut Painting,
    brush: BrushId,
    samples: &[Sample],
    random: &mut ChaCha8Rng,
) -> (u64, u64, bool) {
    let mut stroke = painting.begin_stroke(brush).unwrap();
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
            let _ = loaded(painting, HeadShape::Flat, 5.0, WHITE, 0.6);
        }
        let before = paint(&mut whole, 4);
        let mut painted = 0;
        for seed in 0..16 {
            let random = &mut ChaCha8Rng::seed_from_u64(seed);
            let samples = wandering(random);
            let brush = BrushId(random.random_range(2..4));
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
            let brush = loaded(&mut whole, HeadShape::Round, 4.0, BLUE, 0.4);
            assert_eq!(loaded(&mut cut, HeadShape::Round, 4.0, BLUE, 0.4), brush);
            let clean = paint(&mut cut, 1);
            whole.stroke(brush, &samples[..3]).unwrap();
            let mut stroke = cut.begin_stroke(brush).unwrap();
            stroke.extend(&samples[..2]).unwrap();
            stroke.advance(&mut cut, 20).unwrap();
            // The sample before the refused one is accepted; the one after it is not.
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
        let brush = loaded(&mut painting, HeadShape::Round, 4.0, BLUE, 0.4);
        let error = painting.stroke(brush, &[]).unwrap_err();
        assert!(matches!(error, PaintingError::Stroke(StrokeError::Empty)), "{error}");
        let mut stroke = painting.begin_stroke(brush).unwrap();
        assert_eq!(stroke.advance(&mut painting, 10).unwrap(), 0);
        assert_eq!(stroke.finish(&mut painting).unwrap().substeps, 0);
        assert!(!painting.undo().unwrap(), "something to undo");
        // A stroke of a single sample paints a dab when it ends.
        let mut stroke = painting.begin_stroke(brush).unwrap();
        stroke.extend(&along(&[(9.0, 9.0)], 0.6)).unwrap();
        assert_eq!(stroke.advance(&mut painting, 10).unwrap(), 0, "no dab before the end");
        assert!(stroke.finish(&mut painting).unwrap().substeps > 3, "a dab");
        assert!(painting.undo().unwrap(), "no undo of a dab");
    }
}

#[test]
fn a_brush_hovers_between_strokes_and_bends_within_them() {
    let mut painting = on_both(&bare(130, 100)).remove(0);
    let brush = loaded(&mut painting, HeadShape::Round, 4.0, BLUE, 0.4);
    let samples = along(&[(3.0, 4.0), (15.0, 9.0)], 0.6);
    assert!(painting.head(brush).mesh().is_none(), "a mesh before the first hover");
    painting.hover(brush, &samples[0]);
    let hovering = painting.head(brush).mesh().unwrap();
    assert!(painting.wet().unwrap().totals()[BLUE] == 0, "hovering left paint");
    let mut stroke = painting.begin_stroke(brush).unwrap();
    stroke.extend(&samples).unwrap();
    stroke.lift();
    stroke.advance(&mut painting, 32).unwrap();
    let bent = painting.head(brush).mesh().unwrap();
    let lowest = |mesh: &HeadMesh| {
        mesh.vertices.iter().map(|vertex| vertex[2]).fold(f32::INFINITY, f32::min)
    };
    assert!(lowest(&bent) < lowest(&hovering), "the head did not bend");
    painting.hover(brush, &samples[0]);
    assert_eq!(painting.head(brush).mesh(), Some(bent), "hover moved the head");
    stroke.finish(&mut painting).unwrap();
}

#[test]
#[should_panic(expected = "a stroke is open")]
fn other_actions_wait_for_the_stroke_to_end() {
    let mut painting = on_both(&bare(40, 40)).remove(0);
    let brush = loaded(&mut painting, HeadShape::Round, 4.0, BLUE, 0.4);
    let _stroke = painting.begin_stroke(brush).unwrap();
    let _ = painting.undo();
}
