//! Ruler, perspective and symmetry in the whole window, with a synthetic pen.

use web_time::{Duration, Instant};

use eframe::egui::{Key, Modifiers, Rect, Theme, vec2};
use egui_kittest::kittest::Queryable;
use graphics::tile;
use paint::pose::Sample;
use paint::strokes::{Action, Stroke, StrokeTool, SurfaceId};
use session::{Command, Pace};
use studio::files::WindowSetup;
use studio::pen::{
    Device, DrawingAids, GuideKind, PointerState, ReportKind, RulerShape, Script, SymmetryKind,
};

use super::harness::{Window, button};
use super::pen::report;

/// Places of a wavy stroke, in mm. It starts at `x_mm`, `y_mm`.
fn wavy(x_mm: f64, y_mm: f64) -> Vec<[f64; 2]> {
    (0..60)
        .map(|step: u8| {
            let along = f64::from(step) / 7.0;
            [x_mm + along, y_mm + 0.25 * along + 0.5 * (1.3 * along).sin()]
        })
        .collect()
}

fn hold(window: &Window, surface: SurfaceId, [x_mm, y_mm]: [f64; 2]) -> PointerState {
    let at = window.point(surface, x_mm, y_mm);
    PointerState { at, pressure: Some(0.5), tilt_deg: Some((25.0, 10.0)), twist_deg: Some(30.0) }
}

fn paint_on(window: &mut Window, surface: SurfaceId, places: &[[f64; 2]]) {
    let holds: Vec<PointerState> =
        places.iter().map(|&place| hold(window, surface, place)).collect();
    let mut script = Script::new(Device::Pen).stroke(holds, Duration::from_millis(5));
    let start = Instant::now();
    let length = script.length();
    let mut now = start;
    while now <= start + length {
        now += Duration::from_millis(20);
        std::thread::sleep(now.saturating_duration_since(Instant::now()));
        for report in script.due(start, now) {
            window.studio_mut().pen.feed(report);
        }
        window.frame(Vec::new());
    }
    assert!(!window.studio().pen.is_down(), "the script has ended");
    window.settle();
}

fn paint(window: &mut Window, places: &[[f64; 2]]) {
    paint_on(window, SurfaceId::Canvas, places);
}

fn strokes(window: &Window) -> Vec<Stroke> {
    let script = window.studio().recorded().expect("it is recorded");
    let strokes = script.actions.iter().filter_map(|action| match action {
        Action::Stroke(stroke) => Some(stroke.clone()),
        _ => None,
    });
    strokes.collect()
}

fn last(window: &Window) -> Vec<Sample> {
    strokes(window).pop().expect("there is a stroke").samples
}

/// Places and attitudes of samples, without repetitions. A pen that rests for a moment repeats its
/// sample.
fn ways(samples: &[Sample]) -> Vec<[f64; 6]> {
    let mut ways: Vec<[f64; 6]> = samples
        .iter()
        .map(|at: &Sample| {
            [at.x_mm, at.y_mm, at.pressure, at.tilt_x_deg, at.tilt_y_deg, at.twist_deg]
        })
        .collect();
    ways.dedup();
    ways
}

/// Number of done actions, and of all actions including undone ones.
fn done(window: &Window) -> (usize, usize) {
    let painting = window.studio().painting().expect("a painting is open");
    (painting.history_done, painting.history.len())
}

fn extent(samples: &[Sample]) -> [f64; 2] {
    [|at: &Sample| at.x_mm, |at: &Sample| at.y_mm].map(|of| {
        let places = samples.iter().map(of);
        places.clone().fold(f64::MIN, f64::max) - places.fold(f64::MAX, f64::min)
    })
}

fn aids(window: &mut Window) -> &mut DrawingAids {
    &mut window.studio_mut().aids
}

fn drag(window: &mut Window, handle: &str, [x_mm, y_mm]: [f64; 2]) {
    let from = window.harness().get_by_label(handle).rect().center();
    let to = window.point(SurfaceId::Canvas, x_mm, y_mm);
    window.pen_stroke(&[from, from.lerp(to, 0.4), to]);
    window.settle();
}

fn pixels(window: &Window) -> Vec<[u8; 3]> {
    let view = &window.studio().canvas;
    let (width, height) = view.cells();
    let picture = view.picture(false).expect("it is shown");
    let pixels = picture.pixels(tile::Rect { x: 0, y: 0, width, height }).pixels;
    pixels.into_iter().map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect()
}

