//! A window in which nothing happens draws no frames.

use std::time::Duration;

use eframe::egui::ViewportId;
use paint::strokes::{Action, MaskChange};
use session::Command;

use super::harness::Window;

/// Time after the last frame at which the window wants another one.
fn next_frame(window: &mut Window) -> Duration {
    window.harness().output().viewport_output[&ViewportId::ROOT].repaint_delay
}

/// Draws frames for as many seconds of the window's clock.
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
    window.studio_mut().handle_event(session::Event::Message { text, hint, failed: false });
    pass(&mut window, 1);
    let next = next_frame(&mut window);
    let wanted = Duration::from_secs(2)..=Duration::from_secs(10);
    assert!(wanted.contains(&next), "one frame for its end, none before: {next:?}");
}
