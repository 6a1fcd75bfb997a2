//! Tests of pen input, the window of the pen, and the tools that work wet paint, in the whole
//! window.

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Theme, vec2};
use egui_kittest::kittest::Queryable;
use graphics::gpu::BackendChoice;
use image::RgbaImage;
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
use web_time::{Duration, Instant};

use super::harness::{Window, button};

/// Draws a frame in which a pen sends this report.
pub(crate) fn report(window: &mut Window, kind: ReportKind) {
    let report = Report { device: Device::Pen, arrived: Instant::now(), kind };
    window.studio_mut().pen.feed(report);
    window.frame(Vec::new());
}

fn hold(window: &Window, x_mm: f64, y_mm: f64, pressure: f64) -> PointerState {
    let at = window.point(SurfaceId::Canvas, x_mm, y_mm);
    PointerState { at, pressure: Some(pressure), tilt_deg: Some((15.0, 5.0)), twist_deg: Some(0.0) }
}

/// Loads the brush and plays a stroke from x = 6 to 26 mm, with 200 reports per second in frames of
/// 20 ms. Returns the end of the stroke as a point of the window.
fn stroke(window: &mut Window, y_mm: f64, pressure: f64) -> Pos2 {
    window.click("Load brush");
    draw(window, y_mm, pressure)
}

/// Like [`stroke`], with the tool in use and without loading the brush.
pub(crate) fn draw(window: &mut Window, y_mm: f64, pressure: f64) -> Pos2 {
    let places = (0..60).map(|step| 6.0 + f64::from(step) / 3.0);
    let holds: Vec<PointerState> = places.map(|x_mm| hold(window, x_mm, y_mm, pressure)).collect();
    let end = holds[holds.len() - 1].at;
    let mut script = Script::new(Device::Pen).stroke(holds, Duration::from_millis(5));
    let start = Instant::now();
    for frame in 1..=17 {
        let now = start + Duration::from_millis(20) * frame;
        std::thread::sleep(now.saturating_duration_since(Instant::now()));
        for report in script.due(start, now) {
            window.studio_mut().pen.feed(report);
        }
        window.frame(Vec::new());
    }
    assert!(!window.studio().pen.is_down(), "the script has ended");
    end
}

/// Number of pixels that differ in the rows around a position of the canvas.
fn painted(window: &Window, before: &RgbaImage, after: &RgbaImage, y_mm: f64) -> usize {
    let [from, to] = [y_mm - 4.0, y_mm + 4.0].map(|y| window.point(SurfaceId::Canvas, 2.0, y));
    let right = window.point(SurfaceId::Canvas, 30.0, y_mm).x as u32;
    let rows = from.y as u32..to.y as u32;
    rows.flat_map(|y| (from.x as u32..right).map(move |x| (x, y)))
        .filter(|&(x, y)| before.get_pixel(x, y) != after.get_pixel(x, y))
        .count()
}

#[test]
fn more_pressure_paints_a_broader_stroke() {
    let mut window = Window::open("pen-pressure");
    let Some(before) = window.picture() else { return };
    for (y_mm, pressure) in [(5.0, 0.8), (15.0, 0.15)] {
        stroke(&mut window, y_mm, pressure);
    }
    // The cursor must not cover the paint.
    let device = Device::Pen;
    let arrived = Instant::now();
    let kind = ReportKind::Gone;
    window.studio_mut().pen.feed(Report { device, arrived, kind });
    window.settle();
    let after = window.picture().expect("it was there before");
    let [heavy, light] = [5.0, 15.0].map(|y_mm| painted(&window, &before, &after, y_mm));
    assert!(light > 200, "{light} pixels of a light stroke");
    assert!(heavy as f64 > 1.5 * light as f64, "{heavy} pixels pressed, {light} not");
}

#[test]
fn mouse_events_emulated_for_a_pen_make_no_second_stroke() {
    let mut window = Window::open("pen-mouse");
    let end = stroke(&mut window, 5.0, 0.5);
    // The mouse events of the pen arrive late, because they use another connection.
    window.frame(vec![Event::PointerMoved(end), button(end, true)]);
    assert!(!window.studio().pen.is_down(), "the pen is near");
    window.frame(vec![button(end, false)]);
    window.settle();
    let strokes =
        window.studio().painting().map(|painting| painting.history.clone()).unwrap_or_default();
    assert_eq!(strokes.iter().filter(|kind| kind.contains("stroke")).count(), 1, "{strokes:?}");
}