#[test]
fn strokes_follow_the_ruler_while_they_are_to_and_are_free_else() {
    let mut window = Window::open("aids-ruler");
    window.click("Load brush");
    paint(&mut window, &wavy(8.0, 8.0));
    let free = last(&window);
    assert!(extent(&free)[1] > 1.0, "{:?}", extent(&free));
    window.key(Modifiers::NONE, Key::U);
    window.harness().run_steps(2);
    paint(&mut window, &wavy(8.0, 8.0));
    let led = last(&window);
    // The ruler is level in the middle of 20 mm.
    assert!(led.iter().all(|at| at.y_mm == 10.0), "{:?}", extent(&led));
    assert!((extent(&led)[0] - extent(&free)[0]).abs() < 1e-9);
    aids(&mut window).ruler.shape = RulerShape::Parallel;
    aids(&mut window).ruler.ends = [[2.0, 2.0], [22.0, 17.0]];
    paint(&mut window, &wavy(8.0, 4.0));
    let led = last(&window);
    assert!(
        led.iter()
            .all(|at| ((at.y_mm - led[0].y_mm) - 0.75 * (at.x_mm - led[0].x_mm)).abs() < 0.002),
        "{led:?}"
    );
    assert_eq!((led[0].x_mm, led[0].y_mm), (8.0, 4.0));
    window.save("aids-ruler");
    // You see the ruler, but strokes do not follow it. This must equal a stroke without aids to the
    // bit.
    window.key(Modifiers::NONE, Key::G);
    paint(&mut window, &wavy(8.0, 8.0));
    assert_eq!(ways(&last(&window)), ways(&free));
    window.key(Modifiers::NONE, Key::G);
    window.key(Modifiers::NONE, Key::U);
    assert_eq!(window.studio().aids.guide, None);
    paint(&mut window, &wavy(8.0, 8.0));
    assert_eq!(ways(&last(&window)), ways(&free));
}

#[test]
fn strokes_in_perspective_run_to_a_vanishing_point() {
    let mut window = Window::open("aids-perspective");
    window.click("Load brush");
    window.key(Modifiers::NONE, Key::V);
    window.harness().run_steps(2);
    let [left, right] = [0, 1].map(|at| window.studio().aids.perspective.points[at]);
    for (to, steps) in [(left, [-0.2, -0.12]), (right, [0.2, -0.11])] {
        let places: Vec<[f64; 2]> = (0..50)
            .map(|step: u8| {
                let along = f64::from(step);
                [16.0 + steps[0] * along, 17.0 + steps[1] * along + 0.3 * (0.3 * along).sin()]
            })
            .collect();
        paint(&mut window, &places);
        let led = last(&window);
        let across = to[0] - 16.0;
        let down = to[1] - 17.0;
        let worst = led
            .iter()
            .map(|at: &Sample| {
                ((at.x_mm - 16.0) * down - (at.y_mm - 17.0) * across).abs() / across.hypot(down)
            })
            .fold(0.0, f64::max);
        assert!(worst < 0.002, "{worst} mm from the line to {to:?}");
        assert_eq!((led[0].x_mm, led[0].y_mm), (16.0, 17.0));
        assert!(extent(&led)[0] > 5.0, "{:?}", extent(&led));
    }
    window.save("aids-perspective");
}

#[test]
fn a_stroke_is_painted_mirrored_too_and_undone_with_its_twins() {
    let mut window = Window::open("aids-symmetry");
    window.click("Load brush");
    let bare = pixels(&window);
    window.key(Modifiers::NONE, Key::Y);
    window.harness().run_steps(2);
    paint(&mut window, &wavy(3.0, 6.0));
    let [stroke, twin] = &strokes(&window)[..] else { panic!("{}", strokes(&window).len()) };
    assert_eq!(stroke.samples.len(), twin.samples.len());
    for (at, mirrored) in stroke.samples.iter().zip(&twin.samples) {
        assert!((32.0 - at.x_mm - mirrored.x_mm).abs() < 0.0015, "{at:?} {mirrored:?}");
        assert_eq!(
            (at.y_mm, at.seconds, at.pressure),
            (mirrored.y_mm, mirrored.seconds, mirrored.pressure)
        );
        assert_eq!((at.tilt_x_deg, at.tilt_y_deg), (-mirrored.tilt_x_deg, mirrored.tilt_y_deg));
        let turned = (180.0 - at.twist_deg - mirrored.twist_deg).rem_euclid(360.0);
        assert!(turned.min(360.0 - turned) < 0.02, "{at:?} {mirrored:?}");
    }
    let painted = pixels(&window);
    window.save("aids-symmetry");
    // Both sides have nearly as much paint, and nearly at the mirrored places.
    let cells = (0..200_usize).flat_map(|y| (0..160_usize).map(move |x| (x, y)));
    let mut both = 0;
    let mut either = 0;
    for (x, y) in cells {
        let sides = [x, 319 - x].map(|x| painted[y * 320 + x] != bare[y * 320 + x]);
        both += usize::from(sides == [true; 2]);
        either += usize::from(sides != [false; 2]);
    }
    assert!(either > 1000 && both * 100 > either * 75, "{both} of {either} cells");
    assert_eq!(done(&window), (2, 2));
    window.key(Modifiers::COMMAND, Key::Z);
    window.settle();
    assert_eq!(done(&window), (0, 2), "one undo");
    assert!(pixels(&window) == bare);
    window.key(Modifiers::COMMAND, Key::Y);
    window.settle();
    assert_eq!(done(&window), (2, 2), "one redo");
    assert!(pixels(&window) == painted);
    // The recording paints the same.
    let script = Box::new(window.studio().recorded().expect("it is recorded").clone());
    let library = Box::new((*window.studio().painting().unwrap().library).clone());
    window.studio_mut().ask(Command::Replay { script, library, pace: Pace::Fast });
    window.settle();
    assert!(pixels(&window) == painted, "to the bit");
}

