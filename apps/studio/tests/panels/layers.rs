//! Tests of the layer panel and the history panel.

use eframe::egui::accesskit::{Role, Toggled};
use eframe::egui::{Key, Modifiers, Pos2, Theme, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use paint::document::LayerId;
use paint::strokes::{Action, LayerRef};
use session::{Command, PaintingState};
use studio::panels::Request;
use studio::panels::history::History;
use studio::panels::layers::Layers;
use studio::theme;

use super::fixture::{
    Fixture, assert_requests, click, click_row, is_disabled, painting, picture, show_panel,
};

type Panel = Harness<'static, Fixture<Layers>>;

fn layers() -> Panel {
    show_panel(Layers::default(), painting(), Layers::show)
}

fn three_layers() -> Panel {
    let mut painting = painting();
    let mut third = painting.layers[0].clone();
    third.id = LayerId(3);
    painting.layers.push(third);
    show_panel(Layers::default(), painting, Layers::show)
}

fn act(action: Action) -> Request {
    Request::Worker(Command::Apply(action))
}

fn id(number: u32) -> LayerRef {
    LayerRef::Id(LayerId(number))
}

fn opacity(layer: u32, value: f64) -> Action {
    Action::Opacity { layer: id(layer), value }
}

fn ctrl_click(harness: &mut Panel, label: &str) {
    harness.get_by_label(label).click_modifiers(Modifiers::COMMAND);
    harness.run();
}

/// A place in the row of a layer without a control: its name.
fn name_at(harness: &Panel, label: &str) -> Pos2 {
    harness.get_by_label(label).rect().left_center() + vec2(4.0, 0.0)
}

fn key(harness: &mut Panel, key: Key) {
    harness.key_press(key);
    harness.run();
}

#[test]
fn all_or_a_share_dries() {
    let mut harness = layers();
    harness.get_by_role_and_label(Role::Slider, "Share").set_value_accesskit(35.0);
    harness.run();
    click(&mut harness, "Dry share");
    click(&mut harness, "Dry all");
    let dried = [0.35, 1.0].map(|fraction| act(Action::Dry { fraction }));
    assert_requests(&mut harness, &dried);
}

#[test]
fn dragging_the_stiffness_adjusts_and_ends_once() {
    let mut harness = layers();
    let slider = harness.get_by_role_and_label(Role::Slider, "Stiffness");
    assert_eq!(slider.accesskit_node().numeric_value(), Some(0.7), "paint from the tube");
    let rail = slider.rect();
    harness.hover_at(rail.center());
    harness.drag_at(rail.center());
    harness.run();
    harness.hover_at(rail.left_center() - vec2(20.0, 0.0));
    harness.run();
    harness.drop_at(rail.left_center() - vec2(20.0, 0.0));
    harness.run();
    let soft = Request::Worker(Command::Adjust(Action::Stiffness { value: 0.0 }));
    let requests = std::mem::take(&mut harness.state_mut().requests);
    let [.., last, end] = &requests[..] else { panic!("it adjusts and ends: {requests:?}") };
    assert_eq!(format!("{last:?}"), format!("{soft:?}"));
    assert!(matches!(end, Request::Worker(Command::EndAdjustment)), "{end:?}");
    let slider = harness.get_by_role_and_label(Role::Slider, "Stiffness");
    assert_eq!(slider.accesskit_node().numeric_value(), Some(0.0), "shown before it is reported");
    slider.set_value_accesskit(0.4);
    harness.run();
    assert_requests(&mut harness, &[act(Action::Stiffness { value: 0.4 })]);
}

#[test]
fn layers_are_listed_from_the_top_with_their_figures() {
    let harness = layers();
    let order = ["Wet", "Layer 2", "Layer 1"].map(|label| harness.get_by_label(label).rect().top());
    assert!(order.is_sorted(), "{order:?}");
    assert_eq!(harness.query_all_by_label("0.12 mm, max 0.81 mm").count(), 2);
    assert_eq!(harness.query_all_by_label("covers 34 %").count(), 2);
}

#[test]
fn the_eye_hides_a_layer_and_leaves_its_opacity() {
    let mut harness = layers();
    click(&mut harness, "visibility of Layer 2");
    assert_requests(&mut harness, &[act(Action::Visible { layer: id(2), value: false })]);
    harness.state_mut().painting.layers[1].visible = false;
    harness.run();
    let slider = harness.get_by_role_and_label(Role::Slider, "opacity of Layer 2");
    assert_eq!(slider.accesskit_node().numeric_value(), Some(0.5), "its opacity stays");
    slider.set_value_accesskit(0.8);
    harness.run();
    assert_requests(&mut harness, &[act(opacity(2, 0.8))]);
    click(&mut harness, "visibility of Layer 2");
    assert_requests(&mut harness, &[act(Action::Visible { layer: id(2), value: true })]);
}

#[test]
fn dragging_the_opacity_adjusts_and_ends_once() {
    let mut harness = layers();
    let rail = harness.get_by_role_and_label(Role::Slider, "opacity of Layer 1").rect();
    let start = rail.left_center() + vec2(20.0, 0.0);
    harness.hover_at(start);
    harness.drag_at(start);
    harness.run();
    harness.hover_at(start + vec2(15.0, 0.0));
    harness.run();
    harness.hover_at(start + vec2(30.0, 0.0));
    harness.run();
    let adjusted = std::mem::take(&mut harness.state_mut().requests);
    assert_eq!(adjusted.len(), 3, "{adjusted:?}");
    let mut values = Vec::new();
    for request in &adjusted {
        match request {
            Request::Worker(Command::Adjust(Action::Opacity { layer, value }))
                if *layer == id(1) =>
            {
                values.push(*value);
            }
            other => panic!("not an adjustment of the lower layer: {other:?}"),
        }
    }
    assert!(values.is_sorted() && values[0] > 0.0 && values[2] < 4.0, "{values:?}");
    // While the worker lags, the slider shows the requested value and sends nothing more.
    harness.drop_at(start + vec2(30.0, 0.0));
    harness.run();
    assert_requests(&mut harness, &[Request::Worker(Command::EndAdjustment)]);
    fn shown(harness: &Panel) -> f64 {
        let slider = harness.get_by_role_and_label(Role::Slider, "opacity of Layer 1");
        slider.accesskit_node().numeric_value().unwrap()
    }
    assert_eq!(shown(&harness), values[2]);
    harness.run_steps(90);
    assert_eq!(shown(&harness), 1.0, "the reported value is shown in the end");
    assert_requests(&mut harness, &[]);
}

#[test]
fn a_typed_opacity_is_one_action_of_that_layer_wherever_it_lies() {
    let mut harness = layers();
    harness.state_mut().painting.layers.reverse();
    harness.run();
    let slider = harness.get_by_role_and_label(Role::Slider, "opacity of Layer 2");
    slider.set_value_accesskit(2.5);
    harness.run();
    assert_requests(&mut harness, &[act(opacity(2, 2.5))]);
}

#[test]
fn an_opacity_beyond_the_slider_is_not_changed() {
    let mut odd = painting();
    odd.layers[0].opacity = 17.123_456;
    odd.layers[1].opacity = 0.123_456;
    let mut harness = show_panel(Layers::default(), odd, Layers::show);
    harness.run_steps(3);
    assert_requests(&mut harness, &[]);
}

#[test]
fn a_name_is_edited_by_a_double_click_or_by_f2() {
    let mut harness = layers();
    let at = name_at(&harness, "Layer 2");
    harness.hover_at(at);
    for _ in 0..2 {
        harness.drag_at(at);
        harness.step();
        harness.drop_at(at);
        harness.step();
    }
    harness.run();
    harness.get_by_label("name of Layer 2").type_text(" sky ");
    harness.run();
    key(&mut harness, Key::Enter);
    let [sky, water] =
        ["sky", "water"].map(|name| act(Action::Name { layer: id(2), name: name.to_owned() }));
    assert_requests(&mut harness, &[sky]);
    harness.state_mut().painting.layers[1].name = "sky".to_owned();
    harness.run();
    // The double click also chose the layer, so F2 edits it again with its text selected.
    key(&mut harness, Key::F2);
    harness.get_by_label("name of sky").type_text("water");
    harness.run();
    key(&mut harness, Key::Enter);
    assert_requests(&mut harness, &[water]);
    key(&mut harness, Key::F2);
    harness.get_by_label("name of sky").type_text("x");
    harness.run();
    key(&mut harness, Key::Escape);
    assert_requests(&mut harness, &[]);
    assert!(harness.query_by_label("name of sky").is_none(), "the field is closed");
}

#[test]
fn the_menu_renames_moves_and_merges() {
    let mut harness = three_layers();
    let mut choose = |layer: &str, entry: &str| {
        click(&mut harness, &format!("menu of {layer}"));
        let disabled = is_disabled(&harness, entry);
        click(&mut harness, entry);
        harness.key_press(Key::Escape);
        harness.run();
        disabled.then(|| harness.state_mut().requests.clear());
        disabled
    };
    assert!(choose("Layer 3", "Move up"), "it is on top");
    assert!(choose("Layer 1", "Move down"), "it is the lowest");
    assert!(choose("Layer 1", "Merge down"), "there is none below");
    assert!(!choose("Layer 1", "Move up"), "two are above");
    assert!(!choose("Layer 3", "Move down"), "two are below");
    assert!(!choose("Layer 3", "Merge down"), "one is below");
    let [lowest, top] = [1, 3].map(|layer| act(Action::Order { layer: id(layer), to: 1 }));
    let merge = act(Action::Merge { layer: id(3), with: Some(id(2)) });
    assert_requests(&mut harness, &[lowest, top, merge]);
    harness.state_mut().painting.layers[1].visible = false;
    harness.run();
    click(&mut harness, "menu of Layer 3");
    assert!(is_disabled(&harness, "Merge down"), "the one below is hidden");
    click(&mut harness, "Rename (F2)");
    assert!(harness.query_by_label("name of Layer 3").is_some(), "the name is edited");
}

#[test]
fn a_row_is_dragged_to_another_place() {
    let mut harness = three_layers();
    let mut drag = |from: &str, to: Pos2, key: Option<Key>| {
        let at = name_at(&harness, from);
        harness.hover_at(at);
        harness.drag_at(at);
        harness.step();
        for step in 1..=4_u8 {
            harness.hover_at(at + (to - at) * f32::from(step) / 4.0);
            harness.step();
        }
        picture(&mut harness, "layers-drag");
        key.into_iter().for_each(|key| harness.key_press(key));
        harness.step();
        harness.drop_at(to);
        harness.run();
        format!("{:?}", std::mem::take(&mut harness.state_mut().requests))
    };
    let probe = three_layers();
    let [top, middle, low] = ["choose Layer 3", "choose Layer 2", "choose Layer 1"]
        .map(|label| probe.get_by_label(label).rect());
    let order = |layer, to| format!("{:?}", [act(Action::Order { layer: id(layer), to })]);
    assert_eq!(drag("Layer 3", low.center_bottom() - vec2(0.0, 2.0), None), order(3, 0));
    assert_eq!(drag("Layer 1", top.center_top() + vec2(0.0, 2.0), None), order(1, 2));
    assert_eq!(drag("Layer 1", middle.center_top() + vec2(0.0, 2.0), None), order(1, 1));
    let below = middle.center_top() + vec2(0.0, 2.0);
    assert_eq!(drag("Layer 3", below, None), "[]", "it lies there");
    assert_eq!(drag("Layer 3", low.center(), Some(Key::Escape)), "[]", "left");
}

#[test]
fn two_chosen_layers_merge() {
    let mut harness = three_layers();
    assert!(is_disabled(&harness, "Merge chosen"), "none is chosen");
    click(&mut harness, "choose Layer 1");
    assert!(is_disabled(&harness, "Merge chosen"), "one is chosen");
    ctrl_click(&mut harness, "choose Layer 3");
    fn chosen(harness: &Panel, label: &str) -> bool {
        harness.get_by_label(label).accesskit_node().toggled() == Some(true.into())
            || harness.get_by_label(label).accesskit_node().is_selected() == Some(true)
    }
    assert!(chosen(&harness, "choose Layer 1") && chosen(&harness, "choose Layer 3"));
    assert!(!chosen(&harness, "choose Layer 2"));
    click(&mut harness, "Merge chosen");
    let merge = act(Action::Merge { layer: id(1), with: Some(id(3)) });
    assert_requests(&mut harness, &[merge]);
    harness.state_mut().painting.layers[0].visible = false;
    harness.run();
    assert!(is_disabled(&harness, "Merge chosen"), "one of them is hidden");
    harness.state_mut().painting.layers.remove(0);
    harness.run();
    assert!(is_disabled(&harness, "Merge chosen"), "one of them is gone");
}

#[test]
fn a_pigment_of_one_layer_is_exchanged() {
    let mut harness = layers();
    click(&mut harness, "menu of Layer 2");
    for (button, layer) in
        [("Exchange pigment...", id(2)), ("exchange in the wet layer", LayerRef::Wet)]
    {
        click(&mut harness, button);
        assert!(is_disabled(&harness, "Vermilion"), "the layer has it already");
        click_row(&mut harness, "Lead White");
        let [from, to] = ["Zinc White", "Lead White"].map(str::to_owned);
        assert_requests(&mut harness, &[act(Action::Swap { layer, from, to })]);
    }
}

#[test]
fn the_exchange_window_closes_when_its_layer_disappears() {
    let mut harness = layers();
    click(&mut harness, "menu of Layer 2");
    click(&mut harness, "Exchange pigment...");
    assert!(harness.query_by_label("Search").is_some(), "the window is open");
    harness.state_mut().painting.layers.pop();
    harness.run();
    assert!(harness.query_by_label("Search").is_none(), "the layer is gone");
    assert_requests(&mut harness, &[]);
}

#[test]
fn a_long_name_is_shown_whole() {
    let mut harness = three_layers();
    let name = "the second glaze over the sea, thin, with the poppies and the far hills in it";
    harness.state_mut().painting.layers[1].name = name.to_owned();
    harness.run();
    let shown = harness.get_by_label(name).rect();
    let menu = harness.get_by_label(&format!("menu of {name}")).rect();
    assert!(shown.right() <= menu.left(), "{shown} {menu}");
    assert!(shown.height() > 30.0, "on several lines: {shown}");
    let rows = ["choose Layer 3", "choose Layer 1"].map(|row| harness.get_by_label(row).rect());
    assert_eq!(rows[0].width(), rows[1].width(), "no row widens the panel");
    assert!(rows[0].right() <= theme::PANEL_WIDTH, "within the panel: {:?}", rows[0]);
    picture(&mut harness, "layers-long-name");
}

#[test]
fn layers_are_drawn() {
    let mut harness = layers();
    let Some(drawn) = picture(&mut harness, "layers") else { return };
    // Compare the colour at the centre of the thumbnail.
    let eye = harness.get_by_label("visibility of Layer 2").rect();
    let at = drawn.get_pixel((eye.right() + 6.0 + 30.0) as u32, (eye.top() + 22.0) as u32).0;
    assert_eq!([at[1], at[2]], [90, 60], "{at:?}");
    click(&mut harness, "menu of Layer 2");
    picture(&mut harness, "layers-menu");
    harness.key_press(Key::Escape);
    click(&mut harness, "choose Layer 1");
    harness.state_mut().painting.layers[1].visible = false;
    for (theme, name) in [(Theme::Light, "layers-light"), (Theme::Dark, "layers-chosen")] {
        harness.ctx.set_theme(theme);
        harness.run();
        picture(&mut harness, name);
    }
    click(&mut harness, "menu of Layer 2");
    click(&mut harness, "Exchange pigment...");
    picture(&mut harness, "layers-exchange");
}

fn history(painting: PaintingState) -> Harness<'static, Fixture<History>> {
    show_panel(History::default(), painting, History::show)
}

