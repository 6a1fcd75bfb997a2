//! Tests of the window: layout, columns of panels, view, strokes and split view. If nothing
//! happens, the window draws no frames.

use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::Duration;

use eframe::egui::{
    Event as UiEvent, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, Rect,
    TouchPhase, Vec2, ViewportId, pos2, vec2,
};
use egui_kittest::kittest::Queryable;
use graphics::tile;
use paint::document::Lighting;
use paint::strokes::{Action, Load, MaskChange, SurfaceId};
use session::{Command, Event, TilePixels};
use studio::app::Tab;
use studio::panels::Mode;

use super::harness::button;
use crate::harness::Window;

/// A window with an injected painting: a ramp of greys on the canvas, wood on the
/// palette.
fn injected_window(name: &'static str, size: Vec2, density: f32) -> Window {
    let mut window = Window::without_waiting(name, size, density, Vec::new());
    let mut painting = crate::fixture::painting();
    painting.canvas_cells = (1920, 1080);
    painting.palette_cells = (640, 420);
    let studio = window.studio_mut();
    studio.handle_event(Event::Opened(Arc::new(painting)));
    for (surface, width, height) in
        [(SurfaceId::Canvas, 1920, 1080), (SurfaceId::Palette, 640, 420)]
    {
        let rect = tile::Rect { x: 0, y: 0, width, height };
        let pixels = (0..width * height)
            .map(|at| match surface {
                SurfaceId::Canvas => {
                    [235 - ((at % width) / 96) as u8, 232 - ((at % width) / 96) as u8, 224, 255]
                }
                SurfaceId::Palette => [120 + ((at % width) % 23) as u8, 84, 52, 255],
            })
            .collect();
        let tiles = vec![TilePixels { rect, pixels }];
        studio.handle_event(Event::Tiles { surface, second: false, tiles, newest: None });
    }
    window.harness().run_ok();
    window
}

#[test]
fn all_controls_are_within_the_window() {
    for (size, density) in
        [(vec2(1280.0, 800.0), 1.0), (vec2(1920.0, 1080.0), 1.0), (vec2(1280.0, 800.0), 2.0)]
    {
        let mut window = injected_window("layout", size, density);
        window.save(&format!("layout-{}-{density}", size.x));
        let whole = window.whole();
        for label in ["File", "Canvas", "Palette", "Paint", "Whole canvas", "tube of Vermilion"] {
            let rect = window.harness().get_by_label(label).rect();
            assert!(whole.contains_rect(rect), "{label} at {rect} of {whole}");
        }
    }
}

#[test]
fn keys_change_the_view_except_while_typing() {
    let mut window = injected_window("keys", vec2(1280.0, 800.0), 1.0);
    window.key(Modifiers::NONE, Key::M);
    assert!(window.studio().canvas.view.mirror, "M mirrors");
    window.key(Modifiers::COMMAND, Key::Num1);
    assert_eq!(window.studio().canvas.view.zoom, 1.0);
    window.key(Modifiers::COMMAND, Key::CloseBracket);
    let turned = window.studio().canvas.view.rotation;
    assert!((turned - (-15_f64).to_radians().rem_euclid(TAU)).abs() < 1e-9, "{turned}");
    window.key(Modifiers::NONE, Key::Home);
    let view = window.studio().canvas.view;
    assert!(view.fitted && view.rotation == 0.0 && !view.mirror, "{view:?}");
    window.key(Modifiers::NONE, Key::F12);
    assert!(window.studio().tools.figures, "F12 shows the figures");
    window.click("Rename");
    window.harness().run_ok();
    window.key(Modifiers::NONE, Key::M);
    window.key(Modifiers::NONE, Key::F12);
    assert!(!window.studio().canvas.view.mirror, "typed text is not a shortcut");
    window.key(Modifiers::NONE, Key::Escape);
    window.key(Modifiers::NONE, Key::M);
    assert!(window.studio().canvas.view.mirror, "typing has ended");
}

#[test]
fn tab_hides_all_panels_and_enlarges_the_canvas() {
    let mut window = injected_window("hidden", vec2(1280.0, 800.0), 1.0);
    let before = window.studio().canvas.rect();
    window.key(Modifiers::NONE, Key::Tab);
    window.save("hidden");
    assert_eq!(window.studio().canvas.rect(), window.whole());
    assert!(window.harness().query_by_label("File").is_none(), "the menus are hidden");
    assert!(window.harness().query_by_label("Palette").is_none(), "the palette is hidden");
    window.key(Modifiers::NONE, Key::Tab);
    assert_eq!(window.studio().canvas.rect(), before);
    window.key(Modifiers::NONE, Key::P);
    assert!(
        window.studio().canvas.rect().height() > before.height(),
        "hiding the palette enlarges the canvas"
    );
}

