//! Strokes sent in bursts, groups of strokes, tools that work wet paint, and picking colour and
//! paint.

use std::io::Write;
use std::ops::ControlFlow;
use std::sync::Arc;

use graphics::gpu::{BackendChoice, choose};
use web_time::{Duration, Instant};

use super::window::{Window, load, small, stroke, wander};
use paint::document::Document;
use paint::engine::PaintEngine;
use paint::painting::Painting;
use paint::pose::Sample;
use paint::scene::SpectralDocument;
use paint::session::PaintingSession;
use paint::strokes::{Action, MaskChange, SampleDecimals, StrokeTool, SurfaceId};
use session::{Command, Event, Origin, Pace, PenSample, Picked, Snapshot};

/// A session with the set-up of the worker, for comparison.
pub(crate) fn session() -> PaintingSession {
    let Origin::Blank { script, library } = small() else { panic!("a bare canvas") };
    let (canvas, palette) = script.surfaces(&library, None).unwrap();
    fn painting(document: Document) -> Painting {
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        Painting::open(document, engine, 1 << 28).unwrap()
    }
    let mut session =
        PaintingSession::recorded(painting(canvas), palette.map(painting), &script).unwrap();
    for (name, spec) in &script.brushes {
        session.set_brush(name, spec).unwrap();
    }
    session
}

pub(crate) fn assert_same(found: &Snapshot, session: &mut PaintingSession, after: &str) {
    let (canvas, palette) = session.documents().unwrap();
    assert!(canvas.wet.totals() != [0; 9] || !canvas.dry.is_empty(), "there is paint {after}");
    assert!(*found.canvas == canvas, "the canvas {after}");
    assert!(Some(&*found.palette) == palette.as_ref(), "the palette {after}");
}

#[test]
fn all_samples_of_bursts_are_painted_in_the_order_of_commands() {
    let mut window = Window::open(BackendChoice::Cpu);
    let mut session = session();
    let far = wander(1, 400, 32.0, 20.0);
    let near = wander(2, 150, 10.0, 8.0);
    let again = wander(3, 300, 32.0, 20.0);
    let actions = [
        load("round", "Ultramarine"),
        load("flat", "Vermilion"),
        stroke(SurfaceId::Canvas, "round", &far),
        stroke(SurfaceId::Palette, "flat", &near),
        Action::Dry { fraction: 0.5 },
        stroke(SurfaceId::Canvas, "flat", &again),
        Action::Undo {},
        stroke(SurfaceId::Palette, "round", &near),
        Action::Redo {},
        Action::Wash { brush: "round".to_owned() },
    ];
    for (index, action) in actions.iter().enumerate() {
        session.apply(action).unwrap();
        match action {
            // We send samples all at once, one by one, or in uneven pieces.
            Action::Stroke(stroke) => {
                let length = [1000, 1, 7, 33][index % 4];
                window.stroke(stroke.on, &stroke.brush, stroke.samples.chunks(length));
            }
            action => window.act(action.clone()),
        }
    }
    let snapshot = window.snapshot();
    assert_same(&snapshot, &mut session, "after all actions");
    assert_eq!(window.recording(), *session.recording().unwrap(), "all is recorded");
    let (history, done) = session.history();
    window.wait_until("the history", |window| {
        window.state().history_done == done && window.state().history == history
    });
}