#[test]
fn tools_are_repeated_around_the_centre_and_strokes_on_the_palette_are_not() {
    let mut window = Window::open("aids-radial");
    window.click("Load brush");
    aids(&mut window).symmetry.on = true;
    aids(&mut window).symmetry.kind = SymmetryKind::Radial;
    aids(&mut window).symmetry.arms = 5;
    paint_on(&mut window, SurfaceId::Palette, &wavy(6.0, 6.0));
    assert_eq!(done(&window).1, 1, "on the palette");
    paint(&mut window, &wavy(17.0, 8.0));
    assert_eq!(done(&window).1, 6);
    window.key(Modifiers::NONE, Key::E);
    paint(&mut window, &wavy(17.0, 8.0));
    assert_eq!(done(&window).1, 11);
    let strokes = strokes(&window);
    assert_eq!(
        strokes
            .iter()
            .filter(|stroke: &&Stroke| matches!(stroke.tool, StrokeTool::Erase { .. }))
            .count(),
        5
    );
    // The ends of the arms have one distance from the centre and even angles.
    let centre = window.studio().aids.symmetry.centre;
    let ends = strokes[1..6].iter().map(|stroke| {
        let end = stroke.samples[stroke.samples.len() - 1];
        [end.x_mm - centre[0], end.y_mm - centre[1]]
    });
    let ends: Vec<[f64; 2]> = ends.collect();
    for pair in ends.windows(2) {
        let [[ax, ay], [bx, by]] = [pair[0], pair[1]];
        assert!((ax.hypot(ay) - bx.hypot(by)).abs() < 0.003, "{ends:?}");
        let turn = (by.atan2(bx) - ay.atan2(ax)).to_degrees().rem_euclid(360.0);
        assert!((turn - 72.0).abs() < 0.1, "{turn}");
    }
    window.save("aids-radial");
}

#[test]
fn a_stroke_that_another_action_ends_has_no_twins() {
    let mut window = Window::open("aids-cut");
    window.click("Load brush");
    window.key(Modifiers::NONE, Key::Y);
    for (order, &place) in wavy(4.0, 6.0).iter().enumerate() {
        let state = hold(&window, SurfaceId::Canvas, place);
        let kind = if order == 0 { ReportKind::Pressed(state) } else { ReportKind::Moved(state) };
        report(&mut window, kind);
        if order == 30 {
            window.save("aids-twins-before");
            window.key(Modifiers::NONE, Key::D);
        }
    }
    report(&mut window, ReportKind::Released);
    window.settle();
    let history = window.studio().painting().unwrap().history.clone();
    assert_eq!(history.len(), 2, "{history:?}");
    assert!(history[1].starts_with("dry"), "{history:?}");
}