#[test]
fn the_view_follows_drag_wheel_and_held_keys() {
    let mut window = injected_window("hand", vec2(1280.0, 800.0), 1.0);
    let middle = window.studio().canvas.rect().center();
    let cell = |window: &Window, at| window.studio().canvas.placement().cell(at);
    let drag = |window: &mut Window, button: PointerButton, by: Vec2| {
        let press = |pos: Pos2, pressed: bool| {
            let modifiers = Modifiers::NONE;
            UiEvent::PointerButton { pos, button, pressed, modifiers }
        };
        window.frame(vec![UiEvent::PointerMoved(middle)]);
        window.frame(vec![press(middle, true)]);
        window.frame(vec![UiEvent::PointerMoved(middle + 0.5 * by)]);
        window.frame(vec![UiEvent::PointerMoved(middle + by)]);
        window.frame(vec![press(middle + by, false)]);
    };
    let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1.0;

    let held = cell(&window, middle);
    drag(&mut window, PointerButton::Middle, vec2(60.0, -25.0));
    assert!(near(cell(&window, middle + vec2(60.0, -25.0)), held), "the middle button moves");

    window.harness().key_down(Key::Space);
    window.harness().step();
    let held = cell(&window, middle);
    drag(&mut window, PointerButton::Primary, vec2(-40.0, 30.0));
    assert!(near(cell(&window, middle + vec2(-40.0, 30.0)), held), "space and drag move");
    window.harness().key_up(Key::Space);
    window.harness().step();

    // If you use a tool while you hold its key, the previous tool returns when you release it.
    window.harness().key_down(Key::Z);
    window.harness().step();
    assert_eq!(window.studio().tools.mode, Mode::Zoom);
    let zoom = window.studio().canvas.view.zoom;
    drag(&mut window, PointerButton::Primary, vec2(0.0, -60.0));
    assert!(window.studio().canvas.view.zoom > 1.2 * zoom, "dragging up zooms in");
    window.harness().key_up(Key::Z);
    window.harness().step();
    assert_eq!(window.studio().tools.mode, Mode::Paint);
    // If you press the key shortly, the tool stays.
    window.key(Modifiers::NONE, Key::I);
    assert_eq!(window.studio().tools.mode, Mode::Pick);

    let pointer = middle + vec2(100.0, 50.0);
    window.frame(vec![UiEvent::PointerMoved(pointer)]);
    let held = cell(&window, pointer);
    let zoom = window.studio().canvas.view.zoom;
    window.frame(vec![UiEvent::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: vec2(0.0, 2.0),
        phase: TouchPhase::Move,
        source: MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    }]);
    window.harness().run_steps(30);
    assert!(window.studio().canvas.view.zoom > 1.1 * zoom, "the wheel zooms");
    assert!(near(cell(&window, pointer), held), "the cell under the pointer is kept");
}

#[test]
fn the_hovering_head_is_an_outline_around_the_pointer() {
    let mut window = injected_window("head", vec2(1280.0, 800.0), 1.0);
    for (turn, mirror) in [(0.0, false), (1.0, true)] {
        window.studio_mut().canvas.view.rotation = turn;
        window.studio_mut().canvas.view.mirror = mirror;
        window.harness().run_ok();
        let at = window.point(SurfaceId::Canvas, 96.0, 54.0);
        let before = window.picture();
        window.frame(vec![UiEvent::PointerMoved(at)]);
        window.frame(Vec::new());
        let (Some(before), Some(after)) = (before, window.picture()) else { return };
        window.save(&format!("head-{turn}"));
        let changed =
            |offset: Vec2| window.color(&before, at + offset) != window.color(&after, at + offset);
        let around = (0..360).map(|degrees| Vec2::angled((degrees as f32).to_radians()));
        let directions: Vec<Vec2> = around.collect();
        let ringed = directions.iter().all(|way| (4..48).any(|far| changed(*way * far as f32)));
        assert!(ringed, "the outline goes around the pointer");
        assert!(!changed(Vec2::ZERO), "its place is free");
        assert!(!changed(vec2(-60.0, -60.0)), "nothing else is drawn");
        window.frame(vec![UiEvent::PointerMoved(pos2(1200.0, 300.0))]);
        window.frame(Vec::new());
        let gone = window.picture().unwrap();
        assert_eq!(window.color(&gone, at), window.color(&before, at), "the cursor is gone");
    }
}

