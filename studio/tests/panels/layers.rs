//! Tests of the layer panel.

use eframe::egui::{accesskit::Role, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use render::paint::strokes::{Action, LayerRef};
use session::Command;
use studio::panels::Request;
use studio::panels::layers::Layers;

use super::fixture::{
    Fixture, assert_requests, click, click_row, is_disabled, painting, picture, show_panel,
};

fn layers() -> Harness<'static, Fixture<Layers>> {
    show_panel(Layers::default(), painting(), Layers::show)
}

fn act(action: Action) -> Request {
    Request::Worker(Command::Apply(action))
}

fn opacity(layer: usize, value: f64) -> Action {
    Action::Opacity { layer: LayerRef::Dry(layer), value }
}

#[test]
fn all_or_a_share_dries() {
    let mut harness = layers();
    harness.get_by_role_and_label(Role::Slider, "Share").set_value_accesskit(35.0);
    harness.run();
    click(&mut harness, "Dry share");
    click(&mut harness, "Dry all");
    let dry = |fraction| act(Action::Dry { fraction });
    assert_requests(&mut harness, &[dry(0.35), dry(1.0)]);
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
    let stiffness = |value| Request::Worker(Command::Adjust(Action::Stiffness { value }));
    let requests = std::mem::take(&mut harness.state_mut().requests);
    let [.., last, end] = &requests[..] else { panic!("it adjusts and ends: {requests:?}") };
    assert_eq!(format!("{last:?}"), format!("{:?}", stiffness(0.0)));
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
    let top = |label: &str| harness.get_by_label(label).rect().top();
    let order = [top("Wet"), top("Dry 2"), top("Dry 1")];
    assert!(order.is_sorted(), "{order:?}");
    assert_eq!(harness.query_all_by_label("0.12 mm, max 0.81 mm").count(), 2);
    assert_eq!(harness.query_all_by_label("covers 34 %").count(), 2);
}

#[test]
fn the_eye_hides_a_layer_and_restores_its_opacity() {
    let mut harness = layers();
    click(&mut harness, "visibility of dry layer 2");
    assert_requests(&mut harness, &[act(opacity(1, 0.0))]);
    harness.state_mut().painting.layers[1].opacity = 0.0;
    harness.run();
    click(&mut harness, "visibility of dry layer 2");
    assert_requests(&mut harness, &[act(opacity(1, 0.5))]);
    // A layer that was hidden before the panel saw it.
    harness.state_mut().painting.layers[0].opacity = 0.0;
    harness.run();
    click(&mut harness, "visibility of dry layer 1");
    assert_requests(&mut harness, &[act(opacity(0, 1.0))]);
}

#[test]
fn dragging_the_opacity_adjusts_and_ends_once() {
    let mut harness = layers();
    let rail = harness.get_by_role_and_label(Role::Slider, "opacity of dry layer 1").rect();
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
            Request::Worker(Command::Adjust(Action::Opacity {
                layer: LayerRef::Dry(0),
                value,
            })) => values.push(*value),
            other => panic!("not an adjustment of the lower layer: {other:?}"),
        }
    }
    assert!(values.is_sorted() && values[0] > 0.0 && values[2] < 4.0, "{values:?}");
    // While the worker lags, the slider shows the requested value and sends nothing
    // more.
    harness.drop_at(start + vec2(30.0, 0.0));
    harness.run();
    assert_requests(&mut harness, &[Request::Worker(Command::EndAdjustment)]);
    let shown = |harness: &Harness<'_, Fixture<Layers>>| {
        let slider = harness.get_by_role_and_label(Role::Slider, "opacity of dry layer 1");
        slider.accesskit_node().numeric_value().unwrap()
    };
    assert_eq!(shown(&harness), values[2]);
    harness.run_steps(90);
    assert_eq!(shown(&harness), 1.0, "the reported value is shown in the end");
    assert_requests(&mut harness, &[]);
}

#[test]
fn a_typed_opacity_is_one_action() {
    let mut harness = layers();
    let slider = harness.get_by_role_and_label(Role::Slider, "opacity of dry layer 2");
    slider.set_value_accesskit(2.5);
    harness.run();
    assert_requests(&mut harness, &[act(opacity(1, 2.5))]);
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
fn layers_of_equal_opacity_merge_downwards() {
    let mut harness = layers();
    assert!(is_disabled(&harness, "merge dry layer 1 down"), "there is none below");
    assert!(is_disabled(&harness, "merge dry layer 2 down"), "their opacities differ");
    harness.state_mut().painting.layers[1].opacity = 1.0;
    harness.run();
    click(&mut harness, "merge dry layer 2 down");
    assert_requests(&mut harness, &[act(Action::Merge { layer: 1 })]);
}

#[test]
fn a_hidden_layer_above_a_merge_keeps_its_opacity() {
    let mut harness = layers();
    let lowest = harness.state().painting.layers[0].clone();
    harness.state_mut().painting.layers.insert(0, lowest);
    harness.run();
    click(&mut harness, "visibility of dry layer 3");
    assert_requests(&mut harness, &[act(opacity(2, 0.0))]);
    harness.state_mut().painting.layers[2].opacity = 0.0;
    harness.run();
    click(&mut harness, "merge dry layer 2 down");
    harness.state_mut().painting.layers.remove(0);
    harness.run();
    harness.state_mut().requests.clear();
    click(&mut harness, "visibility of dry layer 2");
    assert_requests(&mut harness, &[act(opacity(1, 0.5))]);
}

#[test]
fn a_pigment_of_one_layer_is_exchanged() {
    let mut harness = layers();
    for (button, layer) in [
        ("exchange in dry layer 2", LayerRef::Dry(1)),
        ("exchange in the wet layer", LayerRef::Wet),
    ] {
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
    click(&mut harness, "exchange in dry layer 2");
    harness.state_mut().painting.layers.pop();
    harness.run();
    assert!(harness.query_by_label("Search").is_none(), "the layer is gone");
    assert_requests(&mut harness, &[]);
}

#[test]
fn layers_are_drawn() {
    let mut harness = layers();
    let Some(drawn) = picture(&mut harness, "layers") else { return };
    // Compare the colour at the centre of the thumbnail.
    let eye = harness.get_by_label("visibility of dry layer 2").rect();
    let at = drawn.get_pixel((eye.right() + 6.0 + 30.0) as u32, eye.center().y as u32).0;
    assert_eq!([at[1], at[2]], [90, 60], "{at:?}");
    click(&mut harness, "exchange in dry layer 2");
    picture(&mut harness, "layers-exchange");
}