#[test]
fn a_snapshot_does_not_wait_for_the_pen() {
    let mut window = Window::open(BackendChoice::Cpu);
    let mut session = session();
    let samples = wander(4, 200, 32.0, 20.0);
    session.apply(&load("filbert", "Prussian Blue")).unwrap();
    window.act(load("filbert", "Prussian Blue"));
    window.ask(Command::PenDown {
        surface: SurfaceId::Canvas,
        brush: "filbert".to_owned(),
        decimals: SampleDecimals::RECORDING,
    });
    fn moves(samples: &[Sample]) -> Command {
        let arrived = Instant::now();
        Command::PenMove(samples.iter().map(|&sample| PenSample { sample, arrived }).collect())
    }
    window.ask(moves(&samples[..90]));
    let midway = window.snapshot();
    assert!(midway.canvas.wet.totals() != [0; 9], "the paint so far is in it");
    window.ask(moves(&samples[90..]));
    window.ask(Command::PenUp);
    let whole = window.snapshot();
    session.apply(&stroke(SurfaceId::Canvas, "filbert", &samples)).unwrap();
    assert_same(&whole, &mut session, "after a stroke that was saved midway");
    assert!(whole.canvas.wet != midway.canvas.wet, "the stroke continued");
    assert!(whole.revision > midway.revision, "changes are counted");
    assert_eq!(window.snapshot().revision, whole.revision, "nothing happened since");
}

#[test]
fn a_window_that_does_not_poll_gets_few_tiles_and_then_all_changes() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.wait_until("both pictures", |window| {
        let pictures = [&window.pictures.canvas, &window.pictures.palette];
        pictures.into_iter().flatten().all(|pixel| pixel[3] == 255)
    });
    window.act(load("round", "Vermilion"));
    let samples = wander(5, 600, 32.0, 20.0);
    window.stroke(SurfaceId::Canvas, "round", samples.chunks(5));
    // Updates at 60 per second would pile up in this time.
    std::thread::sleep(Duration::from_millis(1500));
    window.events.clear();
    window.handle_events();
    let waiting = window
        .events
        .iter()
        .filter(|event: &&Event| matches!(event, Event::Tiles { .. } | Event::Head(Some(_))))
        .count();
    assert!((1..=4).contains(&waiting), "{waiting} events are queued");
    let snapshot = window.snapshot();
    super::replay::assert_pictures(&mut window, &snapshot);
}

#[test]
fn figures_report_steps_and_latency() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("round", "Vermilion"));
    let samples = wander(6, 300, 32.0, 20.0);
    let began = Instant::now();
    window.stroke(SurfaceId::Canvas, "round", samples.chunks(20));
    let newest = window.wait("tiles of a stroke", |event| match event {
        Event::Tiles { newest, .. } => *newest,
        _ => None,
    });
    assert!(newest >= began, "the newest sample is recent");
    let figures = window.figures();
    assert!(figures.substeps_per_second > 10.0, "{figures:?}");
    assert!(figures.max_latency_ms >= figures.mean_latency_ms, "{figures:?}");
}

#[test]
fn an_invalid_sample_is_reported_and_the_stroke_continues() {
    let mut window = Window::open(BackendChoice::Cpu);
    let mut session = session();
    session.apply(&load("round", "Vermilion")).unwrap();
    window.act(load("round", "Vermilion"));
    let good = wander(7, 60, 32.0, 20.0);
    let mut samples = good.clone();
    samples.insert(30, Sample { pressure: 7.0, ..good[30] });
    samples.insert(40, Sample { x_mm: f64::NAN, ..good[40] });
    window.stroke(SurfaceId::Canvas, "round", [&samples[..]]);
    let snapshot = window.snapshot();
    session.apply(&stroke(SurfaceId::Canvas, "round", &good)).unwrap();
    assert_same(&snapshot, &mut session, "without the invalid samples");
}

#[test]
fn the_head_is_reported_while_down_and_removed_when_lifted() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("flat", "Vermilion"));
    let samples = wander(8, 200, 32.0, 20.0);
    window.stroke(SurfaceId::Canvas, "flat", samples.chunks(10));
    let head = window.wait("a head", |event| match event {
        Event::Head(Some(head)) => Some(head.clone()),
        _ => None,
    });
    assert_eq!(head.surface, SurfaceId::Canvas);
    assert_eq!(head.vertices.len(), head.around * head.along);
    let tip = head.vertices.last().expect("a head has a tip");
    let nearest = samples
        .iter()
        .map(|sample: &Sample| {
            let x = f64::from(tip[0]);
            let y = f64::from(tip[1]);
            (10.0 * sample.x_mm - x).hypot(10.0 * sample.y_mm - y)
        })
        .fold(f64::INFINITY, f64::min);
    assert!(nearest < 100.0, "the tip is {nearest} cells off the path");
    window.wait("the lifted head", |event| matches!(event, Event::Head(None)).then_some(()));
}

