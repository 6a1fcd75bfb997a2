//! Tests of sessions that go on from what another one kept.

use std::convert::Infallible;
use std::ops::ControlFlow;
use std::sync::Arc;

use graphics::tile::Rect;
use pigment::PigmentLibrary;

use super::kept::KeptSession;
use super::state::PaintingSession;
use crate::brush::HeadShape;
use crate::document::Document;
use crate::engine::PaintEngine;
use crate::mask::Mask;
use crate::painting::Painting;
use crate::pose::Sample;
use crate::strokes::{Action, BrushSpec, MaskChange, Squeeze, StrokeScript, SurfaceId};

const HEADER: &str = r#"{"format": "strokes", "version": 1, "brushes": {}, "actions": [],
    "canvas": {"width_mm": 24, "height_mm": 16, "cell_mm": 0.25},
    "mixing": {"width_mm": 12, "height_mm": 8, "cell_mm": 0.25},
    "palette": ["Lead White", "Prussian Blue"]}"#;

fn opened(canvas: Document, palette: Option<Document>) -> (Painting, Option<Painting>) {
    let engine = |document: &Document| PaintEngine::on_cpu(document.ground.height.clone());
    let on_canvas = engine(&canvas);
    let on_palette = palette.as_ref().map(engine);
    let canvas = Painting::open(canvas, on_canvas, 1 << 26).unwrap();
    let palette = palette.zip(on_palette).map(|(palette, engine)| {
        Painting::open_under(palette, Arc::clone(canvas.light()), engine, 1 << 26).unwrap()
    });
    (canvas, palette)
}

fn begun() -> PaintingSession {
    let library = PigmentLibrary::van_gogh_oils();
    let script = StrokeScript::from_json("header", HEADER.as_bytes()).unwrap();
    let (canvas, palette) = script.surfaces(&library, None).unwrap();
    let (canvas, palette) = opened(canvas, palette);
    let mut session = PaintingSession::recorded(canvas, palette, &script).unwrap();
    for (name, shape, size_mm) in [("round", HeadShape::Round, 3.0), ("flat", HeadShape::Flat, 4.0)]
    {
        session.set_brush(name, &BrushSpec { shape, size_mm }).unwrap();
    }
    session
}

/// A way over a surface with a bend, of `count` samples.
fn way(y_mm: f64, count: usize) -> Vec<Sample> {
    (0..count)
        .map(|index: usize| {
            let share = index as f64 / 20.0;
            Sample::upright(share, 2.0 + 9.0 * share, y_mm + 2.0 * share * share, 0.3 + 0.4 * share)
        })
        .collect()
}

fn stroke(session: &mut PaintingSession, on: SurfaceId, brush: &str, y_mm: f64) {
    session.begin_stroke(on, brush).unwrap();
    session.extend(&way(y_mm, 21)).unwrap();
    session.end_stroke().unwrap();
}

/// Loads, mixing on the palette, a head that replaces another, undo, and drying.
fn first_half(session: &mut PaintingSession) {
    let recipe = [("Lead White".to_owned(), 1.0)].into();
    let vehicle = 0.1;
    let x_mm = 5.0;
    let y_mm = 4.0;
    let volume_mm3 = 20.0;
    let on = SurfaceId::Palette;
    let heap = Squeeze { on, recipe, vehicle, x_mm, y_mm, volume_mm3 };
    session.apply(&Action::Squeeze(heap)).unwrap();
    session.load("flat", [("Prussian Blue", 1.0)], 0.2).unwrap();
    stroke(session, SurfaceId::Palette, "flat", 3.0);
    stroke(session, SurfaceId::Canvas, "flat", 3.0);
    session.load("round", [("Prussian Blue", 1.0), ("Lead White", 2.0)], 0.3).unwrap();
    stroke(session, SurfaceId::Canvas, "round", 6.0);
    session.undo().unwrap();
    session.set_brush("flat", &BrushSpec { shape: HeadShape::Flat, size_mm: 2.0 }).unwrap();
    session.load("flat", [("Lead White", 1.0)], 0.2).unwrap();
    stroke(session, SurfaceId::Canvas, "flat", 9.0);
    session.apply(&Action::Dry { fraction: 0.5 }).unwrap();
}

fn second_half(session: &mut PaintingSession) {
    stroke(session, SurfaceId::Canvas, "round", 4.0);
    stroke(session, SurfaceId::Palette, "flat", 5.0);
    session.undo().unwrap();
    session.set_brush("wide", &BrushSpec { shape: HeadShape::Flat, size_mm: 6.0 }).unwrap();
    session.load("wide", [("Prussian Blue", 1.0)], 0.1).unwrap();
    stroke(session, SurfaceId::Canvas, "wide", 8.0);
    session.set_brush("flat", &BrushSpec { shape: HeadShape::Flat, size_mm: 4.0 }).unwrap();
    stroke(session, SurfaceId::Canvas, "flat", 10.0);
}

/// Keeps a session in two pieces of its recording, as autosaves do, and restores it.
fn restored(session: &mut PaintingSession, known: usize) -> PaintingSession {
    let earlier = session.recording().unwrap().actions[..known].to_vec();
    let tail = session.recording_from(known).unwrap();
    assert_eq!(tail.from, known, "it follows what is known");
    let mut recording = tail.header;
    recording.actions = earlier.into_iter().chain(tail.actions).chain(tail.open).collect();
    let brushes = session.kept_heads().unwrap();
    let mask = session.canvas().mask().cloned();
    let (canvas, palette) = session.documents().unwrap();
    let (canvas, palette) = opened(canvas, palette);
    let kept = KeptSession { brushes, recording: Some(recording), mask };
    PaintingSession::restored(canvas, palette, kept).unwrap()
}

