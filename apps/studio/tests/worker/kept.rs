//! Sessions that are kept by autosaves and recovered.

use std::convert::Infallible;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use web_time::Instant;

use graphics::gpu::BackendChoice;
use paint::strokes::{Action, MaskChange, SampleDecimals, StrokeScript, SurfaceId};
use session::{
    Autosave, Command, Event, KeptPainting, LostSession, Origin, PenSample, SessionMeta,
};

use super::pen::{load, stroke, wander};
use super::strokes::{assert_same, session};
use super::window::Window;

fn kept(window: &mut Window, recorded: usize) -> Arc<KeptPainting> {
    window.ask(Command::Keep { number: 99, recorded });
    window.wait("all that is kept", |event| match event {
        Event::Kept(kept) if kept.snapshot.number == 99 => Some(kept.clone()),
        _ => None,
    })
}

fn meta() -> SessionMeta {
    SessionMeta { title: "study".to_owned(), path: None, seconds: 7, desk: None }
}

/// The only lost session below `folder`.
fn lost(folder: &Path) -> LostSession {
    let mut all = LostSession::all(folder).unwrap();
    assert_eq!(all.len(), 1, "one session was lost");
    all.remove(0)
}

/// Opens the session that was lost in `folder`, as the studio does.
fn recovered(folder: &Path) -> Window {
    let lost = lost(folder);
    let read = |path: &Path| {
        let bytes = std::fs::read(path).unwrap();
        Box::new(paint::file::read("autosave", &bytes).unwrap())
    };
    let [canvas, palette] = lost.files();
    let kept = lost.work().unwrap().map(|work| Box::new(work.session));
    let mut window = Window::new(BackendChoice::Cpu);
    let canvas = read(&canvas);
    let palette = read(&palette);
    window.ask(Command::Open(Origin::Recovered { canvas, palette, kept }));
    window.wait("the painting", |event| matches!(event, Event::Opened(_)).then_some(()));
    window
}

/// Asserts that the recording of a window, played from the start, gives its canvas and palette.
fn assert_replays(window: &mut Window, when: &str) {
    let text = window.recording().to_json().unwrap();
    let script = StrokeScript::from_json("recording", text.as_bytes()).unwrap();
    let mut player = session();
    script
        .replay(
            &mut player,
            |_: &str, _: &mut _| Ok::<_, Infallible>(()),
            || ControlFlow::Continue(()),
        )
        .unwrap();
    assert_same(&window.snapshot(), &mut player, when);
}

fn paint(window: &mut Window, seed: u64) {
    window.stroke(SurfaceId::Palette, "round", [&wander(seed, 30, 10.0, 8.0)[..]]);
    window.stroke(SurfaceId::Canvas, "round", [&wander(seed + 1, 40, 32.0, 20.0)[..]]);
}

#[test]
fn a_recovered_session_goes_on_with_its_brushes_and_its_whole_recording() {
    let folder = tempfile::tempdir().unwrap();
    let mut autosave = Autosave::begin(folder.path()).unwrap();
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("round", "Ultramarine"));
    paint(&mut window, 1);
    let first = kept(&mut window, 0);
    let recorded = autosave.keep(&first, None, &meta()).unwrap();
    assert_eq!(recorded, 3, "a load and two strokes");
    window.act(Action::Undo {});
    window.act(load("knife", "Vermilion"));
    paint(&mut window, 5);
    let second = kept(&mut window, recorded);
    assert_eq!(second.recording.as_ref().unwrap().actions.len(), 4, "only what is new");
    assert_eq!(autosave.keep(&second, None, &meta()).unwrap(), 7);
    drop((autosave, window));

    let mut window = recovered(folder.path());
    window.wait_until("the brushes", |window| {
        let loaded = window.state().brushes.iter().filter(|brush| brush.amount_mm > 0.0);
        loaded.map(|brush| brush.name.as_str()).eq(["knife", "round"])
    });
    assert_replays(&mut window, "recovered");
    paint(&mut window, 9);
    window.stroke(SurfaceId::Canvas, "knife", [&wander(11, 30, 32.0, 20.0)[..]]);
    assert_eq!(window.recording().actions.len(), 10);
    assert_replays(&mut window, "painted on");
}

#[test]
fn a_mask_survives_recovery_and_the_recording_replays_under_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut autosave = Autosave::begin(folder.path()).unwrap();
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("round", "Ultramarine"));
    let open = vec![[0.0, 0.0], [14.0, 0.0], [14.0, 30.0], [0.0, 30.0]];
    window.act(Action::Mask(MaskChange::PolygonMm(open)));
    autosave.keep(&kept(&mut window, 0), None, &meta()).unwrap();
    drop((autosave, window));

    let mut window = recovered(folder.path());
    // 18 of 32 mm.
    let covered = window.state().mask.as_ref().map(|mask| mask.covered);
    assert_eq!(covered, Some(0.5625), "it is reported");
    // A stroke over the open part.
    paint(&mut window, 2);
    assert!(window.snapshot().canvas.wet.totals().iter().any(|total| *total > 0), "painted");
    assert_replays(&mut window, "painted under the mask");
    window.act(Action::Mask(MaskChange::Clear {}));
    paint(&mut window, 7);
    assert_replays(&mut window, "painted without it");
}

#[test]
fn a_session_lost_within_a_stroke_keeps_what_was_painted_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut autosave = Autosave::begin(folder.path()).unwrap();
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("round", "Ultramarine"));
    let surface = SurfaceId::Canvas;
    let decimals = SampleDecimals::RECORDING;
    window.ask(Command::PenDown { surface, brush: "round".to_owned(), decimals });
    let arrived = Instant::now();
    let samples = wander(3, 40, 32.0, 20.0).into_iter();
    let samples = samples.map(|sample| PenSample { sample, arrived }).collect();
    window.ask(Command::PenMove(samples));
    let within = kept(&mut window, 0);
    let open = within.recording.as_ref().unwrap().open.as_ref();
    assert_eq!(open.map(Action::kind), Some("cut"), "the stroke is open");
    autosave.keep(&within, None, &meta()).unwrap();
    drop((autosave, window));
    let mut window = recovered(folder.path());
    assert!(window.snapshot().canvas.wet.totals().iter().any(|total| *total > 0), "part of it");
    assert_replays(&mut window, "recovered");
    window.act(stroke(SurfaceId::Canvas, "round", &wander(4, 30, 32.0, 20.0)));
    assert_replays(&mut window, "painted on");
}

#[test]
fn an_autosave_of_an_earlier_version_is_recovered_without_a_recording() {
    let folder = tempfile::tempdir().unwrap();
    let mut autosave = Autosave::begin(folder.path()).unwrap();
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("round", "Ultramarine"));
    paint(&mut window, 1);
    autosave.keep(&kept(&mut window, 0), None, &meta()).unwrap();
    let canvas = window.snapshot().canvas;
    let generation = autosave.folder().join("generation-1");
    for name in ["work.json", "brushes.bin"] {
        std::fs::remove_file(generation.join(name)).unwrap();
    }
    drop(autosave);
    let mut window = recovered(folder.path());
    assert!(*window.snapshot().canvas == *canvas, "the painting");
    assert!(!window.state().brushes.is_empty(), "the usual brushes");
    window.ask(Command::Recording(7));
    assert!(window.message().0.contains("no recording"), "nothing is recorded");
}
