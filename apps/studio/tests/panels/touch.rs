//! Fingers and narrow windows: taps of several fingers undo and redo, two fingers move the view,
//! and the panels of a narrow window lie on a sheet over the canvas.

use std::path::PathBuf;

use eframe::egui::{Event, Pos2, Rect, TouchDeviceId, TouchId, TouchPhase, Vec2, vec2};
use egui_kittest::kittest::Queryable;
use image::{Rgb, RgbImage};
use paint::strokes::{Action, Load, SurfaceId};
use session::Command;
use studio::app::CropTool;
use studio::theme::TOUCH_TARGET;

use super::harness::{Window, button};

fn touch(id: u64, phase: TouchPhase, pos: Pos2) -> Event {
    let device_id = TouchDeviceId(0);
    let id = TouchId(id);
    Event::Touch { device_id, id, phase, pos, force: Some(0.5) }
}

/// The events of a finger as the window system sends them. The first finger is a mouse too.
fn finger(id: u64, phase: TouchPhase, pos: Pos2) -> Vec<Event> {
    let mouse = match phase {
        _ if id > 0 => vec![],
        TouchPhase::Start => vec![Event::PointerMoved(pos), button(pos, true)],
        TouchPhase::Move => vec![Event::PointerMoved(pos)],
        TouchPhase::End => vec![button(pos, false), Event::PointerGone],
        TouchPhase::Cancel => vec![Event::PointerGone],
    };
    [touch(id, phase, pos)].into_iter().chain(mouse).collect()
}

/// Events of fingers at these places, all in the same phase.
fn fingers(phase: TouchPhase, places: &[Pos2]) -> Vec<Event> {
    let numbered = places.iter().zip(0..);
    numbered.flat_map(|(&place, id)| finger(id, phase, place)).collect()
}

/// Points of the window in a row through the middle of the canvas, at these distances from it.
fn around(window: &Window, distances: &[f32]) -> Vec<Pos2> {
    let middle = window.point(SurfaceId::Canvas, 16.0, 10.0);
    distances.iter().map(|&distance| middle + vec2(distance, 0.0)).collect()
}

/// Taps with a finger at each place at once. All happens in one frame, so that a slow frame cannot
/// make the tap too late.
fn tap(window: &mut Window, places: &[Pos2]) {
    let whole = [TouchPhase::Start, TouchPhase::End].map(|phase| fingers(phase, places));
    window.frame(whole.concat());
    window.settle();
}

fn done(window: &Window) -> (usize, usize) {
    let painting = window.studio().painting().unwrap();
    (painting.history_done, painting.history.len())
}

/// A window with two strokes of a loaded brush on the canvas.
fn painted(name: &'static str) -> Window {
    let mut window = Window::open(name);
    let load = Load {
        brush: "round".to_owned(),
        recipe: [("Vermilion".to_owned(), 1.0)].into(),
        vehicle: 0.2,
        amount_mm: 0.3,
    };
    window.studio_mut().ask(Command::Apply(Action::Load(load)));
    window.settle();
    for y_mm in [4.0, 8.0] {
        let [from, to] = [6.0, 20.0].map(|x_mm| window.point(SurfaceId::Canvas, x_mm, y_mm));
        window.pen_stroke(&[from, from.lerp(to, 0.5), to]);
        window.settle();
    }
    assert_eq!(done(&window), (2, 2), "two strokes");
    window
}

#[test]
fn a_tap_of_two_fingers_undoes_and_one_of_three_redoes() {
    let mut window = painted("touch-tap");
    let [two, three] = [&[-40.0, 40.0][..], &[-60.0, 0.0, 60.0]].map(|at| around(&window, at));
    tap(&mut window, &two);
    assert_eq!(done(&window), (1, 2), "two fingers undo");
    tap(&mut window, &two);
    assert_eq!(done(&window), (0, 2));
    tap(&mut window, &three);
    assert_eq!(done(&window), (1, 2), "three fingers redo");
    // Beside canvas and palette, this is not a tap.
    let beside = window.harness().get_by_label("Rename").rect().center();
    tap(&mut window, &[beside, beside + vec2(30.0, 0.0)]);
    assert_eq!(done(&window), (1, 2), "on a panel nothing is undone");
}

