//! Tests of recordings: their limits, and that every recording can be read.

use pigment::library::PigmentLibrary;

use super::failure::SessionError;
use super::record::Limits;
use super::state::PaintingSession;
use crate::brush::HeadShape;
use crate::engine::PaintEngine;
use crate::painting::{LayerRef, Painting};
use crate::pose::Sample;
use crate::strokes::{Action, BrushSpec, StrokeScript, SurfaceId};
use graphics::gpu::DeviceError;

fn recorded() -> PaintingSession {
    let library = PigmentLibrary::van_gogh_oils();
    let text = r#"{"format": "strokes", "version": 1, "brushes": {}, "actions": [],
        "canvas": {"width_mm": 8, "height_mm": 6, "cell_mm": 0.2}, "palette": ["Lead White"]}"#;
    let script = StrokeScript::from_json("header", text.as_bytes()).unwrap();
    let (canvas, _) = script.surfaces(&library, None).unwrap();
    let engine = PaintEngine::on_cpu(canvas.ground.height.clone());
    let canvas = Painting::open(canvas, engine, 1 << 24).unwrap();
    let mut session = PaintingSession::recorded(canvas, None, &script).unwrap();
    session.set_brush("round", &round(1.0)).unwrap();
    session
}

fn round(size_mm: f64) -> BrushSpec {
    BrushSpec { shape: HeadShape::Round, size_mm }
}

fn dab(session: &mut PaintingSession) {
    let sample = Sample {
        seconds: 0.0,
        x_mm: 4.0,
        y_mm: 3.0,
        pressure: 0.5,
        tilt_x_deg: 0.0,
        tilt_y_deg: 0.0,
        twist_deg: 0.0,
    };
    session.begin_stroke(SurfaceId::Canvas, "round").unwrap();
    session.extend(&[sample, sample]).unwrap();
    session.end_stroke().unwrap();
}

fn limit(session: &mut PaintingSession, limits: Limits) {
    session.record.as_mut().unwrap().limits = limits;
}

/// Asserts that the recording holds `count` strokes and stops at the next for `reason`.
fn stops(limits: Limits, count: usize, reason: &str) {
    let mut session = recorded();
    limit(&mut session, limits);
    for strokes in 1..=count {
        dab(&mut session);
        assert_eq!(session.recording().unwrap().actions.len(), strokes, "{reason}");
        assert_eq!(session.recording_stopped(), None, "{reason}");
    }
    dab(&mut session);
    assert_eq!(session.recording_stopped(), Some(reason), "after {count}");
    // Later actions would fit, but are not recorded: one before them is missing.
    limit(&mut session, Limits::default());
    session.undo().unwrap();
    dab(&mut session);
    assert_eq!(session.recording().unwrap().actions.len(), count, "{reason}");
    assert_eq!(session.history().1, count + 1, "painting goes on");
    let text = session.recording().unwrap().to_json().unwrap();
    assert!(StrokeScript::from_json("a.json", text.as_bytes()).is_ok(), "cannot be read");
}

#[test]
fn a_recording_holds_what_can_be_read_again_and_says_when_it_ends() {
    let all = Limits::default();
    stops(Limits { actions: 3, ..all }, 3, "a recording holds 3 actions");
    stops(Limits { samples: 5, ..all }, 2, "a recording holds 5 samples");
    let text = "{\"stroke\": {\"brush\": \"round\", \"samples\": [[0,4,3,0.5], [0,4,3,0.5]]}}";
    let bytes = 2 * (text.len() + 6);
    stops(Limits { bytes, ..all }, 2, "a recording holds 0 MiB");
}

#[test]
fn as_many_heads_are_recorded_as_a_file_may_name() {
    let mut session = recorded();
    limit(&mut session, Limits { brushes: 20, ..Limits::default() });
    let wipe = Action::Wipe { brush: "round".to_owned(), keep: 0.5 };
    for head in 0..20 {
        session.set_brush("round", &round(1.0 + 0.01 * f64::from(head))).unwrap();
        session.apply(&wipe).unwrap();
    }
    assert_eq!(session.recording_stopped(), None);
    let text = session.recording().unwrap().to_json().unwrap();
    let read = StrokeScript::from_json("a.json", text.as_bytes()).unwrap();
    // Every head but the last was washed when it was replaced: 20 wipes and 19 washes.
    assert_eq!((read.brushes.len(), read.actions.len()), (20, 39));
    session.set_brush("round", &round(9.0)).unwrap();
    session.apply(&wipe).unwrap();
    assert_eq!(session.recording_stopped(), Some("a recording holds 20 brushes"));
}

#[test]
fn after_a_backend_failed_nothing_before_it_is_taken_back_out_of_order() {
    let mut session = recorded();
    dab(&mut session);
    dab(&mut session);
    session.undo().unwrap();
    let reason = DeviceError::NoAdapter { reason: "it burnt".to_owned() };
    let failed = session.follow_failure::<()>(Err(SessionError::Painting(reason.into())));
    assert!(failed.is_err(), "the failure is not returned");
    assert_eq!(session.history(), (Vec::new(), 0));
    assert!(!session.undo().unwrap() && !session.redo().unwrap(), "a step from before the failure");
    let stopped = session.recording_stopped().unwrap();
    assert!(stopped.starts_with("the backend failed: ") && stopped.contains("burnt"), "{stopped}");
    dab(&mut session);
    assert!(session.undo().unwrap(), "no undo of the new stroke");
    assert!(!session.undo().unwrap(), "an undo from before the failure");
    assert_eq!(session.recording().unwrap().actions.len(), 3);
    // A refused action changes neither the history nor the recording.
    dab(&mut session);
    assert!(
        session.apply(&Action::Merge { layer: LayerRef::Dry(7), with: None }).is_err(),
        "no such layer"
    );
    assert_eq!(session.history().1, 1);
}

#[test]
fn a_session_without_a_header_is_not_recorded() {
    let PaintingSession { canvas, .. } = recorded();
    let mut session = PaintingSession::new(canvas, None).unwrap();
    session.set_brush("round", &round(1.0)).unwrap();
    dab(&mut session);
    assert!(
        session.recording().is_none() && session.recording_stopped().is_none(),
        "a recording was begun"
    );
}