#[test]
fn keys_rotate_a_brush_moved_by_the_mouse() {
    let mut window = Window::open("pen-twist");
    window.key(Modifiers::NONE, Key::Period);
    window.key(Modifiers::NONE, Key::Period);
    window.key(Modifiers::NONE, Key::Comma);
    window.settle();
    assert_eq!(window.studio().pen.settings.grip.twist_deg, 15.0);
    assert_eq!(window.studio().files.preferences.pen, window.studio().pen.settings, "kept");
}

fn open(name: &'static str) -> Window {
    let mut window = Window::open(name);
    window.studio_mut().visible.pen = true;
    window.harness().run_ok();
    window
}

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
    // You click to add a point, and drag to move it.
    drag(&mut window, plot.center() + vec2(0.0, 30.0), plot.center() + vec2(0.0, 50.0));
    let [_, [x, y], _] = points(&window)[..] else { panic!("{:?}", points(&window)) };
    assert!((x - 0.5).abs() < 0.02 && (0.2..0.3).contains(&y), "{x} {y}");
    let point = window.harness().get_by_label("curve point 2").rect().center();
    drag(&mut window, point, point + vec2(40.0, -20.0));
    let [_, [x, moved], _] = points(&window)[..] else { panic!("{:?}", points(&window)) };
    assert!(x > 0.6 && moved > y, "{x} {moved}");
    assert!(window.studio().pen.settings.curve.at(0.5) < 0.5, "the pen uses it");
    window.save("pen-curve");
    // Arrow keys move the focused point.
    window.harness().get_by_label("curve point 2").focus();
    window.harness().step();
    window.key(Modifiers::NONE, Key::ArrowUp);
    assert!((points(&window)[1][1] - moved - 0.02).abs() < 1e-9, "{:?}", points(&window));
    // If you drag a point out of the field, it is removed. The last two stay.
    let point = window.harness().get_by_label("curve point 2").rect().center();
    drag(&mut window, point, plot.left_bottom() + vec2(-60.0, 90.0));
    assert_eq!(points(&window).len(), 2);
    let point = window.harness().get_by_label("curve point 2").rect().center();
    let modifiers = Modifiers::NONE;
    window.frame(vec![Event::PointerMoved(point)]);
    for pressed in [true, false] {
        let button = PointerButton::Secondary;
        window.frame(vec![Event::PointerButton { pos: point, button, pressed, modifiers }]);
    }
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
    for step in 0..=20_u8 {
        let at = field.left_center() + vec2(10.0 + 10.0 * f32::from(step), 0.0);
        let state =
            PointerState { pressure: Some(0.1 + 0.02 * f64::from(step)), ..PointerState::at(at) };
        let kind = if step == 0 { ReportKind::Pressed(state) } else { ReportKind::Moved(state) };
        report(&mut window, kind);
    }
    // The value is 0.5 to the power of 1.6.
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
    // The brush skips most of the wave.
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

/// Labels of the actions so far.
fn history(window: &Window) -> Vec<String> {
    window.studio().painting().map(|painting| painting.history.clone()).unwrap_or_default()
}

fn message(window: &Window) -> String {
    let message = window.studio().message().expect("a message is shown");
    format!("{}: {}", message.text, message.hint.as_deref().unwrap_or_default())
}

#[test]
fn tools_of_the_toolbar_work_the_wet_paint_and_the_status_line_tells_what_they_took() {
    let mut window = Window::open("working");
    window.click("Load brush");
    draw(&mut window, 8.0, 0.6);
    window.settle();
    fn brush(window: &Window) -> session::BrushState {
        let painting = window.studio().painting().expect("a painting is open");
        let name = &window.studio().tools.brush;
        painting.brushes.iter().find(|brush| brush.name == *name).expect("it is listed").clone()
    }
    let loaded = brush(&window);
    for (key, tool, wanted) in [
        (Key::N, "blend", "of paint wiped off the head: "),
        (Key::S, "scrape", "of paint taken off: "),
        (Key::E, "erase", "of paint taken off: "),
    ] {
        window.key(Modifiers::NONE, key);
        draw(&mut window, 8.0, 0.5);
        window.settle();
        let history = history(&window);
        let last = history.last().expect("there are actions");
        assert!(last.starts_with(&format!("{tool}, ")), "{history:?}");
        let text = message(&window);
        assert!(text.contains(" mm3 ") && text.contains(wanted), "{text}");
        assert_eq!(brush(&window), loaded, "{tool}: the paint of the brush stays");
    }
    window.save("working-tools");
    window.click("Paint");
    draw(&mut window, 14.0, 0.5);
    window.settle();
    assert!(history(&window).last().is_some_and(|last| last.starts_with("stroke")));
}

#[test]
fn a_tool_over_dry_paint_alone_says_that_there_was_no_wet_paint() {
    let mut window = Window::open("working-dry");
    window.click("Load brush");
    draw(&mut window, 8.0, 0.6);
    window.key(Modifiers::NONE, Key::D);
    window.settle();
    window.click("Erase");
    draw(&mut window, 8.0, 0.9);
    window.settle();
    assert_eq!(message(&window), "there was no wet paint to erase: dry layers stay as they are");
}