#[test]
fn a_device_gives_the_same_painting() {
    if !has_adapter() {
        return;
    }
    let mut window = Window::open(BackendChoice::Gpu);
    assert!(window.state().backend != session().canvas().backend(), "it is on the device");
    let mut session = session();
    let far = wander(9, 60, 32.0, 20.0);
    let near = wander(10, 40, 10.0, 8.0);
    for action in [
        load("round", "Ultramarine"),
        stroke(SurfaceId::Palette, "round", &near),
        stroke(SurfaceId::Canvas, "round", &far),
        Action::Dry { fraction: 0.7 },
        Action::Undo {},
    ] {
        session.apply(&action).unwrap();
        match action {
            Action::Stroke(stroke) => {
                window.stroke(stroke.on, &stroke.brush, stroke.samples.chunks(13));
            }
            action => window.act(action),
        }
    }
    let snapshot = window.snapshot();
    assert_same(&snapshot, &mut session, "on the device");
    // Shading agrees up to rounding, so a byte may differ by one.
    let light = Arc::clone(&window.state().light);
    let wanted = super::replay::exported(&snapshot.canvas, &light);
    window.wait_until("the canvas as it is", |window| {
        let pairs = window.pictures.canvas.iter().zip(&wanted);
        pairs.into_iter().all(|(a, b)| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 1))
    });
}

/// Whether there is a graphics adapter. If you set the environment variable `IMPASTO_GPU_TESTS` to
/// a file, this appends the adapter's name (or `none`) there.
fn has_adapter() -> bool {
    let device = choose(BackendChoice::Gpu).ok().flatten();
    let name = device.as_ref().map_or("none", |device| &device.adapter().name);
    if let Some(path) = std::env::var_os("IMPASTO_GPU_TESTS") {
        let mut list = std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap();
        writeln!(list, "{name}").unwrap();
    }
    if device.is_none() {
        let _ = writeln!(std::io::stderr(), "no graphics adapter: not tested");
    }
    device.is_some()
}

fn paint(window: &mut Window, seed: u64) {
    let samples = wander(seed, 60, 32.0, 20.0);
    window.stroke(SurfaceId::Canvas, "round", samples.chunks(20));
}

/// Waits until `done` of `all` actions of the history are done.
fn wait_for(window: &mut Window, done: usize, all: usize) {
    window.wait_until("the history", |window| {
        (window.state().history_done, window.state().history.len()) == (done, all)
    });
}

#[test]
fn one_undo_takes_back_the_strokes_of_a_group_and_one_redo_repeats_them() {
    let mut window = Window::open(BackendChoice::Cpu);
    let mut session = session();
    window.act(load("round", "Ultramarine"));
    session.apply(&load("round", "Ultramarine")).unwrap();
    paint(&mut window, 1);
    session.apply(&stroke(SurfaceId::Canvas, "round", &wander(1, 60, 32.0, 20.0))).unwrap();
    window.ask(Command::BeginGroup);
    (2..5).for_each(|seed| paint(&mut window, seed));
    window.ask(Command::EndGroup);
    paint(&mut window, 5);
    wait_for(&mut window, 5, 5);
    let whole = window.snapshot();
    for done in [4, 1, 0] {
        window.act(Action::Undo {});
        wait_for(&mut window, done, 5);
        if done == 1 {
            assert_same(&window.snapshot(), &mut session, "after the undo of the group");
        }
    }
    for done in [1, 4, 5] {
        window.act(Action::Redo {});
        wait_for(&mut window, done, 5);
    }
    let again = window.snapshot();
    assert!(*again.canvas == *whole.canvas, "all is repeated");
    // The recording has an undo for each stroke, and replays to the bit.
    let recording = window.recording();
    let undos = recording.actions.iter().filter(|action| matches!(action, Action::Undo {})).count();
    assert_eq!(undos, 5);
    let Origin::Blank { library, .. } = small() else { panic!("a bare canvas") };
    window.ask(Command::Replay { script: Box::new(recording), library, pace: Pace::Fast });
    window.wait("the replay", |event| matches!(event, Event::Replayed).then_some(()));
    assert!(*window.snapshot().canvas == *whole.canvas, "to the bit");
}

