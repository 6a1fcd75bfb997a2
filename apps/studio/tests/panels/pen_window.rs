//! Tests of the window of the pen, and of stabilised strokes that are recorded.

use web_time::{Duration, Instant};

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use graphics::gpu::BackendChoice;
use paint::strokes::{Action, Load, SampleDecimals, SurfaceId};
use pigment::library::PigmentLibrary;
use session::brushes::{PressureCurve, StabiliserMethod, TiltUse};
use session::{
    Command, Event as WorkerEvent, Origin, Pace, Snapshot, Worker, WorkerOptions, blank_canvas,
};
use studio::pen::{
    Device, Pen, PenEvent, PenSettings, PenTargets, PointerState, Report, ReportKind, Script,
    SurfaceTransform,
};

use super::harness::{Window, button};

fn open(name: &'static str) -> Window {
    let mut window = Window::open(name);
    window.studio_mut().visible.pen = true;
    window.harness().run_ok();
    window
}

/// Drags the mouse from one point of the window to another.
fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.frame(vec![Event::PointerMoved(from)]);
    window.frame(vec![button(from, true)]);
    for step in 1..=4_u8 {
        window.frame(vec![Event::PointerMoved(from + (to - from) * (f32::from(step) / 4.0))]);
    }
    window.frame(vec![button(to, false)]);
    window.harness().run_ok();
}

fn points(window: &Window) -> Vec<[f64; 2]> {
    window.studio().files.preferences.pen.curve.points().list().to_vec()
}

#[test]
fn points_of_the_curve_are_added_dragged_and_removed() {
    let mut window = open("pen-curve");
    let plot = window.harness().get_by_label("Pressure curve").rect();
    window.click("Linear");
    // A click adds a point, and dragging moves it.
    drag(&mut window, plot.center() + vec2(0.0, 30.0), plot.center() + vec2(0.0, 50.0));
    let [_, [x, y], _] = points(&window)[..] else { panic!("{:?}", points(&window)) };
    assert!((x - 0.5).abs() < 0.02 && (0.2..0.3).contains(&y), "{x} {y}");
    let point = window.harness().get_by_label("curve point 2").rect().center();
    drag(&mut window, point, point + vec2(40.0, -20.0));
    let [_, [x, moved], _] = points(&window)[..] else { panic!("{:?}", points(&window)) };
    assert!(x > 0.6 && moved > y, "{x} {moved}");
    assert!(window.studio().pen.settings.curve.at(0.5) < 0.5, "the pen uses it");
    window.save("pen-curve");
    // Arrow keys move the point that has the focus.
    window.harness().get_by_label("curve point 2").focus();
    window.harness().step();
    window.key(Modifiers::NONE, Key::ArrowUp);
    assert!((points(&window)[1][1] - moved - 0.02).abs() < 1e-9, "{:?}", points(&window));
    // Dragged out of the field it goes; the last two stay.
    let point = window.harness().get_by_label("curve point 2").rect().center();
    drag(&mut window, point, plot.left_bottom() + vec2(-60.0, 90.0));
    assert_eq!(points(&window).len(), 2);
    let point = window.harness().get_by_label("curve point 2").rect().center();
    let modifiers = Modifiers::NONE;
    let secondary = |pressed| {
        let pos = point;
        let button = PointerButton::Secondary;
        Event::PointerButton { pos, button, pressed, modifiers }
    };
    window.frame(vec![Event::PointerMoved(point)]);
    window.frame(vec![secondary(true)]);
    window.frame(vec![secondary(false)]);
    assert_eq!(points(&window).len(), 2, "two must stay");
    window.click("Firm");
    assert_eq!(window.studio().files.preferences.pen.curve, PressureCurve::FIRM);
}

#[test]
fn the_right_button_removes_a_point() {
    let mut window = open("pen-curve-right");
    window.click("Firm");
    let before = points(&window).len();
    let point = window.harness().get_by_label("curve point 3").rect().center();
    let modifiers = Modifiers::NONE;
    let button = PointerButton::Secondary;
    window.frame(vec![Event::PointerMoved(point)]);
    for pressed in [true, false] {
        window.frame(vec![Event::PointerButton { pos: point, button, pressed, modifiers }]);
    }
    window.harness().run_ok();
    assert_eq!(points(&window).len(), before - 1);
}

#[test]
fn the_test_field_shows_the_pressure_after_the_curve() {
    let mut window = open("pen-field");
    window.click("Firm");
    let field = window.harness().get_by_label("Test field").rect();
    let report = |window: &mut Window, kind| {
        let report = Report { device: Device::Pen, arrived: Instant::now(), kind };
        window.studio_mut().pen.feed(report);
        window.frame(Vec::new());
    };
    for step in 0..=20_u8 {
        let at = field.left_center() + vec2(10.0 + 10.0 * f32::from(step), 0.0);
        let state =
            PointerState { pressure: Some(0.1 + 0.02 * f64::from(step)), ..PointerState::at(at) };
        let kind = if step == 0 { ReportKind::Pressed(state) } else { ReportKind::Moved(state) };
        report(&mut window, kind);
    }
    // 0.5 to the power of 1.6.
    assert!(window.harness().query_by_label("pen 0.50, brush 0.33").is_some(), "the live mark");
    window.save("pen-field");
    report(&mut window, ReportKind::Released);
    let strokes = window.studio().painting().unwrap().history.len();
    assert_eq!(strokes, 0, "nothing is painted below the window");
    window.harness().step();
    window.click("Clear");
    assert!(window.studio().painting().is_some(), "it goes on");
}