fn travel(place: usize) -> Request {
    Request::Worker(Command::GoTo(place))
}

#[test]
fn a_click_goes_to_an_entry_except_the_current_one() {
    let mut harness = history(painting());
    click(&mut harness, "1 load round");
    click(&mut harness, "0 beginning");
    click(&mut harness, "4 stroke, flat");
    click(&mut harness, "3 dry 50 %");
    assert_requests(&mut harness, &[travel(1), travel(0), travel(4)]);
    let chosen = ["3 dry 50 %", "2 stroke, round"]
        .map(|label| harness.get_by_label(label).accesskit_node().toggled());
    assert_eq!(chosen, [Some(Toggled::True), Some(Toggled::False)]);
}

#[test]
fn undo_and_redo_request_one_step_and_are_disabled_at_the_ends() {
    let mut harness = history(painting());
    click(&mut harness, "Undo");
    click(&mut harness, "Redo");
    let steps =
        [Action::Undo {}, Action::Redo {}].map(|action| Request::Worker(Command::Apply(action)));
    assert_requests(&mut harness, &steps);

    harness.state_mut().painting.history_done = 4;
    harness.run();
    assert!(is_disabled(&harness, "Redo") && !is_disabled(&harness, "Undo"), "all is done");
    harness.state_mut().painting.history_done = 0;
    harness.run();
    assert!(is_disabled(&harness, "Undo") && !is_disabled(&harness, "Redo"), "nothing is done");
    harness.state_mut().painting.history.clear();
    harness.run();
    assert!(is_disabled(&harness, "Undo") && is_disabled(&harness, "Redo"), "the history is empty");
}

