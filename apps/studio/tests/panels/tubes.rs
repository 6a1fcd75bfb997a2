//! Tests of the tube panel and the quick palette.

use std::time::Duration;

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use paint::document::LayerId;
use paint::strokes::{Action, LayerRef, Load, PaletteSpec, Recipe, Squeeze, SurfaceId};
use pigment::palette::{Cards, Palette as Mixable};
use session::Command;
use studio::panels::tubes::{DraggedTube, Tubes, squeeze};
use studio::panels::{FileRequest, Mode, Request};

use super::fixture::{
    Fixture, PIGMENTS, assert_requests, click, click_row, is_disabled, painting, picture,
    show_panel,
};
use crate::harness::{Window, button};

fn tubes() -> Harness<'static, Fixture<Tubes>> {
    show_panel(Tubes::default(), painting(), Tubes::show)
}

fn act(action: Action) -> Request {
    Request::Worker(Command::Apply(action))
}

fn pure(name: &str) -> Recipe {
    Recipe::from([(name.to_owned(), 1.0)])
}

fn of(name: &str) -> Load {
    let brush = "round".to_owned();
    let recipe = pure(name);
    Load { brush, recipe, vehicle: 0.15, amount_mm: 0.3 }
}

fn load(name: &str) -> Request {
    act(Action::Load(of(name)))
}

#[test]
fn a_click_selects_a_tube_and_sends_nothing() {
    let mut harness = tubes();
    click(&mut harness, "tube of Vermilion");
    assert_eq!((harness.state().tools.tube, harness.state().tools.mode), (2, Mode::Squeeze));
    assert_requests(&mut harness, &[]);
    click(&mut harness, "Squeeze");
    assert_eq!(harness.state().tools.mode, Mode::Squeeze, "the tube squeezes already");
}

#[test]
fn a_double_click_or_the_button_loads_the_selected_brush() {
    let mut harness = tubes();
    let tube = harness.get_by_label("tube of Ultramarine");
    tube.click();
    tube.click();
    harness.run();
    assert_requests(&mut harness, &[load("Ultramarine")]);
    assert_eq!((harness.state().tools.tube, harness.state().tools.mode), (4, Mode::Paint));
    click(&mut harness, "Load brush");
    assert_requests(&mut harness, &[load("Ultramarine")]);
}

#[test]
fn a_load_is_cut_to_what_the_brush_can_still_take() {
    let mut harness = tubes();
    harness.state_mut().tools.load_mm = 2.0;
    click(&mut harness, "tube of Ultramarine");
    click(&mut harness, "Load brush");
    let sent = Load { amount_mm: 1.5, ..of("Ultramarine") };
    assert_requests(&mut harness, &[act(Action::Load(sent))]);
}

#[test]
fn squeezing_uses_the_slider_amount_at_the_given_position() {
    let mut harness = tubes();
    let slider = harness.get_by_role_and_label(Role::Slider, "Amount");
    slider.set_value_accesskit(125.0);
    harness.run();
    let table = harness.state_mut();
    table.with_panel(|_, cx| squeeze(cx, 3, SurfaceId::Palette, 4.5, 7.25));
    table.with_panel(|_, cx| squeeze(cx, 7, SurfaceId::Palette, 4.5, 7.25));
    let heap = Squeeze {
        on: SurfaceId::Palette,
        recipe: pure("Eosin Lake"),
        vehicle: 0.0,
        x_mm: 4.5,
        y_mm: 7.25,
        volume_mm3: 125.0,
    };
    assert_requests(&mut harness, &[act(Action::Squeeze(heap))]);
}

#[test]
fn a_dragged_tube_carries_its_slot() {
    let mut harness = tubes();
    let from = harness.get_by_label("tube of Chrome Yellow").rect().center();
    harness.hover_at(from);
    harness.drag_at(from);
    harness.step();
    harness.hover_at(from + vec2(300.0, 300.0));
    harness.run_steps(3);
    let dragged = eframe::egui::DragAndDrop::payload::<DraggedTube>(&harness.ctx);
    assert_eq!(dragged.as_deref(), Some(&DraggedTube { slot: 1 }));
    harness.drop_at(Pos2::new(400.0, 400.0));
    harness.run();
    assert_eq!(harness.state().tools.tube, 1);
    assert_requests(&mut harness, &[]);
}

#[test]
fn a_new_pigment_replaces_one_slot_only() {
    let mut harness = tubes();
    click(&mut harness, "Tubes...");
    click(&mut harness, "slot 5");
    click_row(&mut harness, "Prussian Blue");
    let mut names = PIGMENTS;
    names[4] = "Prussian Blue";
    assert_requests(&mut harness, &[act(Action::Palette(PaletteSpec::from_names(names)))]);

    assert!(is_disabled(&harness, "Vermilion"), "it is already on the palette");
    click(&mut harness, "slot 8");
    assert!(is_disabled(&harness, "Take off"), "slot 8 is empty");
    click_row(&mut harness, "Cobalt Blue");
    let names = PIGMENTS.into_iter().chain(["Cobalt Blue"]);
    assert_requests(&mut harness, &[act(Action::Palette(PaletteSpec::from_names(names)))]);

    click(&mut harness, "slot 1");
    click(&mut harness, "Take off");
    assert_requests(
        &mut harness,
        &[act(Action::Palette(PaletteSpec::from_names(PIGMENTS.into_iter().skip(1))))],
    );
    click(&mut harness, "Open another library...");
    assert_requests(&mut harness, &[Request::File(FileRequest::Open(None))]);
}

