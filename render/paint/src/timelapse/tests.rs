use std::ops::ControlFlow;
use std::path::Path;

use graphics::export::{AnimationFormat, Frame, FrameRate, srgb8};
use pigment::PigmentLibrary;

use super::*;
use crate::brush::HeadShape;
use crate::document::Canvas;
use crate::layer::LayerRef;
use crate::pose::Sample;
use crate::session::PaintingSession;
use crate::strokes::{Action, BrushSpec, StrokeScript};

fn canvas() -> Canvas {
    Canvas { width_mm: 16.0, height_mm: 10.0, cell_mm: 0.25, ..Canvas::default() }
}

fn blank() -> PaintingSession {
    PaintingSession::on_canvas(&PigmentLibrary::van_gogh_oils(), &canvas()).unwrap()
}

/// A script of three strokes of 1 s, of which the second was undone, and its last frame.
fn recorded() -> (StrokeScript, Frame) {
    let mut session = blank();
    let spec = BrushSpec { shape: HeadShape::Round, size_mm: 3.0 };
    session.set_brush("round", &spec).unwrap();
    session.load("round", [("Prussian Blue", 1.0)], 0.3).unwrap();
    for y_mm in [2.0, 5.0, 8.0] {
        let samples: Vec<Sample> = (0..=10)
            .map(|index: i32| {
                let share = f64::from(index) / 10.0;
                Sample::upright(share, 2.0 + 12.0 * share, y_mm, 0.6)
            })
            .collect();
        session.stroke("round", &samples).unwrap();
        if y_mm == 5.0 {
            session.undo().unwrap();
        }
    }
    let end = srgb8(&session.canvas_mut().picture().unwrap()).unwrap();
    (session.recording().unwrap().clone(), end)
}

fn settings(interval: Interval) -> TimelapseSettings {
    TimelapseSettings { interval, ..TimelapseSettings::default() }
}

fn frames(script: &StrokeScript, settings: TimelapseSettings) -> Vec<Frame> {
    let timelapse = Timelapse::new(script, settings).unwrap();
    let wanted: Vec<usize> = (0..timelapse.frames()).collect();
    let mut found = Vec::new();
    let _ = timelapse
        .play(
            &mut blank(),
            &wanted,
            |_| ControlFlow::Continue(()),
            |index, frame| {
                assert_eq!(index, found.len(), "in their order");
                found.push(frame);
                Ok(())
            },
        )
        .unwrap();
    found
}

fn differing(a: &Frame, b: &Frame) -> usize {
    a.values().iter().zip(b.values()).filter(|(a, b)| a != b).count()
}

#[test]
fn frames_grow_from_the_bare_canvas_to_the_end() {
    let (script, end) = recorded();
    let found = frames(&script, settings(Interval::Seconds(0.25)));
    assert_eq!(found.len(), 9, "2 s of strokes that are left");
    let bare = srgb8(&blank().canvas_mut().picture().unwrap()).unwrap();
    assert!(found[0] == bare, "the first is the bare canvas");
    assert!(found[8] == end, "the last is the painting");
    let painted: Vec<usize> = found.iter().map(|frame| differing(frame, &bare)).collect();
    assert!(painted[1..].is_sorted(), "{painted:?}");
    assert!(painted[2] > painted[1] && painted[6] > painted[5], "within strokes: {painted:?}");
}

#[test]
fn an_undone_passage_is_shown_on_request_only() {
    let (script, end) = recorded();
    let [without, with] = [false, true].map(|with_undone| {
        let settings = TimelapseSettings { with_undone, ..settings(Interval::Actions(1)) };
        frames(&script, settings)
    });
    assert_eq!((without.len(), with.len()), (3, 5));
    assert!(without[2] == end && with[4] == end);
    assert!(with[3] == with[1] && with[2] != with[1], "the second stroke comes and goes");
    assert!(without[1] == with[1], "it is painted, but not shown");
}

#[test]
fn frames_are_reduced() {
    let (script, _) = recorded();
    let settings = TimelapseSettings { longest_px: 32, ..settings(Interval::Frames(3)) };
    let found = frames(&script, settings);
    assert!(found.iter().all(|frame| (frame.width(), frame.height()) == (32, 20)));
    assert_eq!(found.len(), 3);
}

