//! Reported state of layers, brushes and tubes, palettes and brushes from a painting's file, and
//! sessions recovered from autosaves.

use std::convert::Infallible;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use graphics::gpu::BackendChoice;
use web_time::Instant;

use super::strokes::{assert_same as assert_same_as_session, session};
use super::window::{Window, load, stroke, wander};
use paint::amount::mm_from_quanta;
use paint::document::{LayerId, Lighting};
use paint::file::{read, read_table, write_with_table};
use paint::strokes::{
    Action, LayerRef, MaskChange, SampleDecimals, Squeeze, StrokeScript, SurfaceId,
};
use session::{
    Autosave, BrushState, Command, Event, KeptPainting, LostSession, Origin, Pace, PenSample,
    SessionMeta, Snapshot,
};

fn round(window: &Window) -> BrushState {
    let found = window.state().brushes.iter().find(|brush| brush.name == "round");
    found.cloned().expect("the brush exists")
}

#[test]
fn layers_report_height_coverage_and_thumbnail() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("flat", "Vermilion"));
    let samples = wander(41, 80, 32.0, 20.0);
    window.stroke(SurfaceId::Canvas, "flat", [&samples[..]]);
    window.act(Action::Dry { fraction: 1.0 });
    window.act(load("round", "Ultramarine"));
    window.stroke(SurfaceId::Canvas, "round", [&wander(42, 50, 32.0, 20.0)[..]]);
    window.act(Action::Dry { fraction: 0.5 });
    let snapshot = window.snapshot();
    window.wait_until("both layers", |window: &Window| {
        let layers = &window.state().layers;
        layers.len() == 2 && layers.iter().all(|layer| layer.max_mm > 0.0)
    });
    for (reported, layer) in window.state().layers.iter().zip(&snapshot.canvas.dry) {
        let cells = layer.paint.vehicle.values().len();
        let volumes = (0..cells).map(|index| layer.paint.cell(index).volume());
        let painted: Vec<u32> = volumes.filter(|&volume| volume > 0).collect();
        let mm = mm_from_quanta(1, 0.1);
        let sum: f64 = painted.iter().map(|&volume| f64::from(volume)).sum();
        assert!(
            (reported.mean_mm - sum / painted.len() as f64 * mm).abs() < 1e-9,
            "{}",
            reported.mean_mm
        );
        assert_eq!(reported.max_mm, f64::from(*painted.iter().max().unwrap()) * mm);
        assert!(
            (reported.coverage - painted.len() as f64 / cells as f64).abs() < 1e-12,
            "its share"
        );
        let thumbnail = &reported.thumbnail;
        assert_eq!((thumbnail.width, thumbnail.height), (160, 100));
        assert_eq!(thumbnail.pixels.len(), 160 * 100);
        let opaque = thumbnail.pixels.iter().filter(|pixel| pixel[3] > 0).count();
        let share = opaque as f64 / thumbnail.pixels.len() as f64;
        assert!((share - reported.coverage).abs() < 0.05, "{share} of {}", reported.coverage);
    }
    fn reddest(window: &Window) -> Option<i32> {
        let pixels = &window.state().layers[0].thumbnail.pixels;
        pixels.iter().filter(|p| p[3] == 255).map(|p| i32::from(p[0]) - i32::from(p[2])).max()
    }
    assert!(reddest(&window) > Some(40), "vermilion is red: {:?}", reddest(&window));
    let layer = LayerRef::Dry(0);
    let from = "Vermilion".to_owned();
    let to = "Emerald Green".to_owned();
    window.act(Action::Swap { layer, from, to });
    window.wait_until("another colour", |window| reddest(window) < Some(0));
    // Undo changes the paint of a layer, so its thumbnail must follow.
    window.act(Action::Undo {});
    window.act(Action::Undo {});
    window.wait_until("one layer", |window| window.state().layers.len() == 1);
    window.wait_until("its colour", |window| reddest(window) > Some(40));
}

#[test]
fn a_changed_layer_gets_a_new_thumbnail() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("flat", "Vermilion"));
    window.stroke(SurfaceId::Canvas, "flat", [&wander(44, 60, 32.0, 20.0)[..]]);
    window.act(Action::Dry { fraction: 0.5 });
    window.act(Action::Dry { fraction: 1.0 });
    window.wait_until("both layers", |window| {
        let layers = &window.state().layers;
        layers.len() == 2 && layers.iter().all(|layer| layer.max_mm > 0.0)
    });
    let most: f64 = window.state().layers.iter().map(|layer| layer.max_mm).sum();
    window.act(Action::Merge { layer: LayerRef::Dry(1), with: None });
    window.wait_until("one layer as thick as both", |window| {
        let layers = &window.state().layers;
        layers.len() == 1 && (layers[0].max_mm - most).abs() < 1e-6
    });
}