#[test]
fn a_group_with_another_action_among_its_strokes_is_none() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("round", "Ultramarine"));
    window.ask(Command::BeginGroup);
    paint(&mut window, 1);
    window.act(Action::Dry { fraction: 0.5 });
    paint(&mut window, 2);
    window.ask(Command::EndGroup);
    wait_for(&mut window, 3, 3);
    window.act(Action::Undo {});
    wait_for(&mut window, 2, 3);
    // Reading does not disturb a group.
    window.ask(Command::BeginGroup);
    paint(&mut window, 3);
    window.snapshot();
    paint(&mut window, 4);
    window.ask(Command::EndGroup);
    wait_for(&mut window, 4, 4);
    window.act(Action::Undo {});
    wait_for(&mut window, 2, 4);
}

#[test]
fn tools_and_masks_of_the_worker_are_those_of_the_session_and_replay_to_the_bit() {
    let mut window = Window::open(BackendChoice::Cpu);
    let mut session = session();
    let samples = wander(1, 300, 32.0, 20.0);
    let mask = MaskChange::PolygonMm(vec![[2.0, 1.0], [30.0, 5.0], [9.0, 19.0]]);
    for action in
        [load("flat", "Vermilion"), stroke(SurfaceId::Canvas, "flat", &samples), Action::Mask(mask)]
    {
        session.apply(&action).unwrap();
        window.act(action);
    }
    for (seed, tool) in [
        (2, StrokeTool::Blend { strength: 0.7 }),
        (3, StrokeTool::Scrape { height_mm: 0.02 }),
        (4, StrokeTool::Erase { strength: 0.123_456_789 }),
    ] {
        let samples = wander(seed, 200, 32.0, 20.0);
        window.ask(Command::ToolDown { tool, surface: SurfaceId::Canvas, brush: "flat".into() });
        let arrived = Instant::now();
        let moved = samples.iter().map(|&sample| PenSample { sample, arrived });
        window.ask(Command::PenMove(moved.collect()));
        window.ask(Command::PenUp);
        session
            .begin_stroke_as(tool, SurfaceId::Canvas, "flat", SampleDecimals::PEN)
            .and_then(|()| session.extend(&samples))
            .and_then(|()| session.end_stroke())
            .unwrap();
    }
    let snapshot = window.snapshot();
    assert_same(&snapshot, &mut session, "after all tools");
    let recording = window.recording();
    assert_eq!(recording, *session.recording().unwrap());
    let text = recording.to_json().unwrap();
    let read = paint::StrokeScript::from_json("recording", text.as_bytes()).unwrap();
    assert_eq!(read, recording, "it is read as it was written");
    let mut again = self::session();
    read.replay(
        &mut again,
        |_: &str, _: &mut _| Ok::<(), std::io::Error>(()),
        || ControlFlow::Continue(()),
    )
    .unwrap();
    assert_same(&snapshot, &mut again, "after a replay");
    // The worker plays it too.
    let library = session.canvas().library().clone();
    let pace = Pace::Fast;
    window.ask(Command::Replay { script: Box::new(read), library: Box::new(library), pace });
    window.wait("the end", |event| matches!(event, Event::Replayed).then_some(()));
    let replayed = window.snapshot();
    assert!(replayed.canvas.wet == snapshot.canvas.wet, "the worker replays something else");
}