/// Canvas, palette and brushes after the recording was played from the start.
fn replayed(session: &PaintingSession) -> PaintingSession {
    let text = session.recording().unwrap().to_json().unwrap();
    let script = StrokeScript::from_json("recording", text.as_bytes()).unwrap();
    let library = PigmentLibrary::van_gogh_oils();
    let (canvas, palette) = script.surfaces(&library, None).unwrap();
    let (canvas, palette) = opened(canvas, palette);
    let mut player = PaintingSession::new(canvas, palette).unwrap();
    script
        .replay(&mut player, |_, _| Ok::<(), Infallible>(()), || ControlFlow::Continue(()))
        .unwrap();
    player
}

fn assert_same_paint(a: &mut PaintingSession, b: &mut PaintingSession, when: &str) {
    assert!(a.documents().unwrap() == b.documents().unwrap(), "canvas and palette {when}");
    let paint = |session: &mut PaintingSession| session.brush_paint("round").unwrap();
    assert!(paint(a) == paint(b), "the brush {when}");
}

#[test]
fn a_restored_session_goes_on_as_the_session_itself_would_have() {
    let mut whole = begun();
    first_half(&mut whole);
    let mut again = restored(&mut whole, 3);
    assert_same_paint(&mut whole, &mut again, "when restored");
    let flat = |session: &mut PaintingSession| session.brush_paint("flat").unwrap();
    assert!(flat(&mut whole).is_some() && flat(&mut whole) == flat(&mut again), "the second head");
    second_half(&mut whole);
    second_half(&mut again);
    assert_same_paint(&mut whole, &mut again, "at the end");
    assert_eq!(whole.recording(), again.recording(), "the recordings agree");
    let (undone, _) = again.history();
    assert_eq!(undone.len(), 3, "only what was done since can be undone: {undone:?}");
}

#[test]
fn the_joined_recording_replays_to_the_bit() {
    let mut session = begun();
    first_half(&mut session);
    let mut session = restored(&mut session, 0);
    second_half(&mut session);
    let (canvas, palette) = session.documents().unwrap();
    let mut player = replayed(&session);
    assert!(player.documents().unwrap() == (canvas, palette), "canvas and palette");
}

#[test]
fn a_session_kept_within_a_stroke_replays_to_the_bit() {
    let mut session = begun();
    first_half(&mut session);
    session.begin_stroke(SurfaceId::Canvas, "round").unwrap();
    for pair in way(5.0, 12).chunks(3) {
        session.extend(pair).unwrap();
        while session.advance(5).unwrap() > 0 {}
    }
    let mut cut = restored(&mut session, 5);
    assert_eq!(cut.recording().unwrap().actions.last().map(Action::kind), Some("cut"));
    let mut player = replayed(&cut);
    assert_same_paint(&mut cut, &mut player, "within the stroke");
    second_half(&mut cut);
    let mut player = replayed(&cut);
    assert!(cut.documents().unwrap() == player.documents().unwrap(), "and after it");
    session.end_stroke().unwrap();
    let (finished, _) = session.documents().unwrap();
    let (open, _) = restored(&mut session, 0).documents().unwrap();
    assert!(finished == open, "a finished stroke is recorded whole");
}

#[test]
fn an_open_adjustment_is_kept() {
    let mut session = begun();
    first_half(&mut session);
    session.adjust(&Action::Stiffness { value: 0.75 }).unwrap();
    let kept = restored(&mut session, 0);
    let last = kept.recording().unwrap().actions.last();
    assert_eq!(last, Some(&Action::Stiffness { value: 0.75 }));
    assert!(session.recording().unwrap().actions.last() != last, "it is still open");
}

#[test]
fn brushes_that_do_not_go_together_are_refused() {
    let mut session = begun();
    first_half(&mut session);
    let (canvas, palette) = session.documents().unwrap();
    let brushes = session.kept_heads().unwrap();
    let refused = |change: fn(&mut super::kept::KeptHead)| {
        let mut brushes = brushes.clone();
        let loaded = brushes.iter_mut().find(|brush| brush.paint.is_some()).unwrap();
        change(loaded);
        let (canvas, palette) = opened(canvas.clone(), palette.clone());
        let kept = KeptSession { brushes, ..KeptSession::default() };
        PaintingSession::restored(canvas, palette, kept).is_err()
    };
    assert!(!refused(|_| {}));
    assert!(refused(|brush| brush.numbers.canvas = Some(7)));
    assert!(refused(|brush| brush.spec.size_mm = 9.0), "its paint has other cells");
}

#[test]
fn the_mask_is_kept_and_one_of_another_canvas_is_refused() {
    let mut whole = begun();
    first_half(&mut whole);
    let open = vec![[0.0, 0.0], [7.0, 0.0], [7.0, 16.0], [0.0, 16.0]];
    whole.apply(&Action::Mask(MaskChange::PolygonMm(open))).unwrap();
    let mut again = restored(&mut whole, 3);
    second_half(&mut whole);
    second_half(&mut again);
    assert_same_paint(&mut whole, &mut again, "under the mask");
    again.apply(&Action::Mask(MaskChange::Inverse(true))).unwrap();
    stroke(&mut again, SurfaceId::Canvas, "round", 12.0);
    let mut player = replayed(&again);
    assert!(again.documents().unwrap() == player.documents().unwrap(), "the recording replays");

    let mask = Mask::with_open(Rect { x: 0, y: 0, width: 3, height: 2 }, |_| true);
    let (canvas, palette) = again.documents().unwrap();
    let (canvas, palette) = opened(canvas, palette);
    let kept = KeptSession { mask: Some(Arc::new(mask)), ..KeptSession::default() };
    let refused = PaintingSession::restored(canvas, palette, kept);
    assert!(refused.unwrap_err().to_string().contains("masks"), "its cells are others");
}