#[test]
fn names_visibility_and_order_are_reported_by_identity() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("flat", "Vermilion"));
    window.stroke(SurfaceId::Canvas, "flat", [&wander(45, 60, 32.0, 20.0)[..]]);
    window.act(Action::Dry { fraction: 0.5 });
    window.act(load("round", "Ultramarine"));
    window.stroke(SurfaceId::Canvas, "round", [&wander(46, 40, 32.0, 20.0)[..]]);
    window.act(Action::Dry { fraction: 1.0 });
    window.wait_until("both layers", |window| {
        let layers = &window.state().layers;
        layers.len() == 2 && layers.iter().all(|layer| layer.max_mm > 0.0)
    });
    let before = window.state().layers.clone();
    let first = LayerRef::Id(LayerId(1));
    window.act(Action::Name { layer: first, name: "under".to_owned() });
    window.act(Action::Visible { layer: first, value: false });
    window.act(Action::Order { layer: first, to: 1 });
    window.wait_until("the order", |window| window.state().layers[1].label() == "under");
    let state = window.state().layers[1].clone();
    assert_eq!((state.id, state.visible, state.opacity), (LayerId(1), false, 1.0));
    // A moved layer keeps its figures and its picture until we have computed them again.
    assert_eq!((state.coverage, state.max_mm), (before[0].coverage, before[0].max_mm));
    assert_eq!(state.thumbnail, before[0].thumbnail);
    let snapshot = window.snapshot();
    assert_eq!(snapshot.canvas.dry[1].name, "under");
    window.act(Action::Visible { layer: LayerRef::Id(LayerId(9)), value: true });
    let (text, _, failed) = window.message();
    assert!(failed && text.contains("there is no layer 9; the painting has 2, 1"), "{text}");
}

#[test]
fn brushes_and_tubes_are_reported() {
    let mut window = Window::open(BackendChoice::Cpu);
    let state = window.state();
    assert_eq!(state.brushes.len(), 6);
    assert!(state.brushes.iter().all(|brush| brush.color.is_none()), "the brushes are clean");
    assert!(state.masstones.iter().all(Option::is_some), "eight tubes");
    assert!(state.tints.iter().all(Option::is_some), "all can be mixed with white");
    window.act(load("round", "Ultramarine"));
    window.wait_until("paint on the brush", |window| round(window).amount_mm > 0.0);
    let loaded = round(&window);
    assert!((loaded.amount_mm - 0.3).abs() < 1e-4, "{}", loaded.amount_mm);
    assert!((loaded.vehicle - 0.1).abs() < 1e-4, "{}", loaded.vehicle);
    let slot = loaded.parts.iter().position(|&part| part == 1.0).expect("one pigment");
    assert_eq!(loaded.color, window.state().masstones[slot]);
    window.stroke(SurfaceId::Palette, "round", [&wander(43, 40, 10.0, 8.0)[..]]);
    window.wait_until("less paint", |window| {
        (1e-3..loaded.amount_mm).contains(&round(window).amount_mm)
    });
    let used = round(&window);
    // The tip paints, so it loses more than the whole head.
    assert!(used.tip_mm < used.amount_mm, "{} of {}", used.tip_mm, used.amount_mm);
    window.act(Action::Undo {});
    window.wait_until("the paint back", |window| round(window).amount_mm == loaded.amount_mm);
    window.act(Action::Wash { brush: "round".to_owned() });
    window.wait_until("a clean brush", |window| round(window).color.is_none());
}

#[test]
fn the_first_dirty_brush_is_told_once() {
    let mut window = Window::open(BackendChoice::Cpu);
    fn dirty(window: &mut Window) -> Vec<String> {
        window.snapshot();
        std::mem::take(&mut window.dirty)
    }
    window.act(load("round", "Ultramarine"));
    let path = wander(43, 60, 10.0, 8.0);
    window.stroke(SurfaceId::Canvas, "round", [&path[..]]);
    window.stroke(SurfaceId::Canvas, "round", [&path[..]]);
    assert!(dirty(&mut window).is_empty(), "its own paint makes no brush dirty");
    // This is a clean flat through wet paint.
    window.stroke(SurfaceId::Canvas, "flat", [&path[..]]);
    assert_eq!(dirty(&mut window), ["flat"]);
    window.stroke(SurfaceId::Canvas, "filbert", [&path[..]]);
    assert!(dirty(&mut window).is_empty(), "once is enough");
}

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
    window.act(Action::Merge { layer: LayerRef::Dry(1), with: None });
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

fn window_history(window: &mut Window) -> usize {
    let revision = window.snapshot().revision;
    window.wait_until("the state", |window| window.state().revision >= revision);
    window.state().history_done
}

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

fn lost(folder: &Path) -> LostSession {
    let mut all = LostSession::all(folder).unwrap();
    assert_eq!(all.len(), 1, "one session was lost");
    all.remove(0)
}

/// Opens the session lost in `folder`, as the studio does.
fn recovered(folder: &Path) -> Window {
    let lost = lost(folder);
    let [canvas, palette] = lost.files();
    let kept = lost.work().unwrap().map(|work| Box::new(work.session));
    let mut window = Window::new(BackendChoice::Cpu);
    let [canvas, palette] = [canvas, palette].map(|path| {
        let bytes = std::fs::read(path).unwrap();
        Box::new(read("autosave", &bytes).unwrap())
    });
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
    assert_same_as_session(&window.snapshot(), &mut player, when);
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
    // The mask covers 18 of 32 mm.
    let covered = window.state().mask.as_ref().map(|mask| mask.covered);
    assert_eq!(covered, Some(0.5625), "it is reported");
    // This stroke is over the open part.
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
