//! Laws of the record: it can always be read again.

use pigment::library::PigmentLibrary;

use super::failure::EaselError;
use super::record::Limits;
use super::state::Easel;
use crate::brush::HeadShape;
use crate::on_cpu::OnCpu;
use crate::painting::Painting;
use crate::pose::Sample;
use crate::strokes::{Action, BrushSpec, Strokes, Surface};
use graphics::gpu::DeviceError;

fn recorded() -> Easel {
    let library = PigmentLibrary::van_gogh_oils();
    let text = r#"{"format": "strokes", "version": 1, "brushes": {}, "actions": [],
        "canvas": {"width_mm": 8, "height_mm": 6, "cell_mm": 0.2}, "palette": ["Lead White"]}"#;
    let script = Strokes::from_json("header", text.as_bytes()).unwrap();
    let (canvas, _) = script.surfaces(&library, None).unwrap();
    let engine = Box::new(OnCpu::new(canvas.ground.height.clone()));
    let canvas = Painting::open(canvas, engine, 1 << 24).unwrap();
    let mut easel = Easel::recorded(canvas, None, &script).unwrap();
    easel.take_brush("round", &round(1.0)).unwrap();
    easel
}

fn round(size_mm: f64) -> BrushSpec {
    BrushSpec { shape: HeadShape::Round, size_mm }
}

fn dab(easel: &mut Easel) {
    let sample = Sample {
        seconds: 0.0,
        x_mm: 4.0,
        y_mm: 3.0,
        pressure: 0.5,
        tilt_x_deg: 0.0,
        tilt_y_deg: 0.0,
        twist_deg: 0.0,
    };
    easel.begin_stroke(Surface::Canvas, "round").unwrap();
    easel.extend(&[sample, sample]).unwrap();
    easel.end_stroke().unwrap();
}

fn limit(easel: &mut Easel, limits: Limits) {
    easel.record.as_mut().unwrap().limits = limits;
}

/// Paints until the recording holds `count` strokes and says why it ended.
fn stops(limits: Limits, count: usize, reason: &str) {
    let mut easel = recorded();
    limit(&mut easel, limits);
    for strokes in 1..=count {
        dab(&mut easel);
        assert_eq!(easel.recording().unwrap().actions.len(), strokes, "{reason}");
        assert_eq!(easel.recording_stopped(), None, "{reason}");
    }
    dab(&mut easel);
    assert_eq!(easel.recording_stopped(), Some(reason), "after {count}");
    // Less would fit, but it would be out of order.
    limit(&mut easel, Limits::default());
    easel.undo().unwrap();
    dab(&mut easel);
    assert_eq!(easel.recording().unwrap().actions.len(), count, "{reason}");
    assert_eq!(easel.history().1, count + 1, "painting goes on");
    let text = easel.recording().unwrap().to_json().unwrap();
    assert!(Strokes::from_json("a.json", text.as_bytes()).is_ok(), "what it holds is sound");
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
    let mut easel = recorded();
    limit(&mut easel, Limits { brushes: 20, ..Limits::default() });
    let wipe = Action::Wipe { brush: "round".to_owned(), keep: 0.5 };
    for head in 0..20 {
        easel.take_brush("round", &round(1.0 + 0.01 * f64::from(head))).unwrap();
        easel.act(&wipe).unwrap();
    }
    assert_eq!(easel.recording_stopped(), None);
    let text = easel.recording().unwrap().to_json().unwrap();
    let read = Strokes::from_json("a.json", text.as_bytes()).unwrap();
    // Each but the last was washed when it gave its name away.
    assert_eq!((read.brushes.len(), read.actions.len()), (20, 39));
    easel.take_brush("round", &round(9.0)).unwrap();
    easel.act(&wipe).unwrap();
    assert_eq!(easel.recording_stopped(), Some("a recording holds 20 brushes"));
}

#[test]
fn after_a_backend_failed_nothing_before_it_is_taken_back_out_of_order() {
    let mut easel = recorded();
    dab(&mut easel);
    dab(&mut easel);
    easel.undo().unwrap();
    let reason = DeviceError::NoAdapter { reason: "it burnt".to_owned() };
    let failed = easel.followed::<()>(Err(EaselError::Painting(reason.into())));
    assert!(failed.is_err(), "it is told");
    assert_eq!(easel.history(), (Vec::new(), 0));
    assert!(!easel.undo().unwrap() && !easel.redo().unwrap(), "nothing is known of before");
    let stopped = easel.recording_stopped().unwrap();
    assert!(stopped.starts_with("the backend failed: ") && stopped.contains("burnt"), "{stopped}");
    dab(&mut easel);
    assert!(easel.undo().unwrap(), "what was done since");
    assert!(!easel.undo().unwrap(), "and no more");
    assert_eq!(easel.recording().unwrap().actions.len(), 3);
    // Anything else that is refused leaves both as they are.
    dab(&mut easel);
    assert!(easel.act(&Action::Merge { layer: 7 }).is_err(), "no such layer");
    assert_eq!(easel.history().1, 1);
}

#[test]
fn a_session_without_a_header_is_not_recorded() {
    let Easel { canvas, .. } = recorded();
    let mut easel = Easel::new(canvas, None).unwrap();
    easel.take_brush("round", &round(1.0)).unwrap();
    dab(&mut easel);
    assert!(easel.recording().is_none() && easel.recording_stopped().is_none(), "none was begun");
}