fn pick(window: &mut Window, x_mm: f64, y_mm: f64, radius_mm: f64) -> Arc<Picked> {
    window.ask(Command::Pick { surface: SurfaceId::Canvas, x_mm, y_mm, radius_mm });
    window.wait("what was picked", |event| match event {
        Event::Picked(picked) => Some(Arc::clone(picked)),
        _ => None,
    })
}

#[test]
fn a_pick_equals_an_instrument_reading() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("flat", "Vermilion"));
    window.stroke(SurfaceId::Canvas, "flat", [&wander(51, 80, 32.0, 20.0)[..]]);
    window.act(Action::Dry { fraction: 1.0 });
    window.act(load("round", "Ultramarine"));
    let over = wander(51, 60, 32.0, 20.0);
    window.stroke(SurfaceId::Canvas, "round", [&over[..]]);
    let x_mm = over[30].x_mm;
    let y_mm = over[30].y_mm;
    let snapshot = window.snapshot();
    let spectral = SpectralDocument::full(&snapshot.canvas);
    let column = (x_mm / 0.1) as usize;
    let row = (y_mm / 0.1) as usize;
    let one = pick(&mut window, x_mm, y_mm, 0.0);
    let wanted = spectral.measured_reflectance(column, row);
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(near(&one.reflectance, &wanted), "one cell");
    assert_eq!(one.layers.len(), 2);
    let heights: f64 = one.layers[1].amounts_mm.iter().sum();
    let volume = snapshot.canvas.wet.cell(row * 320 + column).volume();
    assert!((heights - paint::amount::mm_from_quanta(volume, 0.1)).abs() < 1e-12, "its height");
    // The mean over a disc, computed cell by cell.
    let radius = 0.35;
    let disc = pick(&mut window, x_mm, y_mm, radius);
    let mut sum = vec![0.0; wanted.len()];
    let mut count = 0.0;
    for index in 0..320 * 200 {
        let x = index % 320;
        let y = index / 320;
        let away = (0.1 * x as f64 + 0.05 - x_mm).hypot(0.1 * y as f64 + 0.05 - y_mm);
        if away <= radius {
            count += 1.0;
            for (sum, value) in sum.iter_mut().zip(spectral.measured_reflectance(x, y)) {
                *sum += value;
            }
        }
    }
    let mean: Vec<f64> = sum.iter().map(|sum| sum / count).collect();
    assert!(near(&disc.reflectance, &mean), "the mean of {count} cells");

    // If you load a brush with picked paint, it has this paint.
    let brush = "filbert".to_owned();
    window.act(load("filbert", "Zinc White"));
    window.act(Action::Wash { brush: brush.clone() });
    window.ask(Command::LoadPicked {
        brush,
        picked: Arc::unwrap_or_clone(disc).into(),
        amount_mm: 0.2,
    });
    window.snapshot();
    fn filbert(window: &Window) -> session::BrushState {
        let found = window.state().brushes.iter().find(|brush| brush.name == "filbert");
        found.cloned().expect("the brush exists")
    }
    window.wait_until("paint on the brush", |window| {
        let state = filbert(window);
        (state.amount_mm - 0.2).abs() < 1e-3 && state.parts[0] == 0.0
    });
    let wet = pick(&mut window, x_mm, y_mm, radius).layers[1].clone();
    let total: f64 = wet.amounts_mm[..8].iter().sum();
    for (part, amount) in filbert(&window).parts.iter().zip(wet.amounts_mm) {
        assert!((part - amount / total).abs() < 1e-4, "{part} of {}", amount / total);
    }
    let bare = pick(&mut window, 0.05, 0.05, 0.0);
    window.ask(Command::LoadPicked {
        brush: "filbert".to_owned(),
        picked: Box::new((*bare).clone()),
        amount_mm: 0.2,
    });
    let (text, hint, failed) = window.message();
    assert!(failed && text.contains("no wet paint") && hint.is_some(), "{text}");
}
