//! Palette and brushes from a painting's file, and the undo history across what is not painting.

use graphics::gpu::BackendChoice;
use paint::document::Lighting;
use paint::file::{read, read_table, write_with_table};
use paint::strokes::{Action, Squeeze, SurfaceId};
use session::{Command, Event, Origin, Pace, Snapshot};

use super::pen::{load, wander};
use super::window::Window;

/// Paints on both surfaces and leaves brushes with paint.
fn worked_with() -> Window {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("flat", "Vermilion"));
    window.stroke(SurfaceId::Canvas, "flat", [&wander(51, 40, 32.0, 20.0)[..]]);
    window.act(Action::Squeeze(Squeeze {
        on: SurfaceId::Palette,
        recipe: [("Ultramarine".to_owned(), 1.0)].into(),
        vehicle: 0.0,
        x_mm: 5.0,
        y_mm: 4.0,
        volume_mm3: 3.0,
    }));
    window.act(load("round", "Zinc White"));
    window.stroke(SurfaceId::Palette, "round", [&wander(52, 40, 10.0, 8.0)[..]]);
    window
}

fn open(snapshot: &Snapshot) -> (Origin, Vec<u8>) {
    let bytes = write_with_table(&snapshot.canvas, &snapshot.palette, &snapshot.brushes).unwrap();
    let canvas = Box::new(read("a.exr", &bytes).unwrap());
    let table = Box::new(read_table("a.exr", &bytes).unwrap().unwrap());
    (Origin::WithTable { canvas, table }, bytes)
}

fn assert_same(a: &Snapshot, b: &Snapshot, what: &str) {
    assert!(*a.canvas == *b.canvas, "canvas {what}");
    assert!(*a.palette == *b.palette, "palette {what}");
    assert_eq!(a.brushes, b.brushes, "brushes {what}");
}

#[test]
fn a_painting_opens_as_it_was_left_and_its_recording_replays() {
    let mut window = worked_with();
    let left = window.snapshot();
    assert_eq!(left.brushes.iter().filter(|brush| brush.paint.is_some()).count(), 2);
    let (origin, bytes) = open(&left);
    let mut today = Window::new(BackendChoice::Cpu);
    today.ask(Command::Open(origin));
    today.wait("the painting", |event| matches!(event, Event::Opened(_)).then_some(()));
    assert_same(&today.snapshot(), &left, "opened");
    let round = |window: &Window| {
        window.state().brushes.iter().find(|brush| brush.name == "round").cloned().unwrap()
    };
    window.wait_until("the used brush", |window| round(window).amount_mm < 0.299);
    assert_eq!(round(&today), round(&window), "as it was reported");

    today.stroke(SurfaceId::Canvas, "round", [&wander(53, 40, 32.0, 20.0)[..]]);
    today.stroke(SurfaceId::Palette, "flat", [&wander(54, 40, 10.0, 8.0)[..]]);
    let painted = today.snapshot();
    let mut script = today.recording();
    let folder = tempfile::tempdir().unwrap();
    let start = folder.path().join("start.exr");
    std::fs::write(&start, bytes).unwrap();
    script.start = Some(start.to_str().unwrap().to_owned());
    let library = Box::new((*today.state().library).clone());
    let mut again = Window::new(BackendChoice::Cpu);
    again.ask(Command::Replay { script: Box::new(script), library, pace: Pace::Fast });
    again.wait("the end", |event| matches!(event, Event::Replayed).then_some(()));
    assert_same(&again.snapshot(), &painted, "replayed");
    today.ask(Command::GoTo(0));
    assert_same(&today.snapshot(), &left, "undone");
}

#[test]
fn a_palette_of_another_painting_is_left_out_with_a_remark() {
    let snapshot = worked_with().snapshot();
    let (Origin::WithTable { mut canvas, table }, _) = open(&snapshot) else {
        panic!("a painting with a table")
    };
    canvas.medium.stiffness = 0.1;
    let mut window = Window::new(BackendChoice::Cpu);
    window.ask(Command::Open(Origin::WithTable { canvas, table }));
    let (text, _, failed) = window.message();
    assert!(!failed && text.contains("belongs to another painting"), "{text}");
    let opened = window.snapshot();
    assert_eq!(opened.palette.wet.totals(), [0; 9]);
    assert!(opened.brushes.iter().all(|brush| brush.paint.is_none()), "clean brushes");
}

#[test]
fn undo_reaches_back_across_saving_light_drying_merging_and_the_palette() {
    let mut window = worked_with();
    let first = window.snapshot();
    let first_history = window_history(&mut window);
    window.act(Action::Light(Lighting { illuminant: "A".to_owned(), ..Lighting::default() }));
    let _ = window.snapshot();
    window.act(Action::Dry { fraction: 0.5 });
    window.act(Action::Dry { fraction: 1.0 });
    window.ask(Command::SetSecondLight(Some(Lighting::default())));
    window.act(Action::Merge { layer: paint::strokes::LayerRef::Dry(1), with: None });
    window.act(Action::Scrape { on: SurfaceId::Palette });
    window.stroke(SurfaceId::Canvas, "round", [&wander(55, 30, 32.0, 20.0)[..]]);
    window.ask(Command::SetUndoBytes(1 << 28));
    assert_eq!(window_history(&mut window), first_history + 6, "nothing was dropped");
    window.ask(Command::GoTo(first_history));
    assert_same(&window.snapshot(), &first, "after six undos");
    window.ask(Command::GoTo(0));
    let bare = window.snapshot();
    assert_eq!(bare.canvas.wet.totals(), [0; 9]);
    assert_eq!(bare.palette.wet.totals(), [0; 9]);
}

/// Number of actions that can be undone.
fn window_history(window: &mut Window) -> usize {
    let revision = window.snapshot().revision;
    window.wait_until("the state", |window| window.state().revision >= revision);
    window.state().history_done
}