fn files(folder: &Path, name: &str) -> TimelapseFiles {
    let path = folder.join(name);
    let format = AnimationFormat::from_path(&path).unwrap();
    TimelapseFiles {
        animation: Some((path, format)),
        frames: folder.join("frames"),
        keep_frames: false,
        rate: FrameRate::new(10.0).unwrap(),
        hold_seconds: 2.0,
    }
}

#[test]
fn an_interrupted_run_continues_to_the_same_file() {
    let (script, _) = recorded();
    let timelapse = Timelapse::new(&script, settings(Interval::Frames(6))).unwrap();
    for name in ["whole.gif", "whole.png"] {
        let folder = tempfile::tempdir().unwrap();
        let whole = files(folder.path(), name);
        assert_eq!(timelapse.write(&mut blank(), &whole, go_on).unwrap(), Some(0));
        assert!(!whole.frames.exists(), "the frames are removed");
        let again = files(folder.path(), &format!("again-{name}"));
        let half = |done| if done > 0.4 { ControlFlow::Break(()) } else { go_on(done) };
        assert_eq!(timelapse.write(&mut blank(), &again, half).unwrap(), None);
        assert!(!folder.path().join(format!("again-{name}")).exists());
        assert!(!again.frames.exists(), "nothing is left");
        let again = TimelapseFiles { keep_frames: true, ..again };
        assert_eq!(timelapse.write(&mut blank(), &again, half).unwrap(), None);
        let kept = timelapse.write(&mut blank(), &again, go_on).unwrap();
        assert!(kept.is_some_and(|kept| (1..6).contains(&kept)), "{kept:?} frames existed");
        let [written, resumed] = [name, &format!("again-{name}")]
            .map(|name| std::fs::read(folder.path().join(name)).unwrap());
        assert!(written == resumed, "{name}: the same bytes");
    }
}

#[test]
fn another_number_of_threads_continues_a_run() {
    let (script, _) = recorded();
    let timelapse = Timelapse::new(&script, settings(Interval::Frames(6))).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let files = TimelapseFiles { keep_frames: true, ..files(folder.path(), "a.gif") };
    let written = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| timelapse.write(&mut blank(), &files, go_on)).unwrap()
    });
    assert_eq!(written, [Some(0), Some(6)], "frames that stayed");
}

fn go_on(_: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

#[test]
fn frames_can_stay_as_a_folder() {
    let (script, end) = recorded();
    let timelapse = Timelapse::new(&script, settings(Interval::Frames(4))).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let frames = TimelapseFiles { animation: None, ..files(folder.path(), "a.gif") };
    let written = timelapse.write(&mut blank(), &frames, |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(written, Some(0));
    let last = image::open(frames.frames.join("frame-0004.png")).unwrap().into_rgb8();
    assert!(last.as_raw().as_slice() == end.values().as_flattened());
    assert!(frames.frames.join("animation.json").exists());
}

#[test]
fn settings_out_of_range_are_refused() {
    let (script, _) = recorded();
    let base = TimelapseSettings::default();
    for wrong in [
        settings(Interval::Actions(0)),
        settings(Interval::Seconds(f64::NAN)),
        settings(Interval::Seconds(0.0)),
        settings(Interval::Frames(1)),
        settings(Interval::Frames(1 << 20)),
        settings(Interval::Seconds(0.01)),
        TimelapseSettings { longest_px: 0, ..base },
    ] {
        let refused = Timelapse::new(&script, wrong);
        // 2 s in steps of a hundredth are 201 frames.
        let allowed = wrong.interval == Interval::Seconds(0.01);
        assert_eq!(refused.is_ok(), allowed, "{wrong:?}");
    }
    let folder = tempfile::tempdir().unwrap();
    let files = TimelapseFiles { hold_seconds: -1.0, ..files(folder.path(), "a.gif") };
    let timelapse = Timelapse::new(&script, base).unwrap();
    let error = timelapse.write(&mut blank(), &files, |_| ControlFlow::Continue(())).unwrap_err();
    assert!(matches!(error, TimelapseError::Setting { name: "hold", .. }), "{error}");
}

#[test]
fn an_action_that_fails_is_named() {
    let (mut script, _) = recorded();
    script.actions.push(Action::Merge { layer: LayerRef::Dry(1), with: None });
    let timelapse = Timelapse::new(&script, TimelapseSettings::default()).unwrap();
    let last = timelapse.frames() - 1;
    let error = timelapse
        .play(&mut blank(), &[last], |_| ControlFlow::Continue(()), |_, _| Ok(()))
        .unwrap_err();
    assert!(error.to_string().contains("(merge)"), "{error}");
}