#[test]
fn searching_lists_only_matching_pigments() {
    let mut harness = tubes();
    click(&mut harness, "empty slot 8");
    click(&mut harness, "Search");
    harness.event(Event::Text("BLUE".to_owned()));
    harness.run();
    let rows = ["Cobalt Blue", "Prussian Blue", "Vermilion"]
        .map(|name| harness.query_all_by_label(name).count());
    assert_eq!(rows, [1, 1, 0]);
}

#[test]
fn a_pigment_is_exchanged_in_every_layer_where_possible() {
    let mut harness = tubes();
    let blue = harness.state().painting.library.find("Cobalt Blue").unwrap();
    // The upper dry layer already has the new pigment, so it stays unchanged.
    harness.state_mut().painting.layers[1].slots[7] = Some(blue);
    harness.get_by_label("tube of Ultramarine").click_secondary();
    harness.run();
    click(&mut harness, "Exchange in the painting...");
    click_row(&mut harness, "Cobalt Blue");
    fn swap(layer: LayerRef) -> Request {
        let [from, to] = ["Ultramarine", "Cobalt Blue"].map(str::to_owned);
        act(Action::Swap { layer, from, to })
    }
    assert_requests(&mut harness, &[swap(LayerRef::Id(LayerId(1))), swap(LayerRef::Wet)]);
    assert!(harness.query_by_label("Search").is_none(), "the window is closed");
}

#[test]
fn the_menu_of_a_tube_loads_squeezes_and_replaces() {
    let mut harness = tubes();
    let mut choose = |item: &str| {
        harness.get_by_label("tube of Viridian").click_button(PointerButton::Secondary);
        harness.run();
        click(&mut harness, item);
        std::mem::take(&mut harness.state_mut().requests)
    };
    let requests = choose("Load the brush");
    assert_eq!(format!("{requests:?}"), format!("{:?}", [load("Viridian")]));
    choose("Put another here...");
    assert!(harness.query_by_label("slot 6").is_some(), "the chooser is open");
    assert!(harness.query_by_label("Slot 6: Viridian").is_some(), "for this slot");
}

#[test]
fn without_a_brush_or_a_pigment_nothing_can_be_loaded() {
    let mut bare = painting();
    bare.brushes.clear();
    let mut harness = show_panel(Tubes::default(), bare, Tubes::show);
    assert!(is_disabled(&harness, "Load brush"), "there is no brush");
    harness.state_mut().painting = painting();
    harness.state_mut().tools.tube = 7;
    harness.run();
    assert!(is_disabled(&harness, "Load brush"), "slot 8 is empty");
    assert!(is_disabled(&harness, "Squeeze"), "slot 8 is empty");
}

#[test]
fn the_card_of_a_tube_shows_its_figures() {
    let mut harness = tubes();
    harness.get_by_label("tube of Zinc White").hover();
    // The tooltip appears after half a second.
    harness.run_steps(40);
    let painting = painting();
    let cards = Cards::standard(painting.library.grid);
    let palette = Mixable::new(&painting.library, &painting.light.viewing, cards).unwrap();
    let white = painting.slots[0].unwrap();
    let powers = pigment::palette::hiding_powers(&palette);
    let power = powers.iter().find(|power| power.paint == white).unwrap();
    let mm = power.hides.thickness().unwrap() / painting.medium.scattering_per_mm;
    assert!((0.1..0.9).contains(&mm), "{mm} mm, shown with two decimals");
    let text = format!("hides from {mm:.2} mm");
    assert!(harness.query_by_label(&text).is_some(), "{text}: {harness:?}");
    let curve = harness.query_by_label("reflectance over wavelength");
    assert!(curve.is_some_and(|curve| !curve.accesskit_node().is_hidden()), "a curve");
    picture(&mut harness, "tubes-card");
}

#[test]
fn tubes_show_the_colors_of_their_paint() {
    let mut harness = tubes();
    let drawn = picture(&mut harness, "tubes");
    for (slot, name) in PIGMENTS.into_iter().enumerate() {
        let Some(drawn) = &drawn else { return };
        let rect = harness.get_by_label(&format!("tube of {name}")).rect();
        let painting = &harness.state().painting;
        for (share, color) in [(0.28, painting.masstones[slot]), (0.49, painting.tints[slot])] {
            let y = rect.top() + rect.height() * share;
            let [red, green, blue] = color.unwrap();
            let pixel = drawn.get_pixel(rect.center().x as u32, y as u32).0;
            assert_eq!(pixel, [red, green, blue, 255], "{name} at {share}");
        }
    }
    click(&mut harness, "Tubes...");
    picture(&mut harness, "tubes-chooser");
}

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

/// Clicks at a point with the primary button.
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
    fn secondary(pos: Pos2, pressed: bool) -> Event {
        Event::PointerButton {
            pos,
            button: PointerButton::Secondary,
            pressed,
            modifiers: Modifiers::NONE,
        }
    }
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
    // After a short click it stays open for a second one.
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
    // The panel keeps it, writes it to the home folder, and offers it.
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
