//! Tests of pen input in the whole window.

use web_time::{Duration, Instant};

use eframe::egui::{Event, Key, Modifiers, Pos2};
use image::RgbaImage;
use paint::strokes::SurfaceId;
use studio::pen::{Device, PointerState, Report, ReportKind, Script};

use super::harness::{Window, button};

/// Pointer state at a position of the canvas, in mm.
fn hold(window: &Window, x_mm: f64, y_mm: f64, pressure: f64) -> PointerState {
    let at = window.point(SurfaceId::Canvas, x_mm, y_mm);
    PointerState { at, pressure: Some(pressure), tilt_deg: Some((15.0, 5.0)), twist_deg: Some(0.0) }
}

/// Plays a stroke of a loaded brush from x = 6 to 26 mm with 200 reports per second in
/// frames of 20 ms. Returns its end in the window.
fn stroke(window: &mut Window, y_mm: f64, pressure: f64) -> Pos2 {
    window.click("Load brush");
    draw(window, y_mm, pressure)
}

/// Plays such a stroke of the tool in use.
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
    let differs = |&(x, y): &(u32, u32)| before.get_pixel(x, y) != after.get_pixel(x, y);
    rows.flat_map(|y| (from.x as u32..right).map(move |x| (x, y))).filter(differs).count()
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
    let pixels = |y_mm| painted(&window, &before, &after, y_mm);
    let heavy = pixels(5.0);
    let light = pixels(15.0);
    assert!(light > 200, "{light} pixels of a light stroke");
    assert!(heavy as f64 > 1.5 * light as f64, "{heavy} pixels pressed, {light} not");
}

#[test]
fn mouse_events_emulated_for_a_pen_make_no_second_stroke() {
    let mut window = Window::open("pen-mouse");
    let end = stroke(&mut window, 5.0, 0.5);
    // The mouse events of the pen arrive late, because they come over another connection.
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