#[test]
fn a_long_list_scrolls_to_the_current_entry() {
    let mut long = painting();
    long.history = (1..=2000).map(|number| format!("stroke {number}")).collect();
    long.history_done = 1500;
    let mut harness = history(long);
    fn there(harness: &Harness<'_, Fixture<History>>, place: usize) -> bool {
        harness.query_by_label(&format!("{place} stroke {place}")).is_some()
    }
    assert!(there(&harness, 1500), "the current entry is visible");
    assert!(!there(&harness, 1), "invisible rows are not laid out");
    harness.state_mut().painting.history_done = 40;
    harness.run();
    assert!(there(&harness, 40) && !there(&harness, 1500), "the list follows");
}

#[test]
fn the_list_follows_a_recording_that_is_played() {
    let mut harness = history(painting());
    harness.set_size(vec2(360.0, 260.0));
    for count in (0..=420).step_by(35) {
        let painting = &mut harness.state_mut().painting;
        painting.history = (1..=count).map(|number| format!("stroke {number}")).collect();
        painting.history_done = count;
        harness.step();
    }
    harness.run();
    let current = harness.get_by_label("420 stroke 420").rect();
    assert!(current.bottom() < 260.0, "{current}");
}

#[test]
fn the_current_entry_stays_in_sight_in_a_lower_list() {
    let mut long = painting();
    long.history = (1..=40).map(|number| format!("stroke {number}")).collect();
    long.history_done = 40;
    let mut harness = history(long);
    harness.set_size(vec2(760.0, 300.0));
    harness.run();
    let current = harness.get_by_label("40 stroke 40").rect();
    assert!(current.bottom() < 300.0, "{current}");
}