#[test]
fn the_brush_tab_shows_the_settings_of_the_tool() {
    let mut window = Window::sized("working-settings", vec2(1920.0, 1080.0), 1.0);
    fn shown(window: &mut Window, label: &str) -> bool {
        use egui_kittest::kittest::Queryable;
        window.harness().query_all_by_label(label).next().is_some()
    }
    assert!(!shown(&mut window, "Strength") && !shown(&mut window, "Height"));
    for (tool, label) in [("Blend", "Strength"), ("Erase", "Strength"), ("Scrape", "Height")] {
        window.click(tool);
        assert!(shown(&mut window, label), "{tool} has no {label}");
    }
    window.click("Mask");
    assert!(shown(&mut window, "Any paint") && shown(&mut window, "Invert"));
    window.harness().ctx.set_theme(Theme::Light);
    window.settle();
    window.save("working-mask-settings");
}

/// Drags the mouse with the primary button along places of the canvas in mm.
fn drag_with(window: &mut Window, places: &[(f64, f64)], modifiers: Modifiers) {
    let points: Vec<Pos2> =
        places.iter().map(|&(x, y)| window.point(SurfaceId::Canvas, x, y)).collect();
    let first = points[0];
    let last = points[points.len() - 1];
    let buttons = [button(first, true), button(last, false)];
    let [down, up] = buttons.map(|event| match event {
        Event::PointerButton { pos, button, pressed, .. } => {
            Event::PointerButton { pos, button, pressed, modifiers }
        }
        other => other,
    });
    window.frame(vec![Event::ModifiersChanged(modifiers), Event::PointerMoved(first)]);
    window.frame(vec![down]);
    for &point in &points[1..] {
        window.frame(vec![Event::PointerMoved(point)]);
    }
    window.frame(vec![up, Event::ModifiersChanged(Modifiers::NONE)]);
    window.settle();
}

fn covered(window: &Window) -> Option<f64> {
    let painting = window.studio().painting().expect("a painting is open");
    painting.mask.as_ref().map(|mask| mask.covered)
}

#[test]
fn the_pen_draws_masks_which_the_brush_tab_inverts_and_takes_off() {
    let mut window = Window::open("working-mask");
    window.key(Modifiers::NONE, Key::K);
    // This triangle is half of the 32 x 20 mm.
    drag_with(
        &mut window,
        &[(0.0, 0.0), (16.0, 0.0), (32.0, 0.0), (16.0, 10.0), (0.0, 20.0)],
        Modifiers::NONE,
    );
    let triangle = covered(&window).expect("a mask is set");
    assert!((triangle - 0.5).abs() < 0.02, "{triangle}");
    // This rectangle is a quarter.
    drag_with(&mut window, &[(8.0, 5.0), (12.0, 14.0), (24.0, 15.0)], Modifiers::SHIFT);
    let rectangle = covered(&window).expect("another mask is set");
    assert!((rectangle - 0.75).abs() < 0.02, "{rectangle}");
    window.save("working-mask");
    window.click("Invert");
    window.settle();
    let inverse = covered(&window).expect("it is inverted");
    assert!((inverse - 1.0 + rectangle).abs() < 1e-9, "{inverse} after {rectangle}");
    window.click("Take off");
    window.settle();
    assert_eq!(covered(&window), None);
    assert_eq!(history(&window), ["mask", "mask", "mask inverted", "mask off"]);
    window.key(Modifiers::COMMAND, Key::Z);
    window.settle();
    assert_eq!(covered(&window), Some(inverse), "an undo puts it on again");
}

#[test]
fn a_mask_by_paint_locks_the_bare_canvas() {
    let mut window = Window::open("working-lock");
    window.click("Load brush");
    draw(&mut window, 8.0, 0.6);
    window.click("Mask");
    window.click("Any paint");
    window.settle();
    let share = covered(&window).expect("a mask is set");
    assert!((0.3..0.99).contains(&share), "{share}");
    window.save("working-lock");
}

#[test]
fn a_tap_within_one_frame_picks_a_colour() {
    let mut window = Window::open("working-tap");
    let at = window.point(SurfaceId::Canvas, 10.0, 10.0);
    window.key(Modifiers::NONE, Key::I);
    window.frame(vec![Event::PointerMoved(at)]);
    assert!(!window.shows("sRGB"), "nothing is picked yet");
    window.frame(vec![button(at, true), button(at, false)]);
    window.settle();
    assert!(window.shows("sRGB"), "you see the colour");
}
