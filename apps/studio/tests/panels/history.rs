//! Tests of the history panel.

use eframe::egui::accesskit::Toggled;
use eframe::egui::vec2;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use paint::strokes::Action;
use session::{Command, PaintingState};
use studio::panels::Request;
use studio::panels::history::History;

use super::fixture::{Fixture, assert_requests, click, is_disabled, painting, picture, show_panel};

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
    let chosen = |label: &str| harness.get_by_label(label).accesskit_node().toggled();
    assert_eq!(chosen("3 dry 50 %"), Some(Toggled::True));
    assert_eq!(chosen("2 stroke, round"), Some(Toggled::False));
}

#[test]
fn undo_and_redo_request_one_step_and_are_disabled_at_the_ends() {
    let mut harness = history(painting());
    click(&mut harness, "Undo");
    click(&mut harness, "Redo");
    let step = |action| Request::Worker(Command::Apply(action));
    assert_requests(&mut harness, &[step(Action::Undo {}), step(Action::Redo {})]);

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
    let there = |harness: &Harness<'_, Fixture<History>>, place: usize| {
        harness.query_by_label(&format!("{place} stroke {place}")).is_some()
    };
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
    let chosen = studio::theme::DARK.chosen.to_array();
    assert_eq!(at, chosen, "the current entry is marked");
}

#[test]
fn rows_show_the_canvas_after_their_action_and_hovering_enlarges_it() {
    let mut harness = history(painting());
    assert!(harness.query_by_label("Pictures take 3.0 of 24 MiB").is_some());
    if let Some(drawn) = picture(&mut harness, "history-pictures") {
        let red = |row: &str, x: f32| {
            let rect = harness.get_by_label(row).rect();
            let at = drawn.get_pixel((rect.left() + x) as u32, (rect.top() + 5.0) as u32).0;
            i32::from(at[0]) - i32::from(at[1])
        };
        // The third action has no picture, those around it have.
        assert!(red("2 stroke, round", 42.0) > 60, "{}", red("2 stroke, round", 42.0));
        assert!(red("3 dry 50 %", 42.0).abs() < 10, "{}", red("3 dry 50 %", 42.0));
    }
    harness.get_by_label("2 stroke, round").hover();
    harness.run_steps(60);
    assert!(harness.query_by_label("The outline holds what the action changed.").is_some());
    picture(&mut harness, "history-enlarged");
    harness.get_by_label("0 beginning").hover();
    harness.run_steps(60);
    assert!(harness.query_by_label("The outline holds what the action changed.").is_none());
}
