//! Blending, scraping, erasing and masks in the whole window, with a synthetic pen.

use eframe::egui::{Event, Key, Modifiers, Pos2, Theme, vec2};
use paint::strokes::SurfaceId;

use super::harness::{Window, button};
use super::pen::draw;

/// Labels of the actions so far.
fn history(window: &Window) -> Vec<String> {
    window.studio().painting().map(|painting| painting.history.clone()).unwrap_or_default()
}

/// Text of the status line with its hint.
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
    let brush = |window: &Window| {
        let painting = window.studio().painting().expect("a painting is open");
        let name = &window.studio().tools.brush;
        painting.brushes.iter().find(|brush| brush.name == *name).expect("it is listed").clone()
    };
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
        let told = message(&window);
        assert!(told.contains(" mm3 ") && told.contains(wanted), "{told}");
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
    let shown = |window: &mut Window, label: &str| {
        use egui_kittest::kittest::Queryable;
        window.harness().query_all_by_label(label).next().is_some()
    };
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
fn drag(window: &mut Window, places: &[(f64, f64)], modifiers: Modifiers) {
    let points: Vec<Pos2> =
        places.iter().map(|&(x, y)| window.point(SurfaceId::Canvas, x, y)).collect();
    let first = points[0];
    let last = points[points.len() - 1];
    let held = |at: Pos2, pressed: bool| match button(at, pressed) {
        Event::PointerButton { pos, button, pressed, .. } => {
            Event::PointerButton { pos, button, pressed, modifiers }
        }
        other => other,
    };
    window.frame(vec![Event::ModifiersChanged(modifiers), Event::PointerMoved(first)]);
    window.frame(vec![held(first, true)]);
    for &point in &points[1..] {
        window.frame(vec![Event::PointerMoved(point)]);
    }
    window.frame(vec![held(last, false), Event::ModifiersChanged(Modifiers::NONE)]);
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
    // Half of the 32 x 20 mm as a triangle.
    drag(
        &mut window,
        &[(0.0, 0.0), (16.0, 0.0), (32.0, 0.0), (16.0, 10.0), (0.0, 20.0)],
        Modifiers::NONE,
    );
    let triangle = covered(&window).expect("a mask is set");
    assert!((triangle - 0.5).abs() < 0.02, "{triangle}");
    // A quarter as a rectangle.
    drag(&mut window, &[(8.0, 5.0), (12.0, 14.0), (24.0, 15.0)], Modifiers::SHIFT);
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
    assert!(window.shows("sRGB"), "the colour is told");
}