#[test]
fn memory_is_shown_in_mebibytes_and_can_be_changed() {
    let mut harness = history(painting());
    let bar = harness.get_by_label("Memory of undo");
    assert_eq!(bar.accesskit_node().numeric_value(), Some(18.0), "96 of 512 MiB, in percent");
    harness.get_by_label("Memory allowed").set_value_accesskit(1024.0);
    harness.run();
    assert_requests(&mut harness, &[Request::Worker(Command::SetUndoBytes(1 << 30))]);
}

#[test]
fn an_unusual_memory_limit_is_not_changed() {
    let mut odd = painting();
    odd.undo_bytes = (3, 7_654_321);
    let mut harness = history(odd);
    harness.run_steps(3);
    assert_requests(&mut harness, &[]);
}

#[test]
fn history_is_drawn() {
    let mut harness = history(painting());
    let Some(drawn) = picture(&mut harness, "history") else { return };
    let row = harness.get_by_label("3 dry 50 %").rect();
    let at = drawn.get_pixel(row.right() as u32 - 8, row.center().y as u32).0;
    let chosen = theme::DARK.chosen.to_array();
    assert_eq!(at, chosen, "the current entry is marked");
}

#[test]
fn rows_show_the_canvas_after_their_action_and_hovering_enlarges_it() {
    let mut harness = history(painting());
    assert!(harness.query_by_label("Pictures take 3.0 of 24 MiB").is_some());
    if let Some(drawn) = picture(&mut harness, "history-pictures") {
        let [stroke, dry] = ["2 stroke, round", "3 dry 50 %"].map(|row| {
            let rect = harness.get_by_label(row).rect();
            let at = drawn.get_pixel((rect.left() + 42.0) as u32, (rect.top() + 5.0) as u32).0;
            i32::from(at[0]) - i32::from(at[1])
        });
        // The third action has no picture, the others have one.
        assert!(stroke > 60, "{stroke}");
        assert!(dry.abs() < 10, "{dry}");
    }
    harness.get_by_label("2 stroke, round").hover();
    harness.run_steps(60);
    assert!(harness.query_by_label("The outline holds what the action changed.").is_some());
    picture(&mut harness, "history-enlarged");
    harness.get_by_label("0 beginning").hover();
    harness.run_steps(60);
    assert!(harness.query_by_label("The outline holds what the action changed.").is_none());
}