#[test]
fn options_belong_to_the_brush_in_hand() {
    let mut window = open("pen-options");
    window.click("Only round");
    window.click("tilt Ignored");
    window.click("Own stabiliser");
    window.click("String");
    window.save("pen-options");
    let options = window.studio().files.preferences.options_of("round");
    assert_eq!(options.tilt, TiltUse::Ignored);
    assert_eq!(options.stabiliser.map(|own| own.method), Some(StabiliserMethod::String));
    window.harness().run_ok();
    assert_eq!(window.studio().pen.options, options, "the pen uses them");
    window.key(Modifiers::NONE, Key::Num2);
    window.harness().run_ok();
    assert_ne!(window.studio().tools.brush, "round");
    assert_eq!(window.studio().pen.options, Default::default(), "another brush has none");
    assert_eq!(window.studio().files.preferences.pen, PenSettings::default());
}

/// A worker with a bare canvas.
fn worker() -> Worker {
    let options = WorkerOptions { backend: BackendChoice::Cpu, ..WorkerOptions::default() };
    let worker = Worker::start(options, || {});
    worker.ask(Command::Open(canvas()));
    worker
}

fn canvas() -> Origin {
    blank_canvas(PigmentLibrary::van_gogh_oils(), 32.0, 20.0, 0.1)
}

fn answer<T>(worker: &Worker, found: impl Fn(WorkerEvent) -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = worker.events().find_map(&found) {
            return found;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "no answer");
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn snapshot(worker: &Worker) -> Snapshot {
    worker.ask(Command::Snapshot(1));
    answer(worker, |event| match event {
        WorkerEvent::Snapshot(snapshot) => Some(snapshot),
        _ => None,
    })
}

#[test]
fn a_recorded_stabilised_stroke_replays_to_the_bit() {
    let mut settings = PenSettings::default();
    settings.stabiliser.method = StabiliserMethod::String;
    let mut pen = Pen::new(settings);
    let area = eframe::egui::Rect::from_min_size(Pos2::ZERO, vec2(320.0, 200.0));
    let surfaces = [SurfaceTransform::new(SurfaceId::Canvas, area, |at: Pos2| {
        (f64::from(at.x) / 10.0, f64::from(at.y) / 10.0)
    })];
    let states = (0..120_u8).map(|at| {
        let x = 20.0 + 2.3 * f32::from(at);
        let at = Pos2::new(x, 100.0 + 30.0 * (0.1 * x).sin());
        PointerState { pressure: Some(0.6), ..PointerState::at(at) }
    });
    let mut script = Script::new(Device::Pen).stroke(states, Duration::from_millis(5));
    let worker = worker();
    let recipe = [("Vermilion".to_owned(), 1.0)].into();
    let brush = "round".to_owned();
    worker.ask(Command::Apply(Action::Load(Load { brush, recipe, vehicle: 0.1, amount_mm: 0.3 })));
    let start = Instant::now();
    for frame in 0..70 {
        let now = start + Duration::from_millis(10) * frame;
        script.due(start, now).into_iter().for_each(|report| pen.feed(report));
        let targets = PenTargets { surfaces: &surfaces, covered: &|_| false };
        for event in pen.process_frame(&[], Modifiers::NONE, now, &targets) {
            match event {
                PenEvent::Down { surface, .. } => {
                    let brush = "round".to_owned();
                    let decimals = SampleDecimals::PEN;
                    worker.ask(Command::PenDown { surface, brush, decimals });
                }
                PenEvent::Move(samples) => worker.ask(Command::PenMove(samples)),
                PenEvent::Up => worker.ask(Command::PenUp),
                _ => {}
            }
        }
    }
    let painted = snapshot(&worker);
    worker.ask(Command::Recording(7));
    let recorded = answer(&worker, |event| match event {
        WorkerEvent::Recording { script, .. } => Some(script),
        _ => None,
    });
    // The brush leaves out most of the wave.
    let Some(Action::Stroke(stroke)) = recorded.actions.last() else { panic!("{recorded:?}") };
    let ys = stroke.samples.iter().filter(|at| at.x_mm > 8.0 && at.x_mm < 26.0).map(|at| at.y_mm);
    let swing = ys.clone().fold(f64::MIN, f64::max) - ys.fold(f64::MAX, f64::min);
    assert!((0.5..5.0).contains(&swing), "{swing} of 6 mm");
    let Origin::Blank { library, .. } = canvas() else { panic!("a bare canvas") };
    let again = self::worker();
    let script = Box::new((*recorded).clone());
    again.ask(Command::Replay { script, library, pace: Pace::Fast });
    answer(&again, |event| matches!(event, WorkerEvent::Replayed).then_some(()));
    let replayed = snapshot(&again);
    assert!(painted.canvas.wet.totals() != [0; 9], "there is paint");
    assert!(*painted.canvas == *replayed.canvas, "to the bit");
}
