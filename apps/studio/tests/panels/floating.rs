//! Windows over the canvas: closing them, menus, and strokes beside them.

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Rect, pos2};
use egui_kittest::kittest::Queryable;
use paint::strokes::SurfaceId;

use super::harness::Window;

/// Rectangle of the window that holds the control with this label, found by its text.
fn shown(window: &mut Window, label: &str) -> Option<Rect> {
    window.harness().query_by_label(label).map(|node| node.rect())
}

/// A line of the table of keys, of the tubes' window, and of the exchange's.
const KEYS: &str = "Alt + click";
const TUBES: &str = "Take off";
const EXCHANGE: &str = "exchange";

#[test]
fn escape_closes_the_topmost_window_first() {
    let mut window = Window::open("floating");
    window.click("Tubes...");
    assert!(shown(&mut window, TUBES).is_some(), "the tubes are open");
    window.key(Modifiers::NONE, Key::F1);
    assert!(shown(&mut window, KEYS).is_some(), "the keys are open, over the tubes");
    window.save("floating");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(shown(&mut window, KEYS).is_none(), "the keys were on top");
    assert!(shown(&mut window, TUBES).is_some(), "the tubes stay");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(shown(&mut window, TUBES).is_none(), "the tubes are closed");

    let studio = window.studio_mut();
    let tube = "tube of Vermilion";
    studio.tools.tube = 3;
    window.harness().get_by_label(tube).click_secondary();
    window.harness().run_ok();
    window.click("Exchange in the painting...");
    assert!(shown(&mut window, EXCHANGE).is_some(), "the exchange is open");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(shown(&mut window, EXCHANGE).is_none(), "the exchange is closed");
}

#[test]
fn escape_closes_the_windows_of_the_pen_and_of_own_brushes() {
    let mut window = Window::open("floating-pen");
    let open = |window: &Window| [window.studio().visible.pen, window.studio().visible.brush_sets];
    window.studio_mut().visible.pen = true;
    window.harness().run_ok();
    window.studio_mut().visible.brush_sets = true;
    window.settle();
    window.key(Modifiers::NONE, Key::F1);
    assert!(shown(&mut window, KEYS).is_some(), "the keys lie over both");
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!((shown(&mut window, KEYS), open(&window)), (None, [true, true]), "the keys first");
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!(open(&window), [true, false], "the own brushes were opened after the pen");
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!(open(&window), [false, false]);
}

#[test]
fn the_windows_of_the_pen_and_of_own_brushes_stay_off_the_menus_and_close_them() {
    let mut window = Window::open("floating-pen-menus");
    for (opens, field) in [(true, "Clear"), (false, "Keep brush")] {
        window.click("File");
        assert!(is_listed(&mut window), "the menu is open");
        let visible = &mut window.studio_mut().visible;
        (visible.pen, visible.brush_sets) = (opens, !opens);
        window.settle();
        assert!(!is_listed(&mut window), "{field}: the window closed the menu");
        let bar = window.harness().get_by_role_and_label(Role::Button, "File").rect();
        let rect = shown(&mut window, field).unwrap();
        assert!(rect.top() > bar.bottom() + 20.0, "{field}: {rect} is below the menu bar");
    }
}

#[test]
fn escape_in_the_name_of_a_set_leaves_the_window_open() {
    let mut window = Window::open("floating-name");
    window.studio_mut().visible.brush_sets = true;
    window.settle();
    window.click("New set");
    assert!(shown(&mut window, "Name of the set").is_some(), "a name is typed");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(shown(&mut window, "Name of the set").is_none(), "Escape cancels the name");
    assert!(window.studio().visible.brush_sets, "and closes nothing");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!window.studio().visible.brush_sets, "the second one closes the window");
}

/// Whether the menu of files is open. The list of keys has lines of that name, but no buttons.
fn is_listed(window: &mut Window) -> bool {
    window.harness().query_by_role_and_label(Role::Button, "Save recording...").is_some()
}

/// Clicks a menu of the bar; the list of keys has headings of that name.
fn click_menu(window: &mut Window, name: &str) {
    window.harness().get_by_role_and_label(Role::Button, name).click();
    window.harness().step();
    window.harness().run_ok();
}

#[test]
fn a_window_leaves_the_menus_free_and_closes_the_one_that_is_open() {
    let mut window = Window::open("floating-menus");
    window.click("File");
    assert!(is_listed(&mut window), "the menu is open");
    // Escape belongs to the menu.
    window.click("Tubes...");
    window.key(Modifiers::NONE, Key::F1);
    click_menu(&mut window, "File");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!is_listed(&mut window), "Escape closes the menu");
    assert!(shown(&mut window, KEYS).is_some(), "and only the menu");
    window.key(Modifiers::NONE, Key::Escape);
    click_menu(&mut window, "File");
    window.key(Modifiers::NONE, Key::F1);
    assert!(!is_listed(&mut window), "the keys closed the menu");
    let bar = window.harness().get_by_role_and_label(Role::Button, "File").rect();
    let toolbar = window.harness().get_by_role_and_label(Role::Button, "Paint").rect();
    for label in ["Keys", "Choose tubes"] {
        // The last one is the title; the menus and buttons come before.
        let title = window.harness().get_all_by_label(label).last().unwrap().rect();
        assert!(title.top() > bar.bottom() && title.left() > toolbar.right(), "{label}: {title}");
    }
}

#[test]
fn a_stroke_beside_a_window_reaches_the_canvas() {
    let mut window = Window::open("floating-stroke");
    window.key(Modifiers::NONE, Key::F1);
    window.click("Tubes...");
    window.settle();
    let done = window.studio().painting().unwrap().history_done;
    let canvas = window.studio().canvas.rect();
    let right = window.point(SurfaceId::Canvas, 31.0, 10.0).min(canvas.right_bottom());
    let along: Vec<_> =
        (0..12).map(|at| right - eframe::egui::vec2(4.0 * at as f32, 0.0)).collect();
    window.pen_stroke(&along);
    window.settle();
    let painted = window.studio().painting().unwrap().history_done;
    assert_eq!(painted, done + 1, "the stroke was painted");
    // On the window itself nothing is painted.
    let inside = shown(&mut window, KEYS).unwrap().center();
    window.pen_stroke(&[inside, pos2(inside.x + 9.0, inside.y)]);
    window.settle();
    assert_eq!(window.studio().painting().unwrap().history_done, painted, "the window is in front");
}
