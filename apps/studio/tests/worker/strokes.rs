//! Strokes sent in bursts, with commands in between.

use std::io::Write;
use std::sync::Arc;
use web_time::{Duration, Instant};

use graphics::gpu::{BackendChoice, choose};
use paint::document::Document;
use paint::engine::PaintEngine;
use paint::painting::Painting;
use paint::pose::Sample;
use paint::session::PaintingSession;
use paint::strokes::{Action, SampleDecimals, SurfaceId};
use session::{Command, Event, Origin, Snapshot};

use super::pen::{load, stroke, wander};
use super::window::{Window, small};

/// A session set up as the worker does, for comparison.
pub(crate) fn session() -> PaintingSession {
    let Origin::Blank { script, library } = small() else { panic!("a bare canvas") };
    let (canvas, palette) = script.surfaces(&library, None).unwrap();
    let painting = |document: Document| {
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        Painting::open(document, engine, 1 << 28).unwrap()
    };
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
            // Send samples all at once, one by one, or in uneven pieces.
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
    let moves = |samples: &[Sample]| {
        let arrived = Instant::now();
        Command::PenMove(
            samples.iter().map(|&sample| session::PenSample { sample, arrived }).collect(),
        )
    };
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
        let opaque = |pixels: &[[u8; 4]]| pixels.iter().all(|pixel| pixel[3] == 255);
        opaque(&window.pictures.canvas) && opaque(&window.pictures.palette)
    });
    window.act(load("round", "Vermilion"));
    let samples = wander(5, 600, 32.0, 20.0);
    window.stroke(SurfaceId::Canvas, "round", samples.chunks(5));
    // Long enough for updates at 60 per second to pile up.
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
    super::pictures::assert_pictures(&mut window, &snapshot);
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
    // Shading agrees up to rounding: a byte may differ by one.
    let light = Arc::clone(&window.state().light);
    let wanted = super::pictures::exported(&snapshot.canvas, &light);
    window.wait_until("the canvas as it is", |window| {
        let pairs = window.pictures.canvas.iter().zip(&wanted);
        pairs.into_iter().all(|(a, b)| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 1))
    });
}

/// Whether there is a graphics adapter. Appends its name (or `none`) to the file that the
/// environment variable `IMPASTO_GPU_TESTS` names, if it is set.
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