/// A window on linen with the rigger selected and loaded with vermilion.
fn loaded(name: &'static str) -> Window {
    let mut window = Window::open(name);
    window.studio_mut().tools.brush = "rigger".to_owned();
    let paint = Load {
        brush: "rigger".to_owned(),
        recipe: [("Vermilion".to_owned(), 1.0)].into(),
        vehicle: 0.1,
        amount_mm: 0.4,
    };
    window.studio_mut().ask(Command::Apply(Action::Load(paint)));
    window.settle();
    window
}

fn stroke(window: &mut Window) {
    let along: Vec<Pos2> = (0..=40)
        .map(|at| window.point(SurfaceId::Canvas, 8.0 + 0.4 * f64::from(at), 10.0))
        .collect();
    window.pen_stroke(&along);
    window.settle();
}

/// Mean colour of the canvas view within 0.5 mm of a position.
fn seen(window: &Window, second: bool, x_mm: f64, y_mm: f64) -> [i64; 3] {
    let x = (x_mm / 0.1) as usize - 5;
    let y = (y_mm / 0.1) as usize - 5;
    let rect = tile::Rect { x, y, width: 10, height: 10 };
    let cells = window.studio().canvas.picture(second).unwrap().pixels(rect).pixels;
    [0, 1, 2].map(|channel: usize| {
        let sum: i64 = cells.iter().map(|cell| i64::from(cell.to_array()[channel])).sum();
        sum / cells.len() as i64
    })
}

#[test]
fn a_stroke_lands_at_the_pointer_at_any_rotation() {
    for (turn, mirror) in [(0.0, false), (1.1, false), (2.4, true)] {
        let mut window = loaded("stroke");
        window.studio_mut().canvas.view.rotation = turn;
        window.studio_mut().canvas.view.mirror = mirror;
        window.harness().run_ok();
        let places = [(16.0, 10.0), (16.0, 5.0), (16.0, 15.0), (4.0, 10.0), (28.0, 10.0)];
        let before = places.map(|(x, y)| seen(&window, false, x, y));
        stroke(&mut window);
        let after = places.map(|(x, y)| seen(&window, false, x, y));
        // The pressure of a mouse stroke depends on the speed of the machine.
        let [bare, red] = [before[0], after[0]].map(|[red, green, _]| red - green);
        assert!(red > bare + 6, "{after:?} in the middle, {turn}");
        assert_eq!(before[1..], after[1..], "beside the stroke, {turn}");
        window.save(&format!("stroke-{turn}"));
        let Some(picture) = window.picture() else { continue };
        let reddest = (-8..8).map(|step| {
            let at = window.point(SurfaceId::Canvas, 16.0, 10.0 + 0.1 * f64::from(step));
            let [red, green, _] = window.color(&picture, at);
            i64::from(red) - i64::from(green)
        });
        assert!(reddest.max().unwrap() > 20, "on the screen, {turn}");
    }
}

#[test]
fn keys_undo_dry_and_select_brushes() {
    let mut window = loaded("history");
    let bare = seen(&window, false, 16.0, 10.0);
    stroke(&mut window);
    let done = window.studio().painting().unwrap().history_done;
    let painted = seen(&window, false, 16.0, 10.0);
    assert_ne!(bare, painted);
    window.key(Modifiers::COMMAND, Key::Z);
    window.settle();
    assert_eq!(window.studio().painting().unwrap().history_done, done - 1);
    assert_eq!(seen(&window, false, 16.0, 10.0), bare, "after undo");
    let held = Modifiers { shift: true, ..Modifiers::COMMAND };
    window.key(held, Key::Z);
    window.settle();
    assert_eq!(seen(&window, false, 16.0, 10.0), painted, "after redo");
    window.key(Modifiers::NONE, Key::D);
    window.settle();
    assert_eq!(window.studio().painting().unwrap().layers.len(), 1, "D dries");
    let brush = window.studio().tools.brush.clone();
    window.key(Modifiers::NONE, Key::Num1);
    assert_ne!(window.studio().tools.brush, brush, "1 takes another brush");
}