#[test]
fn handles_are_dragged_while_the_window_of_the_aids_is_open() {
    let mut window = Window::sized("aids-handles", vec2(1600.0, 1000.0), 1.0);
    window.key(Modifiers::NONE, Key::Y);
    let centre = "Centre of the symmetry";
    assert!(window.harness().query_by_label(centre).is_none(), "only lines are shown");
    window.key(Modifiers::SHIFT, Key::G);
    window.harness().run_steps(3);
    drag(&mut window, centre, [22.0, 13.0]);
    fn near(found: [f64; 2], wanted: [f64; 2]) {
        let off = (found[0] - wanted[0]).hypot(found[1] - wanted[1]);
        assert!(off < 0.1, "{found:?}, not {wanted:?}");
    }
    near(window.studio().aids.symmetry.centre, [22.0, 13.0]);
    drag(&mut window, "Angle of the symmetry", [27.0, 8.2]);
    assert_eq!(window.studio().aids.symmetry.angle_deg, 45.0);
    window.click("Above and below");
    assert_eq!(window.studio().aids.symmetry.kind, SymmetryKind::Horizontal);
    window.click("Radial");
    window.click("Perspective");
    window.click("3 points");
    assert_eq!(window.studio().aids.perspective.in_use().len(), 3);
    drag(&mut window, "Vanishing point 3", [12.0, 17.0]);
    near(window.studio().aids.perspective.points[2], [12.0, 17.0]);
    // A point beyond the view has its handle at the edge. If you move this, the point moves by as
    // much.
    aids(&mut window).perspective.points[1] = [90.0, 8.0];
    window.harness().run_steps(2);
    let view = window.studio().canvas.rect();
    let handle = window.harness().get_by_label("Vanishing point 2").rect();
    assert!(view.contains_rect(handle), "{handle} in {view}");
    let from = handle.center();
    window.pen_stroke(&[from, from - vec2(20.0, 0.0), from - vec2(60.0, 0.0)]);
    window.settle();
    let moved = 90.0 - window.studio().aids.perspective.points[1][0];
    let wanted = 60.0
        / f64::from(
            window.point(SurfaceId::Canvas, 1.0, 0.0).x
                - window.point(SurfaceId::Canvas, 0.0, 0.0).x,
        );
    assert!((moved - wanted).abs() < 0.1, "{moved} mm, not {wanted}");
    window.save("aids-handles-dark");
    window.click("Ruler");
    window.click("Ellipses");
    drag(&mut window, "Width of the ellipse", [16.0, 18.0]);
    assert!((window.studio().aids.ruler.half_width_mm - 8.0).abs() < 0.1);
    window.click("Parallels");
    drag(&mut window, "End of the ruler", [25.0, 14.0]);
    near(window.studio().aids.ruler.ends[1], [25.0, 14.0]);
    assert_eq!(done(&window), (0, 0), "handles do not paint");
    window.harness().ctx.set_theme(Theme::Light);
    window.settle();
    window.save("aids-handles-light");
    window.click("Put back");
    near(window.studio().aids.symmetry.centre, [16.0, 10.0]);
    // Beside the handles you can paint.
    paint(&mut window, &wavy(10.0, 16.0));
    assert!(done(&window).1 > 1);
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!window.studio().visible.aids, "Escape closes the window");
}

#[test]
fn handles_are_large_enough_to_be_touched() {
    let mut window = Window::sized("aids-touch", vec2(1600.0, 1000.0), 1.0);
    window.studio_mut().files.preferences.touch_targets = true;
    window.studio_mut().visible.aids = true;
    aids(&mut window).symmetry.on = true;
    aids(&mut window).guide = Some(GuideKind::Perspective);
    window.harness().run_steps(4);
    for handle in ["Centre of the symmetry", "Angle of the symmetry", "Vanishing point 1"] {
        let rect: Rect = window.harness().get_by_label(handle).rect();
        assert!(rect.width() >= 44.0 && rect.height() >= 44.0, "{handle}: {rect}");
    }
    // You cannot paint anywhere on a handle.
    let corner = window.harness().get_by_label("Centre of the symmetry").rect().shrink(2.0).min;
    window.frame(vec![eframe::egui::Event::PointerMoved(corner), button(corner, true)]);
    window.frame(vec![button(corner, false)]);
    window.settle();
    assert_eq!(done(&window), (0, 0));
    window.save("aids-touch");
}

#[test]
fn a_recovered_session_has_its_aids() {
    let mut window = Window::open("aids-desk");
    window.key(Modifiers::NONE, Key::Y);
    window.key(Modifiers::NONE, Key::V);
    aids(&mut window).symmetry.centre = [7.0, 8.0];
    aids(&mut window).perspective.points[0] = [-60.0, 4.0];
    let kept = *aids(&mut window);
    let text = serde_json::to_string(&window.studio().window_setup()).unwrap();
    let setup: WindowSetup = serde_json::from_str(&text).unwrap();
    let mut next = Window::open("aids-setup-next");
    assert_eq!(next.studio().aids.guide, None);
    let context = next.harness().ctx.clone();
    next.studio_mut().set_up(&setup, &context);
    next.settle();
    assert_eq!(*aids(&mut next), kept);
}
