//! Tests of the columns of panels: folding, moving, resizing, and what is remembered.

use eframe::egui::{Event, Pos2, Rect, pos2, vec2};
use egui_kittest::kittest::Queryable;
use studio::app::Tab;

use super::harness::{Window, button};

fn rect(window: &mut Window, label: &str) -> Rect {
    window.harness().get_by_label(label).rect()
}

fn is_shown(window: &mut Window, label: &str) -> bool {
    window.harness().query_by_label(label).is_some()
}

/// Drags from one point to another in five frames.
fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.frame(vec![Event::PointerMoved(from)]);
    window.frame(vec![button(from, true)]);
    for step in 1..=5 {
        window.frame(vec![Event::PointerMoved(from.lerp(to, step as f32 / 5.0))]);
    }
    window.save("docking-dragged");
    window.frame(vec![button(to, false)]);
    window.frame(Vec::new());
    window.harness().run_ok();
}

/// A window of 1440 x 1000 points, in which both groups are open.
fn tall(name: &'static str) -> Window {
    Window::sized(name, vec2(1440.0, 1000.0), 1.0)
}

#[test]
fn a_tab_is_dragged_to_the_other_side_and_remembered() {
    let mut window = tall("dragged-tab");
    let canvas = window.studio().canvas.rect();
    let tab = rect(&mut window, "Light").center();
    drag(&mut window, tab, pos2(60.0, 300.0));
    window.save("docking-left");
    let moved = rect(&mut window, "Light");
    assert!(moved.right() < 400.0, "the panel is at the left: {moved}");
    assert!(rect(&mut window, "Colour").left() > 1000.0, "the others stay");
    assert!(window.studio().canvas.rect().left() > canvas.left() + 200.0, "the canvas yields");
    // The arrangement is in the preferences, and another window starts with it.
    let kept = window.studio().files.preferences.arrangement.clone();
    let text = serde_json::to_string(&kept).unwrap();
    assert!(text.contains("light"), "{text}");
    let mut other = tall("remembered-tab");
    other.studio_mut().panels.arrange(&serde_json::from_str(&text).unwrap());
    other.harness().run_ok();
    assert_eq!(rect(&mut other, "Light"), moved);
}

#[test]
fn a_tab_is_dropped_among_the_tabs_of_another_group() {
    let mut window = tall("joined-tab");
    let tab = rect(&mut window, "Layers").center();
    let middle = rect(&mut window, "Light").center() + vec2(0.0, 150.0);
    drag(&mut window, tab, middle);
    window.save("docking-joined");
    let [layers, light] = ["Layers", "Light"].map(|label| rect(&mut window, label));
    assert!((layers.top() - light.top()).abs() < 30.0, "one group: {layers} {light}");
    assert!(is_shown(&mut window, "Dry all"), "the moved panel is shown");
}

#[test]
fn the_menu_of_a_header_moves_panels_without_a_pointer() {
    let mut window = tall("moved-by-menu");
    window.open_menu("Place of Light");
    window.save("docking-menu");
    window.click("To the other side");
    assert!(rect(&mut window, "Light").right() < 400.0, "it is at the left");
    window.open_menu("View");
    window.click("Standard layout");
    assert!(rect(&mut window, "Light").left() > 1000.0, "it is back");
    let kept = &window.studio().files.preferences.arrangement;
    assert_eq!(*kept, studio::arrangement::Arrangement::default());
}

#[test]
fn a_folded_panel_leaves_its_room_to_the_others() {
    let mut window = tall("folded");
    let before = rect(&mut window, "Light");
    window.click("Fold Brush");
    assert!(!is_shown(&mut window, "Rename"), "the brush panel is folded");
    assert!(rect(&mut window, "Light").top() < before.top() - 300.0, "the light moves up");
    window.save("docking-folded");
    window.click("Unfold Brush");
    assert!(is_shown(&mut window, "Rename"));
    assert_eq!(rect(&mut window, "Light"), before);
    window.click("Fold Light");
    window.click("History");
    assert!(is_shown(&mut window, "Memory allowed"), "a tab unfolds its group");
}

#[test]
fn in_a_low_window_the_panel_in_use_is_whole() {
    let mut window = Window::open("low");
    assert!(is_shown(&mut window, "Rename"), "the upper group is open");
    window.studio_mut().panels.select(Tab::Light);
    window.harness().run_ok();
    assert!(is_shown(&mut window, "Light direction"));
    window.save("docking-low");
    window.click("Brush");
    assert!(is_shown(&mut window, "Rename"));
}

#[test]
fn columns_and_the_palette_are_resized_at_their_edges() {
    let mut window = tall("resized");
    let edge = rect(&mut window, "Width of the right panels").center();
    drag(&mut window, edge, edge - vec2(100.0, 0.0));
    let width = window.studio().files.preferences.arrangement.right.width;
    assert!((width - 384.0).abs() < 2.0, "{width}");
    let palette = rect(&mut window, "Palette").height();
    let edge = rect(&mut window, "Height of the palette").center();
    drag(&mut window, edge, edge - vec2(0.0, 60.0));
    let higher = rect(&mut window, "Palette").height();
    assert!((higher - palette - 60.0).abs() < 2.0, "{palette} {higher}");
    let edge = rect(&mut window, "Height of Brush").center();
    let light = rect(&mut window, "Light").top();
    drag(&mut window, edge, edge + vec2(0.0, 50.0));
    let lower = rect(&mut window, "Light").top();
    assert!((lower - light - 50.0).abs() < 2.0, "{light} {lower}");
    assert!(window.studio().files.preferences.arrangement.right.groups[0].height.is_some());
    window.save("docking-resized");
}