#[test]
fn the_second_light_is_shown_right_of_a_draggable_line() {
    let mut window = loaded("split");
    stroke(&mut window);
    let second = Lighting { illuminant: "A".to_owned(), ..Lighting::default() };
    window.studio_mut().ask(Command::SetSecondLight(Some(second)));
    window.settle();
    assert_ne!(seen(&window, false, 20.0, 10.0), seen(&window, true, 20.0, 10.0));
    let knob = window.studio().canvas.split_handle().unwrap().center();
    let done = window.studio().painting().unwrap().history_done;
    let to = knob + vec2(120.0, 0.0);
    window.pen_stroke(&[knob, knob + vec2(60.0, 0.0), to, to]);
    window.settle();
    assert_eq!(window.studio().painting().unwrap().history_done, done, "the drag does not paint");
    let wanted = window.studio().canvas.placement().cell(to)[0] / 320.0;
    assert!((f64::from(window.studio().tools.split) - wanted).abs() < 0.02, "{wanted}");
    window.save("split");
    window.key(Modifiers::COMMAND, Key::Num1);
    // The brush and its shadow lie over the picture.
    window.frame(vec![eframe::egui::Event::PointerGone]);
    let Some(picture) = window.picture() else { return };
    // At one cell per pixel, each pixel shows the picture of its side.
    for (x, second) in [(120, false), (310, true)] {
        let mut differ = 0;
        for y in 80..120 {
            let cell = tile::Rect { x, y, width: 1, height: 1 };
            let reported = [false, true].map(|second| {
                let view = &window.studio().canvas;
                let [red, green, blue, _] =
                    view.picture(second).unwrap().pixels(cell).pixels[0].to_array();
                [red, green, blue]
            });
            let at = window.studio().canvas.placement().point([x as f64 + 0.5, y as f64 + 0.5]);
            assert_eq!(window.color(&picture, at), reported[usize::from(second)], "cell {x} {y}");
            differ += usize::from(reported[0] != reported[1]);
        }
        assert!(differ > 0, "the lights differ in column {x}");
    }
}

fn rect(window: &mut Window, label: &str) -> Rect {
    window.harness().get_by_label(label).rect()
}

fn is_shown(window: &mut Window, label: &str) -> bool {
    window.harness().query_by_label(label).is_some()
}

fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.frame(vec![UiEvent::PointerMoved(from)]);
    window.frame(vec![button(from, true)]);
    for step in 1..=5 {
        window.frame(vec![UiEvent::PointerMoved(from.lerp(to, step as f32 / 5.0))]);
    }
    window.save("docking-dragged");
    window.frame(vec![button(to, false)]);
    window.frame(Vec::new());
    window.harness().run_ok();
}

/// A window of 1440 x 1000 points, with both groups open.
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
    // The preferences keep the arrangement, and another window starts with it.
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

/// Delay until the next frame that the window asks for.
fn next_frame(window: &mut Window) -> Duration {
    window.harness().output().viewport_output[&ViewportId::ROOT].repaint_delay
}

/// Draws frames for this many seconds of the window's clock.
fn pass(window: &mut Window, seconds: usize) {
    window.harness().run_steps(60 * seconds);
}

#[test]
fn a_window_at_rest_waits_for_its_painter() {
    let mut window = Window::open("idle");
    pass(&mut window, 1);
    let next = next_frame(&mut window);
    assert!(next > Duration::from_secs(2), "{next:?}");
}

#[test]
fn the_dashes_of_a_mask_stand_still_when_nothing_happens() {
    let mut window = Window::open("idle-mask");
    let square = vec![[8.0, 5.0], [24.0, 5.0], [24.0, 15.0], [8.0, 15.0]];
    let mask = Action::Mask(MaskChange::PolygonMm(square));
    window.studio_mut().ask(Command::Apply(mask));
    window.settle();
    assert!(window.studio().painting().unwrap().mask.is_some(), "there is a mask");
    let at = window.studio().canvas.rect().center();
    window.frame(vec![eframe::egui::Event::PointerMoved(at)]);
    window.frame(Vec::new());
    let moving = next_frame(&mut window);
    assert!(moving <= Duration::from_millis(120), "they move after input: {moving:?}");
    pass(&mut window, 5);
    let still = next_frame(&mut window);
    assert!(still > Duration::from_secs(2), "they stand still: {still:?}");
}

#[test]
fn a_message_asks_for_one_frame_when_it_is_to_go() {
    let mut window = Window::open("idle-message");
    let text = "nothing to scrape".to_owned();
    let hint = None;
    window.studio_mut().handle_event(Event::Message { text, hint, failed: false });
    pass(&mut window, 1);
    let next = next_frame(&mut window);
    let wanted = Duration::from_secs(2)..=Duration::from_secs(10);
    assert!(wanted.contains(&next), "one frame for its end, none before: {next:?}");
}
