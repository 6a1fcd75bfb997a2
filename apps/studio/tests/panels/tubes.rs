//! Tests of the tube panel.

use eframe::egui::{Event, PointerButton, Pos2, accesskit::Role};
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
    harness.hover_at(from + eframe::egui::vec2(300.0, 300.0));
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
    let rows = |name: &str| harness.query_all_by_label(name).count();
    assert_eq!((rows("Cobalt Blue"), rows("Prussian Blue"), rows("Vermilion")), (1, 1, 0));
}

#[test]
fn a_pigment_is_exchanged_in_every_layer_where_possible() {
    let mut harness = tubes();
    let blue = harness.state().painting.library.find("Cobalt Blue").unwrap();
    // The upper dry layer already has the new pigment and stays unchanged.
    harness.state_mut().painting.layers[1].slots[7] = Some(blue);
    harness.get_by_label("tube of Ultramarine").click_secondary();
    harness.run();
    click(&mut harness, "Exchange in the painting...");
    click_row(&mut harness, "Cobalt Blue");
    let swap = |layer| {
        let [from, to] = ["Ultramarine", "Cobalt Blue"].map(str::to_owned);
        act(Action::Swap { layer, from, to })
    };
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
        let at = |share: f32| {
            let y = rect.top() + rect.height() * share;
            drawn.get_pixel(rect.center().x as u32, y as u32).0
        };
        let opaque = |[red, green, blue]: [u8; 3]| [red, green, blue, 255];
        let painting = &harness.state().painting;
        assert_eq!(at(0.28), opaque(painting.masstones[slot].unwrap()), "{name}");
        assert_eq!(at(0.49), opaque(painting.tints[slot].unwrap()), "{name} with white");
    }
    click(&mut harness, "Tubes...");
    picture(&mut harness, "tubes-chooser");
}
