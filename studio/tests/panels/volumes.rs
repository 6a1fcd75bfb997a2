//! The workspace of scenes: the whole window with a real worker and a synthetic pen.

use std::time::{Duration, Instant};

use eframe::egui::{Event, Modifiers, PointerButton, Pos2, vec2};
use session::volumes::Subject;
use studio::app::Volumes;

use super::harness::{Window, button};

/// Time limit of every wait.
const PATIENCE: Duration = Duration::from_secs(60);

/// A window that shows a scene on the village.
fn scene(name: &'static str) -> Window {
    let mut window = Window::open(name);
    let context = window.harness().ctx.clone();
    window.studio_mut().open_scene(&context, Subject::Shape("village".to_owned()));
    wait(&mut window, "the first picture", |volumes| volumes.picture().is_some());
    window
}

fn volumes(window: &Window) -> &Volumes {
    window.studio().volumes.as_ref().unwrap()
}

/// Draws frames until `done`.
fn wait(window: &mut Window, what: &str, done: impl Fn(&Volumes) -> bool) {
    let start = Instant::now();
    while !done(volumes(window)) {
        assert!(start.elapsed() < PATIENCE, "{what} does not come");
        std::thread::sleep(Duration::from_millis(3));
        window.harness().step();
    }
}

/// A point of the picture by its share of width and height.
fn at(window: &Window, x: f32, y: f32) -> Pos2 {
    let rect = volumes(window).rect();
    rect.min + vec2(x, y) * rect.size()
}

#[test]
fn look_at_it() {
    let mut window = scene("volumes");
    let from = at(&window, 0.45, 0.55);
    window.frame(vec![Event::PointerMoved(from)]);
    window.frame(vec![button(from, true)]);
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(2) {
        let x = 0.45 + 0.1 * start.elapsed().as_secs_f32();
        let to = at(&window, x, 0.55);
        std::thread::sleep(Duration::from_millis(8));
        window.frame(vec![Event::PointerMoved(to)]);
    }
    let end = at(&window, 0.65, 0.55);
    window.frame(vec![button(end, false)]);
    window.frame(vec![]);
    window.save("volumes-1");
    let (pos, button, modifiers) =
        (at(&window, 0.6, 0.5), PointerButton::Secondary, Modifiers::NONE);
    window.frame(vec![Event::PointerMoved(pos)]);
    window.frame(vec![Event::PointerButton { pos, button, pressed: true, modifiers }]);
    window.frame(vec![Event::PointerButton { pos, button, pressed: false, modifiers }]);
    wait(&mut window, "the answer", |volumes| volumes.here().is_some());
    window.frame(vec![]);
    window.click("Events");
    window.save("volumes-2");
    window.click("Light");
    window.save("volumes-3");
    window.click("Export");
    window.save("volumes-4");
}
