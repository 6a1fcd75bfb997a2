//! Tests of the quick palette in the whole window.

use std::time::Duration;

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use paint::strokes::SurfaceId;

use crate::harness::{Window, button};

fn over_canvas(window: &mut Window) -> Pos2 {
    let point = window.point(SurfaceId::Canvas, 16.0, 10.0);
    window.frame(vec![Event::PointerMoved(point)]);
    window.frame(Vec::new());
    point
}

fn is_open(window: &mut Window) -> bool {
    window.harness().query_by_label("quick size 6 mm").is_some()
}

fn place(window: &mut Window, label: &str) -> Pos2 {
    window.harness().get_by_label(label).rect().center()
}

/// Moves the pointer to a point, presses and releases the primary button there.
fn click_at(window: &mut Window, point: Pos2) {
    window.frame(vec![Event::PointerMoved(point)]);
    window.frame(vec![button(point, true)]);
    window.frame(vec![button(point, false)]);
    window.frame(Vec::new());
}

fn amount(window: &Window) -> f64 {
    let painting = window.studio().painting().unwrap();
    let brush = painting.brushes.iter().find(|brush| brush.name == window.studio().tools.brush);
    brush.unwrap().amount_mm
}

#[test]
fn a_key_opens_it_at_the_pointer_and_a_click_loads_a_tube() {
    let mut window = Window::open("quick");
    let point = over_canvas(&mut window);
    assert!(!is_open(&mut window));
    window.key(Modifiers::NONE, Key::C);
    assert!(is_open(&mut window));
    window.save("quick");
    let tube = place(&mut window, "quick Vermilion");
    assert!((tube.distance(point) - 75.0).abs() < 1.0, "around the pointer: {tube} {point}");
    click_at(&mut window, tube);
    window.settle();
    assert!(!is_open(&mut window) && amount(&window) > 0.0, "the brush is loaded");
    let painting = window.studio().painting().unwrap();
    let slot = painting
        .slots
        .iter()
        .position(|slot| slot.is_some_and(|pigment| painting.library[pigment].name == "Vermilion"));
    assert_eq!(Some(window.studio().tools.tube), slot);
    let history = painting.history.len();
    assert_eq!(history, 0, "the click did not paint: {:?}", painting.history);
}

#[test]
fn escape_a_click_outside_and_the_key_close_it() {
    let mut window = Window::open("quick-close");
    over_canvas(&mut window);
    window.key(Modifiers::NONE, Key::C);
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!is_open(&mut window), "Escape");
    window.key(Modifiers::NONE, Key::C);
    window.key(Modifiers::NONE, Key::C);
    assert!(!is_open(&mut window), "the key again");
    window.key(Modifiers::NONE, Key::C);
    let outside = window.studio().canvas.rect().left_top() + vec2(12.0, 12.0);
    click_at(&mut window, outside);
    window.settle();
    assert!(!is_open(&mut window) && amount(&window) == 0.0, "a click outside");
    assert!(window.studio().painting().unwrap().history.is_empty(), "it did not paint");
}

#[test]
fn the_right_button_is_dragged_to_a_size_and_let_go() {
    let mut window = Window::open("quick-drag");
    let point = over_canvas(&mut window);
    let secondary = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Secondary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    window.frame(vec![secondary(point, true)]);
    window.frame(Vec::new());
    let size = place(&mut window, "quick size 12 mm");
    window.frame(vec![Event::PointerMoved(size)]);
    window.frame(vec![secondary(size, false)]);
    window.settle();
    assert!(!is_open(&mut window));
    let studio = window.studio();
    let brushes = &studio.painting().unwrap().brushes;
    let brush = brushes.iter().find(|brush| brush.name == studio.tools.brush).unwrap();
    assert!((brush.spec.size_mm - 12.0).abs() < 1e-9, "{:?}", brush.spec);
    // A short click leaves it open for a second one.
    window.frame(vec![secondary(point, true)]);
    window.frame(vec![secondary(point, false)]);
    window.frame(Vec::new());
    assert!(is_open(&mut window));
}

#[test]
fn mixtures_that_were_loaded_or_kept_come_back() {
    let mut window = Window::open("quick-mixtures");
    let recipe = [("Zinc White".to_owned(), 3.0), ("Vermilion".to_owned(), 1.0)];
    window.studio_mut().tools.recent = vec![(recipe.into(), 0.1)];
    over_canvas(&mut window);
    window.key(Modifiers::NONE, Key::C);
    let mixture = place(&mut window, "quick mixture Zinc White and Vermilion");
    click_at(&mut window, mixture);
    window.settle();
    assert!(amount(&window) > 0.0);
    let painting = window.studio().painting().unwrap();
    let held = painting.brushes.iter().find(|b| b.name == window.studio().tools.brush).unwrap();
    assert_eq!(held.parts.iter().filter(|part| **part > 0.0).count(), 2, "{:?}", held.parts);
    // Kept through the panel, written to the home folder, and offered.
    window.click("Keep this mixture");
    window.settle();
    window.studio_mut().tools.recent.clear();
    window.key(Modifiers::NONE, Key::C);
    let found = window.harness().query_by_label("quick mixture Zinc White and Vermilion");
    assert!(found.is_some(), "from the list");
}

#[test]
fn it_never_opens_over_a_dialog_and_paint_waits_while_it_is_open() {
    let mut window = Window::open("quick-dialog");
    over_canvas(&mut window);
    window.key(Modifiers::COMMAND, Key::Comma);
    assert!(window.studio().files.has_dialog());
    window.key(Modifiers::NONE, Key::C);
    assert!(!is_open(&mut window), "the dialog has the keys");
    window.key(Modifiers::NONE, Key::Escape);
    let [first, second] =
        [(8.0, 6.0), (24.0, 14.0)].map(|(x, y)| window.point(SurfaceId::Canvas, x, y));
    window.key(Modifiers::NONE, Key::C);
    window.pen_stroke(&[first, second]);
    std::thread::sleep(Duration::from_millis(20));
    window.settle();
    assert!(window.studio().painting().unwrap().history.is_empty(), "no stroke below the menu");
}

#[test]
fn the_menu_opens_it_for_fingers_and_pens_without_keys() {
    let mut window = Window::open("quick-menu");
    window.click("Tools");
    window.click("Quick palette");
    window.frame(Vec::new());
    assert!(is_open(&mut window));
    let middle = window.studio().canvas.rect().center();
    let size = place(&mut window, "quick size 3 mm");
    assert!(size.distance(middle) < 260.0, "over the canvas: {size} {middle}");
    click_at(&mut window, size);
    window.settle();
    let studio = window.studio();
    let brushes = &studio.painting().unwrap().brushes;
    let brush = brushes.iter().find(|brush| brush.name == studio.tools.brush).unwrap();
    assert!((brush.spec.size_mm - 3.0).abs() < 1e-9, "{:?}", brush.spec);
}