#[test]
fn a_second_finger_that_ends_a_stroke_undoes_nothing() {
    let mut window = painted("touch-late");
    let places = around(&window, &[0.0, 80.0]);
    // This is far enough to paint, and near enough for a tap.
    let moved = places[0] + vec2(0.0, 8.0);
    let mut events = finger(0, TouchPhase::Start, places[0]);
    events.extend(finger(0, TouchPhase::Move, moved));
    window.frame(events);
    let mut events = finger(1, TouchPhase::Start, places[1]);
    events.extend(finger(1, TouchPhase::End, places[1]));
    events.extend(finger(0, TouchPhase::End, moved));
    window.frame(events);
    window.settle();
    assert_eq!(done(&window), (3, 3), "the stroke stays, and nothing is undone");
}

/// Displacement in the window that belongs to 10 mm to the right on the canvas.
fn right(window: &Window) -> Vec2 {
    window.point(SurfaceId::Canvas, 21.0, 10.0) - window.point(SurfaceId::Canvas, 11.0, 10.0)
}

#[test]
fn two_fingers_move_zoom_and_turn_the_view_and_paint_nothing() {
    let mut window = painted("touch-view");
    let middle = window.point(SurfaceId::Canvas, 16.0, 10.0);
    let before = right(&window);
    let place = middle;
    let mut at = around(&window, &[-50.0, 50.0]);
    window.frame(fingers(TouchPhase::Start, &at));
    fn go(window: &mut Window, at: &[Pos2]) {
        window.frame(fingers(TouchPhase::Move, at));
    }
    go(&mut window, &at);
    // The fingers move together, and the picture follows.
    for _ in 0..4 {
        at = at.iter().map(|&finger| finger + vec2(6.0, 4.0)).collect();
        go(&mut window, &at);
    }
    let moved = window.point(SurfaceId::Canvas, 16.0, 10.0) - place;
    assert!((moved - vec2(24.0, 16.0)).length() < 1.0, "{moved}");
    assert!((right(&window) - before).length() < 0.01, "only moved");
    // The fingers move apart, and the picture grows around the middle between them.
    let middle = at[0].lerp(at[1], 0.5);
    for half in [55.0, 65.0, 80.0, 100.0] {
        at = vec![middle - vec2(half, 0.0), middle + vec2(half, 0.0)];
        go(&mut window, &at);
    }
    let grown = right(&window).length() / before.length();
    assert!((grown - 2.0).abs() < 0.02, "{grown} times as large");
    let stays = window.point(SurfaceId::Canvas, 16.0, 10.0) - middle;
    assert!(stays.length() < 1.0, "the middle stays: {stays}");
    // The fingers move around each other, and the picture turns with them.
    for step in 1..=10 {
        let arm = 100.0 * Vec2::angled(0.05 * step as f32);
        at = vec![middle - arm, middle + arm];
        go(&mut window, &at);
    }
    let turned = right(&window).angle();
    assert!((turned - 0.5).abs() < 0.02, "{turned} radians");
    window.frame(fingers(TouchPhase::End, &at));
    window.settle();
    assert_eq!(done(&window), (2, 2), "nothing was painted or undone");
}

/// Rectangles of the controls with labels that contain `label`, in which you can press them.
fn handles(window: &mut Window, label: &str) -> Vec<Rect> {
    let found = window.harness().query_all_by_label_contains(label);
    found.map(|node| node.rect()).collect()
}

#[test]
fn handles_over_the_canvas_and_points_of_the_curve_are_large_enough_to_be_touched() {
    let mut window = Window::open("touch-handles");
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("touch-handles.png");
    RgbImage::from_pixel(300, 100, Rgb([200, 20, 20])).save(&path).unwrap();
    let context = window.harness().ctx.clone();
    for touch in [false, true] {
        window.studio_mut().files.preferences.touch_targets = touch;
        let large = |rects: &[Rect], count: usize, what: &str| {
            assert_eq!(rects.len(), count, "{what}: {rects:?}");
            let least = rects
                .iter()
                .map(|rect| rect.width().min(rect.height()))
                .fold(f32::INFINITY, f32::min);
            assert_eq!(least >= TOUCH_TARGET - 0.5, touch, "{what}: {least}");
        };
        window.studio_mut().visible.pen = true;
        window.settle();
        let points = handles(&mut window, "curve point ");
        large(&points, points.len().max(2), "points of the curve");
        window.studio_mut().visible.pen = false;
        window.studio_mut().crop = Some(CropTool::new((320, 200)));
        window.settle();
        window.save(&format!("touch-crop-{touch}"));
        large(&handles(&mut window, "Crop "), 8, "the crop");
        window.studio_mut().crop = None;
        if !window.studio().panels.reference.is_open() {
            window.studio_mut().panels.reference.open(&context, &path);
            window.studio_mut().panels.reference.toggle_over_canvas();
            while !window.studio().panels.reference.is_over_canvas() {
                std::thread::sleep(std::time::Duration::from_millis(5));
                window.harness().step();
            }
            window.click("Move");
        }
        window.settle();
        let mut over = handles(&mut window, "Scale by the ");
        over.extend(handles(&mut window, "Turn the picture"));
        large(&over, 5, "the picture over the canvas");
    }
}

/// Window of an upright phone, in points.
const PHONE: Vec2 = vec2(390.0, 844.0);

fn loaded(name: &'static str) -> Window {
    let mut window = Window::sized(name, PHONE, 2.0);
    window.studio_mut().tools.brush = "round".to_owned();
    let paint = Load {
        brush: "round".to_owned(),
        recipe: [("Vermilion".to_owned(), 1.0)].into(),
        vehicle: 0.2,
        amount_mm: 0.3,
    };
    window.studio_mut().ask(Command::Apply(Action::Load(paint)));
    window.settle();
    window
}

/// Paints a stroke through the middle of the canvas. Returns the number of strokes done.
fn stroke(window: &mut Window) -> usize {
    let along: Vec<_> = (0..=20)
        .map(|at| window.point(SurfaceId::Canvas, 8.0 + 0.8 * f64::from(at), 10.0))
        .collect();
    window.pen_stroke(&along);
    window.settle();
    window.studio().painting().unwrap().history_done
}

#[test]
fn the_canvas_has_half_of_a_phones_window_and_all_controls_are_within_it() {
    for large in [false, true] {
        let mut window = Window::sized("narrow", PHONE, 2.0);
        window.studio_mut().files.preferences.touch_targets = large;
        window.harness().run_ok();
        window.show(if large { "narrow-touch" } else { "narrow" });
        let whole = window.whole();
        let canvas = window.studio().canvas.rect();
        let share = canvas.area() / whole.area();
        assert!(share >= 0.5, "the canvas has {share} of the window, large targets: {large}");
        for label in ["File", "Help", "Panels", "Canvas", "Palette", "Paint", "tube of Vermilion"] {
            let rect = window.harness().get_by_label(label).rect();
            assert!(whole.contains_rect(rect), "{label} at {rect} of {whole}");
        }
        assert!(window.harness().query_by_label("Brush").is_none(), "no panel takes room");
    }
}

#[test]
fn the_sheet_of_panels_covers_the_canvas_until_it_is_closed() {
    let mut window = loaded("sheet");
    assert_eq!(stroke(&mut window), 1);
    let canvas = window.studio().canvas.rect();
    window.click("Panels");
    window.settle();
    window.show("narrow-sheet");
    for label in ["Brush", "Layers", "Light", "History"] {
        let rect: Rect = window.harness().get_by_label(label).rect();
        assert!(window.whole().contains_rect(rect), "{label} at {rect}");
        assert!(rect.left() >= canvas.left(), "{label} lies beside the toolbar");
    }
    assert!(window.harness().query_by_label("Palette").is_none(), "the palette is covered");
    assert_eq!(stroke(&mut window), 1, "nothing is painted through the sheet");
    window.click("Panels");
    window.settle();
    assert_eq!(window.studio().canvas.rect(), canvas);
    assert_eq!(stroke(&mut window), 2, "the canvas is painted again");
}

#[test]
fn a_window_that_becomes_wider_has_its_columns_again() {
    let mut window = Window::sized("turned", PHONE, 2.0);
    window.click("Panels");
    window.harness().set_size(vec2(844.0, 390.0));
    window.harness().run_steps(4);
    window.show("narrow-turned");
    let tab = window.harness().get_by_label("Brush").rect();
    let canvas = window.studio().canvas.rect();
    assert!(tab.left() > canvas.right() && canvas.width() > 100.0, "{tab} beside {canvas}");
}
